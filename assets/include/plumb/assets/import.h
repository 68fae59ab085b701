// Reads meshes from files in any format that assimp knows: OBJ, STL, PLY, glTF/GLB, FBX, Collada,
// OFF, 3DS, X, 3MF and forty more. Node transforms are applied, mirrored parts turned right side
// out, units brought to metres and the up axis to the world's; all of it is reported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"

namespace plumb::inline PLUMB_ABI::assets {

enum class Axis { X, Y, Z };

struct ImportOptions {
  // Metres in one unit of the file [m] > 0. Unset: what the file or its format says, else 1.
  std::optional<double> metres_per_unit = std::nullopt;
  // Which axis of the file points up. Unset: what the file or its format says, else it is taken to
  // be the world's up axis already.
  std::optional<Axis> file_up = std::nullopt;
  Axis world_up = Axis::Y;
  std::uint64_t max_file_bytes = std::uint64_t{2} << 30;
  std::size_t max_triangles = 20'000'000;
  // What the reading process of import_mesh_guarded may take [byte]; a small file can ask for any
  // amount.
  std::uint64_t max_memory_bytes = std::uint64_t{4} << 30;
};

enum class Origin { File, Format, Option, Unknown };  // where a unit or an axis was learnt

struct ImportReport {
  std::string file;
  std::string format;          // as the reader names it
  double metres_per_unit = 1;  // [m]
  Origin unit_origin = Origin::Unknown;
  Axis file_up = Axis::Y;
  Origin up_origin = Origin::Unknown;
  Axis world_up = Axis::Y;
  std::size_t parts = 0;            // meshes placed by nodes, instances counted
  std::size_t mirrored_parts = 0;   // placed by a reflecting transform: their faces were turned
  std::size_t skinned_parts = 0;    // have bones: taken in bind pose
  std::size_t dropped_points = 0;   // faces of one vertex
  std::size_t dropped_lines = 0;    // faces of two
  double coordinate_rounding = 0;   // [m] the reader hands out single precision
  std::vector<std::string> losses;  // what of the surface the mesh has not, and the remedy
  std::vector<std::string> notes;
};

struct Imported {
  TriangleMesh mesh;
  ImportReport report;
};

// In this process. A reader that crashes takes the process with it: for files of unknown origin
// use import_mesh_guarded.
Result<Imported> import_mesh(const std::string& path, const ImportOptions& options = {});

// In a child process with a time limit [s] > 0, so that a crash, a hang or a
// flood of memory inside a reader is an error like any other. Forks: call it from tools, not from a
// game with threads. Where the system has no fork it fails and says so.
Result<Imported> import_mesh_guarded(const std::string& path, const ImportOptions& options = {},
                                     double time_limit = 60);

const char* name_of(Axis axis);
const char* name_of(Origin origin);

}  // namespace plumb::inline PLUMB_ABI::assets
