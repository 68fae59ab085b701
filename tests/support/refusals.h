// A world that is asked for what it must refuse, and its twin that never is: after every test the
// two are still the same, and stay so.
#pragma once

#include <limits>
#include <string>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

class Refusals : public ::testing::Test {
 protected:
  void TearDown() override {
    EXPECT_TRUE(world_.save() == twin_.save());
    EXPECT_EQ(world_.state_hash(), twin_.state_hash());
    EXPECT_EQ(world_.body_count(), twin_.body_count());
    for (int i = 0; i < 60; ++i) {
      world_.step(1.0 / 60);
      twin_.step(1.0 / 60);
      ASSERT_EQ(world_.state_hash(), twin_.state_hash()) << "step " << i;
    }
    EXPECT_TRUE(all_finite(world_));
  }
  static void refused(const Status& status, const std::string& what) {
    EXPECT_FALSE(status.ok()) << what << " was accepted";
    EXPECT_NE(status.code, StatusCode::Ok) << what;
    EXPECT_GE(std::string(status.message).size(), 10u) << what << " has no message";
  }
  PhysicsWorld world_, twin_;
};

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
