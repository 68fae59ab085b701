#include "certificate/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/triangle_area.h"
#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Vertices that finite-index triangles use; counts the faults of the arrays on the way.
std::vector<bool> usable_triangles(const TriangleMesh& mesh, MeshCertificate& certificate) {
  std::vector<bool> used(mesh.vertices.size(), false), usable(mesh.triangles.size(), true);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      usable[t] = usable[t] && v < mesh.vertices.size();
    if (!usable[t]) {
      ++certificate.out_of_range_triangles;
      continue;
    }
    for (const std::uint32_t v : mesh.triangles[t]) {
      used[v] = true;
      if (!mesh.vertices[v].allFinite()) usable[t] = false;
    }
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) ++certificate.unused_vertices;
    if (used[v] && !mesh.vertices[v].allFinite()) ++certificate.non_finite_vertices;
  }
  return usable;
}

std::size_t count_duplicate_faces(const std::vector<Triangle>& faces) {
  std::vector<Triangle> sorted = faces;
  for (Triangle& face : sorted) std::sort(face.begin(), face.end());
  std::sort(sorted.begin(), sorted.end());
  std::size_t count = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) count += sorted[i] == sorted[i - 1] ? 1u : 0u;
  return count;
}

// Corners of faces around a place, joined across two-sided edges, form fans; a place of a manifold
// has one.
std::vector<bool> places_of_several_fans(const Surface& surface) {
  UnionFind fans(3 * surface.faces.size());
  const auto corner_at = [&](const EdgeUse& use, std::uint32_t place) {
    const std::uint32_t next = (use.corner + 1u) % 3u;
    return 3 * use.face + (surface.faces[use.face][use.corner] == place ? use.corner : next);
  };
  for_each_edge(surface.uses, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const EdgeUse &a = surface.uses[begin], &b = surface.uses[begin + 1];
    fans.join(corner_at(a, a.low), corner_at(b, a.low));
    fans.join(corner_at(a, a.high), corner_at(b, a.high));
  });
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> fan_at(surface.places.size(), kNone);
  std::vector<bool> several(surface.places.size(), false);
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t place = surface.faces[f][corner], fan = fans.find(3 * f + corner);
      if (fan_at[place] == kNone) fan_at[place] = fan;
      if (fan_at[place] != fan) several[place] = true;
    }
  }
  return several;
}

struct EdgeTally {
  bool odd, unbalanced, crowded;
};

EdgeTally tally(const Surface& surface, std::size_t begin, std::size_t end) {
  const auto forward = std::count_if(surface.uses.begin() + static_cast<std::ptrdiff_t>(begin),
                                     surface.uses.begin() + static_cast<std::ptrdiff_t>(end),
                                     [](const EdgeUse& use) { return use.forward; });
  const auto total = static_cast<std::ptrdiff_t>(end - begin);
  const std::ptrdiff_t difference = std::abs(2 * forward - total);
  return {total % 2 != 0, difference > total % 2, total > 2};
}

void examine_components(Surface& surface, const std::vector<bool>& several_fans,
                        MeshCertificate& certificate) {
  UnionFind joined(surface.faces.size());
  for_each_edge(surface.uses, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end; ++i)
      joined.join(surface.uses[begin].face, surface.uses[i].face);
  });
  surface.component_of.resize(surface.faces.size());
  std::vector<ComponentCertificate>& list = certificate.component_list;
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    const std::uint32_t root = joined.find(f);
    if (root == f) {
      surface.component_of[f] = static_cast<std::uint32_t>(list.size());
      list.emplace_back();
      list.back().closed = true;
    } else {
      surface.component_of[f] = surface.component_of[root];
    }
  }
  certificate.components = list.size();

  const Vector3d reference = certificate.bounds.center();
  std::vector<bool> manifold(list.size(), true), oriented(list.size(), true);
  std::vector<std::array<std::uint32_t, 2>> place_in_component;
  place_in_component.reserve(3 * surface.faces.size());
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    ComponentCertificate& component = list[surface.component_of[f]];
    ++component.faces;
    component.area += surface.areas[f];
    const Triangle& t = surface.faces[f];
    const Vector3d a = surface.places[t[0]] - reference, b = surface.places[t[1]] - reference,
                   c = surface.places[t[2]] - reference;
    component.signed_volume += a.dot(b.cross(c)) / 6;
    for (const std::uint32_t place : t) {
      place_in_component.push_back({surface.component_of[f], place});
      if (several_fans[place]) manifold[surface.component_of[f]] = false;
    }
  }
  std::sort(place_in_component.begin(), place_in_component.end());
  place_in_component.erase(std::unique(place_in_component.begin(), place_in_component.end()),
                           place_in_component.end());
  for (const auto& entry : place_in_component) ++list[entry[0]].vertices;
  for (ComponentCertificate& component : list) {
    component.euler_characteristic =
        static_cast<std::int64_t>(component.vertices) + static_cast<std::int64_t>(component.faces);
  }
  for_each_edge(surface.uses, [&](std::size_t begin, std::size_t end) {
    const std::uint32_t c = surface.component_of[surface.uses[begin].face];
    const EdgeTally edge = tally(surface, begin, end);
    --list[c].euler_characteristic;
    if (edge.odd) list[c].closed = false;
    if (edge.crowded) manifold[c] = false;
    if (edge.unbalanced) oriented[c] = false;
  });
  for (std::size_t c = 0; c < list.size(); ++c) {
    list[c].closed = list[c].closed && oriented[c];
    if (!list[c].closed) list[c].signed_volume = 0;
    if (list[c].closed && manifold[c]) list[c].genus = (2 - list[c].euler_characteristic) / 2;
  }
}

}  // namespace

