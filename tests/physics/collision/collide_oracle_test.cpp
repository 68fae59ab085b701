// Invariant: for every pair of shapes, in thousands of random and degenerate poses from 1 mm to 10
// km, the manifold tells the true depth or distance, its normal is a direction in which the shapes
// have that room, every point lies on both surfaces, and swapping the shapes changes nothing but
// the sign of the normal. The truth comes from trying every feature against every feature in double
// precision.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collide_checks.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::Scene;
using oracle::V;

constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

CollisionShape random_shape(Random& random, ShapeType type, double size) {
  const auto side = [&] { return static_cast<Real>(size * random.uniform(0.2, 1)); };
  switch (type) {
    case ShapeType::Sphere:
      return make_collision_shape(Sphere{side()});
    case ShapeType::Capsule:
      return make_collision_shape(Capsule{side(), side()});
    case ShapeType::Box:
      return make_collision_shape(Box{Vec3(side(), side(), side())});
    case ShapeType::Hull:
      break;
    case ShapeType::HalfSpace:
    case ShapeType::Cylinder:
    case ShapeType::Cone:
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      break;
  }
  const auto geometry =
      random.below(2) == 0
          ? oracle::random_hull(random, 5 + random.below(9), size)
          : oracle::prism(3 + random.below(6), size, size * random.uniform(0.3, 1));
  return make_collision_shape(ConvexHull{geometry});
}

double reach(const CollisionShape& s) { return static_cast<double>(bounding_radius(s)); }
double half_thickness(const CollisionShape& s) {
  return 0.5 * static_cast<double>(smallest_thickness(s));
}

// Aligned poses, where edges and faces are parallel and centres coincide, are a third of all.
Scene random_scene(Random& random, ShapeType type_a, ShapeType type_b, double size) {
  Scene s;
  s.a = random_shape(random, type_a, size);
  s.b = random_shape(random, type_b, size * random.scale(0.1, 10));
  const int kind = random.below(6);
  const Real h = std::sqrt(Real(0.5));
  const Rotation aligned[4] = {
      {0, 0, 0, 1}, {h, 0, 0, h}, {0, 0, h, h}, {Real(0.5), Real(0.5), Real(0.5), Real(0.5)}};
  s.xa = {{0, 0, 0}, kind < 2 ? aligned[random.below(4)] : random.rotation()};
  s.xb.q = kind < 2 ? aligned[random.below(4)] : random.rotation();
  const double sum = reach(s.a) + reach(s.b);
  V away = random.direction();
  if (kind == 0) away = V::Unit(random.below(3));
  const double distance = random.below(20) == 0 ? 0.0 : sum * random.uniform(0, 1.1);
  s.margin = static_cast<Real>(random.uniform(0, 0.3) * std::min(reach(s.a), reach(s.b)));
  // Somewhere within reach of the common reference point.
  const V pa = sum * random.direction(), pb = pa + distance * away;
  s.xa.p = {static_cast<Real>(pa.x()), static_cast<Real>(pa.y()), static_cast<Real>(pa.z())};
  s.xb.p = {static_cast<Real>(pb.x()), static_cast<Real>(pb.y()), static_cast<Real>(pb.z())};
  if (random.below(2) == 0) {
    // Half of the poses touch, or nearly: overlap by little or lie apart by less than the margin
    // along the direction of approach.
    const double room = room_along(oracle::solid_of(s.a, s.xa), oracle::solid_of(s.b, s.xb), away);
    const V moved = pb + (random.uniform(-0.3, 1) * static_cast<double>(s.margin) - room) * away;
    s.xb.p = {static_cast<Real>(moved.x()), static_cast<Real>(moved.y()),
              static_cast<Real>(moved.z())};
  }
  return s;
}

// The bounds, in metres, for one scene.
struct Bounds {
  double depth;    // of the deepest point against the truth
  double room;     // of the room along the normal against the truth
  double surface;  // of each point against both surfaces
};
Bounds bounds_for(const Scene& s, bool apart) {
  const double thickness = std::min(half_thickness(s.a), half_thickness(s.b));
  // Rounding of the result: positions are as far out as `sum`, hull planes as large as their hull.
  const double rounding = 16 * kEpsilon * (reach(s.a) + reach(s.b));
  const bool polyhedron = s.a.radius == 0 || s.b.radius == 0;
  Bounds bounds{rounding, rounding, rounding};
  if (polyhedron && !(s.a.type == ShapeType::Sphere || s.b.type == ShapeType::Sphere)) {
    // A preferred face, a tie for the deepest; corners beside a face by the clip band, which at a
    // sharp corner of the other face (29 degrees) leaves them four times as far.
    const double preferred = kFacePreference + kDeepestTie;
    bounds.depth += (apart ? kAttained + kDeepestTie : preferred) * thickness;
    bounds.room += preferred * thickness;
    bounds.surface += (4 * kClipBand + (apart ? 0 : preferred)) * thickness;
  }
  // A capsule on another at a small angle bulges towards it by half the tilt squared.
  if (s.a.type == ShapeType::Capsule && s.b.type == ShapeType::Capsule) {
    bounds.surface +=
        0.6 * kParallelTilt * kParallelTilt * static_cast<double>(s.a.radius + s.b.radius);
  }
  return bounds;
}

