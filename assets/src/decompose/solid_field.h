// How far points lie from a solid, and on which side of its surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "geometry/winding.h"
#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

class SolidField {
 public:
  // A closed, oriented surface over places; the arrays must outlive the field. `faces_apart`: no
  // two faces touch but where they are joined.
  SolidField(const std::vector<Eigen::Vector3d>& places, const std::vector<Triangle>& faces,
             bool faces_apart);

  struct Nearest {
    double distance;  // to the surface, from either side
    std::uint32_t face;
  };
  // `guess`: any face; the nearer it is, the shorter the search.
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& point, std::uint32_t guess = 0) const;
  // Of points off the surface, whose nearest face is known.
  [[nodiscard]] bool is_inside(const Eigen::Vector3d& point, std::uint32_t nearest_face) const;

 private:
  [[nodiscard]] double distance_to(std::uint32_t face, const Eigen::Vector3d& point) const;

  const std::vector<Eigen::Vector3d>& places_;
  const std::vector<Triangle>& faces_;
  bool faces_apart_;
  TriangleBvh bvh_;
  WindingField winding_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::detail
