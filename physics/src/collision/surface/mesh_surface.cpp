#include "collision/surface/mesh_surface.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Triangles around one corner at most; more would mean a damaged fan.
constexpr int kMaxFan = 4096;

}  // namespace

NumVec MeshSurface::normal_of(std::uint32_t t) const {
  const auto own = [this](std::uint32_t i) {
    const auto& v = mesh_.corners[i];
    return doubled_area(vertex(v[0]), vertex(v[1]), vertex(v[2]));
  };
  // Lowest height, without the scale, from the sides as they were rounded.
  const auto& v = mesh_.corners[t];
  const NumVec p[3] = {cast<Num>(mesh_.vertices[v[0]]), cast<Num>(mesh_.vertices[v[1]]),
                       cast<Num>(mesh_.vertices[v[2]])};
  std::size_t longest = 0;
  Num side = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Num squared = length_squared(p[(k + 1) % 3] - p[k]);
    if (squared > side) side = squared, longest = k;
  }
  const Num low = kSliverUlps * rounding_;
  const NumVec unscaled_area = doubled_area(p[0], p[1], p[2]);
  const Num area_squared = length_squared(unscaled_area);
  NumVec n = is_scaled_ ? own(t) : unscaled_area;
  const std::uint32_t other =
      mesh_.edges.empty() ? EdgeLink::kNobody : mesh_.edges[t][longest].triangle();
  if (area_squared < low * low * side && other != EdgeLink::kNobody) {
    const NumVec borrowed = own(other);
    if (length_squared(borrowed) > length_squared(n)) n = borrowed;
  }
  return normalized_or(n, NumVec{0, 1, 0});
}

std::uint32_t MeshSurface::edge_id(std::uint32_t t, std::uint32_t k) const {
  const std::uint32_t own = 3 * t + k, other = mesh_.edges[t][k].triangle();
  if (other == EdgeLink::kNobody || other > t) return own;
  const std::uint32_t v0 = mesh_.corners[t][k];
  for (std::uint32_t j = 0; j < 3; ++j)
    if (mesh_.corners[other][(j + 1) % 3] == v0 && mesh_.edges[other][j].triangle() == t)
      return 3 * other + j;
  return own;
}

void MeshSurface::triangle(std::uint32_t t, SurfaceTriangle& out) const {
  place_corners(t, out);
  place_plane(out);
}

void MeshSurface::complete(SurfaceTriangle& t) const {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const EdgeLink link = mesh_.edges[t.id][k];
    t.kind[k] = link.kind();
    t.edge_id[k] = edge_id(t.id, k);
    t.beyond[k] = t.kind[k] == EdgeKind::Convex ? normal_of(link.triangle()) : t.normal;
  }
}

bool MeshSurface::corner_allows(const SurfaceTriangle& t, int corner, NumVec n) const {
  const std::uint32_t at = t.corner_id[corner];
  const NumVec p = t.corner[corner];
  const auto rises = [&](std::uint32_t v) {
    const NumVec d = vertex(v) - p;
    return dot(n, d) > kConeSlack * length(d);
  };
  const auto place_in = [&](std::uint32_t triangle) -> std::size_t {
    const auto& v = mesh_.corners[triangle];
    return v[0] == at ? 0 : (v[1] == at ? 1 : 2);
  };
  // Around the corner: over the edge that leaves it, and, where the fan is open, over the other.
  for (const bool leaving : {true, false}) {
    std::uint32_t triangle = t.id;
    for (int i = 0; i < kMaxFan; ++i) {
      const std::size_t c = place_in(triangle);
      const auto& v = mesh_.corners[triangle];
      if (rises(v[(c + 1) % 3]) || rises(v[(c + 2) % 3])) return false;
      triangle = mesh_.edges[triangle][leaving ? c : (c + 2) % 3].triangle();
      if (triangle == t.id) return true;
      if (triangle == EdgeLink::kNobody) break;
    }
  }
  return dot(n, t.normal) >= -kConeSlack;  // where the surface ends it still has one side only
}

}  // namespace plumb::inline PLUMB_ABI::detail
