// Invariant: every query sees meshes, heightfields and compounds as it sees simple shapes. A level
// surface answers like a half-space under it, a compound like its children as colliders of their
// own, wherever they lie; and what turns fast is stopped by a surface as by a box.
#include <gtest/gtest.h>

#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace surfaces;

const Vector3d kPlace(10, 20, 30);
constexpr double kTurnY = 0.7;

// The same ground twice: once as a surface of 16 m by 16 m about kPlace, once as a half-space.
struct Grounds {
  PhysicsWorld surface, plane;
  explicit Grounds(bool heightfield) {
    const Quat q = turn(kTurnY, Vector3d::UnitY());
    const Shape shape = heightfield
                            ? Shape{Heightfield{field(17, 17, 1, [](int, int) { return 0.0; })}}
                            : Shape{SurfaceMesh{made(grid(0, 16, 0, 16, 11, 7, level, true))}};
    const Vector3d corner = kPlace - wide(q) * Vector3d(8, 0, 8);
    add(surface, body_at(at(corner, q), MotionType::Static), with(shape));
    add(plane, body_at(at(kPlace, Quat::Identity()), MotionType::Static), with(HalfSpace{}));
  }
};
constexpr double kNear = bar(1e-9, 2e-5);  // [m]

class SurfaceQueries : public ::testing::TestWithParam<bool> {};

TEST_P(SurfaceQueries, RaysHitWhereTheyHitAPlane) {
  const Grounds grounds(GetParam());
  oracle::Random random(5);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d from =
        kPlace + Vector3d(random.uniform(-2, 2), random.uniform(0.1, 3), random.uniform(-2, 2));
    const Vector3d path(random.uniform(-2, 2), random.uniform(-5, 2), random.uniform(-2, 2));
    const auto a = grounds.surface.cast_ray(from.cast<PosReal>(), vec(path));
    const auto b = grounds.plane.cast_ray(from.cast<PosReal>(), vec(path));
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (!a) continue;
    ++hits;
    EXPECT_NEAR(a->fraction, b->fraction, kNear) << i;
    EXPECT_LE((wide(a->point) - wide(b->point)).norm(), kNear) << i;
    EXPECT_LE((wide(a->normal) - Vector3d::UnitY()).norm(), kNear) << i;
  }
  EXPECT_GE(hits, 100);
  // From below it is not there.
  EXPECT_FALSE(
      grounds.surface.cast_ray((kPlace - Vector3d::UnitY()).cast<PosReal>(), vec(0, 2, 0)));
}

TEST_P(SurfaceQueries, ShapesMeetItWhereTheyMeetAPlane) {
  const Grounds grounds(GetParam());
  oracle::Random random(6);
  const Shape shapes[] = {sphere(0.3), capsule(0.4, 0.2), box(0.2, 0.3, 0.4),
                          Cylinder{real(0.2), real(0.4)}};
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    ShapeCast cast;
    cast.shape = shapes[i % 4];
    cast.start =
        at(kPlace + Vector3d(random.uniform(-2, 2), random.uniform(1, 3), random.uniform(-2, 2)),
           turn(random.uniform(0, 6), Vector3d(random.uniform(-1, 1), 1, 0.3)));
    cast.translation = vec(random.uniform(-2, 2), random.uniform(-5, 1), random.uniform(-2, 2));
    if (i % 3 == 0) cast.rotation = vec(random.uniform(-3, 3), random.uniform(-3, 3), 1);
    const auto a = grounds.surface.cast_shape(cast), b = grounds.plane.cast_shape(cast);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (!a) continue;
    ++hits;
    // Both stop within a thousandth of the shape's thickness of the ground.
    EXPECT_NEAR(a->fraction, b->fraction, 2e-3) << i;
    EXPECT_GE(a->normal.y(), 0.999) << i;
  }
  EXPECT_GE(hits, 80);
}

