// Numbers of the joint solver that a user should not have to choose.
#pragma once

#include <limits>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail::joint_tolerance {

// Leak of held rows: this part of the velocity that its impulse makes is not asked for [-]. It
// bounds the impulses of loops that contradict themselves. A joint that bears its own weight
// stretches by g h^2 kHoldLeak: 0.17 um at 240 Hz.
inline constexpr Real kHoldLeak = Real(1e-3);

// Added to the diagonal of the held rows' matrix, relative to it [-]: keeps it regular whatever
// axes of the bodies are locked. A hundred roundings of the number type.
inline constexpr Real kRegular = Real(100) * std::numeric_limits<Real>::epsilon();

// A free coordinate whose inverse mass is this small a part of what it is without the held rows is
// held by them [-]: what is left is round-off.
inline constexpr Real kUnmoved = Real(10) * kRegular;

// Errors are worked off no faster than this many body sizes a second [1/s], and turned back no
// faster than this [rad/s], so that joints made far apart close without a bang.
inline constexpr Real kPushSizesPerSecond = Real(8);
inline constexpr Real kPushTurn = Real(8);

// Part of the position error that a substep takes away where joints share a body [-]: passes leave
// something over there, and what is pushed to and fro at full rate gains energy. A joint apart
// takes away all of it.
inline constexpr Real kSharedCorrection = Real(0.2);

// Sweeps over the free rows of one joint where more than one part acts [-].
inline constexpr int kFreeSweeps = 6;

// Passes over all joints, in each half of a substep [-]: one suffices for joints apart, chains gain
// from more. They are alone, before the contacts have their say.
inline constexpr int kChainPasses = 16;

// A limit with restitution does not bounce below this many times the speed that forces add in a
// substep [-].
inline constexpr Real kBounceCut = Real(4);

// Cones narrower than this [rad] hold their axis outright: the direction of what is left is noise.
inline constexpr Real kNarrowCone = Real(1e-3);

// Joints per chunk of a parallel loop [-].
inline constexpr unsigned kJointGrain = 16;

}  // namespace plumb::inline PLUMB_ABI::detail::joint_tolerance
