// Proves that no input can hurt a world: every bad number, shape, mass or handle is refused with a
// status and a sentence, nothing changes, and all bodies go on bit for bit as in a world that was
// never asked.
#include <gtest/gtest.h>

#include <functional>

#include "support/measure.h"
#include "support/refusals.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// A small lively scene.
class BadInput : public Refusals {
 protected:
  BadInput() {
    for (PhysicsWorld* w : {&world_, &twin_}) {
      const Built stack = build_stack(*w, {.count = 3, .gap = 0.1});
      ground_ = stack.ground;
      box_ = stack.bodies[0];
      spinner_ = add(*w, moving(at(5, 3, 0), vec(1, 2, 3), vec(4, 5, 6)), with(box(0.2, 0.3, 0.4)));
      run(*w, 0.2);
    }
  }
  void refused_body(const RigidBody& body, const std::string& what) {
    const Created<BodyId> made = world_.create_body(body);
    refused(made.status, what);
    EXPECT_TRUE(made.id.is_null()) << what;
  }
  void refused_collider(const Collider& collider, const std::string& what) {
    const Created<ColliderId> made = world_.create_collider(spinner_, collider);
    refused(made.status, what);
    EXPECT_TRUE(made.id.is_null()) << what;
  }

  BodyId ground_, box_, spinner_;
};

TEST_F(BadInput, Masses) {
  const auto with_mass = [](double mass) {
    RigidBody body = free_body(1, {1, 1, 1});
    body.mass->mass = mass;
    return body;
  };
  for (double mass : {0.0, -1.0, kInf, -kInf, kNan})
    refused_body(with_mass(mass), "mass " + std::to_string(mass));
}

TEST_F(BadInput, Inertias) {
  const auto with_moments = [](const Vector3d& moments) { return free_body(1, moments); };
  refused_body(with_moments({-1, 1, 1}), "negative moment");
  refused_body(with_moments({kNan, 1, 1}), "NaN moment");
  refused_body(with_moments({kInf, 1, 1}), "infinite moment");
  refused_body(with_moments({1, 1, 3}), "moments against the triangle inequality");
  RigidBody skew = free_body(1, {1, 1, 1});
  skew.mass->I_Bcm_B(0, 1) = 0.3;
  refused_body(skew, "asymmetric tensor");
  RigidBody indefinite = free_body(1, {1, 1, 1});
  indefinite.mass->I_Bcm_B(0, 1) = indefinite.mass->I_Bcm_B(1, 0) = 2;
  refused_body(indefinite, "indefinite tensor");
  RigidBody centre = free_body(1, {1, 1, 1});
  centre.mass->center = {0, kNan, 0};
  refused_body(centre, "NaN centre of mass");
}

TEST_F(BadInput, PosesAndVelocities) {
  for (double bad : {kNan, kInf, -kInf}) {
    RigidBody body = body_at(at(0, bad, 0));
    refused_body(body, "position");
    body = body_at(at(0, 0, 0));
    body.linear_velocity = vec(bad, 0, 0);
    refused_body(body, "linear velocity");
    body = body_at(at(0, 0, 0));
    body.angular_velocity = vec(0, 0, bad);
    refused_body(body, "angular velocity");
    body = body_at(at(0, 0, 0));
    body.pose.orientation.w() = real(bad);
    refused_body(body, "orientation");
  }
  RigidBody zero = body_at(at(0, 0, 0));
  zero.pose.orientation.coeffs().setZero();
  refused_body(zero, "zero quaternion");
}

TEST_F(BadInput, BodyNumbers) {
  for (double bad : {-1.0, kNan, kInf}) {
    RigidBody body = free_body(1, {1, 1, 1});
    body.linear_damping = real(bad);
    refused_body(body, "linear damping");
    body = free_body(1, {1, 1, 1});
    body.angular_damping = real(bad);
    refused_body(body, "angular damping");
  }
  RigidBody body = free_body(1, {1, 1, 1});
  body.gravity_scale = real(kNan);
  refused_body(body, "gravity scale");
  body = free_body(1, {1, 1, 1});
  body.type = static_cast<MotionType>(77);
  refused_body(body, "motion type");
}

TEST_F(BadInput, Frictions) {
  for (double bad : {-1.0, kNan, kInf})
    refused_collider(with(sphere(1), material(bad)), "friction");
}

TEST_F(BadInput, Restitutions) {
  for (double bad : {2.0, -0.1, kNan, kInf})
    refused_collider(with(sphere(1), material(0.5, bad)), "restitution");
}

TEST_F(BadInput, Densities) {
  for (double bad : {-1.0, kNan, kInf}) refused_collider(with(sphere(1), {}, bad), "density");
}

TEST_F(BadInput, Extents) {
  // 1e-30 m has a volume of 1e-90 m^3: no mass that a float could hold.
  for (double bad : {0.0, -1.0, 1e-30, kNan, kInf}) {
    const std::string what = "extent " + std::to_string(bad);
    refused_collider(with(sphere(bad)), "sphere " + what);
    refused_collider(with(box(1, bad, 1)), "box " + what);
    refused_collider(with(capsule(1, bad)), "capsule radius " + what);
    refused_collider(with(capsule(bad, 1)), "capsule length " + what);
  }
}

