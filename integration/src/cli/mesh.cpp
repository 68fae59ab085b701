// plumb mesh FILE
#include <cstdio>

#include "cli/commands.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/report.h"

namespace plumb::cli {

int inspect_mesh(const MeshOptions& options) {
  assets::InspectOptions inspect;
  inspect.import.metres_per_unit = options.metres_per_unit;
  if (!options.up.empty()) inspect.import.file_up = static_cast<assets::Axis>(options.up[0] - 'x');
  if (options.repair || options.weld)
    inspect.repair =
        assets::RepairOptions{.weld_tolerance = options.weld.value_or(0), .orient = true};
  const auto method = assets::mass_method_from(options.method);
  if (!method.ok()) {
    complain(method.error());
    return kBadInput;
  }
  inspect.mass.method = *method;
  inspect.mass.density = options.density;
  inspect.mass.shell_thickness = options.thickness;

  if (options.parts || options.parts_distance) {
    inspect.parts = assets::DecomposeOptions{.max_distance = options.parts_distance.value_or(0),
                                             .max_parts = options.max_parts};
  }

  const auto inspection = assets::inspect_mesh_file(options.file, inspect);
  if (!inspection.ok()) {
    complain(inspection.error());
    return kBadInput;
  }
  const std::string page =
      options.json ? assets::to_json(*inspection) : assets::to_text(*inspection);
  std::fputs(page.c_str(), stdout);
  if (!page.empty() && page.back() != '\n') std::fputc('\n', stdout);
  return inspection->mass && inspection->parts_error.empty() ? kOk : kFailed;
}

}  // namespace plumb::cli
