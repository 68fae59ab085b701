// A hull or box copied into the frame in which a pair is tested, in double precision.
#pragma once

#include <concepts>

#include "collision/face_overlay.h"
#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {

class PlacedPolyhedron {
 public:
  // Point x of the shape's frame stands at R x + t. The arrays are not initialised beyond the
  // counts.
  PlacedPolyhedron(const CollisionShape& shape, const NumMatrix& R, NumVec t);

  using Edge = HullGeometry::Edge;
  [[nodiscard]] int vertex_count() const { return vertex_count_; }
  [[nodiscard]] int face_count() const { return face_count_; }
  [[nodiscard]] int edge_count() const { return edge_count_; }
  // By a counter, or by the index that an edge holds.
  template <std::integral Index>
  [[nodiscard]] NumVec vertex(Index i) const {
    return vertices_[i];
  }
  template <std::integral Index>
  [[nodiscard]] NumVec normal(Index k) const {
    return normals_[k];
  }
  [[nodiscard]] Num offset(int k) const { return offsets_[k]; }  // [m]
  [[nodiscard]] const Edge& edge(int i) const { return edges_[i]; }
  [[nodiscard]] Segment segment(int i) const {
    const Edge& e = edge(i);
    return {vertices_[e.v0], vertices_[e.v1]};
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
    Num best = dot(vertices_[0], d);
    for (int i = 1; i < vertex_count_; ++i) {
      const Num along = dot(vertices_[i], d);
      if (along > best) best = along, farthest = i;
    }
    return farthest;
  }
  // [m] the smallest n . x over the shape.
  [[nodiscard]] Num lowest_along(NumVec n) const {
    Num lowest = dot(vertices_[0], n);
    for (int i = 1; i < vertex_count_; ++i) lowest = std::min(lowest, dot(vertices_[i], n));
    return lowest;
  }
  // Of the faces at the farthest vertex, the one that looks most along d.
  [[nodiscard]] int face_facing(NumVec d) const;
  // The two faces beside the edge that runs most across d from the farthest vertex.
  void faces_facing(NumVec d, int (&out)[2]) const;
  void face(int index, FacePolygon& out) const;

 private:
  const HullGeometry* hull_;  // null for a box
  const Edge* edges_;
  int vertex_count_, face_count_, edge_count_;
  NumVec centre_;
  Num inner_radius_, outer_radius_;
  NumVec vertices_[kMaxHullVertices];
  NumVec normals_[kMaxHullFaces];
  Num offsets_[kMaxHullFaces];
};

}  // namespace plumb::inline PLUMB_ABI::detail
