// What the pair routines fill in: contact points in double precision, before rounding and swapping
// back into a Manifold.
#pragma once

#include "collision/collision_shape.h"
#include "collision/collision_tolerances.h"
#include "collision/features.h"
#include "collision/manifold.h"

namespace plumb::inline PLUMB_ABI::detail {

// A shape in place. Positions are relative to the first shape's origin, axes are the world's.
struct Placed {
  const CollisionShape& shape;
  NumVec p;       // [m]
  NumRotation q;  // unit to double precision
};

struct ContactPoint {
  NumVec position;  // [m] midway between the surfaces
  Num separation;   // [m] along the normal
  std::uint32_t feature;
};

// Normal from the first shape to the second.
struct Contacts {
  NumVec normal;
  int count = 0;
  AxisHint axis;  // before: of the last look; after: of this one
  // [m] Where count is 0: the shapes are at least this far apart, as far as was looked.
  Num gap = 0;
  ContactPoint points[Manifold::kMaxPoints];

  void add(NumVec position, Num separation, std::uint32_t feature) {
    points[count++] = {position, separation, feature};
  }
  // Whether a separation [m] seen along some direction is wider than the margin [m]; notes it.
  bool parted(Num separation, Num margin) {
    if (separation <= margin) return false;
    gap = separation;
    return true;
  }
};

// More points than a manifold holds, in order around the contact area. No initial values: large,
// and only the first `count` are read.
struct ContactCandidates {
  static constexpr int kCapacity = 2 * kMaxFaceVertices + 4;
  int count;
  ContactPoint points[kCapacity];
};

// Chooses at most four: the deepest, and those that span the largest area with it. Ties fall to the
// earlier point, so that the choice stays while the points move a little. `tie` [m]: separations
// closer than that are equal. Points with the name of one already chosen are left out (they
// coincide).
void choose_points(const ContactCandidates& candidates, NumVec normal, Num tie, Contacts& out);

// The same where edges meet, and points lie along them: the deepest, those that hold best against
// tipping over it along the edges, either way, and across them. A point counts by how much nearer
// it is than the margin [m], so that nothing is lost with one that goes beyond it.
void choose_ridge_points(const ContactCandidates& candidates, NumVec normal, Num tie, Num margin,
                         Contacts& out);

inline NumVec to_num(Vec v) { return cast<Num>(v); }
inline NumVec to_num(const Vec3& v) {
  return {static_cast<Num>(v.x()), static_cast<Num>(v.y()), static_cast<Num>(v.z())};
}
// Any unit vector perpendicular to a unit vector, the same one every time.
inline NumVec any_perpendicular(NumVec unit) {
  NumVec t1, t2;
  tangent_frame(unit, t1, t2);
  return t1;
}

}  // namespace plumb::inline PLUMB_ABI::detail
