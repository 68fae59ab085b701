#include "plumb/assets/repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/triangle_area.h"
#include "geometry/winding.h"
#include "mesh/topology.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using Eigen::Vector3d;

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// Faces without area that hang on the surface by a side of their own. Those that fill a T-junction
// (all sides shared) hold the surface closed and stay; they add nothing to any integral.
std::size_t drop_hanging_slivers(TriangleMesh& mesh) {
  std::vector<bool> hangs(mesh.triangles.size(), false);
  const auto uses = detail::sorted_edge_uses(mesh.triangles);
  detail::for_each_edge(uses, [&](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 == 0) return;
    for (std::size_t i = begin; i < end; ++i) hangs[uses[i].face] = true;
  });
  std::vector<Triangle> kept;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const double area =
        detail::area_or_zero(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    if (area > 0 || !hangs[f]) kept.push_back(t);
  }
  const std::size_t dropped = mesh.triangles.size() - kept.size();
  mesh.triangles = std::move(kept);
  return dropped;
}

double signed_volume(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces) {
  const Vector3d reference = bounds_of(mesh).center();
  double volume = 0;
  for (const std::uint32_t f : faces) {
    const Triangle& t = mesh.triangles[f];
    const Vector3d a = mesh.vertices[t[0]] - reference;
    volume += a.dot((mesh.vertices[t[1]] - reference).cross(mesh.vertices[t[2]] - reference)) / 6;
  }
  return volume;
}

void flip(Triangle& t) { std::swap(t[1], t[2]); }

// Turns every patch so that it faces outwards, or inwards if it lies inside an odd number of
// others.
void turn_patches(Repaired& repaired, const detail::Flips& flips) {
  TriangleMesh& mesh = repaired.mesh;
  std::vector<std::vector<std::uint32_t>> patches(flips.patches);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) patches[flips.patch_of[f]].push_back(f);
  std::vector<detail::WindingField> fields;
  std::vector<Eigen::AlignedBox3d> boxes(patches.size());
  fields.reserve(patches.size());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    fields.emplace_back(mesh.vertices, mesh.triangles, patches[p]);
    for (const std::uint32_t f : patches[p]) {
      for (const std::uint32_t v : mesh.triangles[f]) boxes[p].extend(mesh.vertices[v]);
    }
  }
  std::vector<bool> turn(patches.size(), false);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Triangle& t = mesh.triangles[patches[p].front()];
    const Vector3d sample = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    std::size_t depth = 0;
    for (std::size_t other = 0; other < patches.size(); ++other) {
      if (other == p || !boxes[other].contains(boxes[p])) continue;
      if (std::abs(fields[other].at(sample)) > 0.5) ++depth;
    }
    const bool outward = signed_volume(mesh, patches[p]) >= 0;
    turn[p] = outward != (depth % 2 == 0);
  }
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!turn[p]) continue;
    for (const std::uint32_t f : patches[p]) flip(mesh.triangles[f]);
  }
}

}  // namespace

Result<Repaired> repair(const TriangleMesh& mesh, const RepairOptions& options) {
  if (!(options.weld_tolerance >= 0) || !std::isfinite(options.weld_tolerance)) {
    return Error{"repair: weld_tolerance must be finite and at least 0 m"};
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      if (v >= mesh.vertices.size()) {
        return Error{"repair: mesh '" + mesh.name + "' has a triangle with vertex " +
                     std::to_string(v) + " of " + std::to_string(mesh.vertices.size()) +
                     "; export it again"};
      }
      if (!mesh.vertices[v].allFinite()) {
        return Error{"repair: vertex " + std::to_string(v) + " of mesh '" + mesh.name +
                     "' is not finite; export it again"};
      }
    }
  }
  Repaired repaired;
  repaired.mesh.name = mesh.name;
  repaired.mesh.coordinate_rounding = mesh.coordinate_rounding;
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) used[v] = true;
  }
  std::vector<Vector3d> vertices;
  std::vector<std::uint32_t> compact(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!used[v]) continue;
    compact[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  detail::Places places = detail::gather_places(vertices, options.weld_tolerance);
  repaired.welded_vertices = vertices.size() - places.positions.size();
  repaired.mesh.vertices = std::move(places.positions);

  std::set<Triangle> seen;
  for (const Triangle& triangle : mesh.triangles) {
    Triangle face{};
    for (std::size_t i = 0; i < 3; ++i) face[i] = places.place_of[compact[triangle[i]]];
    if (options.drop_degenerate_faces && repeats_a_vertex(face)) {
      ++repaired.dropped_degenerate;
      continue;
    }
    Triangle key = face;
    std::sort(key.begin(), key.end());
    if (!seen.insert(key).second && options.drop_duplicate_faces) {
      ++repaired.dropped_duplicate;
      continue;
    }
    repaired.mesh.triangles.push_back(face);
  }
  if (options.drop_degenerate_faces)
    repaired.dropped_degenerate += drop_hanging_slivers(repaired.mesh);

  if (options.orient) {
    const std::vector<Triangle> before = repaired.mesh.triangles;
    const auto uses = detail::sorted_edge_uses(repaired.mesh.triangles);
    const detail::Flips flips = detail::consistent_flips(repaired.mesh.triangles.size(), uses);
    repaired.orientable = flips.orientable;
    for (std::size_t f = 0; f < repaired.mesh.triangles.size(); ++f) {
      if (flips.flip[f]) flip(repaired.mesh.triangles[f]);
    }
    turn_patches(repaired, flips);
    for (std::size_t f = 0; f < before.size(); ++f) {
      if (before[f] != repaired.mesh.triangles[f]) ++repaired.flipped_faces;
    }
  }
  return repaired;
}

std::string Repaired::text() const {
  std::string text = std::to_string(welded_vertices) + " vertices welded, " +
                     std::to_string(dropped_degenerate) + " degenerate and " +
                     std::to_string(dropped_duplicate) + " duplicate faces dropped, " +
                     std::to_string(flipped_faces) + " faces turned";
  if (!orientable) text += "; part of the surface is one-sided";
  return text;
}

}  // namespace plumb::inline PLUMB_ABI::assets
