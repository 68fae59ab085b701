// How two triangles of one mesh lie to each other, exactly for the coordinates as given.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

enum class PairRelation {
  Apart,     // nothing in common but shared vertices and edges
  Touching,  // a common point on the rim of one of them, or a common piece of plane
  Crossing,  // an edge of one runs through the inside of the other
};

// Vertex indices must name places: equal places, equal indices. Both triangles must have area and
// must not have all three vertices in common. If an edge of one touches the other, `contact` is set
// to a point where it does [m], to rounding.
PairRelation relation_of(const std::vector<Eigen::Vector3d>& places, const Triangle& first,
                         const Triangle& second, std::optional<Eigen::Vector3d>& contact);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
