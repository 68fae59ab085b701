// plumb replay info | verify | diff
#include "cli/commands.h"

#if defined(PLUMB_WITH_REPLAY)
#include <cinttypes>
#include <cstdio>
#include <memory>

#include "plumb/replay/replay.h"
#endif

namespace plumb::cli {

#if defined(PLUMB_WITH_REPLAY)

namespace {

constexpr double kMegabyte = 1e6;  // [bytes]

// Of a verification or a comparison: what to print and the exit code.
int report(const replay::VerifyResult& result, const char* what) {
  if (!result.outcome.ok()) {
    complain(result.outcome.error);
    return kBadInput;
  }
  if (!result.finished) {
    complain("note: the recording was never finished; what there is of it was compared");
  }
  if (result.difference) {
    std::printf("DIFFERENT: %s\n", result.difference->text().c_str());
    return kFailed;
  }
  if (result.not_compared > 0) {
    std::printf("DIFFERENT: %s; the %" PRIu64 " %s that both have are identical\n",
                result.lengths().c_str(), result.steps, what);
    return kFailed;
  }
  std::printf("identical: %" PRIu64 " %s\n", result.steps, what);
  return kOk;
}

}  // namespace

int replay_info(const std::string& recording) {
  const replay::RecordingInfo info = replay::info(recording);
  if (!info.outcome.ok()) {
    complain(info.outcome.error);
    return kBadInput;
  }
  std::printf("Recording    %s, %.2f MB, schema %u, precision %s\n", recording.c_str(),
              static_cast<double>(info.file_bytes) / kMegabyte, info.schema_version,
              info.precision.c_str());
  std::printf("Frames       %" PRIu64 " to %" PRIu64 ": %" PRIu64 " steps, %.3f s simulated\n",
              info.first_frame, info.last_frame, info.steps, info.seconds);
  std::printf("Bodies       %" PRIu64 " that can move\n", info.bodies);
  std::printf("Replay       %" PRIu64 " inputs, %" PRIu64 " snapshots; scene %s\n", info.inputs,
              info.snapshots, info.scene.empty() ? "not included" : "included");
  std::printf(
      "Finished     %s\n",
      info.finished ? "yes" : "no: the program that wrote it was stopped or is still at work");
  if (info.cut_bytes > 0) {
    std::printf("Cut off      %" PRIu64 " bytes at the end belong to a piece that is not whole\n",
                info.cut_bytes);
  }
  return kOk;
}

int replay_verify(const std::string& recording, int threads) {
  const std::unique_ptr<JobSystem> jobs = threads == 1 ? nullptr : make_thread_pool(threads);
  return report(replay::verify(recording, {.jobs = jobs.get()}),
                "frames simulated again, bit by bit");
}

int replay_diff(const std::string& recording_a, const std::string& recording_b) {
  const replay::VerifyResult result = replay::diff(recording_a, recording_b);
  const int code = report(result, "frames");
  if (result.difference) {
    std::printf("Recorded is what %s holds, the other %s\n", recording_a.c_str(),
                recording_b.c_str());
  }
  return code;
}

#else

namespace {

int no_replay() {
  complain(
      "this build of plumb cannot read recordings; build it with PLUMB_REPLAY=ON (needs cargo)");
  return kBadInput;
}

}  // namespace

int replay_info(const std::string&) { return no_replay(); }
int replay_verify(const std::string&, int) { return no_replay(); }
int replay_diff(const std::string&, const std::string&) { return no_replay(); }

#endif

}  // namespace plumb::cli
