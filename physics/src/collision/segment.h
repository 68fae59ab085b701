// Closest points of points and segments.
#pragma once

#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Segment {
  NumVec start, end;  // [m]
};
inline NumVec point_at(const Segment& s, Num t) { return s.start + t * (s.end - s.start); }

// Parameter in [0, 1] of the point of a segment closest to a point.
inline Num closest_parameter(const Segment& s, NumVec point) {
  const NumVec d = s.end - s.start;
  const Num squared = length_squared(d);
  if (!(squared > Num(0))) return Num(0);
  return std::clamp(dot(point - s.start, d) / squared, Num(0), Num(1));
}

// Parameters of a closest pair of points on two segments [Ericson 2005, 5.1.9]. Parallel segments
// have many; the one found lies at an end of the part that they share.
struct SegmentParameters {
  Num a, b;
};
inline SegmentParameters closest_parameters(const Segment& a, const Segment& b) {
  const NumVec da = a.end - a.start, db = b.end - b.start, r = a.start - b.start;
  const Num aa = dot(da, da), bb = dot(db, db), ab = dot(da, db);
  const Num ar = dot(da, r), br = dot(db, r);
  const NumVec across = cross(da, db);
  const Num determinant = dot(across, across);  // aa bb - ab^2 without its cancellation
  Num s = Num(0);
  if (determinant > kParallelSine * kParallelSine * aa * bb) {
    s = std::clamp((ab * br - ar * bb) / determinant, Num(0), Num(1));
  }
  Num t = (ab * s + br) / bb;
  if (t < Num(0) || t > Num(1)) {
    t = t < Num(0) ? Num(0) : Num(1);
    s = std::clamp((ab * t - ar) / aa, Num(0), Num(1));
  }
  return {s, t};
}

}  // namespace plumb::inline PLUMB_ABI::detail
