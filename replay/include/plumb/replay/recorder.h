// Writes every step of a world into a Rerun recording (.rrd): for the eye (3D view, plots, text
// log, with their layout) and for replay (scene, inputs, state hashes, exact snapshots).
//
//   plumb::replay::Recorder recorder;
//   if (auto opened = recorder.open({.path = "run.rrd"}); !opened) report(opened.error);
//   world.attach(&recorder);
//   ... world.step(dt) ...
//   world.detach(&recorder);
//   if (auto closed = recorder.close(); !closed) report(closed.error);
//
// A failing disk never harms the simulation: recording stops, the reason stands in status(). The
// file can be read while it grows; what a killed process had handed over before stays readable.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plumb/ids.h"
#include "plumb/math.h"
#include "plumb/observer.h"
#include "plumb/replay/outcome.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

using rrd::Outcome;

struct RecorderOptions {
  std::string path = {};                 // overwritten if it exists
  std::string application_id = "plumb";  // recordings with the same one share the viewer's layout
  std::string name = {};                 // shown by the viewer; empty: the path
  std::string scene = {};                // the scene as its file's text (JSON); kept as it is

  int snapshot_every = 120;       // [steps] >= 1 between exact snapshots: two seconds at 60 Hz
  int rows_per_chunk = 30;        // [steps] >= 1 kept back and written as one piece
  double frames_per_second = 60;  // [1/s] > 0, the viewer's playback

  bool visuals = true;      // shapes, joints and labels in 3D
  bool contacts = true;     // contact points and normals, each arrow scaled by its impulse
  bool body_states = true;  // exact states of all moving bodies, for a diff by name
  // Energies, counts, stage timings (WorldSettings::profiling), ledger (StepDiagnostics::ledger).
  bool plots = true;
  bool text_log = true;  // plan and events
  // [steps] between two looks at the plan: what changes is told at the next one.
  static constexpr std::uint64_t kPlanEvery = 10;
  int event_lines_per_step = 32;  // [-] >= 0; the rest is counted, not listed
};

// A triangle mesh to look at.
struct VisualMesh {
  std::vector<Eigen::Vector3f> vertices;                      // [m] body frame
  std::vector<Eigen::Matrix<std::uint32_t, 3, 1>> triangles;  // counter-clockwise from outside
  std::uint32_t color = 0;                                    // 0xRRGGBBAA; 0: chosen
};

// What recording costs the thread that steps the world; encoding and writing have their own.
struct RecorderCost {
  double seconds = 0;      // [s] of the clock inside the recorder's callbacks
  double cpu_seconds = 0;  // [s] of the processor, of the calling thread, in the same time
  std::uint64_t steps = 0;
  std::uint64_t body_steps = 0;  // sum over steps of the bodies in the world

  // [s] of the processor
  [[nodiscard]] double seconds_per_body_step() const {
    return body_steps ? cpu_seconds / static_cast<double>(body_steps) : 0;
  }
};

// One recorder records one world, once, from where it stands when the recorder is attached.
class Recorder final : public StepObserver {
 public:
  Recorder();
  ~Recorder() override;  // closes; detach first
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  Outcome open(const RecorderOptions& options);
  // Draw a body as a mesh instead of its colliders. Bodies with the same mesh share it. To be
  // called before attach; for a body created later, before the next step.
  void show_as(BodyId body, std::shared_ptr<const VisualMesh> mesh);

  // Shows a text beside a body, or where a joint holds its bodies. To be called as show_as.
  void label(BodyId body, std::string text);
  void label(JointId joint, std::string text);

  // Hands over what is kept back, waits until it is written; durable: until it is on the disk.
  Outcome flush(double timeout = 10, bool durable = false);  // [s]
  Outcome close(double timeout = 60);                        // [s]
  // Whether everything so far was accepted.
  [[nodiscard]] Outcome status() const;
  [[nodiscard]] RecorderCost cost() const;
  [[nodiscard]] std::uint64_t bytes_written() const;

  void on_attach(const PhysicsWorld& world) override;
  void on_step(const StepView& view) override;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace replay
}  // namespace plumb::inline PLUMB_ABI
