// The remedies that a certificate names. Each is asked for by name and reports what it changed; no
// importer and no mass routine calls them on its own.
#pragma once

#include <cstddef>
#include <string>

#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"

namespace plumb::inline PLUMB_ABI::assets {

struct RepairOptions {
  double weld_tolerance = 0;  // [m] >= 0: vertices nearer than this become one; 0 = equal ones only
  bool drop_degenerate_faces = true;  // repeated vertices; zero area, unless it fills a T-junction
  bool drop_duplicate_faces = true;   // keeps the first of each
  bool orient = false;                // make neighbours agree, then turn outer surfaces outwards
};

struct Repaired {
  TriangleMesh mesh;
  std::size_t welded_vertices = 0;
  std::size_t dropped_degenerate = 0;
  std::size_t dropped_duplicate = 0;
  std::size_t flipped_faces = 0;
  bool orientable = true;  // false: some part is a Moebius strip; its faces still disagree

  [[nodiscard]] std::string text() const;
};

// Fails for meshes with non-finite vertices or indices out of range: there is nothing to guess
// from.
Result<Repaired> repair(const TriangleMesh& mesh, const RepairOptions& options = {});

}  // namespace plumb::inline PLUMB_ABI::assets