struct Worst {
  double depth = 0, surface = 0, normal = 0;  // parts of the allowed bound, or |n| - 1 in epsilon
  double raw_depth = 0, raw_surface = 0;      // parts of the thinner shape's half thickness
  int hits = 0, overlaps = 0, points = 0;
};

void check_scene(const Scene& s, Worst& worst) {
  const oracle::Solid a = oracle::solid_of(s.a, s.xa), b = oracle::solid_of(s.b, s.xb);
  const double truth = signed_distance(a, b);
  const Bounds bounds = bounds_for(s, truth > 0);
  const double margin = static_cast<double>(s.margin);

  oracle::Answers answers;
  ASSERT_NO_FATAL_FAILURE(
      ask_both_ways(s, truth, margin + bounds.depth, margin - bounds.depth, answers));
  if (!answers.hit) return;
  const Manifold& m = answers.m;
  ++worst.hits;
  worst.overlaps += truth < 0 ? 1 : 0;
  worst.points += m.count;

  const V n = oracle::vec(m.normal);
  worst.normal = std::max(worst.normal, std::abs(n.norm() - 1) / kEpsilon);
  double deepest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < m.count; ++i) {
    const ManifoldPoint& point = m.points[i];
    const double separation = static_cast<double>(point.separation);
    deepest = std::min(deepest, separation);
    EXPECT_LE(separation, margin * (1 + kEpsilon));
    const V middle = oracle::vec(point.position);
    const double on_a = std::abs(signed_distance(V(middle - 0.5 * separation * n), a));
    const double on_b = std::abs(signed_distance(V(middle + 0.5 * separation * n), b));
    worst.surface = std::max({worst.surface, on_a / bounds.surface, on_b / bounds.surface});
    worst.raw_surface =
        std::max(worst.raw_surface,
                 std::max(on_a, on_b) / std::min(half_thickness(s.a), half_thickness(s.b)));
    EXPECT_LE(on_a, bounds.surface) << "point " << i << " of " << m.count << ", distance " << truth;
    EXPECT_LE(on_b, bounds.surface) << "point " << i << " of " << m.count << ", distance " << truth;
    for (int k = 0; k < i; ++k) EXPECT_NE(point.feature, m.points[k].feature);
  }
  worst.raw_depth =
      std::max(worst.raw_depth,
               std::abs(deepest - truth) / std::min(half_thickness(s.a), half_thickness(s.b)));
  worst.depth = std::max(worst.depth, std::abs(deepest - truth) / bounds.depth);
  EXPECT_LE(std::abs(deepest - truth), bounds.depth) << "reported " << deepest << " true " << truth;
  // The normal: along it the shapes have that room (or lack it). Rounding turns it by an epsilon,
  // and between cores that nearly touch by an epsilon of the double-precision coordinates over
  // their distance.
  const double sum = reach(s.a) + reach(s.b), between_cores = truth + a.radius + b.radius;
  double turned = 8 * kEpsilon * sum;
  if (between_cores > kTouching * sum) turned += 32 * kNumEpsilon * sum * sum / between_cores;
  EXPECT_LE(std::abs(room_along(a, b, n) - truth), bounds.room + turned)
      << "true " << truth << " points " << m.count;
  expect_swapped(s, answers);
}

struct Pair {
  ShapeType a, b;
  const char* name;
  int poses;
};

class CollideOracle : public testing::TestWithParam<Pair> {};

TEST_P(CollideOracle, DepthNormalAndPointsAreTrueInEveryPose) {
  const Pair pair = GetParam();
  Random random(17);
  Worst worst;
  for (int i = 0; i < pair.poses; ++i) {
    const double size = random.scale(1e-3, 1e4);
    const Scene scene = random_scene(random, pair.a, pair.b, size);
    SCOPED_TRACE(testing::Message() << pair.name << " pose " << i << " size " << size);
    check_scene(scene, worst);
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
  EXPECT_GT(worst.overlaps, pair.poses / 8);
  EXPECT_GT(worst.hits, worst.overlaps);
  std::printf(
      "[ figures  ] %s: %d poses, %d contacts (%d overlapping, %d points); worst depth error %.2g, "
      "worst distance of a point from a surface %.2g of the thinner half thickness; %.2f and %.2f "
      "of the bounds; | |n| - 1 | %.1f eps\n",
      pair.name, pair.poses, worst.hits, worst.overlaps, worst.points, worst.raw_depth,
      worst.raw_surface, worst.depth, worst.surface, worst.normal);
}

constexpr ShapeType kS = ShapeType::Sphere, kC = ShapeType::Capsule, kB = ShapeType::Box,
                    kH = ShapeType::Hull;
INSTANTIATE_TEST_SUITE_P(
    Pairs, CollideOracle,
    testing::Values(Pair{kS, kS, "SphereSphere", 6000}, Pair{kS, kC, "SphereCapsule", 6000},
                    Pair{kC, kC, "CapsuleCapsule", 6000}, Pair{kS, kB, "SphereBox", 6000},
                    Pair{kC, kB, "CapsuleBox", 6000}, Pair{kB, kB, "BoxBox", 6000},
                    Pair{kS, kH, "SphereHull", 3000}, Pair{kC, kH, "CapsuleHull", 3000},
                    Pair{kB, kH, "BoxHull", 3000}, Pair{kH, kH, "HullHull", 3000}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
