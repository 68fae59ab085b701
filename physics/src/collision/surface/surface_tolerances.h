// Every number that collision with surfaces (meshes, heightfields) compares against.
#pragma once

#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

// Two triangles are one plane up to this sine of the angle between them [-]: 0.02 mm of height on
// 10 cm. A ridge as flat as that is passed without a jolt.
inline constexpr Num kFlatSine = 2e-4;
// ... or when the far corner is off the plane by no more than its coordinates are rounded: so many
// units in the last place of the largest one [-] (three corners, two differences each).
inline constexpr Num kFlatUlps = 8;
// Triangles lower than so many roundings of a coordinate [-] have no normal of their own worth
// using.
inline constexpr Num kSliverUlps = 256;
// Twice the area over the square of the longest side [-]: below it a triangle has none.
inline constexpr Num kNoArea = 1e-14;

// A contact normal this near a triangle's own is that one [rad]: larger than the angles between
// triangles of one plane, so that no direction falls into the crack between two of them.
inline constexpr Num kSnapAngle = 3e-4;
// A contact normal may leave the cone of the feature it touches by this angle [rad], for the same
// reason.
inline constexpr Num kConeSlack = 3e-4;

// How far behind a triangle the middle of a shape may lie and still be pushed out to the front [-],
// as a fraction of the shape's half thickness. Farther behind, the shape is on the other side.
inline constexpr Num kBehind = 0.5;
// ... and of one that touched in the last step, which shows what side it came from.
inline constexpr Num kBehindWhenHeld = 1;

// A polyhedron deeper below a triangle's plane than kDeepShare of its half thickness [-] that is
// out of the triangle within kExitShare of that depth [-] along one of its own faces touches the
// surface from the side.
inline constexpr Num kDeepShare = 0.25;
inline constexpr Num kExitShare = 0.5;

// Contacts of several triangles are one manifold when their normals differ by at most this [rad]
// and their surface points lie in one plane to kSamePlane of the shape's half thickness.
inline constexpr Num kSameNormal = 5e-4;
inline constexpr Num kSamePlane = 1e-3;
// Points nearer than this part of the half thickness [-] are one point.
inline constexpr Num kSamePoint = 1e-3;
// A point this near the line between its neighbours, as a part of the half thickness [-], spans no
// area.
inline constexpr Num kOnHullLine = 1e-5;
// Points are thinned out whenever this many have come together.
inline constexpr int kPruneAt = 96;

// Names of parts: cells of the unit octahedron a normal is rounded to on each axis, and the shift
// [-] that keeps usual normals and heights away from the borders between cells.
inline constexpr int kNormalCells = 512;
inline constexpr Num kCellShift =
    0.3819660112501051;  // golden section: far from every small fraction

}  // namespace plumb::inline PLUMB_ABI::detail
