#include <utility>

#include "plumb/assets/report.h"

namespace plumb::inline PLUMB_ABI::assets {

Result<MeshInspection> inspect_mesh_file(const std::string& path, const InspectOptions& options) {
  Result<Imported> imported = options.guarded
                                  ? import_mesh_guarded(path, options.import, options.time_limit)
                                  : import_mesh(path, options.import);
  if (!imported) return Error{imported.error()};
  MeshInspection inspection;
  inspection.mesh = std::move(imported.value().mesh);
  inspection.import = std::move(imported.value().report);
  if (options.repair) {
    Result<Repaired> repaired = repair(inspection.mesh, *options.repair);
    if (!repaired) return Error{"'" + path + "': " + repaired.error()};
    inspection.repaired = repaired->text();
    inspection.mesh = std::move(repaired.value().mesh);
  }
  inspection.certificate = certify(inspection.mesh);
  Result<MeshMass> mass = mass_of_mesh(inspection.mesh, inspection.certificate, options.mass);
  if (mass) {
    inspection.mass = std::move(mass).value();
  } else {
    inspection.mass_error = mass.error();
  }
  Result<HullMesh> hull = convex_hull(inspection.mesh.vertices, options.hull);
  if (hull) {
    inspection.hull = std::move(hull).value();
  } else {
    inspection.hull_error = hull.error();
  }
  if (options.parts) {
    const Result<Decomposition> parts =
        decompose(inspection.mesh, inspection.certificate, *options.parts);
    if (parts) {
      inspection.parts = parts->report;
    } else {
      inspection.parts_error = parts.error();
    }
  }
  return inspection;
}

}  // namespace plumb::inline PLUMB_ABI::assets
