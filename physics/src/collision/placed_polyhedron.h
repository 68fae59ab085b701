// A hull or box copied into the frame in which a pair is tested, in double precision.
#pragma once

#include <concepts>

#include "collision/axes_kernel.h"
#include "collision/face_overlay.h"
#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {

class PlacedPolyhedron {
 public:
  // Point x of the shape's frame stands at R x + t. The arrays are not initialised beyond the
  // counts, filled up to whole vectors.
  PlacedPolyhedron(const CollisionShape& shape, const NumMatrix& R, NumVec t);
  explicit PlacedPolyhedron(const CollisionShape& shape);  // in its own frame

  using Edge = HullGeometry::Edge;
  [[nodiscard]] int vertex_count() const { return vertex_count_; }
  [[nodiscard]] int face_count() const { return face_count_; }
  [[nodiscard]] int edge_count() const { return edge_count_; }
  // By a counter, or by the index that an edge holds.
  template <std::integral Index>
  [[nodiscard]] NumVec vertex(Index i) const {
    return {x_[i], y_[i], z_[i]};
  }
  template <std::integral Index>
  [[nodiscard]] NumVec normal(Index k) const {
    return {normal_x_[k], normal_y_[k], normal_z_[k]};
  }
  [[nodiscard]] Num offset(int k) const { return offsets_[k]; }  // [m]
  [[nodiscard]] const Edge& edge(int i) const { return edges_[i]; }
  [[nodiscard]] Segment segment(int i) const {
    const Edge& e = edge(i);
    return {vertex(e.v0), vertex(e.v1)};
  }
  [[nodiscard]] NumVec centre() const { return centre_; }
  [[nodiscard]] Num inner_radius() const {
    return inner_radius_;
  }  // [m] of a ball about it, inside
  [[nodiscard]] Num outer_radius() const {
    return outer_radius_;
  }  // [m] of a ball about it, around

  [[nodiscard]] int support_index(NumVec d) const {
    int farthest = 0;
    Num best = dot(vertex(0), d);
    for (int i = 1; i < vertex_count_; ++i) {
      const Num along = dot(vertex(i), d);
      if (along > best) best = along, farthest = i;
    }
    return farthest;
  }
  // [m] The smallest n . x over the shape.
  [[nodiscard]] Num lowest_along(NumVec n) const {
    Num lowest = dot(vertex(0), n);
    for (int i = 1; i < vertex_count_; ++i) lowest = std::min(lowest, dot(vertex(i), n));
    return lowest;
  }
  // As the search for axes sees it. Faces may be uneven: the ball that is surely inside is a little
  // smaller.
  [[nodiscard]] PolyhedronLanes lanes() const {
    return {x_,
            y_,
            z_,
            normal_x_,
            normal_y_,
            normal_z_,
            offsets_,
            vertex_count_,
            face_count_,
            centre_.x,
            centre_.y,
            centre_.z,
            (Num(1) - Num(4) * kHullUnevenness) * inner_radius_};
  }
  // Of the faces at the farthest vertex, the one that looks most along d.
  [[nodiscard]] int face_facing(NumVec d) const;
  // The two faces beside the edge that runs most across d from the farthest vertex.
  void faces_facing(NumVec d, int (&out)[2]) const;
  void face(int index, FacePolygon& out) const;
  // [m] how far a point, seen along the face's normal, lies within all its sides.
  [[nodiscard]] Num room_within(int face, NumVec point) const;

 private:
  void place_box(const CollisionShape& shape, const NumMatrix& R, NumVec t);
  void begin_hull(const CollisionShape& shape);
  void set_vertex(int i, NumVec at) { x_[i] = at.x, y_[i] = at.y, z_[i] = at.z; }
  void set_face(int k, NumVec normal, Num offset) {
    normal_x_[k] = normal.x, normal_y_[k] = normal.y, normal_z_[k] = normal.z;
    offsets_[k] = offset;
  }
  void fill_up();

  static constexpr int kVertexRoom = filled_up(kMaxHullVertices);
  static constexpr int kFaceRoom = filled_up(kMaxHullFaces);
  const HullGeometry* hull_;  // null for a box
  const Edge* edges_;
  int vertex_count_, face_count_, edge_count_;
  NumVec centre_;
  Num inner_radius_, outer_radius_;
  Num x_[kVertexRoom], y_[kVertexRoom], z_[kVertexRoom];
  Num normal_x_[kFaceRoom], normal_y_[kFaceRoom], normal_z_[kFaceRoom], offsets_[kFaceRoom];
};

}  // namespace plumb::inline PLUMB_ABI::detail
