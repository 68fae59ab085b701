// A mesh file looked at from all sides, and the page about it that `plumb mesh FILE` prints.
#pragma once

#include <optional>
#include <string>

#include "plumb/assets/certificate.h"
#include "plumb/assets/decompose.h"
#include "plumb/assets/hull.h"
#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/progress.h"
#include "plumb/assets/repair.h"
#include "plumb/assets/result.h"

namespace plumb::inline PLUMB_ABI::assets {

struct MeshInspection {
  TriangleMesh mesh;
  ImportReport import;
  std::string repaired;  // what a repair changed; empty: none was asked for
  MeshCertificate certificate;
  std::optional<MeshMass> mass;
  std::string mass_error;  // why there is no mass
  std::optional<HullMesh> hull;
  std::string hull_error;
  std::optional<DecompositionReport> parts;  // only if asked for
  std::string parts_error;
};

struct InspectOptions {
  ImportOptions import = {};
  std::optional<RepairOptions> repair = {};  // unset: the mesh is looked at as it is
  MassOptions mass = {};
  HullOptions hull = {};
  std::optional<DecomposeOptions> parts = {};  // unset: the mesh is not decomposed
  bool guarded = true;                         // read in a child process (import_mesh_guarded)
  double time_limit = 60;                      // [s] of the guarded reading
  WorkListener on_work = {};
};

// Fails only if the file cannot be read; what is wrong with the mesh is in the inspection.
Result<MeshInspection> inspect_mesh_file(const std::string& path,
                                         const InspectOptions& options = {});

// For people: a table of at most 100 columns.
std::string to_text(const MeshInspection& inspection);
// For programs: one JSON object, keys as the fields are named, schema "plumb-mesh/1".
std::string to_json(const MeshInspection& inspection);

}  // namespace plumb::inline PLUMB_ABI::assets
