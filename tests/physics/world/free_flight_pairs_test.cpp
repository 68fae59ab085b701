// Proves that what flies free of everything, whose box is looked at least, misses nothing: whatever
// overlaps when a step begins has a contact in that step, in swarms that drift, spin and meet,
// after a change of course and after restore.
#include <gtest/gtest.h>

#include <set>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kInner = 0.2;  // [m] radius of a ball inside every shape

std::vector<BodyId> add_swarm(PhysicsWorld& world, unsigned seed) {
  Random random(seed);
  std::vector<BodyId> bodies;
  for (int i = 0; i < 60; ++i) {
    const Vector3d p(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
    const Shape shapes[] = {cube(kInner), sphere(kInner), capsule(0.3, kInner),
                            box(kInner, 0.5, 0.3)};
    const Vector3d v = -random.uniform(0.05, 0.6) * p;
    bodies.push_back(add(world,
                         moving(at(p, random.rotation(3)), vec(v),
                                vec(random.uniform(-6, 6), random.uniform(-6, 6), 0)),
                         with(shapes[i % 4], material(0.3, 0.5))));
  }
  return bodies;
}

std::set<std::pair<BodyId, BodyId>> touching(const PhysicsWorld& world) {
  std::set<std::pair<BodyId, BodyId>> out;
  for (const ContactState& contact : contacts(world)) {
    out.emplace(contact.body_a, contact.body_b);
    out.emplace(contact.body_b, contact.body_a);
  }
  return out;
}

TEST(FreeFlightPairs, WhateverOverlapsHasAContact) {
  int overlaps = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    PhysicsWorld world(no_gravity());
    const std::vector<BodyId> bodies = add_swarm(world, seed);
    for (int step = 0; step < 600; ++step) {
      if (step % 100 == 99)  // all of them turn back
        for (const BodyId body : bodies)
          must(world.set_linear_velocity(body, vec(-0.5 * position(world, body))));
      if (step == 140) {
        const Snapshot saved = world.save();
        must(world.restore(saved));
      }
      std::vector<Vector3d> before;
      for (const BodyId body : bodies) before.push_back(position(world, body));
      world.step(1.0 / 60);
      const auto pairs = touching(world);
      for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = i + 1; j < bodies.size(); ++j) {
          if ((before[i] - before[j]).norm() > 2 * kInner) continue;
          ++overlaps;
          EXPECT_TRUE(pairs.contains({bodies[i], bodies[j]}))
              << "seed " << seed << " step " << step << ": " << i << " and " << j;
        }
    }
  }
  EXPECT_GT(overlaps, 100);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
