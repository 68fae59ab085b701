// Invariant: a compound made again of its own children is the same to the last bit, so that a world
// restored from a snapshot goes on as the one that was saved.
#include "plumb/compound.h"

#include <gtest/gtest.h>

#include "support/build.h"
#include "support/random.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

TEST(Compound, MadeAgainOfItsChildrenHasTheSameBits) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    std::vector<CompoundGeometry::Child> children(3);
    for (CompoundGeometry::Child& child : children) {
      child.shape = Sphere{real(0.1)};
      child.pose.position = vec(random.direction());
      child.pose.orientation = random.rotation(3);
    }
    const auto made = CompoundGeometry::create(children);
    ASSERT_TRUE(made.status.ok()) << made.status.message;
    const auto again = CompoundGeometry::create(made.compound->children());
    ASSERT_TRUE(again.status.ok()) << again.status.message;
    for (std::size_t k = 0; k < children.size(); ++k) {
      const CompoundGeometry::Child &a = made.compound->children()[k],
                                    &b = again.compound->children()[k];
      EXPECT_EQ(a.pose.position, b.pose.position);
      EXPECT_EQ(a.pose.orientation.coeffs(), b.pose.orientation.coeffs());
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
