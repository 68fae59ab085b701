// Invariant: wheels and cones are round on triangles too. What rolls over a plane, however that is
// cut into triangles, rolls on as over one box: no seam and no facet of its own slows or lifts it.
// Ramps and curbs of a mesh cost it what mechanics takes, and nothing more.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace surfaces;

constexpr double kDt = 1.0 / 60;  // [s]

// The box floor first: what all others are compared with.
std::vector<FlatGround> all_grounds() {
  std::vector<FlatGround> all = flat_grounds();
  all.insert(all.begin(), {"box", box(65, 1, 20), {55, -1, 0}});
  return all;
}

struct Rolled {
  double slower = 0;  // change of the speed over the speed, at most
  double astray = 0;  // change of the heading [rad], at most
  double hop = 0;     // [m] change of height, at most
};

// A wheel of radius r rolls along a heading without slipping, on ground whose frame is turned by q.
Rolled roll(const FlatGround& ground, const Shape& wheel, double r, double speed, double heading,
            const Quat& q) {
  const Eigen::Quaterniond R = wide(q);
  WorldSettings settings = no_sleep();
  settings.gravity = vec(R * Vector3d(0, -kGravity, 0));
  PhysicsWorld world(settings);
  add(world, body_at(at(R * ground.origin, q), MotionType::Static),
      with(ground.shape, material(0.6)));
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(-heading, Vector3d::UnitY()));
  const Vector3d v0 = R * (turned * Vector3d(speed, 0, 0));
  const Vector3d w0 = R * (turned * Vector3d(0, 0, -speed / r));
  const Quat lying = q * Quat(turned.cast<Real>()) * turn(kPi / 2, Vector3d::UnitX());
  const BodyId id = add(world, moving(at(R * Vector3d(0, r, 0.137), lying), vec(v0), vec(w0)),
                        with(wheel, material(0.6)));
  run(world, 1, kDt);  // settles into the give of its contact
  const auto height = [&] { return (R.conjugate() * position(world, id)).y(); };
  const double level = height();
  const Vector3d v = velocity(world, id);
  Rolled rolled;
  // A hundred metres, or for half a minute.
  run(world, std::round(std::min((100 - speed) / speed, 30.0)), kDt, [&] {
    const Vector3d now = velocity(world, id);
    rolled.slower = std::max(rolled.slower, std::abs(now.norm() / v.norm() - 1));
    rolled.astray = std::max(rolled.astray, now.normalized().cross(v.normalized()).norm());
    rolled.hop = std::max(rolled.hop, std::abs(height() - level));
  });
  return rolled;
}

// In single precision a coordinate of 100 m is rounded to 8e-6 m, and what lies on two points turns
// as they are rounded.
void expect_smooth(const Rolled& rolled, const std::string& what) {
  std::printf("[ figures  ] %s: slower %.2g astray %.2g hop %.2g\n", what.c_str(), rolled.slower,
              rolled.astray, rolled.hop);
  EXPECT_LE(rolled.slower, bar(1e-10, 1e-4)) << what;
  EXPECT_LE(rolled.astray, bar(1e-7, 2e-4)) << what;
  EXPECT_LE(rolled.hop, bar(1e-9, 1e-4)) << what;
}

TEST(RollingOnSurfaces, AWheelOfAnySizeRollsAsOnABox) {
  for (const double r : {0.05, 0.35, 3.0})
    for (const double speed : {0.7, 5.0, 30.0})
      for (const FlatGround& ground : all_grounds())
        expect_smooth(roll(ground, cylinder(0.3 * r, r), r, speed, 0, Quat::Identity()),
                      std::to_string(r) + " m at " + std::to_string(speed) + " on " + ground.name);
}

// Rounded, askew to the seams, and on ground that is tilted against the world's axes (with gravity
// across it), so that no coordinate is a round number.
TEST(RollingOnSurfaces, AWheelRollsAskewAsStraight) {
  const double r = 0.35;
  for (const double rounding : {0.0, 0.07})
    for (const bool tilted : {false, true})
      for (const FlatGround& ground : all_grounds())
        expect_smooth(roll(ground, cylinder(0.1, r - rounding, rounding), r, 5, 0.15,
                           tilted ? turn(0.7, {1, 2, 3}) : Quat(Quat::Identity())),
                      std::string(ground.name) + (tilted ? ", tilted" : "") +
                          (rounding > 0 ? ", rounded" : ""));
}

// A cone on its side rolls about its apex, in a circle: see RoundShapes.ConeRollsInACircleAboutIts-
// Apex. On triangles it keeps as near to it as on a box, and loses as little.
struct Circle {
  double lowest = 1e9, highest = 0, top = 0, energy = 0;
};
Circle roll_cone(const FlatGround& ground) {
  const double r = 0.5, height = 1, alpha = std::atan2(r, height), W = 0.5;
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(ground.origin, Quat::Identity()), MotionType::Static),
      with(ground.shape, material(0.8)));
  const Vector3d along(std::cos(alpha), std::sin(alpha), 0);  // from apex to base
  const Quat q = Quat(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), -along).cast<Real>());
  const double d = 0.75 * height;
  const Vector3d c = d * along, w = -W / std::tan(alpha) * Vector3d::UnitX();
  const Vector3d apex(0.21, 0, 0.37);
  const BodyId body = add(world, body_at(at(apex + 0.5 * height * along, q)),
                          with(cone(height / 2, r), material(0.8)));
  must(world.set_linear_velocity(body, vec(w.cross(c))));
  must(world.set_angular_velocity(body, vec(w)));
  const auto kinetic = [&] {
    const EnergyReport energy = world.energy();
    return energy.kinetic_linear + energy.kinetic_angular;
  };
  const double radius = d * std::cos(alpha), start = kinetic();
  Circle circle;
  run(world, 2 * kPi / W, kDt, [&] {
    const Vector3d p = position(world, body) - apex;
    circle.lowest = std::min(circle.lowest, std::hypot(p.x(), p.z()) / radius);
    circle.highest = std::max(circle.highest, std::hypot(p.x(), p.z()) / radius);
    circle.top = std::max(circle.top, std::abs(p.y() - d * std::sin(alpha)));
  });
  circle.energy = kinetic() / start;
  return circle;
}

