#include "plumb/assets/decompose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "decompose/best_cut.h"
#include "decompose/hollow.h"
#include "decompose/join_parts.h"
#include "decompose/measure.h"
#include "mesh/topology.h"
#include "plumb/assets/to_physics.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using detail::Node;
using detail::PartHull;
using Eigen::Vector3d;

// Points count as on a plane within this, of a solid of size 1: what rounding of the cuts before
// leaves, and more where the coordinates came through floats.
constexpr double kOnPlane = 1e-9;
constexpr double kRoundings = 4;  // of coordinates: a face's corners are off by one or two
// A hull that fills no more than a film of that width all over a cube is its piece, up to rounding;
// but never as much as a hollow of the distance asked for would hold.
constexpr double kCubeArea = 6;
constexpr double kHollowShare = 0.01;  // of the distance cubed
// Pieces before the joining. Half-way cut solids join worse than those cut to the end.
constexpr std::size_t kPiecesPerPart = 4;

// The mesh over places, moved and scaled to a longest side of 1 about the origin.
struct UnitSolid {
  Vector3d middle;
  double size = 1;  // [m]
  std::vector<Vector3d> places;
  std::vector<Triangle> faces;
};

UnitSolid unit_solid(const TriangleMesh& mesh, const MeshBounds& bounds) {
  UnitSolid solid;
  solid.middle = bounds.center();
  solid.size = bounds.size().maxCoeff();
  std::vector<Vector3d> vertices = mesh.vertices;
  // A certified solid may hold vertices that no triangle uses, finite or not.
  std::vector<bool> used(vertices.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] = used[v] ? Vector3d((vertices[v] - solid.middle) / solid.size) : Vector3d::Zero();
  const detail::Places places = detail::gather_places(vertices, 0);
  solid.places = places.positions;
  for (const Triangle& t : mesh.triangles) {
    const Triangle face{places.place_of[t[0]], places.place_of[t[1]], places.place_of[t[2]]};
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) solid.faces.push_back(face);
  }
  return solid;
}

// Cuts the piece that fills most until all stay within the limit.
std::vector<PartHull> cut_apart(Node whole, const detail::SolidField& solid,
                                const detail::Tolerances& tolerances, std::size_t most_pieces) {
  std::vector<PartHull> done;
  std::vector<Node> open;
  const auto sort_in = [&](Node node) {
    if (node.excess() <= tolerances.film) {
      node.hull.reach = 0;
    } else if (detail::stays_within(node.hull, solid, tolerances.limit)) {
      node.hull.reach = tolerances.limit;
    }
    if (node.hull.reach <= tolerances.limit) {
      done.push_back(std::move(node.hull));
    } else {
      open.push_back(std::move(node));
    }
  };
  sort_in(std::move(whole));
  while (!open.empty() && done.size() + open.size() < most_pieces) {
    const auto worst = std::max_element(open.begin(), open.end(), [](const Node& a, const Node& b) {
      return a.excess() < b.excess();
    });
    Node node = std::move(*worst);
    open.erase(worst);
    std::optional<detail::BestCut> cut = detail::best_cut(node, tolerances.on_plane);
    if (!cut) {
      done.push_back(std::move(node.hull));
      continue;
    }
    sort_in(std::move(cut->front));
    sort_in(std::move(cut->back));
  }
  for (Node& node : open) done.push_back(std::move(node.hull));
  return done;
}

std::string check(const DecomposeOptions& options) {
  if (!(options.max_distance >= 0) || !std::isfinite(options.max_distance)) {
    return "max_distance must be finite and above 0 m, or 0 for a share of the size";
  }
  if (options.max_parts < 1 || options.max_parts > kMostParts) {
    return "max_parts must be 1 to " + std::to_string(kMostParts);
  }
  if (options.max_part_vertices < 4 || options.max_part_vertices > kMostPartVertices) {
    return "max_part_vertices must be 4 to " + std::to_string(kMostPartVertices);
  }
  return {};
}

}  // namespace

