// Proves the reports of a step against what can be worked out without the engine: a sensor holds
// exactly what overlaps it, the impulses of contacts are the momentum that bodies gained, a hit's
// impulse is what stopped or turned back the body.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;
using oracle::Solid;

constexpr double kDt = 1.0 / 60;  // [s]

Solid solid_of(const PhysicsWorld& world, BodyId body, ColliderId collider) {
  const detail::CollisionShape shape = detail::make_collision_shape(world.collider(collider).shape);
  Solid s = oracle::solid_of(shape, {{0, 0, 0}, {0, 0, 0, 1}});
  const Vector3d p = wide(world.pose(body).position);
  const Eigen::Quaterniond q = orientation(world, body).normalized();
  for (Vector3d& v : s.vertices) v = p + q * v;
  for (Vector3d& n : s.normals) n = q * n;
  return s;
}

using Holding = std::set<std::pair<ColliderId, ColliderId>>;  // sensor, other

// Bodies of all shapes fly through sensors of all shapes, some of which move themselves.
TEST(Events, SensorsHoldExactlyWhatOverlapsThem) {
  oracle::Random random(21);
  PhysicsWorld world(no_gravity());
  struct Part {
    BodyId body;
    ColliderId collider;
    bool sensor;
    MotionType type;
  };
  std::vector<Part> parts;
  const auto some_shape = [&](double size) -> Shape {
    return oracle::random_shape(random, random.below(4), size, 0.3);
  };
  for (int i = 0; i < 60; ++i) {
    const bool sensor = i % 2 == 0;
    RigidBody body = body_at(at(Vector3d(4 * random.direction()), Quat::Identity()));
    // Sensors of every motion type, and colliders of every one, by turns.
    body.type = std::array{MotionType::Static, MotionType::Kinematic,
                           MotionType::Dynamic}[static_cast<std::size_t>((sensor ? i / 2 : i) % 3)];
    if (body.type != MotionType::Static) {
      body.linear_velocity = vec(random.uniform(1, 6) * random.direction());
      body.angular_velocity = vec(random.uniform(0, 4) * random.direction());
    }
    body.can_sleep = false;
    Collider collider = with(some_shape(sensor ? 2 : 0.8));
    collider.is_sensor = sensor;
    collider.filter.layers = sensor ? 1 : 2;
    collider.filter.collides_with = sensor ? 2 : 1;
    const BodyId id = must(world.create_body(body));
    parts.push_back({id, must(world.create_collider(id, collider)), sensor, body.type});
  }
  Holding held;
  int enters = 0, exits = 0, stays = 0;
  for (int step = 0; step < 180; ++step) {
    // A step reports what overlapped when it began.
    std::map<std::pair<ColliderId, ColliderId>, double> distance;
    for (const Part& a : parts)
      for (const Part& b : parts)
        if (a.sensor && !b.sensor && std::max(a.type, b.type) != MotionType::Static)
          distance[{a.collider, b.collider}] = oracle::signed_distance(
              solid_of(world, a.body, a.collider), solid_of(world, b.body, b.collider));
    world.step(kDt);
    for (const SensorEvent& event : world.events().sensors) {
      const auto pair = std::pair(event.sensor, event.other);
      if (event.kind == SensorEvent::Kind::Enter) {
        EXPECT_TRUE(held.insert(pair).second) << "entered twice";
        ++enters;
      } else {
        EXPECT_EQ(held.erase(pair), 1u) << "left without having entered";
        ++exits;
      }
    }
    for (const auto& [pair, d] : distance) {
      if (std::abs(d) < 64 * kEps * 10) continue;  // rounding decides
      EXPECT_EQ(held.count(pair) > 0, d < 0) << "step " << step << " distance " << d;
      stays += d < 0 ? 1 : 0;
    }
  }
  EXPECT_GT(enters, 50);
  EXPECT_GT(exits, 50);
  EXPECT_GT(stays, 1000);
}

