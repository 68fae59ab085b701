// A triangle mesh, stretched by its instance's scale, as collision sees it.
#pragma once

#include "collision/surface/mesh_data.h"
#include "collision/surface/surface_triangle.h"

namespace plumb::inline PLUMB_ABI::detail {

class MeshSurface final : public SurfaceSource {
 public:
  MeshSurface(const MeshData& mesh, NumVec scale) : mesh_(mesh), scale_(scale) {
    const NumBox box = mesh.tree.bounds();
    const NumVec far = max_each(absolute(box.lower), absolute(box.upper));
    constexpr Num kUlp = std::numeric_limits<Real>::epsilon();
    rounding_ = kUlp * std::max({far.x, far.y, far.z});
    is_scaled_ = scale.x != Num(1) || scale.y != Num(1) || scale.z != Num(1);
  }

  [[nodiscard]] NumBox bounds() const { return scaled(mesh_.tree.bounds()); }
  [[nodiscard]] NumVec vertex(std::uint32_t i) const {
    return multiply_each(scale_, cast<Num>(mesh_.vertices[i]));
  }
  // [m] of a vertex, without the scale.
  [[nodiscard]] Num rounding() const { return rounding_; }
  // Unit. A sliver's own would be noise: it takes that of its neighbour over the longest side.
  [[nodiscard]] NumVec normal_of(std::uint32_t t) const;
  void triangle(std::uint32_t t, SurfaceTriangle& out) const;  // without its neighbours
  void complete(SurfaceTriangle& t) const override;
  [[nodiscard]] bool corner_allows(const SurfaceTriangle& t, int corner, NumVec n) const override;

  // visit(const SurfaceTriangle&) for those whose own boxes overlap the box.
  template <class Visit>
  void query(const NumBox& box, Visit&& visit) const {
    SurfaceTriangle t;
    mesh_.tree.query(unscaled(box), [&](std::uint32_t place) {
      place_corners(place, t);
      if (!overlaps(box_of(t), box)) return;
      place_plane(t);
      visit(t);
    });
  }
  template <class Visit>
  void cast_segment(NumVec origin, NumVec direction, Num max_fraction, Visit&& visit) const {
    SurfaceTriangle t;
    const SegmentQuery ray(divide(origin), divide(direction));
    mesh_.tree.cast(ray, max_fraction, [&](std::uint32_t place, Num largest) {
      triangle(place, t);
      return visit(t, largest);
    });
  }
  // visit(triangle, largest squared distance from `box`) -> new largest.
  template <class Visit>
  void nearest(const NumBox& box, Num largest, Visit&& visit) const {
    SurfaceTriangle t;
    mesh_.tree.nearest([&](const NumBox& node) { return squared_gap(scaled(node), box); }, largest,
                       [&](std::uint32_t place, Num so_far) {
                         triangle(place, t);
                         return visit(t, so_far);
                       });
  }

 private:
  [[nodiscard]] NumVec divide(NumVec v) const {
    return {v.x / scale_.x, v.y / scale_.y, v.z / scale_.z};
  }
  [[nodiscard]] NumBox scaled(const NumBox& b) const {
    return {multiply_each(scale_, b.lower), multiply_each(scale_, b.upper)};
  }
  [[nodiscard]] NumBox unscaled(const NumBox& b) const {
    return {divide(b.lower), divide(b.upper)};
  }
  // The two halves of triangle().
  void place_corners(std::uint32_t t, SurfaceTriangle& out) const {
    out.id = t;
    for (std::uint32_t k = 0; k < 3; ++k) {
      out.corner_id[k] = mesh_.corners[t][k];
      out.corner[k] = vertex(out.corner_id[k]);
    }
  }
  void place_plane(SurfaceTriangle& out) const {
    out.normal = normal_of(out.id);
    out.offset = dot(out.normal, out.corner[0]);
  }
  [[nodiscard]] static NumBox box_of(const SurfaceTriangle& t) {
    return {min_each(t.corner[0], min_each(t.corner[1], t.corner[2])),
            max_each(t.corner[0], max_each(t.corner[1], t.corner[2]))};
  }
  [[nodiscard]] std::uint32_t edge_id(std::uint32_t t, std::uint32_t k) const;

  const MeshData& mesh_;
  NumVec scale_;
  Num rounding_;
  bool is_scaled_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
