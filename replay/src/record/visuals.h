// The 3D scene: which body is drawn by which batch, kept up to date as bodies come and go.
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "plumb/replay/recorder.h"
#include "plumb/world.h"
#include "record/frame.h"
#include "record/mesh_batch.h"
#include "record/shape_batch.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// How large the scene is, for the camera, the ground and the arrows.
struct SceneExtent {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // [m] of what moves
  double radius = 1;                                 // [m] around it
  double half_height = 1;                            // [m] half of its size along up
  double body_radius = 1;                            // [m] mean over what moves
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();     // unit, against gravity
  double top = 0;                                    // [m] highest point of what moves, along up
};
SceneExtent extent_of(const PhysicsWorld& world, const Frame& frame);

class Visuals {
 public:
  Visuals();

  void show_as(BodyId body, std::shared_ptr<const VisualMesh> mesh);
  // Looks at the whole world again and sends what changed with the frame's pose.
  void rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
               const SceneExtent& extent);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  void add_collider(rrd::Writer& writer, const Collider& collider, PlacedPart part, Role role,
                    const SceneExtent& extent);
  // The mesh of a shape that is no primitive, one for all colliders of the same sizes.
  const VisualMesh* shape_mesh(const Shape& shape);
  MeshBatch& mesh_batch(rrd::Writer& writer, const void* key, const VisualMesh& mesh);

  std::vector<ShapeBatch> shapes_;  // primitive x role
  std::map<const void*, std::size_t> mesh_index_;
  std::vector<MeshBatch> meshes_;
  std::vector<std::shared_ptr<const void>> kept_alive_;  // so that no address is met twice
  std::map<BodyId, std::shared_ptr<const VisualMesh>> shown_as_;
  std::map<std::vector<double>, std::shared_ptr<const VisualMesh>> shape_meshes_;  // by sizes
  using MeshAndScale = std::tuple<const void*, Real, Real, Real>;
  std::map<MeshAndScale, std::shared_ptr<const VisualMesh>> scaled_meshes_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
