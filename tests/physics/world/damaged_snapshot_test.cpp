// Proves that a snapshot with a number no world can hold (not finite, a mass below zero, a rotation
// that is none) is refused and leaves the world as it was, whichever column holds it.
#include <gtest/gtest.h>

#include <limits>

#include "plumb/joint.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

// Boxes in contact, two of them joined.
BodyId build(PhysicsWorld& world) {
  const Built stack = build_stack(world, {.count = 3});
  Joint joint;
  joint.body_a = stack.bodies[0];
  joint.body_b = stack.bodies[1];
  must(world.create_joint(joint));
  run(world, 0.3);
  return stack.bodies[0];
}

// A half-space has no bounds, a joint perhaps no limits; and efforts on a body that became
// non-finite are remembered as they were.
bool need_not_be_finite(const std::string& column) {
  for (const char* start : {"collider.bounds", "body.acceleration", "joint_numbers.", "joint.force",
                            "joint.torque", "joint.effort", "joint.first", "joint.second",
                            "contact.impulse", "contact.friction", "contact.step"})
    if (column.starts_with(start)) return true;
  return false;
}

class DamagedSnapshot : public ::testing::Test {
 protected:
  DamagedSnapshot() {
    build(world_);
    good_ = world_.save();
  }
  // The snapshot with one number changed must be refused by a world that goes on unchanged.
  void refused(std::size_t column, std::size_t at, double value) {
    Snapshot bad = good_;
    bad.columns[column].reals[at] = value;
    EXPECT_EQ(world_.restore(bad).code, StatusCode::BadSnapshot)
        << good_.columns[column].name << " " << at << ": " << value;
  }
  void TearDown() override {
    PhysicsWorld twin;
    must(twin.restore(good_));
    EXPECT_EQ(world_.state_hash(), twin.state_hash());
    EXPECT_EQ(world_.time(), twin.time());
  }
  PhysicsWorld world_;
  Snapshot good_;
};

TEST_F(DamagedSnapshot, NumbersThatAreNotFiniteAreRefusedInEveryColumn) {
  const double inf = std::numeric_limits<double>::infinity();
  int columns = 0;
  for (std::size_t c = 0; c < good_.columns.size(); ++c) {
    const SnapshotColumn& column = good_.columns[c];
    if (column.reals.empty() || need_not_be_finite(column.name)) continue;
    ++columns;
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), inf, -inf}) {
      refused(c, 0, value);
      refused(c, column.reals.size() - 1, value);
    }
  }
  EXPECT_GE(columns, 25);
}

TEST_F(DamagedSnapshot, NegativeMassesAndQuaternionsThatAreNoRotationsAreRefused) {
  for (std::size_t c = 0; c < good_.columns.size(); ++c) {
    const SnapshotColumn& column = good_.columns[c];
    const std::size_t last = column.reals.size() - 1;
    if (column.name == "body.mass") refused(c, last, -1);
    if (column.name == "body.orientation" || column.name == "body.principal_axes" ||
        column.name == "collider.orientation")
      refused(c, last, 30);
  }
}

// What blew up is out of the run; the world goes on, and so does what is restored from it.
TEST(SnapshotAfterQuarantine, IsRestored) {
  PhysicsWorld world;
  const BodyId thrown = build(world);
  const double huge = static_cast<double>(std::numeric_limits<Real>::max()) / 1e3;  // [N s]
  must(world.apply_impulse(thrown, vec(huge, huge, 0)));
  int quarantined = 0;
  for (int i = 0; i < 10; ++i) {
    world.step(1.0 / 60);
    quarantined += static_cast<int>(world.last_report().quarantined);
    PhysicsWorld other;
    must(other.restore(world.save()));
    EXPECT_EQ(other.state_hash(), world.state_hash());
  }
  EXPECT_GE(quarantined, 1);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
