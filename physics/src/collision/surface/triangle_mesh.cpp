// TriangleMeshGeometry::create: welds, drops what has no area, finds neighbours, builds the tree.
#include <algorithm>
#include <limits>

#include "collision/contact_points.h"
#include "collision/surface/mesh_data.h"
#include "collision/surface/mesh_surface.h"
#include "math/eigen_bridge.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

struct HalfEdge {
  std::uint32_t low, high, triangle;
  std::uint8_t slot;
  bool upwards;  // runs from low to high
};

// For each vertex of the input the first one at the same place.
std::vector<std::uint32_t> weld(std::span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &u = vertices[a], &v = vertices[b];
    if (u.x() != v.x()) return u.x() < v.x();
    if (u.y() != v.y()) return u.y() < v.y();
    return u.z() < v.z();
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (before(a, b)) return true;
    return !before(b, a) && a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

bool has_area(NumVec a, NumVec b, NumVec c) {
  const Num longest =
      std::max({length_squared(b - a), length_squared(c - b), length_squared(a - c)});
  return length(doubled_area(a, b, c)) > kNoArea * longest;
}

// Keeps triangles with area, with vertices renumbered in the order of their first use.
void take_triangles(std::span<const Vec3> vertices, std::span<const std::uint32_t> indices,
                    MeshData& mesh) {
  const std::vector<std::uint32_t> first = weld(vertices);
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(vertices.size(), kUnused);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> v{first[indices[i]], first[indices[i + 1]],
                                         first[indices[i + 2]]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0] ||
        !has_area(to_num(vertices[v[0]]), to_num(vertices[v[1]]), to_num(vertices[v[2]]))) {
      ++mesh.dropped;
      continue;
    }
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (number[v[k]] == kUnused) {
        number[v[k]] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(to_inner(vertices[v[k]]));
      }
      corners[k] = number[v[k]];
    }
    mesh.corners.push_back(corners);
    mesh.source.push_back(static_cast<std::uint32_t>(i / 3));
  }
}

// Puts the triangles into the order of the tree's leaves.
void build_tree(MeshData& mesh) {
  std::vector<NumBox> boxes;
  boxes.reserve(mesh.corners.size());
  for (const auto& v : mesh.corners) {
    const NumVec a = to_num(mesh.vertices[v[0]]), b = to_num(mesh.vertices[v[1]]),
                 c = to_num(mesh.vertices[v[2]]);
    boxes.push_back({min_each(a, min_each(b, c)), max_each(a, max_each(b, c))});
  }
  const std::vector<std::uint32_t> order = mesh.tree.build(boxes);
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<std::uint32_t> source;
  for (const std::uint32_t t : order) {
    corners.push_back(mesh.corners[t]);
    source.push_back(mesh.source[t]);
  }
  mesh.corners = std::move(corners);
  mesh.source = std::move(source);
}

// Neighbours share an edge and run along it in opposite directions, nobody else uses it.
void link_neighbours(MeshData& mesh) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh.corners.size());
  for (std::uint32_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t v0 = mesh.corners[t][k], v1 = mesh.corners[t][(k + 1) % 3];
      halves.push_back({std::min(v0, v1), std::max(v0, v1), t, k, v0 < v1});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.slot < b.slot;
  });
  mesh.edges.assign(mesh.corners.size(), {});
  for (std::size_t i = 0, end = 0; i < halves.size(); i = end) {
    end = i + 1;
    while (end < halves.size() && halves[end].low == halves[i].low &&
           halves[end].high == halves[i].high)
      ++end;
    if (end - i == 1) {
      ++mesh.open_edges;
    } else if (end - i == 2 && halves[i].upwards != halves[i + 1].upwards) {
      const HalfEdge &a = halves[i], &b = halves[i + 1];
      mesh.edges[a.triangle][a.slot] = {b.triangle, EdgeKind::Flat};
      mesh.edges[b.triangle][b.slot] = {a.triangle, EdgeKind::Flat};
    } else {
      ++mesh.odd_edges;
    }
  }
}

std::uint32_t far_corner(const MeshData& mesh, std::uint32_t t, std::uint32_t v0,
                         std::uint32_t v1) {
  for (const std::uint32_t v : mesh.corners[t])
    if (v != v0 && v != v1) return v;
  return mesh.corners[t][0];
}

