// Any convex core in the frame of a pair, by its farthest points and by the features that it rests
// on. For pairs in which one core is curved.
#pragma once

#include "collision/placed_polyhedron.h"
#include "collision/round_core.h"

namespace plumb::inline PLUMB_ABI::detail {

// The part of a core that faces a direction: what it would rest on. A generator of a curved side is
// a segment, the flat end of a cylinder or the base of a cone is a disc.
struct SupportFeature {
  enum class Kind { Point, Segment, Disc, Polygon, Plane };
  Kind kind = Kind::Point;
  FeatureName name = 0;    // of the whole
  NumVec out{0, 1, 0};     // unit: the direction it was asked for
  NumVec normal{0, 1, 0};  // disc, plane: unit, outward
  Num offset = 0;          // [m] disc, plane: normal . x
  NumVec centre{0, 0, 0};  // disc [m]
  Num radius = 0;          // disc [m]
  NumVec spoke{1, 0, 0};   // disc: unit, fixed to the body, perpendicular to the normal
  Segment segment{};       // segment; its ends have the names vertex 0 and 1 of `ends`
  FeatureName ends[2]{};   // segment
  Num bend = 0;            // segment [m]: radius of the round side it belongs to, 0 for an edge
  const FacePolygon* polygon = nullptr;

  [[nodiscard]] bool is_flat() const { return kind >= Kind::Disc; }
};

// Names of the features of a round core: faces 0 and 1 are the ends towards -y and +y, face 2 is
// the side; a rim point is a vertex (see feature_overlay.cpp).
inline constexpr int kSideFace = 2;
inline constexpr int kGeneratorVertex = 32;  // + 0 towards -y, + 1 towards +y

class ConvexCore {
 public:
  // `polyhedron`: of a box or hull, placed in the same frame; kept by the caller. Not for a
  // half-space.
  ConvexCore(const Placed& placed, const PlacedPolyhedron* polyhedron);

  // Farthest point in a direction of any length > 0 [m].
  [[nodiscard]] NumVec support(NumVec d) const {
    if (polyhedron_ != nullptr) return polyhedron_->vertex(polyhedron_->support_index(d));
    if (!is_curved(shape_.type)) return p_ + (dot(d, axis_) < Num(0) ? -half_.y : half_.y) * axis_;
    return p_ + rows_ * support_of_round(shape_, transpose_times(rows_, d));
  }
  [[nodiscard]] const CollisionShape& shape() const { return shape_; }
  [[nodiscard]] const PlacedPolyhedron* polyhedron() const { return polyhedron_; }
  [[nodiscard]] NumVec centre() const { return centre_; }
  [[nodiscard]] NumVec origin() const { return p_; }
  [[nodiscard]] NumVec axis() const { return axis_; }         // unit: its y axis
  [[nodiscard]] Num outer_radius() const { return outer_; }   // [m] of a ball about the centre
  [[nodiscard]] Num half_thickness() const { return thin_; }  // [m] with the rounding
  [[nodiscard]] NumVec half() const { return half_; }
  [[nodiscard]] bool has_axis() const { return polyhedron_ == nullptr && half_.y > Num(0); }

  // `polygon`: room for the answer when it is a face.
  void feature_facing(NumVec n, FacePolygon& polygon, SupportFeature& out) const;

 private:
  void round_feature(NumVec n, SupportFeature& out) const;

  const CollisionShape& shape_;
  const PlacedPolyhedron* polyhedron_;
  NumVec p_, half_, axis_, centre_;
  NumMatrix rows_;
  Num outer_, thin_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
