// Every number the collision routines compare against, with its unit and its reason.
#pragma once

#include <limits>

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

// The narrowphase computes in double in every build and rounds once, when it hands out its result.
// A difference of two large coordinates is then exact for single-precision input, so that 1 mm on a
// 10 km box comes out as well as 1 m on 1 m, and no tolerance below has to hide rounding. On scalar
// code the price is a few percent against float.
using Num = double;
using NumVec = Vector3<Num>;
using NumRotation = Quaternion<Num>;
using NumMatrix = Matrix3<Num>;

// ---- what shapes are allowed --------------------------------------------------------------------

// Sizes [m] outside are refused: a hundred times beyond 1 mm ... 10 km on both ends, where volume
// and inertia still fit into single precision.
inline constexpr Num kSmallestSize = 1e-5;
inline constexpr Num kLargestSize = 1e6;
// Largest over smallest extent of one shape: beyond it the inertia is singular in single precision.
inline constexpr Num kLargestAspect = 1e5;

// Hull faces may be uneven, and neighbours may be reflex, by this part of the smallest width: hulls
// of scanned or modelled points arrive rounded to few digits.
inline constexpr Num kHullUnevenness = 1e-3;
// Limits of a hull; the clipping and SAT buffers on the stack have these sizes.
inline constexpr int kMaxHullVertices = 256;
inline constexpr int kMaxHullFaces = 2 * kMaxHullVertices - 4;  // Euler, all triangles
inline constexpr int kMaxHullEdges = 3 * kMaxHullVertices - 6;
inline constexpr int kMaxFaceVertices = 64;

// ---- coherence: which of nearly equal answers is taken
// ---------------------------------------------- All are parts of the half thickness of the thinner
// shape of the pair, thus scale-free; each bounds the error that it brings into the depth.

// A face of the larger shape is kept as normal unless a face of the other, or two edges, beat its
// separation by this much: normals of resting shapes do not alternate.
inline constexpr Num kFacePreference = 1e-3;
// Points this close to the deepest count as equally deep, and the first in face order is taken.
inline constexpr Num kDeepestTie = 1e-4;
// Corners this close to the side of a face count as on it: flush faces keep their four corners and
// their names while they creep against one another.
inline constexpr Num kClipBand = 2e-4;

// A point replaces another in the choice of four only if it spans this much more.
inline constexpr Num kSpanGain = 1.001;
// The depth at which an axis counts as beaten by none, as a part of where it provably is [-]: far
// beyond rounding.
inline constexpr Num kSureShare = 0.9;
// A face seen at a flatter angle than this cosine along the normal is not laid over another one.
inline constexpr Num kSteepFace = 0.1;
// Two capsules give two points if their axes run past one another by less than this part of the sum
// of radii over the length they share.
inline constexpr Num kParallelCapsules = 0.01;
// ... and if the angle between the axes is at most this [rad]: the surface of the second along the
// normal is then its radius away to half a percent.
inline constexpr Num kParallelTilt = 0.1;
// Points where the grown surface of a rounded shape lies closer to the core's point than its radius
// by more than this part of the radius are left out: at kParallelTilt a flat face misses half a
// percent.
inline constexpr Num kGrownMiss = 5e-3;

// ---- rounding
// ---------------------------------------------------------------------------------------

inline constexpr Num kNumEpsilon = std::numeric_limits<Num>::epsilon();
// Edges at a smaller angle [rad] have no cross product worth a name; face normals cover their case
// to (angle x length). 8 sqrt(eps): the direction left after cancellation is good to 1e-9.
inline constexpr Num kParallelSine = 1.2e-7;
// A separating axis is attained if points of both shapes lie that close to it, as a part of the
// thinner shape's half thickness: single-precision face planes are no better.
inline constexpr Num kAttained = 1e-6;
// Below this part of the sizes two cores touch: the direction of what is left between them would be
// worse than 1e-5, that of a face or of two edges is not.
inline constexpr Num kTouching = 1e-11;

// ---- curved cores
// ---------------------------------------------------------------------------------------

// The polytope in which the depth of overlap is sought grows until its bounds agree to this part of
// the half thickness; then the direction is refined to the end of the valley that it lies in. Two
// valleys whose depths differ by less are not told apart.
inline constexpr Num kDepthGap = 5e-4;
// Points added to it at most. Boxes and flat ends take 5 to 15, deep round ones up to 60.
inline constexpr int kDepthMaxIterations = 96;
inline constexpr int kDepthMaxFaces = 2 * kDepthMaxIterations + 16;
// A direction is refined by moving the shapes apart along it, to a clearance of this part of the
// half thickness, and looking for their closest points there: far enough for an exact direction.
inline constexpr Num kRefineClearance = 0.02;
// Refinements at most; near the surface one or two are enough.
inline constexpr int kMaxRefinements = 24;
// Cores nearer than this part of their sizes get the direction of their closest points refined too:
// that of a distance of 1e-6 is only good to 1e-9, and face normals are tried before it.
inline constexpr Num kNearlyTouching = 1e-6;
// A disc whose rim rises by more than kDeepestTie of the half thickness is tilted: its contact
// points then follow its deepest point instead of being fixed to the body.

// Steps of a ray towards a rounded surface; 4 to 8 are usual, a grazing ray halves what is left.
inline constexpr int kMaxRaySteps = 96;

// GJK stops when upper and lower bound of the squared distance agree to this part.
inline constexpr Num kGjkGap = 1e-14;
// The points that its simplex gives may miss the closest point by this part of the sizes; slivers
// that miss by more are taken for one of their edges.
inline constexpr Num kWitness = 1e-10;
// Convergence takes some 5 to 20 supports; the bound only guards against a cycle from rounding.
inline constexpr int kGjkMaxIterations = 96;

}  // namespace plumb::inline PLUMB_ABI::detail
