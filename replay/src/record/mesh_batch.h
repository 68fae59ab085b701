// All bodies that look like one mesh: the triangles once, a row of instance poses a step. Instances
// have no colour of their own in Rerun, so those asleep are drawn by a grey twin.
#pragma once

#include <string>
#include <vector>

#include "plumb/replay/recorder.h"
#include "plumb/shapes.h"
#include "record/frame.h"
#include "record/placed_part.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// Triangles with a normal of their own, so that edges look like edges.
VisualMesh mesh_of(const HullGeometry& hull);
VisualMesh mesh_of(const SurfaceMesh& surface);
VisualMesh mesh_of(const HeightfieldGeometry& field);

class MeshBatch {
 public:
  // entity: "world/meshes/0"
  MeshBatch(rrd::Writer& writer, const std::string& entity, const VisualMesh& mesh);

  void clear_parts() { parts_.clear(); }
  void add_part(const PlacedPart& part) { parts_.push_back(part); }
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  void add_instances(rrd::Table& table, const Frame& frame, bool awake);

  rrd::Table awake_, asleep_;
  std::vector<PlacedPart> parts_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
