#include "record/water.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint32_t kColor = 0x12848c88;
constexpr double kRadii = 4;  // half a side of the square, in radii of the scene

enum Column : std::size_t { kPosition, kTriangle };

}  // namespace

Water::Water() : table_("world/water") {
  table_.add_column<float>("Mesh3D:vertex_positions", 3);
  table_.add_column<std::uint32_t>("Mesh3D:triangle_indices", 3);
}

void Water::rebuild(rrd::Writer& writer, const Frame& frame, const SceneExtent& extent) {
  Row row{frame.number, frame.time, {}};
  for (const Effect& effect : frame.effects) {
    const auto* fluid = std::get_if<Buoyancy>(&effect.kind);
    if (!fluid) continue;
    const Surface surface{fluid->normal.template cast<double>().normalized(), double{fluid->level}};
    // One lake may be given body by body.
    if (std::find(row.surfaces.begin(), row.surfaces.end(), surface) == row.surfaces.end())
      row.surfaces.push_back(surface);
  }
  if (rows_.empty()) {
    if (row.surfaces.empty()) return;
    rrd::Table look(table_.entity());
    const std::size_t color = look.add_column<std::uint32_t>("Mesh3D:albedo_factor");
    look.column(color).append_one(kColor);
    look.send_static(writer);
  } else if (rows_.back().surfaces == row.surfaces) {
    return;
  }
  add(row, extent);
  rows_.push_back(std::move(row));
}

void Water::widen(const SceneExtent& extent) {
  for (const Row& row : rows_) add(row, extent);
}

std::optional<double> Water::height(const Eigen::Vector3d& up) const {
  if (rows_.empty() || rows_.front().surfaces.empty()) return {};
  const Surface& surface = rows_.front().surfaces.front();
  return surface.level * surface.normal.dot(up);
}

void Water::add(const Row& row, const SceneExtent& extent) {
  const double side = kRadii * extent.radius;
  std::uint32_t first = 0;
  for (const Surface& surface : row.surfaces) {
    const Eigen::Vector3d& n = surface.normal;
    const Eigen::Vector3d middle = extent.center + (surface.level - n.dot(extent.center)) * n;
    const Eigen::Vector3d aside =
        std::abs(n.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d a = side * aside.cross(n).normalized(), b = n.cross(a);
    auto* position = table_.column(kPosition).extend<float>(4);
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(middle - a - b), Eigen::Vector3d(middle + a - b),
          Eigen::Vector3d(middle + a + b), Eigen::Vector3d(middle - a + b)}) {
      position = std::transform(corner.data(), corner.data() + 3, position,
                                [](double x) { return static_cast<float>(x); });
    }
    const std::uint32_t corners[6] = {first, first + 1, first + 2, first, first + 2, first + 3};
    table_.column(kTriangle).append(std::span<const std::uint32_t>(corners));
    first += 4;
  }
  table_.end_row(row.frame, row.time);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
