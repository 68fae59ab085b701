// What can be said for certain about a triangle mesh: is it the boundary of a solid, and if not,
// what is wrong and what would help. Nothing is repaired here (plumb/assets/repair.h does, on
// request); the mesh is only read.
//
// Topology is that of the positions: vertices at the same place count as one, because formats such
// as STL do not share them at all and others split them for normals and texture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets {

// How the surface lies in space.
enum class Embedding {
  NotTested,  // the mesh has faults that make the question void, or the test was switched off
  Clean,      // no two faces meet outside their shared vertices and edges
  Touching,   // some faces touch or lie on each other, none passes through another
  Crossing,   // faces pass through each other
};

struct ComponentCertificate {
  std::size_t faces = 0;
  std::size_t vertices = 0;
  bool closed = false;       // its boundary is empty and its faces agree on the outside
  double area = 0;           // [m^2]
  double signed_volume = 0;  // [m^3] < 0: its normals point inwards; 0 if not closed
  std::int64_t euler_characteristic = 0;  // V - E + F
  std::optional<std::int64_t> genus;      // number of handles; only of closed manifold components
  bool cavity = false;                    // oriented inwards and inside another component
};

struct Finding {
  enum class Kind { Fault, Note };  // a fault keeps the mesh from being a certified solid
  Kind kind = Kind::Note;
  std::string text;
  std::string remedy;  // empty for most notes
};

struct CertifyOptions {
  bool test_self_crossing = true;
  // Pairs of faces that cross are counted up to here, then the count stops (a soup of 1e5 faces
  // can hold 1e9 pairs).
  std::size_t max_crossing_pairs = 100000;
};

struct MeshCertificate {
  std::string name;
  MeshBounds bounds;

  // The arrays as they came.
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t non_finite_vertices = 0;     // used by triangles, NaN or infinite
  std::size_t out_of_range_triangles = 0;  // an index beyond the vertex array
  std::size_t unused_vertices = 0;
  std::size_t duplicate_vertices = 0;  // at exactly the same place as an earlier one
  std::size_t duplicate_faces = 0;     // the same three places as an earlier face
  std::size_t degenerate_faces = 0;    // zero area

  // The surface, with vertices at the same place counted once.
  std::size_t surface_vertices = 0;
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;         // used by one face: the rim of a hole
  std::size_t non_manifold_edges = 0;     // used by more than two faces
  std::size_t inconsistent_edges = 0;     // two faces that disagree on which side is outside
  std::size_t non_manifold_vertices = 0;  // where fans of faces meet in a point only
  bool closed = false;                    // no edge has a free side
  bool consistently_oriented = false;     // every edge is run through equally often either way
  bool orientable = false;                // flipping some faces could make it so (no Moebius strip)
  bool manifold = false;                  // no non-manifold edge or vertex
  bool inside_out = false;                // closed, oriented, and its outer surface faces inwards
  std::int64_t euler_characteristic = 0;  // V - E + F
  std::optional<std::int64_t> genus;      // handles of all components; closed manifolds only
  std::size_t components = 0;             // joined by edges
  std::size_t cavities = 0;
  std::vector<ComponentCertificate> component_list;

  Embedding embedding = Embedding::NotTested;
  std::size_t crossing_pairs = 0;  // faces that pass through each other
  std::size_t touching_pairs = 0;
  bool crossing_count_complete = true;  // false: there are more pairs than counted
  std::vector<std::array<std::uint32_t, 2>> crossing_examples;  // up to 8 pairs of triangle numbers
  // How often the surface winds around the points just outside and inside its faces; a solid has
  // 0 and 1. One face of each component speaks for all of it where none touch; faces that touch are
  // sampled one by one. Only of closed oriented meshes.
  int winding_min = 0;
  int winding_max = 0;
  std::size_t winding_samples = 0;

  double area = 0;           // [m^2]
  double signed_volume = 0;  // [m^3] 0 unless closed and oriented

  bool solid = false;  // the exact mass integrals hold
  std::vector<Finding> findings;

  // The faults and their remedies in one text, empty for a solid.
  [[nodiscard]] std::string fault_text() const;
};

MeshCertificate certify(const TriangleMesh& mesh, const CertifyOptions& options = {});

const char* name_of(Embedding embedding);

}  // namespace plumb::inline PLUMB_ABI::assets
