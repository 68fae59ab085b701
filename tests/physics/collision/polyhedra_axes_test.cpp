// Invariant: the search for the axis between two polyhedra finds what a look at every face and at
// every pair of edges finds, though it ends early at an axis that it can prove to be the best;
// whatever it is told to look at first; and with the same bits for every vector length.
#include "collision/polyhedra_axes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

NumVec to_vec(const V& v) { return {v.x(), v.y(), v.z()}; }
NumMatrix to_turn(Rotation q) { return to_matrix(normalized(NumRotation{q.x, q.y, q.z, q.w})); }

CollisionShape random_polyhedron(Random& random, double size) {
  switch (random.below(4)) {
    case 0:
      return make_collision_shape(Box{Vec3(static_cast<Real>(size), static_cast<Real>(0.4 * size),
                                           static_cast<Real>(random.scale(0.01, 1) * size))});
    case 1:
      return make_collision_shape(ConvexHull{oracle::prism(7, size, 0.1 * size)});
    case 2:
      return make_collision_shape(ConvexHull{oracle::random_hull(random, 40, size)});
    default:
      return make_collision_shape(ConvexHull{oracle::random_hull(random, 9, size)});
  }
}

Num best_face_of(const PlacedPolyhedron& p, const PlacedPolyhedron& q) {
  Num best = -std::numeric_limits<Num>::infinity();
  for (int k = 0; k < p.face_count(); ++k)
    best = std::max(best, q.lowest_along(p.normal(k)) - p.offset(k));
  return best;
}

// Every direction across two edges in which both shapes end at them.
Num best_edges_of(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num size) {
  Num best = -std::numeric_limits<Num>::infinity();
  const Num tolerance = Num(1e-9) * size;
  for (int i = 0; i < a.edge_count(); ++i) {
    for (int k = 0; k < b.edge_count(); ++k) {
      const Segment ea = a.segment(i), eb = b.segment(k);
      const NumVec across = cross(ea.end - ea.start, eb.end - eb.start);
      if (length(across) < Num(1e-6) * length(ea.end - ea.start) * length(eb.end - eb.start))
        continue;
      for (const Num sign : {Num(1), Num(-1)}) {
        const NumVec n = sign * normalized_or(across, {1, 0, 0});
        const bool ends_a = -a.lowest_along(-n) - dot(n, ea.start) < tolerance;
        const bool ends_b = dot(n, eb.start) - b.lowest_along(n) < tolerance;
        if (ends_a && ends_b) best = std::max(best, dot(n, eb.start - ea.start));
      }
    }
  }
  return best;
}

AxisHint any_hint(Random& random) {
  switch (random.below(3)) {
    case 0:
      return AxisHint::of_edges(random.below(900), random.below(900));
    case 1:
      return AxisHint::of_face(random.below(600), random.below(2) == 0);
    default:
      return {};
  }
}

struct Counts {
  int overlapping = 0, by_edges = 0, early = 0;
};

// One relative placement: found from nothing, from what was found, and from a wrong hint.
void expect_best(Random& random, const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num size,
                 Counts& counts) {
  const Num faces = std::max(best_face_of(a, b), best_face_of(b, a));
  const Num best = std::max(faces, best_edges_of(a, b, size));
  const Num margin = 10 * size, thickness = std::min(a.inner_radius(), b.inner_radius());
  AxisHint hints[3] = {{}, any_hint(random), {}};
  for (AxisHint& hint : hints) {
    Contacts contacts;
    contacts.axis = hint;
    PolyhedraAxes axes;
    ASSERT_TRUE(find_axes(a, b, margin, contacts, axes));
    // Single-precision planes of one flat face differ by that much.
    EXPECT_NEAR(axes.separation(), best, kAttained * thickness);
    hints[2] = contacts.axis;
    if (axes.edges.a >= 0) {
      EXPECT_GT(axes.edges.separation, faces - kAttained * thickness);
    }
    counts.by_edges += axes.edges.a >= 0 ? 1 : 0;
    counts.early += std::isinf(axes.face_b.separation) ? 1 : 0;
    counts.overlapping += best < Num(0) ? 1 : 0;
  }
}

struct RandomPair {
  double size;  // [m]
  CollisionShape a, b;
  explicit RandomPair(Random& random)
      : size(random.scale(1e-2, 1e2)),
        a(random_polyhedron(random, size)),
        b(random_polyhedron(random, size * random.scale(0.2, 1))) {}
};

