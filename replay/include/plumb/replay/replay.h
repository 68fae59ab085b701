// Reads recordings back: what is in one, whether it can be simulated again bit by bit, where two of
// them part, and a world as it stood at any recorded step.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "plumb/replay/outcome.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

using rrd::Outcome;

struct RecordingInfo {
  Outcome outcome;  // not ok: the file could not be read; the rest as far as it was
  std::string application_id, recording_id;
  std::uint32_t schema_version = 0;
  std::string precision;          // of the build that recorded: "f32", "f32d" or "f64"
  std::string scene;              // as given to the recorder
  std::uint64_t first_frame = 0;  // step number where the recording begins
  std::uint64_t last_frame = 0;   // of the last recorded step
  std::uint64_t steps = 0, inputs = 0, snapshots = 0;
  std::uint64_t bodies = 0;  // that can move, in the last row
  double seconds = 0;        // [s] simulated between the first and the last step
  bool finished = false;     // false: the recorder was never closed (killed, or still at work)
  std::uint64_t file_bytes = 0;
  std::uint64_t cut_bytes = 0;  // at the file's end, of a piece that was not written to its end
};
RecordingInfo info(const std::string& path);

// The first place where two runs, or a run and its recording, are not bit-equal.
struct Difference {
  std::uint64_t frame = 0;  // step number
  std::uint64_t recorded_hash = 0, computed_hash = 0;
  // Known where the recording holds body states: the body that differs most at that step.
  std::optional<BodyId> body;
  std::string quantity;               // "position.y"
  double recorded = 0, computed = 0;  // [its SI unit]
  double ulps = 0;                    // units in the last place between them
  std::uint64_t bodies = 0;           // that differ at that step

  [[nodiscard]] std::string text() const;
};

struct VerifyOptions {
  JobSystem* jobs = nullptr;  // to step with; null: the calling thread
};

struct VerifyResult {
  Outcome outcome;          // not ok: no verdict
  bool finished = false;    // the recording has its end; else what there is was verified
  std::uint64_t steps = 0;  // compared
  // Of diff(): steps that only one of the two has, where one goes on longer or begins earlier.
  std::uint64_t not_compared = 0;
  std::string shorter;  // of diff(): the path of the recording with fewer steps; empty: neither
  std::uint64_t missing = 0;  // steps by which it is shorter
  std::optional<Difference> difference;

  [[nodiscard]] bool identical() const { return outcome.ok() && !difference && not_compared == 0; }
  // Where not_compared > 0: "b.rrd is 60 frames shorter".
  [[nodiscard]] std::string lengths() const;
};

// Simulates again from the recording alone: its first snapshot, its inputs, its time steps.
VerifyResult verify(const std::string& path, const VerifyOptions& options = {});

// Compares two recordings step by step, without simulating. Steps that only one of them has are
// counted and not compared; with any of them the two are not identical.
VerifyResult diff(const std::string& path_a, const std::string& path_b);

struct ResumeResult {
  Outcome outcome;
  std::optional<PhysicsWorld> world;  // as it stood after the step `frame`
};
// From the last snapshot before it, simulated on to the frame and checked against its hash.
ResumeResult resume(const std::string& path, std::uint64_t frame);

}  // namespace replay
}  // namespace plumb::inline PLUMB_ABI
