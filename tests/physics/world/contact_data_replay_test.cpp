// Proves that contact data belong to the state: belts, one-way passages, material pairs, filters,
// exclusions and turning friction give the same bits for any number of threads, after restore in
// the middle and when recorded inputs are played back; bad input is refused and changes nothing.
#include <gtest/gtest.h>

#include <limits>

#include "support/measure.h"
#include "support/replay_checks.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

struct Scene {
  std::vector<BodyId> bodies;
  ColliderId belt, shelf;
  BodyId floor;
};

// Bodies thrown up through plates onto a belt, resisting, sensed, grouped.
Scene build(PhysicsWorld& world) {
  Scene scene;
  Material ground = material(0.6);
  ground.kind = 1;
  scene.floor = add_slab(world, 20, 20, ground);
  Collider belt = with(box(4, 0.05, 4), material(0.5));
  belt.one_way = vec(0, 1, 0);
  belt.surface_velocity = {vec(0.5, 0, 0), vec(0, 0.3, 0)};
  const BodyId carrier = add(world, body_at(at(0, 2, 0), MotionType::Static), belt);
  scene.belt = world.colliders_of(carrier)[0];
  Collider shelf = with(box(3, 0.1, 3));
  shelf.one_way = vec(0.2, 1, 0);
  RigidBody lift = body_at(at(0, 4, 0), MotionType::Kinematic);
  lift.linear_velocity = vec(0, 0.3, 0);
  lift.angular_velocity = vec(0, 0.2, 0.05);
  scene.shelf = world.colliders_of(add(world, lift, shelf))[0];
  Collider zone = with(cube(1.5));
  zone.is_sensor = true;
  add(world, body_at(at(0, 3, 0), MotionType::Static), zone);
  for (int i = 0; i < 48; ++i) {
    Collider collider = with(i % 3 == 0   ? Shape(sphere(0.2))
                             : i % 3 == 1 ? Shape(cube(0.2))
                                          : Shape(capsule(0.15, 0.15)),
                             material(0.6, i % 5 == 0 ? 0.5 : 0));
    collider.material.kind = static_cast<std::uint32_t>(i % 4);
    collider.material.rolling_friction = real(i % 2 == 0 ? 0.01 : 0);
    collider.material.torsional_friction = real(0.005);
    if (i % 4 == 1) collider.material.grain = vec(1, 0, 1);
    collider.material.grain_friction = real(0.2);
    collider.material.adhesion = real(i % 6 == 3 ? 50 : 0);
    collider.filter.group = i % 7 == 0 ? -2 : i % 11 == 0 ? 5 : 0;
    RigidBody body = moving(at(0.9 * (i % 6) - 2.2, 0.5 + 0.45 * (i / 12), 0.9 * (i / 6 % 6) - 2),
                            vec(0.3 * (i % 4), 4 + i % 9, 0.1 * i), vec(i % 3, 1, 0));
    scene.bodies.push_back(add(world, body, collider));
  }
  must(world.set_material_pair(1, 2, MaterialPair{.friction = real(0.05)}));
  must(world.set_material_pair(
      2, 3, MaterialPair{.restitution = real(0.9), .rolling_friction = real(0.1)}));
  must(world.exclude_pair(scene.bodies[1], scene.floor));
  must(world.exclude_pair(world.colliders_of(scene.bodies[2])[0], scene.belt));
  return scene;
}

void disturb(PhysicsWorld& world, const Scene& scene, int step) {
  const double t = step * 0.01;
  if (step % 40 == 13)
    must(world.set_surface_velocity(scene.belt, {vec(t, 0, -t), vec(0, 1 - t, 0)}));
  if (step == 50) must(world.set_material_pair(1, 2, std::nullopt));
  if (step == 70)
    must(world.set_material_pair(
        1, 3, MaterialPair{.friction = real(0.01), .torsional_friction = real(0.2)}));
  if (step == 90) must(world.exclude_pair(scene.bodies[4], scene.bodies[10]));
  if (step == 95) must(world.exclude_pair(world.colliders_of(scene.bodies[5])[0], scene.shelf));
  if (step == 120) must(world.exclude_pair(scene.bodies[1], scene.floor, false));
  if (step == 130) must(world.set_filter(scene.belt, {1, 0xffffffffu, -2147483647 - 1}));
  if (step == 140) must(world.destroy_body(scene.bodies[4]));
  if (step == 150)
    must(world.exclude_pair(world.colliders_of(scene.bodies[5])[0], scene.shelf, false));
}

