// What sensors see: a sorted list that only their events change, so that whatever stays costs
// nothing from step to step, asleep or awake.
#include <algorithm>

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {

void update_overlaps(WorldState& world) {
  std::vector<OverlapChange>& changes = world.overlap_changes;
  changes.clear();
  for (const SensorEvent& event : world.gathering.sensors)
    changes.push_back({{event.sensor, event.other},
                       static_cast<std::uint32_t>(changes.size()),
                       event.kind == SensorEvent::Kind::Enter});
  std::sort(changes.begin(), changes.end(), [](const OverlapChange& a, const OverlapChange& b) {
    return a.overlap != b.overlap ? a.overlap < b.overlap : a.order < b.order;
  });
  std::vector<SensorOverlap>& merged = world.new_overlaps;
  merged.clear();
  auto old = world.overlaps.cbegin();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const SensorOverlap& changed = changes[i].overlap;
    if (i + 1 < changes.size() && changes[i + 1].overlap == changed) continue;  // not the last word
    while (old != world.overlaps.cend() && *old < changed) merged.push_back(*old++);
    if (old != world.overlaps.cend() && *old == changed) ++old;
    if (changes[i].inside) merged.push_back(changed);
  }
  merged.insert(merged.end(), old, world.overlaps.cend());
  world.overlaps.swap(merged);
}

}  // namespace detail

std::span<const SensorOverlap> PhysicsWorld::overlaps_of(ColliderId sensor) const {
  const std::vector<SensorOverlap>& all = state_->overlaps;
  const auto begin = std::lower_bound(
      all.begin(), all.end(), sensor,
      [](const SensorOverlap& overlap, ColliderId id) { return overlap.sensor < id; });
  auto end = begin;
  while (end != all.end() && end->sensor == sensor) ++end;
  return {begin, end};
}

}  // namespace plumb::inline PLUMB_ABI