TEST(PolyhedraAxes, AreTheBestOfAll) {
  Random random(29);
  Counts counts;
  for (int pair = 0; pair < 400; ++pair) {
    const auto [size, a, b] = RandomPair(random);
    const PlacedPolyhedron placed_a(a);
    for (int i = 0; i < 10; ++i) {
      const Rotation q = random.rotation();
      const V offset = random.scale(1e-3, 2.5) * size * random.direction();
      const PlacedPolyhedron placed_b(b, to_turn(q), to_vec(offset));
      ASSERT_NO_FATAL_FAILURE(expect_best(random, placed_a, placed_b, size, counts)) << pair;
    }
  }
  std::printf("[ figures  ] %d overlapping, %d by edges, %d ended at a face of the first\n",
              counts.overlapping, counts.by_edges, counts.early);
  EXPECT_GT(counts.overlapping, 1000);
  EXPECT_GT(counts.by_edges, 500);
  EXPECT_GT(counts.early, 500);
}

// Slight overlaps, as in resting contact, are where the search ends early most often.
TEST(PolyhedraAxes, AreTheBestOfAllInSlightContact) {
  Random random(31);
  Counts counts;
  for (int pair = 0; pair < 400; ++pair) {
    const auto [size, a, b] = RandomPair(random);
    const PlacedPolyhedron placed_a(a);
    const Rotation q = random.rotation();
    const V way = random.direction();
    double low = 0, high = 4 * size;  // from overlapping to apart
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      const PlacedPolyhedron at(b, to_turn(q), to_vec(middle * way));
      (std::max(best_face_of(placed_a, at), best_face_of(at, placed_a)) > Num(0) ? high : low) =
          middle;
    }
    for (const double deeper : {-1e-3, 0.0, 1e-4, 1e-3, 1e-2, 0.1}) {
      const V offset = (low - deeper * size) * way;
      const PlacedPolyhedron placed_b(b, to_turn(q), to_vec(offset));
      ASSERT_NO_FATAL_FAILURE(expect_best(random, placed_a, placed_b, size, counts)) << pair;
    }
  }
  EXPECT_GT(counts.early, 1000);
}

TEST(PolyhedraAxes, HaveTheSameBitsForEveryVectorLength) {
  Random random(37);
  for (int pair = 0; pair < 300; ++pair) {
    const CollisionShape a = random_polyhedron(random, 1), b = random_polyhedron(random, 1);
    const PlacedPolyhedron placed_a(a);
    const PlacedPolyhedron placed_b(b, to_turn(random.rotation()),
                                    to_vec(random.uniform(0, 2) * random.direction()));
    const PolyhedronLanes lanes_a = placed_a.lanes(), lanes_b = placed_b.lanes();
    const Num floor = -std::numeric_limits<Num>::infinity();
    const FaceAxis one = choose_axes_kernel(128).best_face(lanes_a, lanes_b, floor);
    for (const int bits : {256, 512}) {
      const FaceAxis other = choose_axes_kernel(bits).best_face(lanes_a, lanes_b, floor);
      EXPECT_EQ(one.face, other.face);
      EXPECT_EQ(one.separation, other.separation);
    }
  }
}

// Lists of edges of every length, so that the last vector is full or not.
TEST(PolyhedraAxes, HaveTheSameEdgesForEveryVectorLength) {
  Random random(41);
  for (int count = 1; count < 30; ++count) {
    std::vector<double> numbers[2];
    EdgeLanes lanes[2];
    for (int side = 0; side < 2; ++side) {
      const auto room = static_cast<std::size_t>(filled_up(count));
      numbers[side].assign(12 * room, 0.0);
      for (std::size_t k = 0; k < 12; ++k)
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
          numbers[side][k * room + i] = random.uniform(-1, 1);
      double* x = numbers[side].data();
      lanes[side] = {x,
                     x + room,
                     x + 2 * room,
                     x + 3 * room,
                     x + 4 * room,
                     x + 5 * room,
                     x + 6 * room,
                     x + 7 * room,
                     x + 8 * room,
                     x + 9 * room,
                     x + 10 * room,
                     x + 11 * room,
                     count};
    }
    const EdgesAxis one = choose_axes_kernel(128).best_edges(lanes[0], lanes[1], -10);
    for (const int bits : {256, 512}) {
      const EdgesAxis other = choose_axes_kernel(bits).best_edges(lanes[0], lanes[1], -10);
      EXPECT_EQ(one.a, other.a);
      EXPECT_EQ(one.b, other.b);
      EXPECT_EQ(one.separation, other.separation);
    }
    if (count > 4) {
      EXPECT_GE(one.a, 0);
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
