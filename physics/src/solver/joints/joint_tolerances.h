// Numbers of the joint solver that a user should not have to choose.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail::joint_tolerance {

// Compliance of held rows, relative to what they can move [-]. Where a group has no loop it only
// keeps the arithmetic regular. Joints of a loop may hold what others hold already, and contradict
// them: their compliance bounds the impulses at which they do. It stretches a joint of a loop that
// bears its own weight by g h^2 kLoopCompliance.
inline constexpr double kCompliance = 1e-11;
inline constexpr double kLoopCompliance = 1e-5;

// How much friction against turning yields in one of Newton's steps where limits bound the turn
// too, relative to what it can turn [-]. Five rows of three angles ask for rates that contradict
// each other by round-off: this bounds the impulses at which they do. What is left goes in the next
// step.
inline constexpr double kFrictionGive = 1e-3;

// A row of which the rows before it leave this part of what it can move is held by them [-]: what
// is left is round-off.
inline constexpr double kUnmoved = 1e-9;

// A group whose inertia is this close to that of a rod cannot be turned back [-].
inline constexpr Real kRegular = Real(100) * std::numeric_limits<Real>::epsilon();

// Newton's steps in one pass over a piece [-]: two at least before the drift; more only while
// motors, limits and frictions reach their bounds or leave them.
inline constexpr int kMostNewtonSteps = 8;

// Errors are worked off no faster than this many body sizes a second [1/s], and turned back no
// faster than this [rad/s], so that joints made far apart close without a bang.
inline constexpr Real kPushSizesPerSecond = Real(8);
inline constexpr Real kPushTurn = Real(8);

// Part of the position error that a substep takes away in groups that are too wide to be solved at
// once [-]. All others take away all of it.
inline constexpr Real kSharedCorrection = Real(0.2);

// How joints close (joint_close.cpp): damping, relative to what a row can move without levers, and
// the part of the error that a step may leave out [-]. The test TautBridge holds bridges of 10 and
// 40 planks, 1 to 16 substeps; they gained no energy with a damping of 1e-3 to 1e-1. Without it
// those of 40 come apart; where it acts on every step, a chain that lashes freely loses 4.5 %
// instead of 1.4 % (the test Chains).
inline constexpr double kClosingDamping = 1e-2;
inline constexpr Real kLeftOut = Real(0.05);

// Newton's steps end when every held coordinate will be right to this [-], in body sizes or
// radians; when a step leaves more than kSlowStep of the error it is the last.
inline constexpr Real kClosed = sizeof(Real) == 4 ? Real(1e-6) : Real(1e-9);
inline constexpr Real kSlowStep = Real(0.5);
// ... to this where WorldSettings::joint_order is 4: what is left is of one sign, and its weight
// adds up.
inline constexpr Real kClosedTight =
    std::min(kClosed, Real(100) * std::numeric_limits<Real>::epsilon());
// ... and when all of them leave this many times what there was at best, or what is far off [-],
// they are taken back.
inline constexpr Real kAstray = Real(4);
inline constexpr Real kFarOff = Real(0.01);

// A group is factored as a whole as long as the squared lengths of its columns add up to no more
// than this many a joint [-]: chains, trees and ragdolls have 1 to 10, a net of n by n joints n^2.
inline constexpr std::uint64_t kMostWork = 64;

// Passes over the joints of a group that is too wide, in each half of a substep [-].
inline constexpr int kChainPasses = 16;

// What turns or swings in a group that touches nothing may do so by this much in one of its
// substeps [rad]: bodies about their joints, and the fastest vibration of what is stretched. The
// group takes up to kMostCycles substeps of its own for one of the world's.
inline constexpr Real kTurnPerCycle = Real(0.25);
inline constexpr Real kVibrationPerCycle = Real(0.7);
inline constexpr int kMostCycles = 8;

// What a spring without end of stiffness may take back in a substep, in body sizes or radians [-].
inline constexpr Real kReach = Real(0.25);

// A limit with restitution does not bounce below this many times the speed that forces add in a
// substep [-].
inline constexpr Real kBounceCut = Real(4);

// A velocity motor drives as long as it reaches this part of its target [-] or, where that is more
// than a slow motor gives, this many body sizes or radians a second [1/s]: below it is stalled. A
// position motor drives as long as it closes that part of what is left in a second [1/s], until it
// is as near as this [sizes or rad].
inline constexpr Real kDrivenShare = Real(0.1);
inline constexpr Real kDrivenSizesPerSecond = Real(1e-3);
inline constexpr Real kArrived = Real(1e-3);

// Cosine of half the angle [-] up to which attitudes are held by twice the quaternion's vector
// part: 0.5 rad.
inline constexpr Real kNearHalfCosine = Real(0.969);

// Cones narrower than this [rad] hold their axis outright: the direction of what is left is noise.
inline constexpr Real kNarrowCone = Real(1e-3);

// Joints, and pieces, per chunk of a parallel loop [-].
inline constexpr unsigned kJointGrain = 16;
inline constexpr unsigned kPieceGrain = 4;

}  // namespace plumb::inline PLUMB_ABI::detail::joint_tolerance
