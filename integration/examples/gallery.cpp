// Every shape and every kind of joint in one scene, each doing its thing:
//
//   build/release/examples/gallery assets/scenes/gallery.json gallery.rrd
//   rerun gallery.rrd
//
// Loads the scene, steps it, and prints what each joint with a name has done: how far its
// coordinate went, the largest force it carried, whether it broke. The recording, with the names
// beside bodies and joints, is left out if no second file is named. `plumb run --labels -o` does
// the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "plumb/assets/scene.h"
#include "plumb/integration/scene_recording.h"
#include "plumb/world.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

// What a joint did over the run.
struct Seen {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();  // [rad] or [m]
  double force = 0;                                           // [N] largest
  double broke_at = -1;                                       // [s]

  void look(const PhysicsWorld& world, JointId id) {
    if (!world.is_valid(id)) {
      if (broke_at < 0) broke_at = world.time();
      return;
    }
    const JointState state = world.joint_state(id);
    const JointKind kind = world.joint(id).kind;
    const bool turns =
        std::holds_alternative<HingeJoint>(kind) || std::holds_alternative<ConeTwistJoint>(kind);
    const auto at = static_cast<double>(turns ? state.angle : state.translation);
    lowest = std::min(lowest, at);
    highest = std::max(highest, at);
    force = std::max(force, static_cast<double>(world.joint_reaction(id).force.norm()));
  }
};

int complain(const std::string& text) {
  std::fprintf(stderr, "gallery: %s\n", text.c_str());
  return 1;
}

int run(const std::string& scene_path, const std::string& recording_path) {
  const auto scene = assets::load_scene(scene_path);
  if (!scene.ok()) return complain(scene.error());
  PhysicsWorld world;
  const auto instance = assets::instantiate(*scene, world);
  if (!instance.ok()) return complain(instance.error());

#if defined(PLUMB_WITH_REPLAY)
  replay::Recorder recorder;
  if (!recording_path.empty()) {
    replay::RecorderOptions options;
    options.path = recording_path;
    options.scene = assets::scene_to_json(*scene);
    if (const auto opened = recorder.open(options); !opened) return complain(opened.error);
    integration::show_meshes(recorder, *instance);
    integration::show_labels(recorder, *scene, *instance, world);
    world.attach(&recorder);
  }
#else
  if (!recording_path.empty()) return complain("this build cannot record");
#endif

  std::vector<Seen> seen(instance->joints.size());
  for (std::uint64_t step = 0; step < scene->step.count(); ++step) {
    if (const StepReport& report = world.step(scene->step.dt); !report.status.ok())
      return complain(report.status.message);
    for (std::size_t k = 0; k < seen.size(); ++k) seen[k].look(world, instance->joints[k].id);
  }

#if defined(PLUMB_WITH_REPLAY)
  if (!recording_path.empty()) {
    world.detach(&recorder);
    if (const auto closed = recorder.close(); !closed) return complain(closed.error);
  }
#endif

  std::printf("%zu bodies, %zu joints, %.1f s\n", world.body_count(), seen.size(), world.time());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::string& name = instance->joints[k].name;
    if (name == "joint " + std::to_string(k)) continue;
    std::printf("%-20s from %7.3f to %7.3f, up to %7.0f N", name.c_str(), seen[k].lowest,
                seen[k].highest, seen[k].force);
    if (seen[k].broke_at >= 0) std::printf(", breaks at %.2f s", seen[k].broke_at);
    std::printf("\n");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) return complain("usage: gallery SCENE.json [RECORDING.rrd]");
  return run(argv[1], argc == 3 ? argv[2] : "");
}
