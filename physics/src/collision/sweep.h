// The motion of a body over a span of time that runs from 0 to 1: its centre on a parabola, and a
// turn about the centre, either about one axis or as a free top turns.
#pragma once

#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Sweep {
  NumVec centre{0, 0, 0};  // [m] at time 0
  NumVec travel{0, 0, 0};  // [m]
  NumVec bend{0, 0, 0};    // [m] centre(t) = centre + t travel + t^2 bend
  NumRotation start{0, 0, 0, 1};
  NumVec turn{0, 0, 0};  // [rad] q(t) = exp(t turn) start; any number of turns

  // A free top instead: `turn` is not read then, `start` is that of the principal axes.
  bool tumbles = false;
  NumVec momentum{0, 0, 0};         // [kg m^2/s] times the length of the span [s]
  NumVec inverse_moments{0, 0, 0};  // [1/(kg m^2)]

  [[nodiscard]] NumVec centre_at(Num t) const { return centre + t * (travel + t * bend); }
  [[nodiscard]] NumVec velocity_at(Num t) const { return travel + (Num(2) * t) * bend; }
  [[nodiscard]] NumRotation rotation_at(Num t) const;
  // [rad] per unit of time, world axes, of a body that is turned so.
  [[nodiscard]] NumVec spin_at(NumRotation q) const;
  // [rad] per unit of time, never exceeded.
  [[nodiscard]] Num fastest_spin() const;
};

// A body at rest.
inline Sweep resting_at(NumVec centre, NumRotation q) {
  Sweep sweep;
  sweep.centre = centre;
  sweep.start = q;
  return sweep;
}

// The turn that takes q0 to q1 [rad], of all those that differ by whole turns the one nearest to
// `expected` (the angular velocity times the time): a fast wheel turns more than once.
NumVec turn_between(NumRotation q0, NumRotation q1, NumVec expected);

}  // namespace plumb::inline PLUMB_ABI::detail