TEST_F(BadInput, Planes) {
  refused_collider(with(HalfSpace{}), "half-space on a dynamic body");
  const auto on_ground = [&](const HalfSpace& plane, const std::string& what) {
    const Created<ColliderId> made = world_.create_collider(ground_, with(plane));
    refused(made.status, what);
    EXPECT_TRUE(made.id.is_null()) << what;
  };
  on_ground({vec(0, 0, 0), 0}, "normal of length zero");
  on_ground({vec(kNan, 0, 0), 0}, "NaN normal");
  on_ground({vec(0, 1, 0), real(kInf)}, "infinite offset");
}

TEST_F(BadInput, ColliderPoses) {
  Collider collider = with(sphere(1));
  collider.pose.position = vec(kNan, 0, 0);
  refused_collider(collider, "position");
  collider = with(sphere(1));
  collider.pose.orientation.coeffs().setZero();
  refused_collider(collider, "zero quaternion");
  collider = with(sphere(1));
  collider.pose.orientation.coeffs().setConstant(real(kNan));
  refused_collider(collider, "NaN quaternion");
}

TEST_F(BadInput, Hulls) {
  refused_collider(with(ConvexHull{}), "hull without geometry");
  const std::vector<Vec3> corners = {vec(0, 0, 0), vec(1, 0, 0), vec(0, 1, 0), vec(0, 0, 1)};
  const std::vector<std::uint32_t> sizes = {3, 3, 3, 3};
  const std::vector<std::uint32_t> faces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  ASSERT_TRUE(HullGeometry::create(corners, sizes, faces).status.ok());
  const auto bad = [](const std::vector<Vec3>& v, const std::vector<std::uint32_t>& s,
                      const std::vector<std::uint32_t>& f, const std::string& what) {
    const HullGeometry::Result made = HullGeometry::create(v, s, f);
    refused(made.status, what);
    EXPECT_EQ(made.hull, nullptr) << what;
  };
  bad({}, {}, {}, "nothing");
  std::vector<Vec3> flat = corners, broken = corners;
  flat[3] = vec(1, 1, 0);
  bad(flat, sizes, faces, "flat");
  broken[2] = vec(0, kNan, 0);
  bad(broken, sizes, faces, "NaN vertex");
  std::vector<std::uint32_t> outside = faces, inside_out = faces;
  outside[5] = 9;
  bad(corners, sizes, outside, "vertex that does not exist");
  for (std::size_t i = 0; i < 12; i += 3) std::swap(inside_out[i], inside_out[i + 1]);
  bad(corners, sizes, inside_out, "inside out");
  bad(corners, {3, 3, 3}, {0, 2, 1, 0, 1, 3, 0, 3, 2}, "open");
  bad(corners, {3, 3, 3, 2}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2}, "face of two vertices");
  bad(corners, {3, 3, 3, 9}, faces, "sizes that do not add up");
}

TEST_F(BadInput, ForcesAndImpulses) {
  for (double bad : {kNan, kInf, -kInf}) {
    const Vec3 v = vec(0, bad, 0), good = vec(1, 0, 0);
    const Pos3 p = pos(bad, 0, 0), here = pos(0, 0, 0);
    refused(world_.apply_force(box_, v), "force");
    refused(world_.apply_force_at(box_, v, here), "force at");
    refused(world_.apply_force_at(box_, good, p), "force at a bad point");
    refused(world_.apply_force_at_body_point(box_, good, v), "force at a bad body point");
    refused(world_.apply_force_at_body_point(box_, v, good), "bad force at a body point");
    refused(world_.apply_torque(box_, v), "torque");
    refused(world_.apply_impulse(box_, v), "impulse");
    refused(world_.apply_impulse_at(box_, v, here), "impulse at");
    refused(world_.apply_impulse_at(box_, good, p), "impulse at a bad point");
    refused(world_.apply_impulse_at_body_point(box_, good, v), "impulse at a bad body point");
    refused(world_.apply_impulse_at_body_point(box_, v, good), "bad impulse at a body point");
    refused(world_.apply_angular_impulse(box_, v), "angular impulse");
    refused(world_.set_linear_velocity(box_, v), "linear velocity");
    refused(world_.set_angular_velocity(box_, v), "angular velocity");
    Pose pose;
    pose.position = p;
    refused(world_.set_pose(box_, pose), "pose");
  }
  Pose zero;
  zero.orientation.coeffs().setZero();
  refused(world_.set_pose(box_, zero), "pose with a zero quaternion");
  MassProperties none;
  refused(world_.set_mass(box_, none), "mass properties without mass");
}

TEST_F(BadInput, ActingOnImmovableBodies) {
  refused(world_.apply_force(ground_, vec(1, 0, 0)), "force on a static body");
  refused(world_.apply_impulse(ground_, vec(1, 0, 0)), "impulse on a static body");
  refused(world_.apply_torque(ground_, vec(1, 0, 0)), "torque on a static body");
  refused(world_.set_linear_velocity(ground_, vec(1, 0, 0)), "velocity of a static body");
}

