// Depth of overlap of two convex cores by growing a polytope inside their Minkowski difference
// [van den Bergen 2001]. Its nearest face is a lower bound of the depth, the farthest point along
// any direction an upper bound: it stops when the two agree to a tolerance, with the best direction
// seen.
#pragma once

#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

class ExpandingPolytope {
 public:
  // `first`: four points of the difference that span a volume, counter-clockwise or not. The origin
  // need not lie inside of them.
  explicit ExpandingPolytope(const NumVec (&first)[4], Num size);

  struct Face {
    int corner[3];
    NumVec normal;  // unit, outward; zero for a face without area
    Num distance;   // [m] of its plane from the origin; negative when the origin is outside
    bool alive;
  };
  // The nearest face; null when none is left that has area.
  [[nodiscard]] const Face* nearest() const;
  // Adds a point beyond `nearest`. False when it is full or the point adds nothing.
  bool add(NumVec point);

 private:
  void add_face(int a, int b, int c);

  int corner_count_ = 0, face_count_ = 0;
  Num size_;
  NumVec inside_;
  NumVec corners_[kDepthMaxIterations + 8];
  Face faces_[kDepthMaxFaces];
};

}  // namespace plumb::inline PLUMB_ABI::detail