Surface examine_surface(const TriangleMesh& mesh, MeshCertificate& certificate) {
  certificate.name = mesh.name;
  certificate.bounds = bounds_of(mesh);
  certificate.vertices = mesh.vertices.size();
  certificate.triangles = mesh.triangles.size();
  const std::vector<bool> usable = usable_triangles(mesh, certificate);

  // Vertices that are not used or not finite would only disturb the gathering.
  std::vector<Vector3d> vertices;
  constexpr std::uint32_t kAbsent = ~0u;
  std::vector<std::uint32_t> compact(mesh.vertices.size(), kAbsent);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!usable[t]) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (compact[v] != kAbsent) continue;
      compact[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(mesh.vertices[v]);
    }
  }
  Places places = gather_places(vertices, 0);
  certificate.duplicate_vertices = vertices.size() - places.positions.size();

  Surface surface;
  surface.places = std::move(places.positions);
  certificate.surface_vertices = surface.places.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!usable[t]) continue;
    Triangle face{};
    for (std::size_t i = 0; i < 3; ++i) face[i] = places.place_of[compact[mesh.triangles[t][i]]];
    const bool repeated = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    const double area = repeated ? 0
                                 : area_or_zero(surface.places[face[0]], surface.places[face[1]],
                                                surface.places[face[2]]);
    if (area == 0) ++certificate.degenerate_faces;
    if (repeated) continue;  // its sides cancel each other: the surface is the same without it
    surface.faces.push_back(face);
    surface.source.push_back(static_cast<std::uint32_t>(t));
    surface.areas.push_back(area);
    certificate.area += area;
  }
  certificate.duplicate_faces = count_duplicate_faces(surface.faces);

  surface.uses = sorted_edge_uses(surface.faces);
  bool all_even = true;
  for_each_edge(surface.uses, [&](std::size_t begin, std::size_t end) {
    ++certificate.edges;
    const EdgeTally edge = tally(surface, begin, end);
    if (end - begin == 1) ++certificate.boundary_edges;
    if (edge.crowded) ++certificate.non_manifold_edges;
    if (edge.unbalanced) ++certificate.inconsistent_edges;
    all_even = all_even && !edge.odd;
  });
  const std::vector<bool> several_fans = places_of_several_fans(surface);
  certificate.non_manifold_vertices =
      static_cast<std::size_t>(std::count(several_fans.begin(), several_fans.end(), true));
  const bool any = !surface.faces.empty();
  certificate.closed = any && all_even;
  certificate.consistently_oriented = any && certificate.inconsistent_edges == 0;
  certificate.orientable = any && consistent_flips(surface.faces.size(), surface.uses).orientable;
  certificate.manifold =
      any && certificate.non_manifold_edges == 0 && certificate.non_manifold_vertices == 0;

  std::vector<bool> in_use(surface.places.size(), false);
  for (const Triangle& face : surface.faces) {
    for (const std::uint32_t place : face) in_use[place] = true;
  }
  certificate.euler_characteristic = std::count(in_use.begin(), in_use.end(), true) -
                                     static_cast<std::int64_t>(certificate.edges) +
                                     static_cast<std::int64_t>(surface.faces.size());
  examine_components(surface, several_fans, certificate);
  if (certificate.closed && certificate.consistently_oriented) {
    for (const ComponentCertificate& component : certificate.component_list) {
      certificate.signed_volume += component.signed_volume;
    }
    if (certificate.manifold) {
      const auto components = static_cast<std::int64_t>(certificate.components);
      certificate.genus = (2 * components - certificate.euler_characteristic) / 2;
    }
  }
  return surface;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