TEST_P(SurfaceQueries, DistancesAndOverlapsAreThoseOfAPlane) {
  const Grounds grounds(GetParam());
  oracle::Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Vector3d place =
        kPlace + Vector3d(random.uniform(-2, 2), random.uniform(0.6, 2), random.uniform(-2, 2));
    const auto a = grounds.surface.closest_point(place.cast<PosReal>(), 5);
    ASSERT_TRUE(a.has_value());
    EXPECT_NEAR(a->distance, place.y() - kPlace.y(), kNear);
    EXPECT_LE((wide(a->on_collider) - Vector3d(place.x(), kPlace.y(), place.z())).norm(), kNear);
    const Pose pose = at(place, turn(random.uniform(0, 6), Vector3d(1, 0.5, 0.2)));
    const auto c = grounds.surface.closest_point(box(0.2, 0.3, 0.4), pose, 5);
    const auto d = grounds.plane.closest_point(box(0.2, 0.3, 0.4), pose, 5);
    ASSERT_TRUE(c.has_value() && d.has_value());
    EXPECT_NEAR(c->distance, d->distance, 10 * kNear);
    const Pose low = at(Vector3d(place.x(), kPlace.y() + random.uniform(0.05, 0.6), place.z()),
                        Quat::Identity());
    std::vector<ColliderId> over, under;
    grounds.surface.overlap_shape(sphere(0.3), low, over);
    grounds.plane.overlap_shape(sphere(0.3), low, under);
    EXPECT_EQ(over.size(), under.size()) << low.position.y();
  }
}

INSTANTIATE_TEST_SUITE_P(Both, SurfaceQueries, ::testing::Bool(), [](const auto& which) {
  return std::string(which.param ? "Heightfield" : "Mesh");
});

TEST(CompoundQueries, AnswerLikeTheirChildren) {
  const std::vector<CompoundGeometry::Child> children = {
      child(box(0.5, 0.2, 0.3), {-0.6, 0.1, 0}, turn(0.4, Vector3d(0, 0, 1))),
      child(sphere(0.4), {0.7, 0, 0.2}), child(capsule(0.5, 0.15), {0, 0.6, -0.3})};
  PhysicsWorld whole, apart;
  const Pose pose = at({3, -2, 5}, turn(1.1, Vector3d(1, 2, 0.5)));
  add(whole, body_at(pose, MotionType::Static), with(compound(children)));
  const BodyId body = must(apart.create_body(body_at(pose, MotionType::Static)));
  for (const CompoundGeometry::Child& part : children) {
    Collider collider = with(part.shape);
    collider.pose = part.pose;
    must(apart.create_collider(body, collider));
  }
  oracle::Random random(8);
  int hits = 0, met = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d centre(3, -2, 5);
    const Vector3d from =
        centre + Vector3d(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    const Vector3d path =
        2 * (centre - from) + Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const auto a = whole.cast_ray(from.cast<PosReal>(), vec(path));
    const auto b = apart.cast_ray(from.cast<PosReal>(), vec(path));
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (a) {
      ++hits;
      EXPECT_NEAR(a->fraction, b->fraction, kNear) << i;
    }
    ShapeCast cast;
    cast.shape = box(0.1, 0.2, 0.1);
    cast.start = at(from, Quat::Identity());
    cast.translation = vec(path);
    const auto c = whole.cast_shape(cast), d = apart.cast_shape(cast);
    ASSERT_EQ(c.has_value(), d.has_value()) << i;
    if (c) {
      ++met;
      EXPECT_NEAR(c->fraction, d->fraction, 2e-3) << i;
    }
    const auto e = whole.closest_point(from.cast<PosReal>(), 10);
    const auto f = apart.closest_point(from.cast<PosReal>(), 10);
    ASSERT_TRUE(e && f);
    EXPECT_NEAR(e->distance, f->distance, 10 * kNear) << i;
  }
  EXPECT_GE(hits, 100);
  EXPECT_GE(met, 100);
}

// A rod that spins at 25 turns a second while it falls: its tips go 3 m a step.
TEST(SurfaceContinuous, AFastRodDoesNotTurnIntoAMesh) {
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, 0, 0), MotionType::Static),
      with(SurfaceMesh{made(grid(-20, 20, -20, 20, 20, 20, level, true))}));
  RigidBody rod = moving(at(0, 0.5, 0), vec(0, -1, 0));
  rod.angular_velocity = vec(0, 0, 157);
  const BodyId id = add(world, rod, with(box(1, 0.02, 0.02), material(0.3)));
  double lowest = 1;
  run(world, 1, 1.0 / 60, [&] {
    const Pose pose = world.pose(id);
    for (const double side : {-1.0, 1.0}) {
      const Vector3d tip = wide(pose.position) + wide(pose.orientation) * Vector3d(side, 0, 0);
      lowest = std::min(lowest, tip.y());
    }
  });
  EXPECT_GE(lowest, -0.05);
  EXPECT_TRUE(all_finite(world));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
