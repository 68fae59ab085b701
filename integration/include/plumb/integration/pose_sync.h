// Carries poses from the world to an engine's transforms, interpolated between the last two steps,
// and touches only bodies that moved. A sleeping world costs nothing.
//
//   PoseSync sync(loop);
//   each frame, after loop.tick():
//     sync.write(world, loop.alpha(), [&](const SyncedPose& p) { transforms[p.entity] = p.pose; });
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/integration/fixed_step_loop.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::integration {

struct SyncedPose {
  std::uint64_t entity = 0;  // RigidBody::user_data
  BodyId body;
  Pose pose;  // between the last two steps
};

// The pose a share alpha (0..1) of the way from one to the other: positions along the line,
// orientations along the shorter arc at even speed.
Pose interpolated(const Pose& from, const Pose& to, double alpha);

class PoseSync {
 public:
  PoseSync() = default;
  // Hooks itself into the loop and must outlive it.
  explicit PoseSync(FixedStepLoop& loop) {
    loop.after_step([this](PhysicsWorld& world, double) { after_step(world); });
  }
  PoseSync(const PoseSync&) = delete;
  PoseSync& operator=(const PoseSync&) = delete;

  // After every step, for those who step without FixedStepLoop.
  void after_step(const PhysicsWorld& world);

  // The body starts here: it is written at the next frame, and its first step is interpolated from
  // here. Call it after create_body() and set_pose(); without it a body is first written after a
  // step that moved it, and a teleport is smeared over one step.
  void place(const PhysicsWorld& world, BodyId body);

  // Calls `write_one` with a SyncedPose for every body that moved in the last step, and once more
  // for one that has come to rest. Returns how many it wrote.
  template <class WriteOne>
  std::size_t write(const PhysicsWorld& world, double alpha, WriteOne&& write_one) {
    std::size_t kept = 0, written = 0;
    for (std::size_t k = 0; k < active_.size(); ++k) {
      Track& track = tracks_[active_[k]];
      if (world.is_valid(track.body)) {
        write_one(SyncedPose{track.entity, track.body,
                             interpolated(track.previous, track.current, alpha)});
        ++written;
        if (!track.at_rest) {
          active_[kept++] = active_[k];
          continue;
        }
      }
      track.active = false;
    }
    active_.resize(kept);
    return written;
  }

  // Bodies that the next write() will touch.
  [[nodiscard]] std::size_t active_count() const { return active_.size(); }

 private:
  struct Track {
    BodyId body;
    std::uint64_t entity = 0;
    Pose previous, current;
    std::uint64_t moved_in = 0;  // number of the step
    bool known = false;          // `current` holds where the body was
    bool active = false;         // listed in active_
    bool at_rest = true;         // previous and current are the same: one write is enough
  };
  Track& track_of(BodyId body);
  void activate(std::uint32_t index);

  std::vector<Track> tracks_;          // by BodyId::index
  std::vector<std::uint32_t> active_;  // indices into tracks_
  std::vector<BodyState> moved_;
};

}  // namespace plumb::inline PLUMB_ABI::integration
