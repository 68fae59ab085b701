// Rolling and torsional friction: a torque in the contact against turning of one surface over the
// other, at most a lever arm times the normal force.
//
//   C'  = w_rel . t1, w_rel . t2 (rolling)   w_rel . n + drive (torsion)
//   M   = torque impulse on B, its opposite on A;  |M_t| <= rolling * N,  |M_n| <= torsional * N
//
// N is the normal impulse of the whole manifold. Only rows that resist turning have one of these,
// in an array of their own; the others pay the look at one index. Nothing is remembered from
// substep to substep: what holds a ball on a slope is the friction force, which is, and the torque
// that belongs to it is found anew before friction is solved.
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

template <class T>
struct TurningRow {
  T rolling = T(0), torsional = T(0);                   // [m]
  T k11 = T(0), k12 = T(0), k22 = T(0), k33 = T(0);     // [1/(kg m^2)] response about t1, t2 and n
  T impulse1 = T(0), impulse2 = T(0), impulse3 = T(0);  // [N m s] this substep
  T resisted = T(0);  // [rad/s] the most that a pass of this step took from the turning
};

}  // namespace plumb::inline PLUMB_ABI::detail
