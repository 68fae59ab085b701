// The error of a step by step doubling: the same step from the same state with twice the substeps.
#include <algorithm>
#include <cmath>

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr int kMostSubsteps = 64;  // as in check(WorldSettings)

// [rad] between two attitudes.
double angle_between(const Quat& a, const Quat& b) {
  const Eigen::Quaterniond d = a.cast<double>().conjugate() * b.cast<double>();
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

}  // namespace

bool wants_estimate(const WorldState& world) {
  const std::uint32_t every = world.diagnostics.error_every;
  return every != 0 && world.step_count % every == 0 &&
         2 * world.settings.substeps <= kMostSubsteps;
}

void step_twin(WorldState& world, const PhysicsWorld& original, double dt) {
  if (world.twin == nullptr) world.twin = std::make_unique<PhysicsWorld>();
  original.save(world.twin_image);
  if (!world.twin->restore(world.twin_image).ok()) {
    world.twin.reset();
    return;
  }
  WorldSettings finer = world.settings;
  finer.substeps *= 2;
  finer.step_tolerance = Real(0);
  if (!world.twin->set_settings(finer).ok()) return;
  world.twin->set_job_system(world.jobs);
  world.twin->step(dt);
}

void compare_with_twin(WorldState& world, const PhysicsWorld& original) {
  if (world.twin == nullptr) return;
  std::vector<BodyState> ours, theirs;
  original.copy_body_states(ours);
  world.twin->copy_body_states(theirs);
  ErrorEstimate& error = world.report.error;
  error.measured = true;
  const std::size_t count = std::min(ours.size(), theirs.size());
  for (std::size_t i = 0; i < count; ++i) {
    const BodyState& a = ours[i];
    const BodyState& b = theirs[i];
    const double apart = (a.pose.position.cast<double>() - b.pose.position.cast<double>()).norm();
    if (apart > error.position) {
      error.position = apart;
      error.worst = a.id;
    }
    error.angle = std::max(error.angle, angle_between(a.pose.orientation, b.pose.orientation));
    error.velocity = std::max(error.velocity,
                              static_cast<double>((a.linear_velocity - b.linear_velocity).norm()));
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
