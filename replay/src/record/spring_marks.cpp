#include "record/spring_marks.h"

#include <variant>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint32_t kColor = 0x7be08aff;
constexpr double kRadius = 0.03;  // [mean body radii]

}  // namespace

SpringMarks::SpringMarks() : lines_("world/springs") {}

void SpringMarks::rebuild(rrd::Writer& writer, const Frame& frame, const SceneExtent& extent) {
  parts_.clear();
  const std::vector<std::size_t> slots = slots_of(frame);
  for (const Effect& effect : frame.effects) {
    const auto* spring = std::get_if<Spring>(&effect.kind);
    if (!spring) continue;
    const LocalPose at_body{spring->point, Quat::Identity()};
    const LocalPose at_other{spring->other_point.template cast<Real>(), Quat::Identity()};
    parts_.push_back({Anchor(effect.body, at_body, slots), Anchor(spring->other, at_other, slots)});
  }
  if (parts_.empty() && !announced_) return;  // never had any
  if (!announced_) lines_.send_look(writer, kRadius * extent.body_radius, kColor);
  announced_ = true;
  add(frame);
}

void SpringMarks::add(const Frame& frame) {
  if (announced_) lines_.add(frame, parts_);
}

void SpringMarks::send(rrd::Writer& writer) { lines_.send(writer); }

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
