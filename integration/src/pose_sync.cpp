#include "plumb/integration/pose_sync.h"

namespace plumb::inline PLUMB_ABI::integration {

Pose interpolated(const Pose& from, const Pose& to, double alpha) {
  Pose out;
  out.position = from.position + static_cast<PosReal>(alpha) * (to.position - from.position);
  out.orientation = from.orientation.slerp(static_cast<Real>(alpha), to.orientation).normalized();
  return out;
}

PoseSync::Track& PoseSync::track_of(BodyId body) {
  if (body.index >= tracks_.size()) tracks_.resize(body.index + std::size_t{1});
  Track& track = tracks_[body.index];
  if (track.body != body) {
    // A new body in the place of one that was destroyed; its listing as active may go on.
    const bool listed = track.active;
    track = Track{};
    track.body = body;
    track.active = listed;
  }
  return track;
}

void PoseSync::activate(std::uint32_t index) {
  if (tracks_[index].active) return;
  tracks_[index].active = true;
  active_.push_back(index);
}

void PoseSync::place(const PhysicsWorld& world, BodyId body) {
  if (!world.is_valid(body)) return;
  const BodyState state = world.state(body);
  Track& track = track_of(body);
  track.entity = state.user_data;
  track.previous = track.current = state.pose;
  track.known = true;
  track.moved_in = world.step_count();
  track.at_rest = true;
  activate(body.index);
}

void PoseSync::after_step(const PhysicsWorld& world) {
  const std::uint64_t step = world.step_count();
  world.copy_moved_body_states(moved_);
  for (const BodyState& state : moved_) {
    Track& track = track_of(state.id);
    track.previous = track.known ? track.current : state.pose;
    track.current = state.pose;
    track.known = true;
    track.entity = state.user_data;
    track.moved_in = step;
    track.at_rest = false;
    activate(state.id.index);
  }
  for (const std::uint32_t index : active_) {
    Track& track = tracks_[index];
    if (track.moved_in == step) continue;
    track.previous = track.current;
    track.at_rest = true;
  }
}

}  // namespace plumb::inline PLUMB_ABI::integration
