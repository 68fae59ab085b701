#include "plumb/replay/replay.h"
#include "replay/load.h"
#include "replay/rerun_steps.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

RecordingInfo info(const std::string& path) { return detail::load(path, 0).info; }

ResumeResult resume(const std::string& path, std::uint64_t frame) {
  ResumeResult result;
  const detail::Recording recording = detail::load(path, frame);
  result.outcome = detail::check_replayable(path, recording);
  if (!result.outcome.ok()) return result;
  const RecordingInfo& info = recording.info;
  if (frame < recording.snapshot_frame || frame > info.last_frame) {
    result.outcome =
        Outcome::failed(path + ": has frames " + std::to_string(info.first_frame) + " to " +
                        std::to_string(info.last_frame) + ", not " + std::to_string(frame));
    return result;
  }
  PhysicsWorld world;
  result.outcome = detail::restore(path, recording, world);
  for (const detail::RecordedStep& step : recording.steps) {
    if (step.frame <= recording.snapshot_frame) continue;
    if (!result.outcome.ok() || step.frame > frame) break;
    result.outcome = detail::step_again(recording, step, world);
    if (result.outcome.ok() && world.motion_hash() != step.state_hash)
      result.outcome = Outcome::failed("the replay leaves the recording at frame " +
                                       std::to_string(step.frame) + "; run verify for the details");
    if (!result.outcome.ok()) result.outcome.error = path + ": " + result.outcome.error;
  }
  if (result.outcome.ok()) result.world = std::move(world);
  return result;
}

}  // namespace replay
}  // namespace plumb::inline PLUMB_ABI