// Newton's second law, body by body, in a falling and settling pile: what contacts report is all
// that acts besides gravity.
TEST(Events, ContactImpulsesAreTheMomentumThatBodiesGain) {
  for (const double restitution : {0.0, 0.5}) {
    PhysicsWorld world(no_sleep());
    add_floor(world, material(0.5, restitution));
    Random random(22);
    for (int i = 0; i < 60; ++i) {
      const Vector3d p(random.uniform(-1, 1), 0.6 + 0.5 * i, random.uniform(-1, 1));
      const Shape shapes[] = {cube(0.25), sphere(0.25), capsule(0.2, 0.15)};
      add(world, body_at(at(p, random.rotation(3))),
          with(shapes[i % 3], material(0.5, restitution)));
    }
    const std::vector<BodyState> bodies = states(world);
    std::map<BodyId, Vector3d> before;
    double largest = 0;
    int compared = 0;
    for (int step = 0; step < 240; ++step) {
      for (const BodyState& body : bodies) before[body.id] = velocity(world, body.id);
      world.step(kDt);
      // A body stopped on its way has not had the whole step's gravity.
      if (world.last_report().continuous > 0) continue;
      ++compared;
      std::map<BodyId, Vector3d> impulse;
      std::map<BodyId, double> throughput;
      for (const ContactState& contact : contacts(world)) {
        for (int k = 0; k < contact.point_count; ++k) {
          const Vector3d on_b =
              static_cast<double>(contact.points[k].normal_impulse) * wide(contact.normal) +
              wide(contact.points[k].friction_impulse);
          impulse.try_emplace(contact.body_a, Vector3d::Zero()).first->second -= on_b;
          impulse.try_emplace(contact.body_b, Vector3d::Zero()).first->second += on_b;
          throughput[contact.body_a] += on_b.norm();
          throughput[contact.body_b] += on_b.norm();
        }
      }
      for (const BodyState& body : bodies) {
        const double mass = world.mass_properties(body.id).mass;
        if (body.type != MotionType::Dynamic) continue;
        const Vector3d gained = mass * (velocity(world, body.id) - before[body.id]);
        const Vector3d sum = impulse.try_emplace(body.id, Vector3d::Zero()).first->second +
                             mass * kDt * Vector3d(0, -kGravity, 0);
        // Some hundred roundings, of the momentum and of all that went through.
        const double rounding =
            500 * kEps *
            (throughput[body.id] +
             mass * (before[body.id].norm() + velocity(world, body.id).norm() + kDt * kGravity));
        ASSERT_LE((gained - sum).norm(), rounding) << "step " << step << " e " << restitution;
        largest = std::max(largest, throughput[body.id]);
      }
    }
    EXPECT_GT(largest, 100);
    EXPECT_GT(compared, 150);
  }
}

TEST(Events, AHitsImpulseIsWhatTurnsTheBodyBack) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    PhysicsWorld world(no_gravity());
    add(world, body_at(at(0.5, 0, 0), MotionType::Static),
        with(box(0.5, 5, 5), material(0, restitution)));
    const BodyId ball = add(world, moving(at(-2, 0.3, 0), vec(7, 0, 0)),
                            with(sphere(0.25), material(0, restitution)));
    const double mass = world.mass_properties(ball).mass;
    std::vector<HitEvent> hits;
    for (int step = 0; step < 60; ++step) {
      world.step(kDt);
      hits.insert(hits.end(), world.events().hits.begin(), world.events().hits.end());
    }
    ASSERT_EQ(hits.size(), 1u) << restitution;
    const HitEvent& hit = hits[0];
    const double sign = hit.body_a == ball ? 1 : -1;
    EXPECT_NEAR(static_cast<double>(hit.approach_speed), 7, 7 * 8 * kEps);
    EXPECT_NEAR(static_cast<double>(hit.impulse), mass * 7 * (1 + restitution),
                mass * 14 * 16 * kEps);
    EXPECT_NEAR(sign * static_cast<double>(hit.normal.x()), 1, 8 * kEps);
    EXPECT_NEAR(velocity(world, ball).x(), -7 * restitution, 7 * 16 * kEps);
    // Where they touch: on the wall's face, to the slop (0.2 % of the ball's thickness).
    EXPECT_NEAR(wide(hit.point).x(), 0, 1e-3);
    EXPECT_NEAR(wide(hit.point).y(), 0.3, 1e-3);
  }
}

// A hit is an approach that was stopped: boxes that come to rest tell no others on their way.
TEST(Events, EveryHitHasASpeedAndAnImpulse) {
  PhysicsWorld world;
  add_floor(world, material(0.4, 0.4));
  for (int i = 0; i < 8; ++i)
    add(world, body_at(at(0.2 * (i % 3), 1 + 1.2 * i, 0.1 * (i % 2))),
        with(box(0.5, 0.4, 0.3), material(0.4, 0.4)));
  int hits = 0;
  for (int step = 0; step < 300; ++step) {
    world.step(kDt);
    for (const HitEvent& hit : world.events().hits) {
      ++hits;
      ASSERT_GT(hit.approach_speed, Real(0)) << "step " << step;
      ASSERT_GT(hit.impulse, Real(0)) << "step " << step;
    }
  }
  EXPECT_GT(hits, 20);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
