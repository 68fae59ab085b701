#include "import/units.h"

#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <set>
#include <utility>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCentimetre = 0.01;   // [m] FBX counts its unit in these
constexpr double kMillimetre = 0.001;  // [m] 3MF and AMF use it unless they say otherwise

// Formats whose specification fixes the unit, or whose reader already converts to metres.
const std::set<std::string> kMetreFormats{"gltf", "glb", "ifc", "ifczip", "x3d",
                                          "x3db", "wrl", "lwo", "lws",    "ogex"};
const std::set<std::string> kMillimetreFormats{"3mf", "amf"};
// Formats whose specification fixes y as up, or whose reader already turns it up.
const std::set<std::string> kYUpFormats{"gltf", "glb", "x3d", "x3db", "wrl", "lwo", "lws"};

// The rotation by a cyclic exchange of axes, x -> y -> z -> x, that brings one axis to another: no
// mirror, no rounding.
Matrix3d cycle(Axis from, Axis to) {
  const int steps = (static_cast<int>(to) - static_cast<int>(from) + 3) % 3;
  Matrix3d m = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) m((i + steps) % 3, i) = 1;
  return m;
}

// A quarter turn between y and z, as everybody expects it (x stays); the cyclic exchange for x.
Matrix3d bring_up(Axis from, Axis to) {
  if (from == to) return Matrix3d::Identity();
  Matrix3d m = Matrix3d::Identity();
  if (from == Axis::Z && to == Axis::Y) {
    m << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // (x, y, z) -> (x, z, -y)
    return m;
  }
  if (from == Axis::Y && to == Axis::Z) {
    m << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // (x, y, z) -> (x, -z, y)
    return m;
  }
  return cycle(from, to);
}

template <class T>
std::optional<T> metadata(const aiScene& scene, const char* key) {
  T value{};
  if (scene.mMetaData != nullptr && scene.mMetaData->Get(key, value)) return value;
  return std::nullopt;
}

// A number that went through a float: seven digits give back the one that the file has.
double as_written(double through_float) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.7g", through_float);
  return std::strtod(digits, nullptr);
}

// In centimetres; assimp hands it out as float or double, depending on its version.
std::optional<double> fbx_unit(const aiScene& scene) {
  std::optional<double> unit = metadata<double>(scene, "UnitScaleFactor");
  if (!unit) {
    if (const auto single = metadata<float>(scene, "UnitScaleFactor"))
      unit = as_written(static_cast<double>(*single));
  }
  return unit && *unit > 0 && std::isfinite(*unit) ? unit : std::nullopt;
}

// FBX names three signed axes; their exchange into right, up, front is the matrix to y-up axes.
std::optional<Matrix3d> fbx_axes(const aiScene& scene, ImportReport& report) {
  constexpr std::array<std::array<const char*, 2>, 3> kKeys{
      {{"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}}};
  Matrix3d m = Matrix3d::Zero();
  for (std::size_t row = 0; row < 3; ++row) {
    const auto axis = metadata<std::int32_t>(scene, kKeys[row][0]);
    const auto sign = metadata<std::int32_t>(scene, kKeys[row][1]);
    if (!axis || !sign) return std::nullopt;
    if (*axis < 0 || *axis > 2 || (*sign != 1 && *sign != -1)) {
      report.notes.push_back("the axes of the FBX settings make no sense; taken as y up");
      return std::nullopt;
    }
    m(static_cast<Eigen::Index>(row), *axis) = *sign;
  }
  if (std::abs(m.determinant()) != 1) {
    report.notes.push_back(
        "the axes of the FBX settings are not three different ones; taken as y up");
    return std::nullopt;
  }
  report.file_up = static_cast<Axis>(*metadata<std::int32_t>(scene, kKeys[1][0]));
  return m;
}

// Collada's reader puts unit and up axis into the root node; this is the unit it used.
double collada_unit(const aiScene& scene) {
  const aiMatrix4x4& root = scene.mRootNode->mTransformation;
  return as_written(std::cbrt(std::abs(static_cast<double>(root.Determinant()))));
}

}  // namespace

Result<Matrix3d> to_world(const aiScene& scene, const std::string& extension,
                          const ImportOptions& options, ImportReport& report) {
  double scale = 1;  // [m] per unit the reader hands out
  Matrix3d axes =
      Matrix3d::Identity();  // from the reader's axes to those with report.file_up applied
  bool axes_to_y = false;    // the axes are y-up after `axes`
  report.world_up = options.world_up;
  report.file_up = options.world_up;

  if (extension == "fbx") {
    if (const auto factor = fbx_unit(scene)) {
      scale = *factor * kCentimetre;
      report.metres_per_unit = scale;
      report.unit_origin = Origin::File;
    } else {
      scale = report.metres_per_unit = kCentimetre;
      report.unit_origin = Origin::Format;
      report.notes.push_back("the FBX settings hold no usable unit; taken as centimetres");
    }
    if (const auto m = fbx_axes(scene, report)) {
      axes = *m;
      report.up_origin = Origin::File;
    } else {
      report.file_up = Axis::Y;
      report.up_origin = Origin::Format;
    }
    axes_to_y = true;
  } else if (extension == "dae" || extension == "zae") {
    report.metres_per_unit = collada_unit(scene);
    report.unit_origin = Origin::File;
    report.file_up = Axis::Y;
    report.up_origin = Origin::File;
    report.notes.push_back(
        "the Collada reader applied the file's unit and turned its up axis to y");
    axes_to_y = true;
    if (!(report.metres_per_unit > 0))
      return Error{"the Collada root transform has no volume (unit of 0 m?)"};
  } else {
    if (kMetreFormats.count(extension) > 0) report.unit_origin = Origin::Format;
    if (kMillimetreFormats.count(extension) > 0) {
      scale = report.metres_per_unit = kMillimetre;
      report.unit_origin = Origin::Format;
      report.notes.push_back(
          "taken as millimetres, the format's default; give metres_per_unit if the file says else");
    }
    if (kYUpFormats.count(extension) > 0) {
      report.file_up = Axis::Y;
      report.up_origin = Origin::Format;
      axes_to_y = true;
    }
  }

  if (options.metres_per_unit) {
    // What the reader hands out for Collada has the file's unit in it already.
    const bool applied = extension == "dae" || extension == "zae";
    scale = applied ? *options.metres_per_unit / report.metres_per_unit : *options.metres_per_unit;
    report.metres_per_unit = *options.metres_per_unit;
    report.unit_origin = Origin::Option;
  }
  if (options.file_up) {
    axes = bring_up(*options.file_up, options.world_up);
    report.file_up = *options.file_up;
    report.up_origin = Origin::Option;
  } else if (axes_to_y) {
    axes = bring_up(Axis::Y, options.world_up) * axes;
  }
  if (report.unit_origin == Origin::Unknown) {
    report.notes.push_back(
        "the file tells no unit; taken as metres (give metres_per_unit otherwise)");
  }
  if (report.up_origin == Origin::Unknown) {
    report.notes.push_back(
        "the file tells no up axis; axes kept as they are (give file_up otherwise)");
  }
  if (axes.determinant() < 0)
    report.notes.push_back("the file's axes are left-handed; the mesh was mirrored back");
  return Matrix3d(scale * axes);
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
