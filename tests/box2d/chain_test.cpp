// Proves, against Box2D 2.4.1, that chains and bridges of hinges settle into the shape that statics
// gives them, and that sensors tell of a visitor in the steps in which it is there.
#include <gtest/gtest.h>

#include <vector>

#include "box2d/planar_joints.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace box2d_comparison;

// Where the hinges of a hanging chain of equal links stand: link k slopes by tan a_k = V_k / H, H
// the horizontal pull that is the same everywhere, V_k the weight carried at the link's middle,
// counted from the lowest point. H is the one with which the links span the distance.
std::vector<Vector2d> funicular(const std::vector<double>& weights, double link, double span) {
  const auto nodes_with = [&](double pull) {
    double total = 0;
    for (const double w : weights) total += w;
    std::vector<Vector2d> nodes{{0, 0}};
    double carried = -total / 2;  // both ends carry half: the load is symmetric
    for (const double w : weights) {
      const double slope = (carried + w / 2) / pull;
      carried += w;
      nodes.push_back(nodes.back() + link * Vector2d(1, slope) / std::hypot(1, slope));
    }
    return nodes;
  };
  double low = 1e-6, high = 1e9;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (nodes_with(middle).back().x() < span ? low : high) = middle;
  }
  return nodes_with(low);
}

struct Chain {
  JointedPair pair;
  std::vector<Body> links;
  std::vector<double> weights;
  double link, span;

  // `count` links hung between two points; begins as an arc of a circle, and is damped. The middle
  // one is heavier by a factor.
  Chain(int count, double length, double span_wanted, double heavier)
      : link(length), span(span_wanted) {
    // Half angle of the arc whose chords have the link's length: chord = 2 r sin(a / n),
    // span = 2 r sin a.
    double low = 1e-3, high = kPi / 2;
    for (int i = 0; i < 100; ++i) {
      const double a = (low + high) / 2;
      (link * std::sin(a) / std::sin(a / count) > span ? low : high) = a;
    }
    const double half_angle = low, r = span / 2 / std::sin(half_angle);
    std::vector<Vector2d> nodes;
    for (int k = 0; k <= count; ++k) {
      const double a = -half_angle + 2 * half_angle * k / count;
      nodes.emplace_back(span / 2 + r * std::sin(a), r * (std::cos(half_angle) - std::cos(a)));
    }
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vector2d middle = (nodes[i] + nodes[i + 1]) / 2, along = nodes[i + 1] - nodes[i];
      const double density = 1000 * (2 * k + 1 == count ? heavier : 1);
      const double half_width = 0.05;
      links.push_back(pair.add_box(link / 2, half_width,
                                   {.x = middle.x(),
                                    .y = middle.y(),
                                    .angle = std::atan2(along.y(), along.x()),
                                    .damping = 1},
                                   {}, density));
      weights.push_back(density * 2 * link * half_width);
    }
    for (std::size_t k = 0; k <= links.size(); ++k) {
      const Body left = k == 0 ? pair.ground() : links[k - 1];
      const Body right = k == links.size() ? pair.ground() : links[k];
      hinge(pair, left, right, nodes[k]);
    }
  }

  // Farthest that a link's middle is from where it should be [m]; theirs, ours.
  [[nodiscard]] std::pair<double, double> farthest() const {
    const std::vector<Vector2d> nodes = funicular(weights, link, span);
    double theirs = 0, ours = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const Vector2d middle = (nodes[k] + nodes[k + 1]) / 2;
      const Planar a = PlanarPair::theirs(links[k]), b = pair.ours(links[k]);
      theirs = std::max(theirs, (Vector2d(a.x, a.y) - middle).norm());
      ours = std::max(ours, (Vector2d(b.x, b.y) - middle).norm());
    }
    return {theirs, ours};
  }
};

TEST(Box2dChain, HangsInTheShapeOfStatics) {
  Chain chain(15, 0.4, 4, 1);
  chain.pair.run_both(20);
  const auto [theirs, ours] = chain.farthest();
  EXPECT_LT(ours, 4e-4);    // [m] measured 4e-5
  EXPECT_LT(theirs, 1e-4);  // measured 5e-6
}

TEST(Box2dBridge, SagsUnderALoadInItsMiddle) {
  Chain bridge(11, 0.5, 5, 5);
  bridge.pair.run_both(20);
  const auto [theirs, ours] = bridge.farthest();
  EXPECT_LT(ours, 1e-3);    // [m] measured 1.2e-4
  EXPECT_LT(theirs, 1e-4);  // measured 3e-6
}

// A disc passes through a sensor at a steady 0.05 m a step: it overlaps the sensor after the steps
// 26 to 55. Both engines look at the poses with which a step begins, so that the step 27 tells of
// its coming and the step 57 of its going. (Box2D's skin of 0.01 m makes less than a step of
// difference.)
TEST(Box2dSensor, TellsTheStepsOfEnteringAndLeaving) {
  PlanarPair pair(0);
  const double speed = 3, radius = 0.25, half = 0.5, from = -2.025;
  const Body disc = pair.add_disc(radius, {.x = from, .vx = speed});
  b2BodyDef def;
  b2PolygonShape gate;
  gate.SetAsBox(f(half), 1);
  b2FixtureDef fixture;
  fixture.shape = &gate;
  fixture.isSensor = true;
  b2Body* their_gate = pair.their_world().CreateBody(&def);
  their_gate->CreateFixture(&fixture);
  Collider collider = with(box(half, 1, 0.5));
  collider.is_sensor = true;
  add(pair.world(), body_at(at(0, 0, 0), MotionType::Static), collider);

  int entered_theirs = 0, left_theirs = 0, entered_ours = 0, left_ours = 0;
  for (int step = 1; step <= 120; ++step) {
    pair.step();
    bool inside = false;
    for (const b2ContactEdge* edge = disc.theirs->GetContactList(); edge; edge = edge->next)
      inside |= edge->contact->IsTouching();
    if (inside && entered_theirs == 0) entered_theirs = step;
    if (!inside && entered_theirs != 0 && left_theirs == 0) left_theirs = step;
    for (const SensorEvent& event : pair.world().events().sensors) {
      if (event.kind == SensorEvent::Kind::Enter && entered_ours == 0) entered_ours = step;
      if (event.kind == SensorEvent::Kind::Exit && left_ours == 0) left_ours = step;
    }
  }
  const double meet = (-half - radius - from) / speed / kDt;  // 25.5 steps
  const double part = (half + radius - from) / speed / kDt;   // 55.5 steps
  const int entered = static_cast<int>(std::ceil(meet)) + 1,
            left = static_cast<int>(std::ceil(part)) + 1;
  EXPECT_EQ(entered_ours, entered);
  EXPECT_EQ(left_ours, left);
  EXPECT_EQ(entered_theirs, entered);
  EXPECT_EQ(left_theirs, left);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
