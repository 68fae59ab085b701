// What the harness asks of an engine. One file an engine; each takes the scene with its own
// recommended settings.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/anchors/scene.h"

namespace plumb::anchors {

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;
  virtual void step(double dt) = 0;  // dt: [s]
  // In the order of Scene::bodies; out has their number.
  virtual void read(std::vector<BodyState>& out) const = 0;
  // Seconds of the last step by stage, and counts of it; empty where the engine tells neither.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> stages() const { return {}; }
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> counts() const { return {}; }
};

struct EngineOptions {
  int threads = 1;         // the stepping one included
  int substeps = 0;        // of ours; 0: as many as are recommended
  bool profiling = false;  // fill stages()
};

struct EngineKind {
  std::string name;
  std::string settings;  // version and what it is run with
  bool ours = false;
  int most_threads = 1;
  // Null where the engine cannot build the scene.
  std::unique_ptr<Engine> (*make)(const Scene& scene, const EngineOptions& options) = nullptr;
};

// Those that this program was built with, ours first.
const std::vector<EngineKind>& engine_kinds();

// Each defined in a file of its own.
std::vector<EngineKind> plumb_kinds();
#ifdef PLUMB_ANCHORS_BULLET
EngineKind bullet_kind();
#endif
#ifdef PLUMB_ANCHORS_ODE
EngineKind ode_kind();
#endif
#ifdef PLUMB_ANCHORS_RAPIER
EngineKind rapier_kind();
#endif
#ifdef PLUMB_ANCHORS_BOX3D
EngineKind box3d_kind();
#endif
#ifdef PLUMB_ANCHORS_MUJOCO
std::vector<EngineKind> mujoco_kinds();  // by integrator
#endif

}  // namespace plumb::anchors
