// The settings that are good enough, or cheap enough, from the table of what was measured.
#include "world/measured_settings.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "world/measured_table.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

struct Candidate {
  int rate, substeps, joint_order;
  double error, cost;
};

// One entry a step and number of substeps; for Any the worst of the kinds in both respects.
void add_candidates(SceneKind kind, double dt, int joint_order, std::vector<Candidate>& out) {
  for (const MeasuredSetting& row : kMeasured) {
    if (std::string_view(row.precision) != kPrecisionName) continue;
    if (kind != SceneKind::Any && row.kind != kind) continue;
    if (row.kind == SceneKind::Jointed && row.joint_order != joint_order) continue;
    constexpr double kSameStep = 1 + 1e-9;  // 1.0/60 is not 60 Hz to the last bit
    if (dt > 0 && 1 > kSameStep * dt * row.rate) continue;
    const auto same = std::find_if(out.begin(), out.end(), [&](const Candidate& c) {
      return c.rate == row.rate && c.substeps == row.substeps && c.joint_order == joint_order;
    });
    if (same == out.end()) {
      out.push_back({row.rate, row.substeps, joint_order, row.error, row.cost});
    } else {
      same->error = std::max(same->error, row.error);
      same->cost = std::max(same->cost, row.cost);
    }
  }
}
std::vector<Candidate> candidates_of(SceneKind kind, double dt) {
  std::vector<Candidate> out;
  add_candidates(kind, dt, 2, out);
  if (kind == SceneKind::Any || kind == SceneKind::Jointed) add_candidates(kind, dt, 4, out);
  return out;
}

SettingsChoice choice_of(const Candidate& candidate, const Status& status) {
  SettingsChoice choice;
  choice.status = status;
  choice.settings.substeps = candidate.substeps;
  choice.settings.joint_order = candidate.joint_order;
  choice.dt = 1.0 / candidate.rate;
  choice.error = candidate.error;
  choice.cost = candidate.cost;
  return choice;
}

// The cheapest of those with `bounded` <= bound, by `wanted`; else, with a status, the one that
// comes nearest to the bound.
SettingsChoice choose(double bound, SceneKind kind, double dt, double Candidate::*bounded,
                      double Candidate::*wanted, const char* unreachable) {
  SettingsChoice refused;
  if (!std::isfinite(bound) || bound <= 0) {
    refused.status = {StatusCode::OutOfRange, "tolerance or budget must be finite and positive"};
    return refused;
  }
  if (!std::isfinite(dt) || dt < 0) {
    refused.status = {StatusCode::OutOfRange, "dt must be finite and not negative [s]"};
    return refused;
  }
  if (static_cast<int>(kind) >= kSceneKindCount) {
    refused.status = {StatusCode::OutOfRange, "the kind of scene is none of SceneKind"};
    return refused;
  }
  const std::vector<Candidate> all = candidates_of(kind, dt);
  if (all.empty()) {
    refused.status = {StatusCode::Unreachable, "nothing was measured at so short a step"};
    return refused;
  }
  const Candidate* best = nullptr;
  const Candidate* nearest = &all.front();
  for (const Candidate& c : all) {
    if (c.*bounded < nearest->*bounded) nearest = &c;
    if (!(c.*bounded <= bound)) continue;
    if (best == nullptr || c.*wanted < best->*wanted) best = &c;
  }
  return best != nullptr ? choice_of(*best, {})
                         : choice_of(*nearest, {StatusCode::Unreachable, unreachable});
}

}  // namespace
}  // namespace detail

SettingsChoice WorldSettings::from_tolerance(double tolerance, SceneKind kind, double dt) {
  return detail::choose(tolerance, kind, dt, &detail::Candidate::error, &detail::Candidate::cost,
                        "no measured setting is so accurate; the most accurate one is given");
}
SettingsChoice WorldSettings::from_budget(double budget, SceneKind kind, double dt) {
  return detail::choose(budget, kind, dt, &detail::Candidate::cost, &detail::Candidate::error,
                        "no measured setting is so cheap; the cheapest one is given");
}
const char* measured_on() { return detail::kMeasuredOn; }

const char* name_of(SceneKind kind) {
  switch (kind) {
    case SceneKind::Any:
      return "any";
    case SceneKind::Free:
      return "free";
    case SceneKind::Bouncing:
      return "bouncing";
    case SceneKind::Sliding:
      return "sliding";
    case SceneKind::Jointed:
      return "jointed";
    case SceneKind::Stacked:
      return "stacked";
  }
  return "";
}

}  // namespace plumb::inline PLUMB_ABI
