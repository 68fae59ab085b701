#include <algorithm>
#include <array>
#include <cstdio>

#include "plumb/replay/replay.h"
#include "replay/compare.h"
#include "replay/load.h"
#include "replay/rerun_steps.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

std::string Difference::text() const {
  std::array<char, 512> line{};
  std::snprintf(
      line.data(), line.size(), "frame %llu differs: state hash %016llx, recorded %016llx",
      static_cast<unsigned long long>(frame), static_cast<unsigned long long>(computed_hash),
      static_cast<unsigned long long>(recorded_hash));
  std::string all = line.data();
  if (quantity.empty()) return all;
  if (!body) {  // not a quantity of one: there are not the same bodies on both sides
    std::snprintf(line.data(), line.size(), "; other bodies: %.0f that can move, recorded %.0f",
                  computed, recorded);
    return all + line.data();
  }
  const std::string who = "body " + std::to_string(body->index) + ", ";
  std::snprintf(line.data(), line.size(), "; %s%s is %.17g, recorded %.17g (%.3g apart, %.3g ulp)",
                who.c_str(), quantity.c_str(), computed, recorded, computed - recorded, ulps);
  all += line.data();
  if (bodies > 1) all += "; " + std::to_string(bodies) + " bodies differ";
  return all;
}

std::string VerifyResult::lengths() const {
  const auto frames = [](std::uint64_t n) {
    return std::to_string(n) + (n == 1 ? " frame" : " frames");
  };
  if (shorter.empty())
    return "they begin at other frames: " + frames(not_compared) + " in one only";
  return shorter + " is " + frames(missing) + " shorter";
}

VerifyResult verify(const std::string& path, const VerifyOptions& options) {
  VerifyResult result;
  const detail::Recording recording = detail::load(path, 0);
  result.finished = recording.info.finished;
  result.outcome = detail::check_replayable(path, recording);
  if (!result.outcome.ok()) return result;

  PhysicsWorld world;
  world.set_job_system(options.jobs);
  result.outcome = detail::restore(path, recording, world);
  if (!result.outcome.ok()) return result;

  for (const detail::RecordedStep& step : recording.steps) {
    result.outcome = detail::step_again(recording, step, world);
    if (!result.outcome.ok()) {
      result.outcome.error = path + ": " + result.outcome.error;
      return result;
    }
    ++result.steps;
    const std::uint64_t hash = world.motion_hash();
    if (hash == step.state_hash) continue;
    Difference difference;
    difference.frame = step.frame;
    difference.recorded_hash = step.state_hash;
    difference.computed_hash = hash;
    if (const auto row = detail::load_bodies(path, step.frame))
      detail::name_difference(*row, detail::body_row(world), difference);
    result.difference = std::move(difference);
    break;
  }
  return result;
}

VerifyResult diff(const std::string& path_a, const std::string& path_b) {
  VerifyResult result;
  const detail::Recording a = detail::load(path_a, 0), b = detail::load(path_b, 0);
  result.finished = a.info.finished && b.info.finished;
  result.outcome = a.info.outcome.ok() ? b.info.outcome : a.info.outcome;
  if (!result.outcome.ok()) return result;
  if (a.info.precision != b.info.precision) {
    result.outcome =
        Outcome::failed(path_a + " was recorded by the " + a.info.precision + " build, " + path_b +
                        " by the " + b.info.precision + " build: their bits cannot be the same");
    return result;
  }
  const std::size_t steps_a = a.steps.size(), steps_b = b.steps.size();
  if (steps_a != steps_b) result.shorter = steps_a < steps_b ? path_a : path_b;
  result.missing = std::max(steps_a, steps_b) - std::min(steps_a, steps_b);
  std::size_t i = 0, k = 0;
  while (i < a.steps.size() && k < b.steps.size()) {
    if (a.steps[i].frame < b.steps[k].frame) {
      ++i;
      ++result.not_compared;
    } else if (b.steps[k].frame < a.steps[i].frame) {
      ++k;
      ++result.not_compared;
    } else {
      ++result.steps;
      const detail::RecordedStep &step_a = a.steps[i++], &step_b = b.steps[k++];
      if (step_a.state_hash == step_b.state_hash) continue;
      Difference difference;
      difference.frame = step_a.frame;
      difference.recorded_hash = step_a.state_hash;
      difference.computed_hash = step_b.state_hash;
      const auto row_a = detail::load_bodies(path_a, step_a.frame);
      const auto row_b = detail::load_bodies(path_b, step_b.frame);
      if (row_a && row_b) detail::name_difference(*row_a, *row_b, difference);
      result.difference = std::move(difference);
      break;
    }
  }
  if (!result.difference) result.not_compared += a.steps.size() - i + b.steps.size() - k;
  if (result.steps == 0 && result.outcome.ok())
    result.outcome = Outcome::failed(path_a + " and " + path_b + " have no frame in common");
  return result;
}

}  // namespace replay
}  // namespace plumb::inline PLUMB_ABI