TEST(RollingOnSurfaces, AConeRollsItsCircleAsOnABox) {
  const std::vector<FlatGround> grounds = all_grounds();
  const Circle truth = roll_cone(grounds[0]);
  for (const FlatGround& ground : grounds) {
    const Circle circle = roll_cone(ground);
    std::printf("[ figures  ] %s: radius %.6f ... %.6f height off %.2g energy %.6f\n", ground.name,
                circle.lowest, circle.highest, circle.top, circle.energy);
    EXPECT_NEAR(circle.lowest, 1, 2e-3) << ground.name;
    EXPECT_NEAR(circle.highest, 1, 2e-3) << ground.name;
    EXPECT_LE(circle.top, 1e-3) << ground.name;
    EXPECT_NEAR(circle.energy, truth.energy, 2e-3) << ground.name;
  }
}

// Level, a ramp of 10 degrees to a height of 0.5 m, level: seams of both kinds across the way.
double ramp(double x, double) { return std::clamp((x - 3) * std::tan(kPi / 18), 0.0, 0.5); }

TEST(RollingOnSurfaces, AWheelRollsUpARamp) {
  const double r = 0.35, v0 = 3, end = 3 + 0.5 / std::tan(kPi / 18);
  Soup soup;
  for (const double x : {-5.0, 3.0, end, 15.0})
    for (const double z : {-2.0, 2.0}) soup.add({x, ramp(x, z), z});
  for (const std::uint32_t i : {0U, 2U, 4U}) {
    soup.triangle(i, i + 1, i + 3);
    soup.triangle(i, i + 3, i + 2);
  }
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, 0, 0), MotionType::Static),
      with(SurfaceMesh{made(soup)}, material(0.8)));
  const BodyId id = add(
      world,
      moving(at({0, r, 0.1}, turn(kPi / 2, Vector3d::UnitX())), vec(v0, 0, 0), vec(0, 0, -v0 / r)),
      with(cylinder(0.1, r), material(0.8)));
  double last = 0, highest = 0;
  run(world, 4, kDt / 4, [&] {
    EXPECT_GT(position(world, id).x(), last - 1e-6);
    last = position(world, id).x();
    highest = std::max(highest, position(world, id).y());
  });
  // Into the ramp it keeps its angular momentum about the new contact, up the ramp its energy.
  const double slope = kPi / 18, in = v0 * (std::cos(slope) + 0.5) / 1.5;
  const double truth = std::sqrt(in * in - 4.0 / 3 * kGravity * 0.5);
  std::printf("[ figures  ] ramp: x %.4g v %.4g of %.4g highest %.6g z %.2g\n", last,
              velocity(world, id).x(), truth, highest, position(world, id).z());
  EXPECT_GT(last, end + 1);
  EXPECT_NEAR(velocity(world, id).x(), truth, 0.01 * truth);
  EXPECT_LE(highest, 0.5 + r + 1e-3);
  EXPECT_NEAR(position(world, id).z(), 0.1, 2e-3);
}

// Over a curb it keeps its angular momentum about the edge, and then its energy.
TEST(RollingOnSurfaces, AWheelClimbsACurb) {
  const double r = 0.35, v0 = 1.8, curb = 0.05;
  for (const bool as_mesh : {false, true}) {
    PhysicsWorld world(no_sleep());
    add(world, body_at(at(0, 0, 0), MotionType::Static),
        with(SurfaceMesh{made(grid(-5, 10, -3, 3, 15, 6, level))}, material(0.8)));
    const Shape step =
        as_mesh ? Shape{SurfaceMesh{made(box_soup(3, curb, 2))}} : Shape{box(3, curb, 2)};
    add(world, body_at(at(4, 0, 0), MotionType::Static), with(step, material(0.8)));
    const BodyId id = add(world,
                          moving(at({0, r, 0.1}, turn(kPi / 2, Vector3d::UnitX())), vec(v0, 0, 0),
                                 vec(0, 0, -v0 / r)),
                          with(cylinder(0.1, r), material(0.8)));
    double last = 0, highest = 0;
    run(world, 2.5, kDt / 4, [&] {
      EXPECT_GT(position(world, id).x(), last - 1e-6);
      last = position(world, id).x();
      highest = std::max(highest, position(world, id).y());
    });
    const double in = v0 * (1 - 2 * curb / (3 * r));
    const double truth = std::sqrt(in * in - 4.0 / 3 * kGravity * curb);
    std::printf("[ figures  ] curb mesh %d: x %.4g v %.4g of %.4g highest %.6g\n", as_mesh, last,
                velocity(world, id).x(), truth, highest);
    EXPECT_GT(last, 2);
    EXPECT_NEAR(velocity(world, id).x(), truth, 0.02 * truth) << as_mesh;
    EXPECT_LE(highest, curb + r + 1e-3) << as_mesh;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
