// A recording in memory: everything a replay needs except the snapshots, of which one is kept.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "plumb/replay/replay.h"
#include "rrd/reader.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

struct RecordedStep {
  std::uint64_t frame = 0;
  double dt = 0;    // [s]
  double time = 0;  // [s] after the step
  std::uint64_t state_hash = 0;
};

struct Recording {
  RecordingInfo info;
  std::vector<RecordedStep> steps;                           // ascending, without gaps
  std::map<std::uint64_t, std::vector<InputRecord>> inputs;  // by the step they were given before
  std::uint64_t snapshot_frame = 0;
  std::optional<Snapshot> snapshot;
};

// Reads a recording of any precision and checks that its steps are all there. The snapshot kept is
// the last one not after `until`, or the first one.
Recording load(const std::string& path, std::uint64_t until);

// Every body that can move at one frame.
struct BodyRow {
  std::vector<std::uint64_t> ids;
  std::vector<std::uint8_t> awake;
  std::vector<PosReal> position;                        // x3
  std::vector<Real> orientation;                        // x4
  std::vector<Real> linear_velocity, angular_velocity;  // x3
};
// Empty when the recording holds no body states at that frame.
std::optional<BodyRow> load_bodies(const std::string& path, std::uint64_t frame);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