constexpr DisturbedRun<Scene> kRun{build, disturb, 240};

TEST(ContactDataReplay, AnyNumberOfThreads) { expect_same_with_threads(kRun); }

TEST(ContactDataReplay, SaveAndRestoreInTheMiddle) {
  expect_same_after_restore(kRun,
                            [](int step, bool disturbed) { return !disturbed && step % 20 == 7; });
}

TEST(ContactDataReplay, RecordedInputsReplayIntoAnEmptyWorld) { expect_same_in_replay(kRun); }

// Every column of the new tables damaged in turn: refused, never read outside, nothing changed.
TEST(ContactDataReplay, DamagedColumnsAreRefused) {
  PhysicsWorld world;
  build(world);
  run(world, 0.5);
  const Snapshot good = world.save();
  int looked_at = 0;
  for (const SnapshotColumn& column : good.columns) {
    const bool ours = column.name.starts_with("material_pair.") ||
                      column.name.starts_with("excluded.") || column.name == "pair.passage";
    if (!ours) continue;
    ++looked_at;
    const auto damaged = [&](auto&& damage) {
      Snapshot bad = good;
      for (SnapshotColumn& c : bad.columns)
        if (c.name == column.name) damage(c);
      PhysicsWorld other;
      EXPECT_EQ(other.restore(bad).code, StatusCode::BadSnapshot) << column.name;
      EXPECT_EQ(other.body_count(), 0u);
    };
    damaged([](SnapshotColumn& c) {
      c.type = c.type == SnapshotColumn::Type::Uint64 ? SnapshotColumn::Type::Float64
                                                      : SnapshotColumn::Type::Uint64;
    });
    if (column.type == SnapshotColumn::Type::Uint64 && column.name != "material_pair.has")
      damaged([](SnapshotColumn& c) { c.integers.back() = 0xffu; });
    if (column.type == SnapshotColumn::Type::Float64)
      damaged([](SnapshotColumn& c) { c.reals[0] = -1; });
  }
  EXPECT_EQ(looked_at, 6);
}

TEST(ContactDataReplay, BadInputIsRefusedAndChangesNothing) {
  PhysicsWorld world;
  const Scene scene = build(world);
  run(world, 0.2);
  const Snapshot before = world.save();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf}) {
    EXPECT_EQ(world.set_surface_velocity(scene.belt, {vec(0, bad, 0), Vec3::Zero()}).code,
              StatusCode::NotFinite);
    EXPECT_EQ(world.set_surface_velocity(scene.belt, {Vec3::Zero(), vec(0, 0, bad)}).code,
              StatusCode::NotFinite);
    Collider collider = with(sphere(1));
    collider.one_way = vec(bad, 0, 0);
    EXPECT_FALSE(world.create_collider(scene.floor, collider).ok());
    collider = with(sphere(1));
    collider.surface_velocity.linear = vec(0, 0, bad);
    EXPECT_FALSE(world.create_collider(scene.floor, collider).ok());
    collider = with(sphere(1));
    collider.material.rolling_friction = real(bad);
    EXPECT_FALSE(world.create_collider(scene.floor, collider).ok());
    collider = with(sphere(1));
    collider.material.torsional_friction = real(-1);
    EXPECT_FALSE(world.create_collider(scene.floor, collider).ok());
  }
  EXPECT_EQ(world.set_surface_velocity(ColliderId{}, {}).code, StatusCode::StaleHandle);
  for (const InputKind kind :
       {InputKind::SetSurfaceVelocity, InputKind::SetFilter, InputKind::SetMaterialPair,
        InputKind::ExcludeBodyPair, InputKind::ExcludeColliderPair}) {
    EXPECT_FALSE(world.apply_input({kind, scene.belt.value(), {}}).ok()) << name_of(kind);
    EXPECT_FALSE(world.apply_input({kind, scene.belt.value(), {0.5, -1, nan}}).ok());
    EXPECT_NE(std::string(name_of(kind)), "unknown");
  }
  EXPECT_FALSE(world.apply_input({InputKind::SetFilter, scene.belt.value(), {1, 1, 3e9}}).ok());
  EXPECT_TRUE(world.save() == before);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
