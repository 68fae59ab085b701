#include "replay/rerun_steps.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

Outcome check_replayable(const std::string& path, const Recording& recording) {
  const RecordingInfo& info = recording.info;
  if (!info.outcome.ok()) return info.outcome;
  if (info.precision != kPrecisionName)
    return Outcome::failed(path + ": was recorded by the " + info.precision +
                           " build, this is the " + kPrecisionName +
                           " build; configure with -DPLUMB_PRECISION=" + info.precision);
  if (!recording.snapshot) return Outcome::failed(path + ": holds no snapshot to start from");
  return {};
}

Outcome restore(const std::string& path, const Recording& recording, PhysicsWorld& world) {
  const Status restored = world.restore(*recording.snapshot);
  if (restored.ok()) return {};
  return Outcome::failed(path + ": the snapshot at frame " +
                         std::to_string(recording.snapshot_frame) +
                         " cannot be restored: " + restored.message);
}

Outcome step_again(const Recording& recording, const RecordedStep& step, PhysicsWorld& world) {
  const auto found = recording.inputs.find(step.frame);
  if (found != recording.inputs.end()) {
    for (std::size_t i = 0; i < found->second.size(); ++i) {
      const InputRecord& input = found->second[i];
      const Status applied = world.apply_input(input);
      if (!applied.ok())
        return Outcome::failed("input " + std::to_string(i) + " (" + name_of(input.kind) +
                               ") before frame " + std::to_string(step.frame) +
                               " is not accepted: " + applied.message);
    }
  }
  const Status stepped = world.step(step.dt).status;
  if (stepped.ok()) return {};
  return Outcome::failed("frame " + std::to_string(step.frame) +
                         " cannot be stepped: " + stepped.message);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
