// The step: one line a stage.
#include <chrono>
#include <cmath>

#include "world/joint_world.h"
#include "world/ledger_charges.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

// Runs a stage, and times it when somebody asked for the profile.
class StageRunner {
 public:
  explicit StageRunner(WorldState& world) : world_(world) {}
  template <class Run>
  void operator()(Stage stage, Run&& run) {
    if (!world_.settings.profiling) {
      run(world_);
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    run(world_);
    world_.report.stage_seconds[static_cast<std::size_t>(stage)] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

 private:
  WorldState& world_;
};

void run_stages(WorldState& world, double dt) {
  StageRunner stage(world);
  world.stepping = true;
  world.memory.reset();
  stage(Stage::Plan, [dt](WorldState& w) { plan_step(w, dt); });
  stage(Stage::Broadphase, find_pairs);
  stage(Stage::Narrowphase, collide_pairs);
  stage(Stage::Islands, find_newton_islands);
  stage(Stage::Coloring, color_contacts);
  stage(Stage::Rows, build_rows);
  stage(Stage::Substeps, run_substeps);
  stage(Stage::Continuous, stop_fast_bodies);
  if (world.diagnostics.ledger) weigh_paths(world);
  stage(Stage::Finalize, finalize_bodies);
  if (world.diagnostics.ledger) close_ledger(world);
  stage(Stage::Sleep, sleep_islands);
  if (!world.joints.empty()) break_joints(world);
  std::swap(world.published, world.gathering);
  world.gathering.clear();
  world.stepping = false;
}

}  // namespace
}  // namespace detail

const StepReport& PhysicsWorld::step(double dt) {
  detail::WorldState& world = *state_;
  StepReport& report = world.report;
  if (world.stepping) {
    static const StepReport refused = [] {
      StepReport no;
      no.status = {StatusCode::InsideStep, "step() was called while the world steps"};
      return no;
    }();
    return refused;
  }
  if (!std::isfinite(dt) || dt < 0) {
    report.status = {StatusCode::OutOfRange,
                     "dt must be finite and not negative [s]; nothing was stepped"};
    return report;
  }
  if (dt == 0) {
    report.status = {};
    report.dt = 0;
    return report;
  }
  const bool estimate = detail::wants_estimate(world);
  if (estimate) detail::step_twin(world, *this, dt);
  detail::run_stages(world, dt);
  if (estimate) detail::compare_with_twin(world, *this);
  if (!world.observers.empty()) {
    const Events happened = events();
    const StepView view{*this, report, happened, world.inputs};
    world.stepping = true;  // observers look, they do not touch
    for (StepObserver* observer : world.observers) observer->on_step(view);
    world.stepping = false;
  }
  world.inputs.clear();
  return report;
}

}  // namespace plumb::inline PLUMB_ABI
