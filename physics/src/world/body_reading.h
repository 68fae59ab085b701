// What is told of one body to those outside: its state, its share of the energy.
#pragma once

#include "math/eigen_bridge.h"
#include "plumb/events.h"
#include "plumb/report.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// `About`: BodyInfo, or what an image keeps of it.
template <class About>
Pose pose_of(const About& about, const BodyPose& inner) {
  const Rotation R_WB = inner.q * conjugate(about.R_BP);
  Pose pose;
  pose.orientation = to_public(R_WB);
  pose.position = to_public_position(inner.x - cast<PosReal>(rotate(R_WB, about.center_B)));
  return pose;
}

template <class About>
BodyState state_of(std::uint32_t slot, const About& about, bool awake, const BodyPose& pose,
                   const BodyVelocity& velocity) {
  BodyState state;
  state.id = {slot, about.generation};
  state.type = about.type;
  state.awake = awake;
  state.pose = pose_of(about, pose);
  state.linear_velocity = to_public(velocity.v);
  state.angular_velocity = to_public(velocity.w);
  state.user_data = about.user_data;
  return state;
}

// gravity: [m/s^2] what acts on the body, its own scale included.
inline void add_energy(EnergyReport& sum, double mass, const Eigen::Vector3d& gravity,
                       const BodyPose& pose, const BodyVelocity& velocity, Vec momentum) {
  const Eigen::Vector3d v = to_public(velocity.v).cast<double>();
  const Eigen::Vector3d w = to_public(velocity.w).cast<double>();
  const Eigen::Vector3d L = to_public(momentum).cast<double>();
  const Eigen::Vector3d x = to_public_position(pose.x).cast<double>();
  sum.kinetic_linear += 0.5 * mass * v.squaredNorm();
  sum.kinetic_angular += 0.5 * w.dot(L);
  sum.potential -= mass * gravity.dot(x);
  sum.momentum += mass * v;
  sum.angular_momentum += L + mass * x.cross(v);
}

// position: seen from `origin`.
inline ContactPoint contact_point(PosVec origin, Vec position, Vec normal, Real impulse) {
  ContactPoint point;
  point.position = to_public_position(origin + cast<PosReal>(position));
  point.normal = to_public(normal);
  point.normal_impulse = impulse;
  return point;
}

}  // namespace plumb::inline PLUMB_ABI::detail
