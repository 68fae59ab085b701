// What acts along a free coordinate, as laws between its rate u and the impulse l along it.
//
//   soft    l = -T (k x + c u)     spring, servo, soft limit. x: the displacement after the time T
//   rigid   u = u*                 motor, servo without softness, friction [Coulomb], limit
//
// each with bounds on l: a motor's largest effort, T times the friction, a limit that only pushes.
// T is the time for which the pass acts: h/2 where the impulses are split, else h.
//
// Springs: T = h/2 is the implicit midpoint rule, which keeps a spring's energy; T = h is the
// implicit Euler rule, which damps what swings faster than substeps can follow. A spring that turns
// by w h in a substep has T/h = 1 - kVibrationPerCycle / (2 w h), at least 1/2, where impulses are
// split: no swing of it changes its sign undamped, as the midpoint rule would have it when w h is
// large, and then every turn of the spring's line feeds energy.
//
// Both kinds are solved by the same step, dl = -lack / (S + give), S = du/dl of the mechanism.
#pragma once

#include "solver/joints/joint_block.h"
#include "solver/joints/joint_solver.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Law {
  RowPart part = kSpring;
  bool soft = false;
  bool stiff = false;  // a spring that acts like a rigid hold: substeps cannot follow it
  Real lack = 0;       // [m/s] or [rad/s] by which u misses what the law asks for at its impulse
  Real give = 0;       // d lack / d l of the law itself; zero of a rigid one
  Real impulse = 0;    // along the row, whichever way it is counted in RowImpulses
  Real lower = 0, upper = 0;

  [[nodiscard]] bool inside() const { return lower < impulse && impulse < upper; }
  // Whether the law has a say: its impulse may move in the direction in which the lack drives it.
  [[nodiscard]] bool acts() const {
    return inside() || (lower < upper && (impulse <= lower ? lack < Real(0) : lack > Real(0)));
  }
};
inline constexpr int kMaxLaws = 5;

// A free row at one moment of a pass.
struct RowMoment {
  JointPass pass;
  Real h;     // [s] substep
  Real rate;  // u
  Real end;   // coordinate at the end of the substep, at that rate
};

// The laws of free row f, soft ones first, limits last.
int laws_of(const JointBlock& block, int f, const RowMoment& moment, Law laws[kMaxLaws]);

// Gives part `law.part` of free row f a new impulse, counted along the row.
void set_impulse(JointBlock& block, int f, JointPass pass, RowPart part, Real impulse);

// A motor without bound must not work against a limit without end: what they do to each other goes.
void settle_unlimited_motor(JointBlock& block, int f, JointPass pass);

// All parts of a row along it.
[[nodiscard]] Real total_impulse(const RowImpulses& impulses, bool second);

}  // namespace plumb::inline PLUMB_ABI::detail
