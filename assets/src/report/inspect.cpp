#include <utility>

#include "plumb/assets/report.h"

namespace plumb::inline PLUMB_ABI::assets {

Result<MeshInspection> inspect_mesh_file(const std::string& path, const InspectOptions& options) {
  const auto work = [&](const std::string& what) {
    if (options.on_work) options.on_work("'" + path + "': " + what);
  };
  work("reading the file");
  Result<Imported> imported = options.guarded
                                  ? import_mesh_guarded(path, options.import, options.time_limit)
                                  : import_mesh(path, options.import);
  if (!imported) return Error{imported.error()};
  MeshInspection inspection;
  inspection.mesh = std::move(imported.value().mesh);
  inspection.import = std::move(imported.value().report);
  const std::string triangles = std::to_string(inspection.mesh.triangles.size()) + " triangles";
  if (options.repair) {
    work("repairing " + triangles);
    Result<Repaired> repaired = repair(inspection.mesh, *options.repair);
    if (!repaired) return Error{"'" + path + "': " + repaired.error()};
    inspection.repaired = repaired->text();
    inspection.mesh = std::move(repaired.value().mesh);
  }
  work("certificate of " + triangles);
  inspection.certificate = certify(inspection.mesh);
  work(std::string("mass by the method ") + name_of(options.mass.method));
  Result<MeshMass> mass = mass_of_mesh(inspection.mesh, inspection.certificate, options.mass);
  if (mass) {
    inspection.mass = std::move(mass).value();
  } else {
    inspection.mass_error = mass.error();
  }
  work("convex hull of " + std::to_string(inspection.mesh.vertices.size()) + " vertices");
  Result<HullMesh> hull = convex_hull(inspection.mesh.vertices, options.hull);
  if (hull) {
    inspection.hull = std::move(hull).value();
  } else {
    inspection.hull_error = hull.error();
  }
  if (options.parts) {
    work("cutting " + triangles + " into convex parts");
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
