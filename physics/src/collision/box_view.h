// A box as a polyhedron: vertices, edges and faces by number.
//   vertex: bit i set = positive side of axis i
//   face:   2 * axis, + 1 for the negative side
//   edge:   4 * axis + (bits of its vertices on the two other axes)
#pragma once

#include <array>

#include "collision/face_overlay.h"

namespace plumb::inline PLUMB_ABI::detail {

constexpr int box_edge_index(int v0, int v1) {
  const int axis = (v0 ^ v1) >> 1;  // bit 1, 2, 4 -> 0, 1, 2
  const int low = axis == 0 ? 1 : 0, high = axis == 2 ? 1 : 2;
  return 4 * axis + ((v0 >> low) & 1) + 2 * ((v0 >> high) & 1);
}

struct BoxTables {
  std::array<std::array<int, 4>, 6> face_vertices{};  // counter-clockwise from outside
  std::array<std::array<int, 4>, 6> face_edges{};     // edge i joins vertex i to the next
};
constexpr BoxTables make_box_tables() {
  BoxTables tables;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3);
    const bool negative = face % 2 != 0;
    const int base = negative ? 0 : 1 << axis;
    const std::array<int, 4> loop =
        negative ? std::array<int, 4>{base, base | v, base | u | v, base | u}
                 : std::array<int, 4>{base, base | u, base | u | v, base | v};
    const auto k = static_cast<std::size_t>(face);
    tables.face_vertices[k] = loop;
    for (std::size_t i = 0; i < 4; ++i) {
      tables.face_edges[k][i] = box_edge_index(loop[i], loop[(i + 1) % 4]);
    }
  }
  return tables;
}
inline constexpr BoxTables kBoxTables = make_box_tables();

struct BoxView {
  NumVec centre;
  NumVec axes[3];  // unit
  NumVec half;     // [m]

  [[nodiscard]] NumVec vertex(int index) const {
    const Num x = (index & 1) != 0 ? half.x : -half.x, y = (index & 2) != 0 ? half.y : -half.y,
              z = (index & 4) != 0 ? half.z : -half.z;
    return centre + x * axes[0] + y * axes[1] + z * axes[2];
  }
  [[nodiscard]] int support_index(NumVec d) const {
    return (dot(d, axes[0]) > Num(0) ? 1 : 0) | (dot(d, axes[1]) > Num(0) ? 2 : 0) |
           (dot(d, axes[2]) > Num(0) ? 4 : 0);
  }
  // The face that looks most along d.
  [[nodiscard]] int face_facing(NumVec d) const {
    const NumVec along{dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])};
    const NumVec m = absolute(along);
    const int axis = m.x >= m.y ? (m.x >= m.z ? 0 : 2) : (m.y >= m.z ? 1 : 2);
    return 2 * axis + (component(along, axis) < Num(0) ? 1 : 0);
  }
  // The two faces beside the edge that runs most across d from the farthest vertex.
  void faces_facing(NumVec d, int (&out)[2]) const {
    const NumVec along{dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])};
    const NumVec m = absolute(along);
    const int across = m.x <= m.y ? (m.x <= m.z ? 0 : 2) : (m.y <= m.z ? 1 : 2);
    for (int i = 0; i < 2; ++i) {
      const int axis = (across + 1 + i) % 3;
      out[i] = 2 * axis + (component(along, axis) > Num(0) ? 0 : 1);
    }
  }
  void face(int index, FacePolygon& out) const {
    const int axis = index / 2;
    const Num sign = index % 2 == 0 ? Num(1) : Num(-1);
    const auto k = static_cast<std::size_t>(index);
    out.count = 4;
    out.name = face_name(index);
    out.normal = sign * axes[axis];
    out.offset = dot(out.normal, centre) + component(half, axis);
    for (std::size_t i = 0; i < 4; ++i) {
      out.points[i] = vertex(kBoxTables.face_vertices[k][i]);
      out.vertex_names[i] = vertex_name(kBoxTables.face_vertices[k][i]);
      out.edge_names[i] = edge_name(kBoxTables.face_edges[k][i]);
    }
  }
};

}  // namespace plumb::inline PLUMB_ABI::detail
