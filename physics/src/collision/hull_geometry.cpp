// HullGeometry::create: checks a polyhedron once, and derives what the collision routines need. All
// sums in double, whatever Real is.
#include <algorithm>
#include <limits>

#include "collision/contact_points.h"
#include "math/eigen_bridge.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using detail::Num;
using detail::NumVec;

HullGeometry::Result bad(const char* message) { return {nullptr, {StatusCode::BadShape, message}}; }

struct HalfEdge {
  std::uint32_t v0, v1, face, slot;  // slot: place in the list of all face vertices
  [[nodiscard]] std::uint32_t low() const { return std::min(v0, v1); }
  [[nodiscard]] std::uint32_t high() const { return std::max(v0, v1); }
};

struct Plane {
  NumVec normal;
  Num offset;
};

// Vector area by Newell's sum about a point of the face: exact for any polygon, and the mean plane
// of an uneven one.
NumVec doubled_vector_area(std::span<const NumVec> points, std::span<const std::uint32_t> loop) {
  NumVec sum{0, 0, 0};
  const NumVec origin = points[loop[0]];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += cross(points[loop[i]] - origin, points[loop[i + 1]] - origin);
  }
  return sum;
}

struct Solid {
  Num volume;       // [m^3]
  NumVec centroid;  // [m]
};
// Tetrahedra from the mean of the vertices, so that a hull far from its origin keeps its digits.
Solid solid_of(std::span<const NumVec> points, std::span<const std::uint32_t> sizes,
               std::span<const std::uint32_t> loops) {
  NumVec mean{0, 0, 0};
  for (const NumVec& p : points) mean += p;
  mean = (Num(1) / static_cast<Num>(points.size())) * mean;
  Num sum = 0;
  NumVec moment{0, 0, 0};
  for (std::size_t k = 0, start = 0; k < sizes.size(); start += sizes[k], ++k) {
    const NumVec a = points[loops[start]] - mean;
    for (std::size_t i = 1; i + 1 < sizes[k]; ++i) {
      const NumVec b = points[loops[start + i]] - mean, c = points[loops[start + i + 1]] - mean;
      const Num six_volumes = dot(a, cross(b, c));
      sum += six_volumes;
      moment += six_volumes * (a + b + c);
    }
  }
  if (!(sum > Num(0))) return {Num(0), mean};
  return {sum / Num(6), mean + (Num(0.25) / sum) * moment};
}

const char* check_input(std::span<const Vec3> vertices, std::span<const std::uint32_t> sizes,
                        std::span<const std::uint32_t> loops) {
  if (vertices.size() < 4 || sizes.size() < 4)
    return "a hull needs at least 4 vertices and 4 faces";
  if (vertices.size() > static_cast<std::size_t>(detail::kMaxHullVertices)) {
    return "a hull may have at most 256 vertices: simplify it first";
  }
  std::size_t total = 0;
  for (const std::uint32_t size : sizes) {
    if (size < 3) return "each face of a hull needs at least 3 vertices";
    if (size > static_cast<std::uint32_t>(detail::kMaxFaceVertices)) {
      return "a face of a hull may have at most 64 vertices: simplify it first";
    }
    total += size;
  }
  if (total != loops.size())
    return "the face sizes of a hull must add up to its list of face vertices";
  for (const std::uint32_t v : loops) {
    if (v >= vertices.size()) return "a face of a hull names a vertex that does not exist";
  }
  return nullptr;
}

// Half-edges sorted so that the two of an edge are neighbours; on success `edges` holds each once.
const char* pair_edges(std::vector<HalfEdge>& halves, std::vector<HullGeometry::Edge>& edges,
                       std::vector<std::uint32_t>& face_edges) {
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low() != b.low()) return a.low() < b.low();
    if (a.high() != b.high()) return a.high() < b.high();
    return a.slot < b.slot;
  });
  constexpr const char* kOpen =
      "each edge of a hull must be shared by exactly two faces that run along it in opposite "
      "directions";
  if (halves.size() % 2 != 0) return kOpen;
  face_edges.resize(halves.size());
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    const HalfEdge& a = halves[i];
    const HalfEdge& b = halves[i + 1];
    if (a.v0 == a.v1) return "a face of a hull has the same vertex twice in a row";
    if (a.v0 != b.v1 || a.v1 != b.v0 || a.face == b.face) return kOpen;
    if (i > 0 && a.low() == halves[i - 1].low() && a.high() == halves[i - 1].high()) return kOpen;
    face_edges[a.slot] = face_edges[b.slot] = static_cast<std::uint32_t>(edges.size());
    edges.push_back({a.v0, a.v1, a.face, b.face});
  }
  return nullptr;
}

}  // namespace

