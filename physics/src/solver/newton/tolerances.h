// Numbers of the Newton solver that a user should not have to choose.
#pragma once

#include <cstddef>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail::newton::tolerance {

// The step length rho over the largest effective mass of an island [-]. It is no stiffness: at the
// fixed point nothing of it is left. Larger: fewer outer iterations, wider jumps of Newton's
// method, fewer digits; in double 1e8 leaves eight.
inline constexpr double kStepLength = 1e8;
// The same after an interior point, whose velocities have fewer digits, and its growth from one
// outer iteration to the next [-].
inline constexpr double kShortStepLength = 1e3;
inline constexpr double kStepGrowth = 1e3;
// Newton's iterations before an interior point is sought, and from there [-].
inline constexpr int kPlainIterations = 5;
inline constexpr int kInnerIterations = 15;
// Iterations towards an interior point [-]; so often one is sought in one solve.
inline constexpr int kInteriorIterations = 40;
inline constexpr int kInteriorPoints = 5;
// Outer iterations [-]; in the first of them what slides has a disc in place of its cone.
inline constexpr int kOuterIterations = 20;
inline constexpr int kDiscIterations = 12;
// Newton's method ends when the momentum that no body accounts for is this part of what acts on it
// [-].
inline constexpr double kMomentum = 1e-9;
// The outer iteration ends when contacts and joints miss their laws by this part of what gravity
// and forces add to velocities in a substep [-], or of the speeds themselves [-].
inline constexpr double kVelocity = 1e-6;
inline constexpr double kRelativeVelocity = 1e-8;
// Beyond this many times as much the report counts a solve as not converged [-].
inline constexpr double kNotConverged = 1e3;

// A point slides when it is faster than this part of what gravity adds in a substep [-].
inline constexpr double kSlides = 1e-4;

// Surfaces nearer than this part of the slop, on either side, just touch [-]: 2 um for a 1 m box.
// To work off what is left would only stir what rests.
inline constexpr double kTouching = 1e-3;
// Part of an overlap that a substep takes away [-].
inline constexpr double kPush = 0.2;

// When an island calls for this solver by itself (choose.h; physics/README.md has the map that was
// measured). A body on one that is so many times lighter [-], on it: cosine of the angle between
// the normal and the vertical [-]; a contact that presses with so many weights of the lighter body
// [-]; loaded overlap of so many slops [-]; steps for which that must go on [-]; steps for which a
// body that was heard stays [-].
inline constexpr Real kLightest = Real(10);
inline constexpr Real kLies = Real(0.5);
inline constexpr Real kMostLoad = Real(12.5);
inline constexpr Real kMostOverlap = Real(10);
inline constexpr unsigned char kStepsToBeLoad = 8;
inline constexpr unsigned char kStepsToStay = 60;
// What it may cost then, in products of 6x6 blocks (0.4 us each with all that goes with them, and
// so many as much for what a factorization takes beside): in one factorization, a column of 200
// bodies; in one step of the world, for columns, chains and trees (so many products a body) so
// many for each body, about 24 ms at most; 2 ms for clusters, which seldom need it for longer than
// a blow. An island that is larger, or has taken more, is not heard for so many steps [-];
// trees only where that comes so many steps in a row: they settle [-]. Larger ones are not even
// looked at [bodies].
inline constexpr std::size_t kMostProducts = 600;
inline constexpr std::size_t kProductsBeside = 20;
inline constexpr std::size_t kMostWork = 60'000;
inline constexpr std::size_t kWorkPerBody = 1'200;
inline constexpr std::size_t kMostClusterWork = 5'000;
// A cluster that would take more than that with so many factorizations a step, which is few, is not
// begun [-].
inline constexpr std::size_t kFewFactorizations = 16;
inline constexpr unsigned char kStepsOfPause = 240;
inline constexpr std::size_t kTreeProducts = 3;
inline constexpr unsigned char kMostOverruns = 20;
inline constexpr std::size_t kMostBodies = 300;

// Blocks of 288 bytes in one island's factor [-]: 144 MB. Larger islands stay with the fast solver.
inline constexpr std::size_t kMostBlocks = 500'000;

}  // namespace plumb::inline PLUMB_ABI::detail::newton::tolerance
