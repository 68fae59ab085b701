// The convex hull of a piece as the search wants it: corners, planes, volume, and nothing that
// takes longer.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <vector>

#include "decompose/piece.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Lengths and volumes of a solid of size 1.
struct Tolerances {
  double limit = 0;     // how far parts may be from the solid
  double on_plane = 0;  // points this near to a plane count as on it
  double film = 0;      // a volume that is nothing but rounding
};

struct PartHull {
  std::vector<Eigen::Vector3d> corners;
  std::vector<CutPlane> planes;  // outward
  Eigen::AlignedBox3d box;
  double volume = 0;
  // No point of the hull is farther from the solid than this, as far as is known.
  double reach = std::numeric_limits<double>::infinity();

  // The largest height above a plane: < 0 inside; outside at most the distance.
  [[nodiscard]] double height(const Eigen::Vector3d& p) const;
};

// None if the points are too flat for a body.
std::optional<PartHull> part_hull(const std::vector<Eigen::Vector3d>& points);
// Of both together.
std::optional<PartHull> joined(const PartHull& a, const PartHull& b);

// The volume that two parts share.
double shared_volume(const PartHull& a, const PartHull& b);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
