// plumb mesh FILE
#include <cmath>
#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "cli/status_line.h"
#include "plumb/assets/decompose.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/report.h"

namespace plumb::cli {
namespace {

// What is wrong with the options, whatever the file holds; empty if nothing is.
std::string check(const MeshOptions& options) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(options.density))
    return "--density: the density must be a finite number of kg/m^3 > 0, for example 1000";
  const bool needs_one = options.method == "shell" || options.thickness != 0;
  if (needs_one && !positive(options.thickness))
    return "--thickness: a shell has a finite thickness > 0 in metres, for example 0.002";
  if (options.metres_per_unit && !positive(*options.metres_per_unit))
    return "--metres-per-unit: it must be a finite number > 0, for example 0.001";
  if (options.weld && !(std::isfinite(*options.weld) && *options.weld >= 0))
    return "--weld: the distance must be a finite number of metres >= 0, for example 1e-6";
  if (options.parts_distance &&
      !(std::isfinite(*options.parts_distance) && *options.parts_distance >= 0))
    return "--parts-distance: it must be a finite number of metres >= 0, for example 0.01";
  if (options.max_parts < 1 || options.max_parts > assets::kMostParts)
    return "--max-parts: their number must lie from 1 to " + std::to_string(assets::kMostParts);
  return {};
}

}  // namespace

int inspect_mesh(const MeshOptions& options) {
  if (const std::string wrong = check(options); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
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

  const auto inspection = [&] {
    StatusLine status(true);
    inspect.on_work = [&](const std::string& work) { status.show(work); };
    return assets::inspect_mesh_file(options.file, inspect);
  }();
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
