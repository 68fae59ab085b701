// How one body moves: inertia in world axes, angular velocity from angular momentum, the kick by
// known forces, and free flight.
#pragma once

#include "motion/rotation_flow.h"
#include "plumb/settings.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// The part of a symmetric tensor that acts in the world axes that are not locked.
Symmetric3<Real> without_locked_axes(const Symmetric3<Real>& m, std::uint32_t locks);
// Inverse of the part of the inertia that acts in the axes that are not locked; 0 in the others.
Symmetric3<Real> inverse_in_free_axes(const Symmetric3<Real>& inertia, std::uint32_t locks);

// [kg m^2], [1/(kg m^2)] in world axes. A locked axis has neither.
inline Symmetric3<Real> world_inertia(const BodyMass& m, Rotation q) {
  const Symmetric3<Real> I = rotate_diagonal(to_matrix(q), m.moments);
  return m.angular_locks == 0 ? I : without_locked_axes(I, m.angular_locks);
}
inline Symmetric3<Real> world_inverse_inertia(const BodyMass& m, Rotation q) {
  if (m.angular_locks == 0) return rotate_diagonal(to_matrix(q), m.inverse_moments);
  return inverse_in_free_axes(rotate_diagonal(to_matrix(q), m.moments), m.angular_locks);
}

// w = I^-1 L, through the principal axes (no 3x3 product).
inline Vec angular_velocity_of(const BodyMass& m, Rotation q, Vec L) {
  if (m.angular_locks != 0) return world_inverse_inertia(m, q) * L;
  return rotate(q, multiply_each(m.inverse_moments, inverse_rotate(q, L)));
}
inline Vec angular_momentum_of(const BodyMass& m, Rotation q, Vec w) {
  if (m.angular_locks != 0) return world_inertia(m, q) * w;
  return rotate(q, multiply_each(m.moments, inverse_rotate(q, w)));
}

// Exact factors of x' = v, v' = a - c v over a time h: v1 = decay v0 + gain a, x1 - x0 = gain v0 +
// lift a.
struct DampedMotion {
  Real decay;  // exp(-c h)
  Real gain;   // [s] (1 - exp(-c h)) / c
  Real lift;   // [s^2] (h - gain) / c
};
DampedMotion damped_motion(Real damping, Real h);

// Whether a method leaves L as it is. The others work on w and write their L back.
constexpr bool keeps_momentum(RotationMethod method) {
  return method == RotationMethod::Exact || method == RotationMethod::Jacobi ||
         method == RotationMethod::Splitting || method == RotationMethod::Splitting4;
}

// Turns a body without the gyroscopic term: w stays, L = I w is what it comes to.
void turn_steadily(const BodyMass& m, Rotation& q, Vec& L, Real h);
// Turns a body freely for a time h by the chosen method. Locked axes are the same under all.
void turn_freely(RotationMethod method, const BodyMass& m, Rotation& q, Vec& L, Real h);

}  // namespace plumb::inline PLUMB_ABI::detail