TEST_F(BadInput, NullHandles) {
  const BodyId none;
  refused(world_.destroy_body(none), "destroy");
  refused(world_.apply_force(none, vec(1, 0, 0)), "force");
  refused(world_.set_pose(none, Pose{}), "pose");
  refused(world_.set_awake(none, true), "awake");
  refused(world_.destroy_collider(ColliderId{}), "destroy collider");
  refused(world_.create_collider(none, with(sphere(1))).status, "collider of nothing");
  EXPECT_FALSE(world_.is_valid(none));
}

TEST_F(BadInput, HandlesThatNeverWere) {
  for (const BodyId id : {BodyId{99999, 1}, BodyId{box_.index, box_.generation + 5},
                          BodyId{0xffffffffu, 0xffffffffu}}) {
    refused(world_.destroy_body(id), "destroy");
    refused(world_.apply_impulse(id, vec(1, 0, 0)), "impulse");
    EXPECT_FALSE(world_.is_valid(id));
    EXPECT_EQ(world_.linear_velocity(id), Vec3::Zero());  // default values, no crash
    EXPECT_TRUE(world_.colliders_of(id).empty());
    EXPECT_EQ(world_.mass_properties(id).mass, 0);
  }
  EXPECT_FALSE(world_.is_valid(ColliderId{12345, 1}));
  EXPECT_TRUE(world_.body_of(ColliderId{12345, 1}).is_null());
}

TEST_F(BadInput, Settings) {
  const auto refused_settings = [&](const std::function<void(WorldSettings&)>& spoil,
                                    const std::string& what) {
    WorldSettings settings;
    spoil(settings);
    refused(check(settings), what);
    refused(world_.set_settings(settings), what);
  };
  refused_settings([](WorldSettings& s) { s.gravity = vec(0, kNan, 0); }, "gravity");
  refused_settings([](WorldSettings& s) { s.substeps = 0; }, "substeps 0");
  refused_settings([](WorldSettings& s) { s.substeps = 65; }, "substeps 65");
  refused_settings([](WorldSettings& s) { s.substeps = -4; }, "substeps -4");
  refused_settings([](WorldSettings& s) { s.contact_frequency = 0; }, "contact frequency");
  refused_settings([](WorldSettings& s) { s.contact_frequency = real(kNan); }, "contact frequency");
  refused_settings([](WorldSettings& s) { s.contact_damping_ratio = -1; }, "damping ratio");
  refused_settings([](WorldSettings& s) { s.time_to_sleep = -1; }, "time to sleep");
  refused_settings([](WorldSettings& s) { s.rotation = static_cast<RotationMethod>(9); },
                   "rotation");
}

TEST_F(BadInput, Snapshots) {
  const Snapshot good = world_.save();
  Snapshot bad = good;
  bad.schema_version += 1;
  refused(world_.restore(bad), "other schema");
  bad = good;
  bad.precision = "f16";
  refused(world_.restore(bad), "other precision");
  bad = Snapshot{};
  refused(world_.restore(bad), "empty");
  for (std::size_t i = 0; i < good.columns.size(); ++i) {
    const SnapshotColumn& column = good.columns[i];
    bad = good;
    bad.columns.erase(bad.columns.begin() + static_cast<long>(i));
    refused(world_.restore(bad), "without " + column.name);
    const bool reals = column.type == SnapshotColumn::Type::Float64;
    if (reals ? column.reals.empty() : column.integers.empty()) continue;
    bad = good;
    if (reals) {
      bad.columns[i].reals.pop_back();
    } else {
      bad.columns[i].integers.pop_back();
    }
    refused(world_.restore(bad), "cut short: " + column.name);
  }
}

TEST_F(BadInput, Inputs) {
  refused(world_.apply_input({static_cast<InputKind>(9999), 0, {}}), "unknown kind");
  refused(world_.apply_input({InputKind::ApplyForce, box_.value(), {}}), "no numbers");
  refused(world_.apply_input({InputKind::ApplyForce, box_.value(), {1, 2}}), "too few numbers");
  refused(world_.apply_input({InputKind::ApplyForce, 0, {1, 2, 3}}), "no target");
  refused(world_.apply_input({InputKind::ApplyForce, box_.value(), {1, kNan, 3}}), "NaN");
  refused(world_.apply_input({InputKind::CreateBody, 0, {1, 2, 3}}), "half a body");
  refused(world_.apply_input({InputKind::CreateCollider, box_.value(), {7}}), "half a collider");
}

// A world made with bad settings says nothing (constructors cannot) but runs with the defaults.
TEST(BadInputConstruction, BadSettingsAreReplacedByTheDefaults) {
  WorldSettings bad;
  bad.gravity = vec(0, kNan, 0);
  PhysicsWorld world(bad);
  EXPECT_TRUE(check(world.settings()).ok());
  EXPECT_EQ(world.settings().gravity, WorldSettings{}.gravity);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
