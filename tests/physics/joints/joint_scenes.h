// Scenes of jointed bodies, in double.
#pragma once

#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace joint_scenes {

using namespace testing_support;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// A body of given mass properties that never sleeps.
inline BodyId add_body(PhysicsWorld& world, const Vector3d& place, double mass,
                       const Vector3d& moments, const Quat& attitude = Quat::Identity()) {
  RigidBody body = free_body(mass, moments);
  body.pose = at(place, attitude);
  body.can_sleep = false;
  return must(world.create_body(body));
}

// A world point and attitude as a frame of a body (of the world itself for the null handle).
inline LocalPose frame_at(const PhysicsWorld& world, BodyId body, const Vector3d& p,
                          const Quaterniond& q = Quaterniond::Identity()) {
  LocalPose frame;
  Quaterniond R = Quaterniond::Identity();
  Vector3d x = Vector3d::Zero();
  if (!body.is_null()) {
    const Pose pose = world.pose(body);
    R = wide(pose.orientation);
    x = wide(pose.position);
  }
  frame.position = vec(R.conjugate() * (p - x));
  frame.orientation = Quat((R.conjugate() * q).cast<Real>()).normalized();
  return frame;
}

// The attitude whose x axis points along `axis`.
inline Quaterniond x_along(const Vector3d& axis) {
  return Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis.normalized());
}

// A joint whose frames coincide at a world point as the bodies stand.
inline Joint joint_at(const PhysicsWorld& world, BodyId a, BodyId b, const JointKind& kind,
                      const Vector3d& p, const Vector3d& axis = Vector3d::UnitX()) {
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  joint.frame_a = frame_at(world, a, p, x_along(axis));
  joint.frame_b = frame_at(world, b, p, x_along(axis));
  joint.kind = kind;
  return joint;
}

// [kg m^2] of the bob: nearly a point.
constexpr double kBobMoment = 1e-6;

// A bob on a massless arm, hung from the world's origin; swings in the x-y plane.
struct Pendulum {
  PhysicsWorld world;
  BodyId bob;
  JointId joint;
  double length, inertia;

  Pendulum(const JointKind& kind, double amplitude, double l = 1, double mass = 1,
           double moment = kBobMoment, const WorldSettings& settings = {})
      : world(settings), length(l), inertia(moment + mass * l * l) {
    bob = add_body(world, l * Vector3d(std::sin(amplitude), -std::cos(amplitude), 0), mass,
                   Vector3d::Constant(moment), turn(amplitude, Vector3d::UnitZ()));
    joint = must(
        world.create_joint(joint_at(world, {}, bob, kind, Vector3d::Zero(), Vector3d::UnitZ())));
  }
  [[nodiscard]] double angle() const {
    const Vector3d x = position(world, bob);
    return std::atan2(x.x(), -x.y());
  }
};

// Mean time between upward passages of an oscillating reading through zero, over `periods` of them.
template <class Read>
double period_of(PhysicsWorld& world, double dt, int periods, const Read& read) {
  double first = -1, last = read(), t = 0;
  for (int found = -1; found < periods;) {
    world.step(dt);
    const double now = read();
    if (last < 0 && now >= 0) {
      const double when = t + dt * last / (last - now);
      if (++found == 0) first = when;
      if (found == periods) return (when - first) / periods;
    }
    last = now;
    t += dt;
    if (t > 1e4) break;
  }
  ADD_FAILURE() << "it does not swing";
  return 0;
}

}  // namespace joint_scenes
}  // namespace plumb::inline PLUMB_ABI
