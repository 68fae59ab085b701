#include "cli/recording_file.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#if defined(PLUMB_WITH_REPLAY)
#include "cli/output_path.h"
#include "plumb/integration/scene_recording.h"
#include "plumb/replay/recorder.h"
#endif

namespace plumb::cli {

#if defined(PLUMB_WITH_REPLAY)

struct RecordingFile::State {
  replay::Recorder recorder;
  std::string path, partial;
  std::uint64_t bytes = 0;
  replay::RecorderCost cost;  // of the steps, without closing the file
};

namespace {

// Why no recording can appear under this name; empty if one can.
std::string why_not(const std::string& path, const std::string& scene) {
  std::error_code ignored;
  if (std::filesystem::equivalent(path, scene, ignored)) {
    return path + " is the scene itself; give another name, for example run.rrd";
  }
  // The finished recording takes the place of what is there, which no device survives.
  if (is_device(path)) {
    return path + " is a device, a pipe or a socket; give the name of a file, for example " +
           "run.rrd, or leave out -o to record nothing";
  }
  return why_no_file(behind_links(path));
}

}  // namespace

std::string RecordingFile::open(const std::string& path, const assets::Scene& scene,
                                const assets::SceneInstance& instance, PhysicsWorld& world,
                                bool labels) {
  if (std::string wrong = why_not(path, scene.source); !wrong.empty()) return wrong;
  auto state = std::make_unique<State>();
  state->path = behind_links(path);
  // Of this process alone: another one may be recording to the same name.
  state->partial = state->path + "." + std::to_string(getpid()) + ".partial";
  replay::RecorderOptions options;
  options.path = state->partial;
  options.name = scene.name;
  options.scene = assets::scene_to_json(scene);
  options.frames_per_second = 1 / scene.step.dt;
  if (const auto opened = state->recorder.open(options); !opened.ok()) return opened.error;
  integration::show_meshes(state->recorder, instance);
  if (labels) integration::show_labels(state->recorder, scene, instance, world);
  world.attach(&state->recorder);
  state_ = std::move(state);
  return {};
}

std::string RecordingFile::problem() const { return state_ ? state_->recorder.status().error : ""; }

std::string RecordingFile::finish(PhysicsWorld& world) {
  world.detach(&state_->recorder);
  state_->cost = state_->recorder.cost();
  if (const auto closed = state_->recorder.close(); !closed.ok()) {
    return closed.error + "; what there is of it is in " + state_->partial;
  }
  std::error_code problem;
  std::filesystem::rename(state_->partial, state_->path, problem);
  if (problem) {
    return "cannot rename " + state_->partial + " to " + state_->path + ": " + problem.message();
  }
  state_->bytes = std::filesystem::file_size(state_->path, problem);
  return {};
}

std::uint64_t RecordingFile::bytes() const { return state_ ? state_->bytes : 0; }
double RecordingFile::seconds() const { return state_ ? state_->cost.seconds : 0; }
double RecordingFile::seconds_per_body_step() const {
  return state_ ? state_->cost.seconds_per_body_step() : 0;
}
std::uint64_t RecordingFile::body_steps() const { return state_ ? state_->cost.body_steps : 0; }

#else

struct RecordingFile::State {};

std::string RecordingFile::open(const std::string&, const assets::Scene&,
                                const assets::SceneInstance&, PhysicsWorld&, bool) {
  return "this build of plumb cannot record; build it with PLUMB_REPLAY=ON (needs cargo) or leave "
         "out -o";
}
std::string RecordingFile::problem() const { return {}; }
std::string RecordingFile::finish(PhysicsWorld&) { return {}; }
std::uint64_t RecordingFile::bytes() const { return 0; }
double RecordingFile::seconds() const { return 0; }
double RecordingFile::seconds_per_body_step() const { return 0; }
std::uint64_t RecordingFile::body_steps() const { return 0; }

#endif

RecordingFile::RecordingFile() = default;
RecordingFile::~RecordingFile() = default;
bool RecordingFile::is_open() const { return state_ != nullptr; }

}  // namespace plumb::cli
