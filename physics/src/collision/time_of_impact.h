// When do two convex shapes meet that move and turn?
//
// Conservative advancement [Mirtich 1996] with a certificate of second order. Let n be a unit
// vector from A to B at time t, fixed in the world, and s(t) the room between the shapes along n, a
// lower bound of their distance. A point r of B's core (from B's centre c, turning with w) has at
// t + u
//      n . x >= n . c + u n . c' + r . (n + u n x w) - (u^2/2) K,   K = |w| |n x w| R
// where R is the largest distance of a point of the core from the axis through c: a Taylor
// expansion whose last term is bounded rather than evaluated. The smallest right side over all
// points of B is one support query in the direction n + u (n x w); the same for A with the signs
// changed. The difference of the two is a concave function g(u) below s(t + u): where g(u) >= the
// sought separation, the shapes stay apart by it during all of [t, t + u], not only at its end.
// The largest such u is taken, then the axis is chosen anew, from the closest points at t + u.
//
// So no motion between two looks is missed, however fast a body spins, and the time reported is
// never later than that of the first touch. Without rotation, or about an axis along n, the bound
// is exact. [Catto 2013] looks for the root of s on one axis too, but trusts s between its ends.
#pragma once

#include "collision/collision_shape.h"
#include "collision/sweep.h"

namespace plumb::inline PLUMB_ABI::detail {

struct SurfaceTriangle;

// A shape that a moving body carries.
struct SweptShape {
  const CollisionShape& shape;
  NumVec p;       // [m] of the shape, from the centre of its body, in the body's axes
  NumRotation q;  // of the shape in the body
  const Sweep& sweep;
  const SurfaceTriangle* triangle = nullptr;  // this one of the surface, instead of all of it
  Num scale = 1;  // (0, 1] of the shape about its middle: the core of it that is followed
};

struct ImpactSearch {
  Num begin = 0, end = 1;  // part of the sweeps' span
  // Signed distance at which the shapes count as having met [m]; negative: that much overlap.
  Num separation = 0;
  Num tolerance = 0;  // [m] > 0: a meeting is reported at up to this much more
  // Shapes that are nearer than this when the search begins touch already [m]. They are let go on
  // until they are deeper than the sought separation by `allowance`; or, if they are that deep
  // already, until they get deeper at all (by twice the tolerance); or until they are apart.
  // A triangle has no depth of its own: what touches a surface is followed against it by a core of
  // the shape that leaves out the allowance at its thinnest. So is all that the shape comes to on
  // the same surface if it is deeper than the sought separation already: it would never get off.
  Num touching = 0;
  Num allowance = 0;  // [m] >= 0; 0: what touches at the beginning meets then
};

enum class ImpactStatus : unsigned char {
  Apart,       // never nearer than the sought separation
  Meets,       // at `time`
  Deepens,     // touched at the beginning and is deeper by the allowance at `time`
  Unfinished,  // too many advances; apart until `time`, unknown after it
};

struct Impact {
  ImpactStatus status = ImpactStatus::Apart;
  Num time = 1;            // within [begin, end]; the end when the shapes stay apart
  Num distance = 0;        // [m] signed, then
  NumVec normal{0, 1, 0};  // unit, from A to B, then
  NumVec point{0, 0, 0};   // [m] midway between the surfaces, then
  bool touched = false;    // nearer than `touching` at the beginning
  // At the beginning: [m] signed, unit, [m].
  Num first_distance = 0;
  NumVec first_normal{0, 1, 0}, first_point{0, 0, 0};
  int looks = 0;  // how often the closest points were computed
  int advances = 0;
};

// Of two half-spaces, which never meet, the answer is Apart. A half-space must be at rest.
Impact time_of_impact(const SweptShape& a, const SweptShape& b, const ImpactSearch& search);

}  // namespace plumb::inline PLUMB_ABI::detail
