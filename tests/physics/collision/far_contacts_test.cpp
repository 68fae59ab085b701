// Invariant: a contact is the same wherever in the world it is: far from the origin (1e6 m; 1e3 m
// where positions are single) every pair of shapes meets as deep, and along the same normal, as at
// the origin.
#include <gtest/gtest.h>

#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace surfaces;

double bumps(double x, double z) { return 0.2 * std::sin(1.3 * x) * std::cos(0.9 * z); }

std::vector<std::pair<const char*, Shape>> moving_shapes() {
  return {{"sphere", sphere(0.4)},
          {"capsule", capsule(0.4, 0.2)},
          {"box", box(0.4, 0.3, 0.5)},
          {"rounded box", rounded_box(0.3, 0.2, 0.4, 0.1)},
          {"hull", ConvexHull{oracle::prism(5, 0.4, 0.3)}},
          {"cylinder", cylinder(0.3, 0.4)},
          {"rounded cylinder", cylinder(0.2, 0.3, 0.1)},
          {"cone", cone(0.4, 0.3)},
          {"compound",
           compound({child(box(0.5, 0.1, 0.1), {0, 0, 0}), child(sphere(0.3), {0.5, 0, 0})})}};
}

std::vector<std::pair<const char*, Shape>> standing_shapes() {
  std::vector<std::pair<const char*, Shape>> all = moving_shapes();
  all.push_back({"half-space", HalfSpace{}});
  all.push_back({"mesh", SurfaceMesh{made(grid(-3, 3, -3, 3, 7, 7, bumps))}});
  all.push_back({"heightfield",
                 Heightfield{field(9, 9, 0.8, [](int i, int k) { return bumps(i, 0.7 * k); })}});
  return all;
}

bool is_curved(const Shape& shape) {
  return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape);
}

struct Meeting {
  bool met = false;
  double separation = 0;
  Vector3d normal{0, 0, 0};
};

// The deepest contact as a step begins that moves nothing.
Meeting meet(const Shape& standing, const Pose& stand, const Shape& moving_shape, const Pose& place,
             const Vector3d& origin) {
  WorldSettings settings = no_gravity();
  settings.sleeping = false;
  PhysicsWorld world(settings);
  const auto moved = [&](Pose pose) {
    pose.position += pos(origin);
    return pose;
  };
  add(world, body_at(moved(stand), MotionType::Static), with(standing));
  add(world, body_at(moved(place)), with(moving_shape));
  world.step(1e-7);
  Meeting meeting;
  for (const ContactState& c : contacts(world)) {
    for (int i = 0; i < c.point_count; ++i) {
      const double s = static_cast<double>(c.points[i].separation);
      if (meeting.met && !(s < meeting.separation)) continue;
      meeting = {true, s, wide(c.normal)};
    }
  }
  return meeting;
}

// Centres of mass that are not the shape's origin are rounded once more where positions are single:
// by half a unit in the last place of 1e3 m, in two bodies and three axes [m].
bool is_off_centre(const Shape& shape) {
  return std::holds_alternative<Cone>(shape) || std::holds_alternative<Compound>(shape);
}
constexpr double kRounding = 2 * 1.733 * 3.06e-5;  // [m]

// Single positions hold these numbers exactly up to 1e3 m, so that only what the engine itself
// makes of a far place could tell the two apart.
constexpr bool kDoublePositions = sizeof(PosReal) == sizeof(double);
constexpr double kFar = kDoublePositions ? 1e6 : 1e3;  // [m]
double exact(double x) { return kDoublePositions ? x : std::round(x * 1024) / 1024; }
Vector3d exact(const Vector3d& v) { return {exact(v.x()), exact(v.y()), exact(v.z())}; }

TEST(FarContacts, FarAwayShapesMeetAsAtTheOrigin) {
  oracle::Random random(41);
  int met = 0;
  for (const auto& [below, standing] : standing_shapes()) {
    for (const auto& [above, shape] : moving_shapes()) {
      for (int trial = 0; trial < 12; ++trial) {
        const bool is_field = std::holds_alternative<Heightfield>(standing);
        const Pose stand = at(is_field ? exact(Vector3d(-3.2, 0, -3.2)) : Vector3d(0, 0, 0),
                              turn(random.uniform(-0.1, 0.1), {1, 2, 3}));
        const Pose place = at(
            exact({random.uniform(-0.3, 0.3), random.uniform(0.1, 1.0), random.uniform(-0.3, 0.3)}),
            turn(random.uniform(-3, 3), random.direction()));
        const Vector3d far =
            exact(Vector3d(kFar, -kFar, kFar) +
                  Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        const Meeting here = meet(standing, stand, shape, place, {0, 0, 0});
        const Meeting there = meet(standing, stand, shape, place, far);
        const std::string what = std::string(above) + " on " + below;
        // What lies within rounding of the margin may count on one side only.
        if (here.met != there.met) {
          EXPECT_GT(here.met ? here.separation : there.separation, 1e-3) << what;
          continue;
        }
        if (!here.met) continue;
        ++met;
        // A coordinate of 1e6 m is rounded to 1.2e-10 m, in two bodies and three axes. The least
        // way out of a cylinder or cone is found by a search, and near it the depth hardly changes.
        const bool sought = is_curved(standing) || is_curved(shape);
        const bool rounds = !kDoublePositions && (is_off_centre(standing) || is_off_centre(shape));
        const double rounding = rounds ? kRounding : 0;
        EXPECT_NEAR(here.separation, there.separation, (sought ? 2e-6 : bar(1e-9, 2e-6)) + rounding)
            << what << " " << trial;
        EXPECT_LT((here.normal - there.normal).norm(),
                  (sought ? 2e-4 : bar(1e-6, 2e-4)) + rounding / 0.1)
            << what << " " << trial;
      }
    }
  }
  EXPECT_GT(met, 400);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
