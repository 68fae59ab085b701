// A world to which random things are done, good and bad: bodies, colliders, joints and effects of
// every kind come, change and go, and stale handles are used again and again.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/random.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

class RandomChanges {
 public:
  RandomChanges(PhysicsWorld& world, std::uint32_t seed) : world_(&world), random_(seed) {}

  // Goes on with another world that holds the same.
  void move_to(PhysicsWorld& world) { world_ = &world; }

  // Does one thing. Returns what was wrong with how the world took it; empty: nothing.
  std::string act() {
    const std::uint64_t before = world_->state_hash();
    must_fail_ = false;
    const Status status = one_of(25);
    if (!status.ok() && world_->state_hash() != before)
      return std::string("refused, but changed the world: ") + status.message;
    if (must_fail_ && status.ok()) return "took what it must refuse";
    return {};
  }

 private:
  int below(int n) { return std::min(n - 1, static_cast<int>(random_.uniform(0, n))); }
  bool chance(double p) { return random_.uniform(0, 1) < p; }
  double between(double low, double high) { return random_.uniform(low, high); }
  // Uniform in the logarithm.
  double sized(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  Vec3 arrow(double longest) { return vec(random_.direction() * between(0, longest)); }
  template <class Id>
  Id any(const std::vector<Id>& made) {  // stale ones too
    if (made.empty()) return {};
    return made[static_cast<std::size_t>(below(static_cast<int>(made.size())))];
  }
  BodyId body() {
    const BodyId id = any(bodies_);
    must_fail_ = must_fail_ || !world_->is_valid(id);
    return id;
  }
  ColliderId collider() {
    const ColliderId id = any(colliders_);
    must_fail_ = must_fail_ || !world_->is_valid(id);
    return id;
  }
  template <class Made, class Id>
  Status keep(const Made& made, std::vector<Id>& all) {
    if (made.ok()) all.push_back(made.id);
    return made.status;
  }
  Pose place() {
    return at(Eigen::Vector3d(between(-4, 4), between(-1, 6), between(-4, 4)),
              random_.rotation(kPi));
  }
  LocalPose local(double reach) {
    LocalPose pose;
    pose.position = arrow(reach);
    pose.orientation = random_.rotation(kPi);
    return pose;
  }

  Shape shape() {
    const double a = sized(0.1, 1), b = a * between(0.3, 1), c = a * between(0.3, 1);
    switch (below(6)) {
      case 0:
        return sphere(a);
      case 1:
        return box(a, b, c);
      case 2:
        return capsule(a, b);
      case 3:
        return cylinder(a, b);
      case 4:
        return cone(a, b);
      default:
        return rounded_box(a, b, c, 0.2 * std::min(b, c));
    }
  }
  Collider new_collider() {
    Collider made =
        with(shape(), material(between(0, 1), chance(0.5) ? 0 : between(0, 1)), sized(50, 8000));
    if (chance(0.3)) made.pose = local(0.5);
    made.is_sensor = chance(0.1);
    if (chance(0.1)) made.one_way = vec(random_.direction());
    if (chance(0.1)) made.surface_velocity.linear = vec(random_.direction());
    if (chance(0.1)) made.material.adhesion = real(sized(1, 1e4));
    if (chance(0.1)) made.material.grain = vec(random_.direction());
    made.material.grain_friction = real(between(0, 1));
    if (chance(0.1)) made.material.rolling_friction = real(between(0, 0.05));
    return made;
  }
  RigidBody new_body() {
    RigidBody made = body_at(place(), chance(0.8)   ? MotionType::Dynamic
                                      : chance(0.5) ? MotionType::Kinematic
                                                    : MotionType::Static);
    if (made.type != MotionType::Static) {
      made.linear_velocity = arrow(10);
      made.angular_velocity = arrow(20);
    }
    made.continuous = chance(0.2);
    made.can_sleep = chance(0.9);
    return made;
  }
  JointAxis axis(double reach) {
    JointAxis made;
    if (chance(0.5))
      made.limit = JointLimit{real(-between(0, reach)),
                              real(between(0, reach)),
                              {real(chance(0.5) ? 0 : between(1, 20)), Real(1)},
                              real(chance(0.5) ? 0 : between(0, 1))};
    if (chance(0.4)) {
      JointMotor motor;
      motor.mode = chance(0.5) ? JointMotor::Mode::Velocity : JointMotor::Mode::Position;
      motor.target = real(between(-2, 2));
      motor.max_effort = real(sized(1, 1e4));
      made.motor = motor;
    }
    return made;
  }
  Joint new_joint() {
    Joint made;
    made.body_a = chance(0.15) ? BodyId{} : any(bodies_);
    made.body_b = chance(0.15) ? BodyId{} : any(bodies_);
    made.frame_a = local(1);
    made.frame_b = local(1);
    switch (below(9)) {
      case 0:
        made.kind = BallJoint{real(between(0, 5))};
        break;
      case 1:
        made.kind = HingeJoint{axis(1.5)};
        break;
      case 2:
        made.kind = SliderJoint{axis(1)};
        break;
      case 3:
        made.kind = FixedJoint{};
        break;
      case 4:
        made.kind = DistanceJoint{real(between(0.2, 2))};
        break;
      case 5:
        made.kind = RopeJoint{real(between(0.2, 3))};
        break;
      case 6:
        made.kind = GearJoint{any(joints_), any(joints_), real(sized(0.1, 10))};
        break;
      case 7:
        made.kind = ConeTwistJoint{};
        break;
      default:
        made.kind = SpringJoint{real(between(0, 2)), real(sized(1, 1e4)), real(sized(0.1, 1e3)),
                                chance(0.5)};
    }
    if (chance(0.2)) made.softness = {real(between(1, 20)), real(between(0, 1))};
    made.collide_connected = chance(0.3);
    if (chance(0.1)) made.break_force = real(sized(10, 1e5));
    return made;
  }
  Effect new_effect() {
    Effect made;
    if (!chance(0.3)) made.body = any(bodies_);
    switch (below(5)) {
      case 0: {
        Drag drag;
        drag.linear = real(sized(0.01, 100));
        drag.quadratic = real(sized(0.01, 10));
        made.kind = drag;
        break;
      }
      case 1:
        made.kind = Thrust{arrow(100), arrow(0.2)};
        break;
      case 2: {
        Buoyancy lake;
        lake.level = real(between(0, 2));
        made.kind = lake;
        break;
      }
      case 3:
        made.kind = Wind{};
        break;
      default: {
        Spring spring;
        spring.other = chance(0.5) ? BodyId{} : any(bodies_);
        spring.rest_length = real(between(0.1, 2));
        spring.stiffness = real(sized(1, 1e4));
        made.kind = spring;
      }
    }
    return made;
  }

  Status one_of(int things) {
    switch (below(things)) {
      case 0:
      case 1:
      case 2: {
        const Status made = keep(world_->create_body(new_body()), bodies_);
        return made.ok() ? keep(world_->create_collider(bodies_.back(), new_collider()), colliders_)
                         : made;
      }
      case 3:
        return world_->destroy_body(body());
      case 4:
        return keep(world_->create_collider(body(), new_collider()), colliders_);
      case 5:
        return world_->destroy_collider(collider());
      case 6:
      case 7:
        return keep(world_->create_joint(new_joint()), joints_);
      case 8: {
        const JointId joint = any(joints_);
        must_fail_ = !world_->is_valid(joint);
        return world_->destroy_joint(joint);
      }
      case 9:
        return world_->set_pose(body(), place());
      case 10:
        return world_->set_linear_velocity(body(), arrow(20));
      case 11:
        return world_->set_angular_velocity(body(), arrow(20));
      case 12:
        return world_->set_awake(body(), chance(0.5));
      case 13:
        return world_->set_motion_type(body(), static_cast<MotionType>(below(3)));
      case 14: {
        MotionLocks locks;
        locks.linear_x = chance(0.2);
        locks.angular_y = chance(0.3);
        return world_->set_locks(body(), locks);
      }
      case 15:
        return world_->set_mass(body(), inertia_of::box(sized(0.1, 1e3), {0.5, 0.7, 0.3}));
      case 16:
        return world_->set_shape(collider(), shape());
      case 17:
        return world_->set_local_pose(collider(), local(0.5));
      case 18:
        return world_->set_material(collider(), new_collider().material);
      case 19:
        return world_->set_sensor(collider(), chance(0.3));
      case 20: {
        Filter filter;
        filter.layers = 1u << below(3);
        filter.group = below(5) - 2;
        return world_->set_filter(collider(), filter);
      }
      case 21:
        return keep(world_->create_effect(new_effect()), effects_);
      case 22: {
        const EffectId effect = any(effects_);
        must_fail_ = !world_->is_valid(effect);
        return world_->destroy_effect(effect);
      }
      case 23: {
        WorldSettings settings = world_->settings();
        settings.gravity = chance(0.7) ? vec(0, -kGravity, 0) : arrow(20);
        if (chance(0.2)) settings.substeps = 1 + below(6);
        return world_->set_settings(settings);
      }
      default: {
        must_fail_ = true;
        const Real bad = std::numeric_limits<Real>::quiet_NaN();
        return chance(0.5) ? world_->set_linear_velocity(any(bodies_), Vec3(bad, 0, 0))
                           : world_->set_density(any(colliders_), -1);
      }
    }
  }

  PhysicsWorld* world_;
  Random random_;
  bool must_fail_ = false;
  std::vector<BodyId> bodies_;
  std::vector<ColliderId> colliders_;
  std::vector<JointId> joints_;
  std::vector<EffectId> effects_;
};

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