Result<Decomposition> decompose(const TriangleMesh& mesh, const DecomposeOptions& options) {
  return decompose(mesh, certify(mesh), options);
}

Result<Decomposition> decompose(const TriangleMesh& mesh, const MeshCertificate& certificate,
                                const DecomposeOptions& options) {
  const std::string name = "convex parts of mesh '" + mesh.name + "': ";
  if (const std::string wrong = check(options); !wrong.empty()) return Error{name + wrong};
  if (!certificate.solid) {
    return Error{name + "it is not the boundary of a solid: " + certificate.fault_text() +
                 "; it can collide as its hull, or as a surface where it does not move freely"};
  }
  const UnitSolid unit = unit_solid(mesh, certificate.bounds);
  const double distance =
      options.max_distance > 0 ? options.max_distance : kPartsDistance * unit.size;
  const double limit = distance / unit.size;
  detail::Tolerances tolerances;
  tolerances.limit = limit;
  tolerances.on_plane = std::max(kOnPlane, kRoundings * mesh.coordinate_rounding / unit.size);
  tolerances.film = std::min(kCubeArea * tolerances.on_plane, kHollowShare * limit * limit * limit);

  Node whole;
  whole.piece = detail::piece_of(unit.places, unit.faces);
  whole.concave = detail::concave_edges(unit.places, unit.faces);
  std::optional<PartHull> hull = detail::part_hull(detail::points_of(whole.piece));
  if (!hull) return Error{name + "it is too flat for a body"};
  whole.hull = std::move(*hull);
  const double volume = whole.piece.volume;

  const detail::SolidField solid(unit.places, unit.faces,
                                 certificate.embedding == Embedding::Clean);
  std::vector<PartHull> parts =
      cut_apart(std::move(whole), solid, tolerances, kPiecesPerPart * options.max_parts);
  detail::join_parts(parts, solid, tolerances, options.max_parts);

  if (parts.size() > options.max_parts) {
    return Error{name + "they could not be joined to " + std::to_string(options.max_parts) +
                 "; allow " + std::to_string(parts.size())};
  }

  Decomposition out;
  out.report.mesh_volume = volume;
  out.report.max_distance = limit;
  for (PartHull& part : parts) {
    Result<HullMesh> made = convex_hull(part.corners, {.max_vertices = options.max_part_vertices});
    if (!made) return Error{name + made.error()};
    out.parts.push_back(std::move(made).value());
  }
  detail::measure(unit.places, unit.faces, solid, parts, out);
  // Back to metres.
  for (HullMesh& part : out.parts) {
    for (Vector3d& v : part.vertices) v = unit.middle + unit.size * v;
    part.max_outside *= unit.size;
    part.simplification_distance *= unit.size;
  }
  DecompositionReport& report = out.report;
  for (double* length :
       {&report.max_distance, &report.parts_beyond_mesh, &report.mesh_beyond_parts})
    *length *= unit.size;
  for (double* room :
       {&report.mesh_volume, &report.parts_volume, &report.overlap_volume, &report.largest_overlap})
    *room *= unit.size * unit.size * unit.size;
  return out;
}

Result<std::shared_ptr<const CompoundGeometry>> to_physics(const Decomposition& decomposition,
                                                           const Vector3d& origin) {
  std::vector<CompoundGeometry::Child> children;
  for (const HullMesh& part : decomposition.parts) {
    Result<std::shared_ptr<const HullGeometry>> hull = to_physics(part, origin);
    if (!hull) {
      return Error{"part " + std::to_string(children.size()) + " of " +
                   std::to_string(decomposition.parts.size()) + ": " + hull.error()};
    }
    children.push_back({ConvexHull{std::move(hull).value()}, {}});
  }
  CompoundGeometry::Result made = CompoundGeometry::create(children);
  if (!made.status.ok()) return Error{std::string("compound: ") + made.status.message};
  return std::move(made.compound);
}

}  // namespace plumb::inline PLUMB_ABI::assets
