// The edges where a solid is hollow: the planes through them are where it wants to be cut.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "decompose/piece.h"
#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

struct ConcaveEdge {
  Eigen::Vector3d a, b;                // its ends
  Eigen::Vector3d normal_1, normal_2;  // unit, outward, of its faces
  double angle = 0;                    // [rad] that it is short of flat, > 0
};

// Of a closed, oriented surface over places. Edges of more than two faces are left out.
std::vector<ConcaveEdge> concave_edges(const std::vector<Eigen::Vector3d>& places,
                                       const std::vector<Triangle>& faces);

// What of them lies in front of the plane by more than `on_plane`.
std::vector<ConcaveEdge> in_front(const std::vector<ConcaveEdge>& edges, const CutPlane& plane,
                                  double on_plane);

// Planes through the deepest of them, at most `count`: both faces' own and the one midway. No two
// are nearly the same.
std::vector<CutPlane> planes_through(const std::vector<ConcaveEdge>& edges, std::size_t count);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
