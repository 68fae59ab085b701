// From meshes to what the engine takes: mass properties, hulls and surfaces of triangles.
#pragma once

#include <memory>

#include "plumb/assets/hull.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"
#include "plumb/mass_properties.h"
#include "plumb/math.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI::assets {

// Checked by the engine's own test for what a body can have.
Result<MassProperties> to_physics(const MeshMass& mass);

// In the engine's number type. `origin` [m] becomes (0, 0, 0): the centre of mass where the body's
// frame is to stand there.
Result<std::shared_ptr<const HullGeometry>> to_physics(
    const HullMesh& hull, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

// The triangles as a surface; no vertex is welded but those at the very same place.
Result<std::shared_ptr<const TriangleMeshGeometry>> to_physics(const TriangleMesh& mesh);

}  // namespace plumb::inline PLUMB_ABI::assets