HullGeometry::Result HullGeometry::create(std::span<const Vec3> vertices,
                                          std::span<const std::uint32_t> face_sizes,
                                          std::span<const std::uint32_t> face_vertices) {
  if (const char* message = check_input(vertices, face_sizes, face_vertices)) return bad(message);
  std::vector<NumVec> points;
  points.reserve(vertices.size());
  for (const Vec3& v : vertices) {
    if (!v.allFinite())
      return {nullptr, {StatusCode::NotFinite, "a hull's vertices must be finite"}};
    points.push_back(detail::to_num(v));
  }

  // Topology: closed, of one piece, without handles.
  auto hull = std::make_shared<HullGeometry>();
  hull->vertices_.assign(vertices.begin(), vertices.end());
  hull->face_vertices_.assign(face_vertices.begin(), face_vertices.end());
  hull->face_starts_.push_back(0);
  std::vector<HalfEdge> halves;
  std::vector<int> uses(points.size(), 0);
  for (std::uint32_t k = 0, start = 0; k < face_sizes.size(); start += face_sizes[k], ++k) {
    for (std::uint32_t i = 0; i < face_sizes[k]; ++i) {
      const std::uint32_t slot = start + i, next = start + (i + 1) % face_sizes[k];
      halves.push_back({face_vertices[slot], face_vertices[next], k, slot});
      ++uses[face_vertices[slot]];
    }
    hull->face_starts_.push_back(start + face_sizes[k]);
  }
  if (const char* message = pair_edges(halves, hull->edges_, hull->face_edges_))
    return bad(message);
  if (std::any_of(uses.begin(), uses.end(), [](int n) { return n < 3; })) {
    return bad("each vertex of a hull must be used by at least three faces");
  }
  if (points.size() + face_sizes.size() != hull->edges_.size() + 2) {
    return bad("a hull must be one closed surface without holes (vertices - edges + faces = 2)");
  }

  // Planes: through the mean direction of each face, moved out to hold every vertex.
  const Solid solid = solid_of(points, face_sizes, face_vertices);
  if (!(solid.volume > Num(0))) {
    return bad("a hull must have volume and its faces run counter-clockwise seen from outside");
  }
  std::vector<Plane> planes;
  Num width = std::numeric_limits<Num>::infinity(), inner = width;
  for (std::size_t k = 0; k < face_sizes.size(); ++k) {
    const NumVec area = doubled_vector_area(points, hull->face(k));
    const NumVec normal = normalized_or(area, NumVec{0, 0, 0});
    if (!(length_squared(normal) > Num(0))) return bad("a face of a hull has no area");
    Num lowest = std::numeric_limits<Num>::infinity(), highest = -lowest;
    for (const NumVec& p : points) {
      const Num along = dot(normal, p - solid.centroid);
      lowest = std::min(lowest, along);
      highest = std::max(highest, along);
    }
    width = std::min(width, highest - lowest);
    inner = std::min(inner, highest);
    planes.push_back({normal, highest});
  }
  // Each vertex of a face must lie in the plane that holds all: uneven and reflex faces both fail
  // this.
  const Num allowed = detail::kHullUnevenness * width;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    for (const std::uint32_t v : hull->face(k)) {
      if (!(dot(planes[k].normal, points[v] - solid.centroid) >= planes[k].offset - allowed)) {
        return bad("a hull must be convex and its faces flat, to 0.001 of its smallest width");
      }
    }
  }

  Num outer_squared = 0;
  for (const NumVec& p : points)
    outer_squared = std::max(outer_squared, length_squared(p - solid.centroid));
  for (const Plane& plane : planes) {
    hull->face_normals_.push_back(detail::to_public(detail::cast<Real>(plane.normal)));
    hull->face_offsets_.push_back(
        static_cast<Real>(plane.offset + dot(plane.normal, solid.centroid)));
  }
  hull->interior_point_ = detail::to_public(detail::cast<Real>(solid.centroid));
  hull->inner_radius_ = static_cast<Real>(inner);
  hull->outer_radius_ = static_cast<Real>(std::sqrt(outer_squared));
  return {std::move(hull), {}};
}

HullGeometry::Result HullGeometry::scaled(const Vec3& factors) const {
  if (!factors.allFinite())
    return {nullptr, {StatusCode::NotFinite, "a hull's scale must be finite"}};
  if (!(factors.minCoeff() > Real(0))) {
    return {nullptr,
            {StatusCode::OutOfRange,
             "a hull's scale must be greater than zero on each axis: mirror the points instead"}};
  }
  std::vector<Vec3> points;
  for (const Vec3& v : vertices_) points.push_back(v.cwiseProduct(factors));
  std::vector<std::uint32_t> sizes;
  for (std::size_t k = 0; k < face_count(); ++k)
    sizes.push_back(static_cast<std::uint32_t>(face(k).size()));
  return create(points, sizes, face_vertices_);
}

}  // namespace plumb::inline PLUMB_ABI
