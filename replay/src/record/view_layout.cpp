#include "record/view_layout.h"

#include <algorithm>
#include <cmath>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

// The eye stands this many scene radii to the side, above and in front of the scene's centre: the
// whole scene in view, its depth visible.
constexpr double kEyeRight = 0.8, kEyeUp = 0.7, kEyeFront = 1.4;
// ... and looks this much of the scene's half height below the centre, but no more than so many
// radii: what begins high falls and stays low.
constexpr double kLookDown = 0.8, kLookDownRadii = 0.4;

// Rerun's directions are up 1, down 2, right 3, left 4, forward 5, back 6, for x, y, z.
void send_axes(rrd::Writer& writer, const Eigen::Vector3d& up) {
  constexpr std::uint8_t kUp = 1, kRight = 3, kForward = 5, kBack = 6;
  const std::uint8_t y_up[3] = {kRight, kUp, kBack}, z_up[3] = {kRight, kForward, kUp};
  rrd::Table axes("world");
  const std::size_t column = axes.add_column<std::uint8_t>("ViewCoordinates:xyz", 3);
  axes.column(column).append(std::span<const std::uint8_t>(up.z() > up.y() ? z_up : y_up));
  axes.send_static(writer);
}

// The power of ten below or at it [m].
double round_length(double length) {
  return length > 0 ? std::pow(10, std::floor(std::log10(length))) : 1;
}

void copy_to(const Eigen::Vector3d& v, float (&out)[3]) {
  std::transform(v.data(), v.data() + 3, out, [](double x) { return static_cast<float>(x); });
}

}  // namespace

void send_layout(rrd::Writer& writer, const SceneExtent& extent, const RecorderOptions& options,
                 bool ledger, const std::optional<FartherView>& farther) {
  rrd::Layout layout;
  layout.timeline = rrd::kFrameTimeline;
  layout.frames_per_second = static_cast<float>(options.frames_per_second);
  layout.views = {
      {PLUMB_RR_VIEW_3D, "Scene", "+ /world/**\n+ /contacts/**\n+ /labels/**", 0},
      {PLUMB_RR_VIEW_PLOT, "Energy", "+ /plots/energy", 1},
      {PLUMB_RR_VIEW_PLOT, "Stages", "+ /plots/timing", 2},
      {PLUMB_RR_VIEW_PLOT, "Counts", "+ /plots/counts", 3},
      {PLUMB_RR_VIEW_PLOT, "Overlap", "+ /plots/overlap", 3},
      {PLUMB_RR_VIEW_TEXT_LOG, "Plan and events", "+ /log", 4},
  };
  if (ledger) {
    const rrd::View tabs[] = {
        {PLUMB_RR_VIEW_PLOT, "Energy ledger", "+ /plots/ledger/energy", 1},
        {PLUMB_RR_VIEW_PLOT, "Momentum x", "+ /plots/ledger/momentum_x", 1},
        {PLUMB_RR_VIEW_PLOT, "Momentum y", "+ /plots/ledger/momentum_y", 1},
        {PLUMB_RR_VIEW_PLOT, "Momentum z", "+ /plots/ledger/momentum_z", 1},
    };
    layout.views.insert(layout.views.begin() + 1, std::begin(tabs), std::end(tabs));
  }
  const Eigen::Vector3d& up = extent.up;
  const Eigen::Vector3d aside =
      std::abs(up.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d front = aside.cross(up).normalized();
  const Eigen::Vector3d right = up.cross(front);
  const Eigen::Vector3d target =
      extent.center - std::min(kLookDown * extent.half_height, kLookDownRadii * extent.radius) * up;
  const Eigen::Vector3d eye =
      target + extent.radius * (kEyeRight * right + kEyeUp * up + kEyeFront * front);
  copy_to(eye, layout.eye);
  copy_to(target, layout.target);
  copy_to(up, layout.up);
  if (farther) {
    layout.followed = farther->followed;
    layout.grid_height = static_cast<float>(farther->grid_height);
    layout.grid_spacing = static_cast<float>(round_length(extent.radius));
  }
  send_axes(writer, up);
  writer.send_layout(layout);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
