// Invariant: two edges that run along one another hold on all that they share. Over it the manifold
// resists tipping both ways, as far as the margin says, and goes over steadily into the one point
// of edges that cross.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;

constexpr Real kMargin = Real(0.01);    // [m]
constexpr double kHalfEdge = 0.8;       // [m] of the shorter edge
constexpr double kSteepest = 10.0 / 3;  // [-] slope of the surfaces beside an edge

// A shape that rests on an edge parallel to z: where that edge is, upright and upside down.
struct Ridge {
  const char* name;
  CollisionShape shape;
  Rotation up;    // the edge on top
  double height;  // [m] of the edge over the shape's origin
};

Rotation about(Vec axis, double angle) {
  return from_rotation_vector(static_cast<Real>(angle) * axis);
}

std::vector<Ridge> ridges(double half_edge) {
  const double quarter = std::acos(-1.0) / 4;
  const Real half = static_cast<Real>(half_edge);
  const Rotation lay = about({1, 0, 0}, -2 * quarter);  // y to -z, the axis of a prism
  std::vector<Ridge> all;
  all.push_back({"cube", make_collision_shape(Box{Vec3(1, 1, half)}), about({0, 0, 1}, quarter),
                 std::sqrt(2.0)});
  all.push_back({"plank", make_collision_shape(Box{Vec3(Real(0.3), 1, half)}),
                 about({0, 0, 1}, std::atan2(0.3, 1.0)), std::hypot(0.3, 1.0)});
  // A corner of the polygon lies at x = 1 of the prism.
  for (const int sides : {3, 6})
    all.push_back({sides == 3 ? "wedge" : "hexagon",
                   make_collision_shape(ConvexHull{oracle::prism(sides, 1, half_edge)}),
                   about({0, 0, 1}, 2 * quarter) * lay, 1.0});
  return all;
}

// What the manifold can hold against tipping about x: how far out along z (or -z) it presses, each
// point as much as it is nearer than the margin. 1 where it reaches the end of the edge and
// touches.
double hold(const Manifold& m, double gap, double side) {
  double most = 0;
  for (int i = 0; i < m.count; ++i) {
    const double near =
        (static_cast<double>(kMargin) - static_cast<double>(m.points[i].separation)) /
        (static_cast<double>(kMargin) - gap);
    most = std::max(most, side * static_cast<double>(m.points[i].position.z) / kHalfEdge * near);
  }
  return most;
}

struct Poses {
  const Ridge *below, *above;
  double gap;  // [m] between the edges

  // The upper one is turned about the vertical by `twist`, and about x by `tip`.
  bool meet(double twist, double tip, Manifold& m) const {
    const Rotation down = about({0, 0, 1}, std::acos(-1.0)) * above->up;
    const Rotation turn = about({1, 0, 0}, tip) * about({0, 1, 0}, twist);
    const Vec arm{0, static_cast<Real>(above->height), 0};
    const Vec place{0, static_cast<Real>(below->height + gap), 0};
    return collide(below->shape, {{0, 0, 0}, below->up}, above->shape,
                   {place + rotate(turn, arm), turn * down}, kMargin, m);
  }
};

template <class Visit>
void each_pair(Visit&& visit) {
  const std::vector<Ridge> longer = ridges(1.1), shorter = ridges(kHalfEdge);
  for (const Ridge& below : longer)
    for (const Ridge& above : shorter) {
      SCOPED_TRACE(testing::Message() << above.name << " on " << below.name);
      visit(below, above);
    }
}

TEST(EdgeContact, ParallelEdgesHoldAtBothEnds) {
  each_pair([](const Ridge& below, const Ridge& above) {
    for (const double gap : {5e-3, 1e-3, 1e-5}) {
      Manifold m;
      ASSERT_TRUE((Poses{&below, &above, gap}.meet(0, 0, m))) << gap;
      EXPECT_GE(m.count, 2) << gap;
      EXPECT_GT(hold(m, gap, 1), 0.99) << gap;
      EXPECT_GT(hold(m, gap, -1), 0.99) << gap;
    }
  });
}

// Twisted about the vertical the edges cross in the middle. Beside the crossing the surfaces part
// by no more than the steepest slope at the edges, 2 for the plank; so much at least is held.
TEST(EdgeContact, SmallTwistsTakeLittleFromEitherEnd) {
  each_pair([](const Ridge& below, const Ridge& above) {
    for (const double gap : {5e-3, 1e-3, 1e-5}) {
      for (const double twist : {1e-6, 1e-5, 1e-4, 1e-3, 2e-3}) {
        for (const double turned : {twist, -twist}) {
          Manifold m;
          ASSERT_TRUE((Poses{&below, &above, gap}.meet(turned, 0, m)));
          const double parted = kSteepest * kHalfEdge * twist;
          const double least = 1 - parted / (static_cast<double>(kMargin) - gap) - 0.01;
          EXPECT_GT(hold(m, gap, 1), least) << "gap " << gap << " twist " << turned;
          EXPECT_GT(hold(m, gap, -1), least) << "gap " << gap << " twist " << turned;
        }
      }
    }
  });
}

// Step by step through the parallel pose, twisting or tipping: depth and hold change by no more
// than the surfaces move.
TEST(EdgeContact, DepthAndHoldChangeSteadilyThroughTheParallelPose) {
  constexpr int kSteps = 400;
  constexpr double kStep = 2e-5;  // [rad]
  each_pair([](const Ridge& below, const Ridge& above) {
    for (const bool tips : {false, true}) {
      const double gap = 2e-3;
      double last_depth = 0, last_hold[2] = {0, 0};
      for (int i = -kSteps / 2; i <= kSteps / 2; ++i) {
        const double angle = kStep * i;
        Manifold m;
        // Tipped by no more than leaves both ends apart.
        const bool met =
            tips ? Poses{&below, &above, gap + kHalfEdge * std::abs(angle)}.meet(0, angle, m)
                 : Poses{&below, &above, gap}.meet(angle, 0, m);
        ASSERT_TRUE(met);
        double depth = 1;
        for (int k = 0; k < m.count; ++k)
          depth = std::min(depth, static_cast<double>(m.points[k].separation));
        const double holds[2] = {hold(m, gap, 1), hold(m, gap, -1)};
        if (i > -kSteps / 2) {
          // As steep as the plank, and once more for the end that tips.
          const double moved = (kSteepest + 1) * kHalfEdge * kStep + 2e-6;
          EXPECT_LT(std::abs(depth - last_depth), moved) << "angle " << angle;
          for (int side = 0; side < 2; ++side)
            EXPECT_LT(std::abs(holds[side] - last_hold[side]),
                      2 * moved / (static_cast<double>(kMargin) - gap) + 0.01)
                << "angle " << angle << " side " << side;
        }
        last_depth = depth;
        last_hold[0] = holds[0];
        last_hold[1] = holds[1];
      }
    }
  });
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