void name_edges(MeshData& mesh) {
  const MeshSurface surface(mesh, {1, 1, 1});
  std::vector<std::array<EdgeLink, 3>> named = mesh.edges;
  for (std::uint32_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = mesh.edges[t][k].triangle();
      if (other == EdgeLink::kNobody || other < t) continue;
      const std::uint32_t v0 = mesh.corners[t][k], v1 = mesh.corners[t][(k + 1) % 3];
      const EdgeKind kind = kind_of_edge(
          surface.vertex(v0), surface.vertex(v1), surface.normal_of(t),
          surface.vertex(far_corner(mesh, t, v0, v1)), surface.normal_of(other),
          surface.vertex(far_corner(mesh, other, v0, v1)), kFlatUlps * surface.rounding());
      const bool folded = kind == EdgeKind::Open;
      named[t][k] = {folded ? EdgeLink::kNobody : other, kind};
      for (std::size_t j = 0; j < 3; ++j) {
        if (mesh.corners[other][j] == v1 && mesh.corners[other][(j + 1) % 3] == v0)
          named[other][j] = {folded ? EdgeLink::kNobody : t, kind};
      }
    }
  }
  mesh.edges = std::move(named);
}

}  // namespace
}  // namespace detail

TriangleMeshGeometry::Result TriangleMeshGeometry::create(std::span<const Vec3> vertices,
                                                          std::span<const std::uint32_t> indices) {
  const auto bad = [](StatusCode code, const char* message) {
    return Result{nullptr, {code, message}};
  };
  if (indices.empty() || vertices.empty())
    return bad(StatusCode::BadShape, "a triangle mesh needs at least one triangle");
  if (indices.size() % 3 != 0)
    return bad(StatusCode::BadShape, "a triangle mesh needs three indices for each triangle");
  if (indices.size() / 3 > detail::StaticBvh::kMaxItems)
    return bad(StatusCode::CapacityExceeded,
               "a triangle mesh may have at most 134217728 triangles: cut it into several");
  for (const std::uint32_t i : indices) {
    if (i >= vertices.size())
      return bad(StatusCode::BadShape, "a triangle names a vertex that does not exist");
  }
  for (const Vec3& v : vertices) {
    if (!v.allFinite()) return bad(StatusCode::NotFinite, "a mesh's vertices must be finite [m]");
    if (static_cast<detail::Num>(v.cwiseAbs().maxCoeff()) > detail::kLargestSize)
      return bad(StatusCode::OutOfRange, "a mesh's vertices must lie within +-1e6 m");
  }
  auto data = std::make_shared<detail::MeshData>();
  detail::take_triangles(vertices, indices, *data);
  if (data->corners.empty())
    return bad(StatusCode::BadShape, "no triangle of the mesh has an area");
  detail::build_tree(*data);
  detail::link_neighbours(*data);
  detail::name_edges(*data);
  data->vertices.shrink_to_fit();
  auto mesh = std::make_shared<TriangleMeshGeometry>();
  mesh->lower_ = mesh->upper_ = detail::to_public(data->vertices[0]);
  for (const detail::Vec& v : data->vertices) {
    mesh->lower_ = mesh->lower_.cwiseMin(detail::to_public(v));
    mesh->upper_ = mesh->upper_.cwiseMax(detail::to_public(v));
  }
  mesh->data_ = std::move(data);
  return {std::move(mesh), {}};
}

std::size_t TriangleMeshGeometry::triangle_count() const { return data_->corners.size(); }
std::array<Vec3, 3> TriangleMeshGeometry::triangle(std::size_t t) const {
  const auto& v = data_->corners[t];
  return {detail::to_public(data_->vertices[v[0]]), detail::to_public(data_->vertices[v[1]]),
          detail::to_public(data_->vertices[v[2]])};
}
std::uint32_t TriangleMeshGeometry::source_of(std::size_t t) const { return data_->source[t]; }
EdgeKind TriangleMeshGeometry::edge_kind(std::size_t t, int k) const {
  return data_->edges[t][static_cast<std::size_t>(k)].kind();
}
std::size_t TriangleMeshGeometry::dropped_triangles() const { return data_->dropped; }
std::size_t TriangleMeshGeometry::open_edges() const { return data_->open_edges; }
std::size_t TriangleMeshGeometry::odd_edges() const { return data_->odd_edges; }
std::size_t TriangleMeshGeometry::bytes() const {
  const detail::MeshData& d = *data_;
  return d.vertices.size() * sizeof(detail::Vec) +
         d.corners.size() * (sizeof(d.corners[0]) + sizeof(d.edges[0]) + sizeof(d.source[0])) +
         d.tree.bytes();
}

void TriangleMeshGeometry::copy_input(std::vector<Vec3>& vertices,
                                      std::vector<std::uint32_t>& indices) const {
  vertices.clear();
  for (const detail::Vec& v : data_->vertices) vertices.push_back(detail::to_public(v));
  // Triangles that were dropped leave three times vertex 0 in their place.
  indices.assign(3 * (data_->corners.size() + data_->dropped), 0);
  for (std::size_t t = 0; t < data_->corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) indices[3 * data_->source[t] + k] = data_->corners[t][k];
}

}  // namespace plumb::inline PLUMB_ABI
