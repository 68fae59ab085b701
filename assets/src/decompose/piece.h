// A piece of a closed solid, and its exact cut by a plane.
//
// A face is a plane region given by its directed edges alone, the inside on their left seen from
// outside; it may have holes and several patches, and none of it is ever cut into triangles. That
// makes the cut of a face and the cap that closes a piece the same few lines, with nothing that
// could go wrong where a plane runs through corners or along faces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

struct CutPlane {
  Eigen::Vector3d normal;  // unit
  double offset = 0;       // the plane is normal . x = offset

  [[nodiscard]] double height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
  [[nodiscard]] CutPlane flipped() const { return {-normal, -offset}; }
};

struct Piece {
  struct Edge {
    std::uint32_t from, to;
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<Edge> edges;               // face by face
  std::vector<std::uint32_t> face_ends;  // of each face in `edges`
  double volume = 0;
  double cap_area = 0;  // of the last cut
};

// Of a closed, oriented surface over places.
Piece piece_of(const std::vector<Eigen::Vector3d>& places, const std::vector<Triangle>& faces);

// Those that faces use.
std::vector<Eigen::Vector3d> points_of(const Piece& piece);

// What lies in front of the plane. Points within `on_plane` of it count as on it and stay as they
// are, so that a cut along a face takes nothing of it along. Nothing left: no faces.
Piece in_front(const Piece& piece, const CutPlane& plane, double on_plane);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
