#include "solver/newton/choose.h"

#include <algorithm>

#include "math/eigen_bridge.h"
#include "solver/newton/island.h"
#include "solver/newton/tolerances.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

CallsOfRows::CallsOfRows(const WorldState& world)
    : world_(world),
      gravity_(to_inner(world.settings.gravity)),
      g_(solver_of(world.settings) == ContactSolver::Auto ? length(gravity_) : Real(0)) {}

Call CallsOfRows::of(const ContactRow<Real>& row) const {
  // A body alone with what does not move presses as it strikes; what lies on others weighs on them.
  if (!row.both_dynamic) return Call::None;
  Real pressed = 0, gap = 0;
  for (int i = 0; i < row.count; ++i) {
    pressed += row.points[i].impulse;
    gap = std::min(gap, row.points[i].separation);
  }
  if (!(pressed > Real(0))) return Call::None;
  const Real m_a = world_.bodies.mass[row.body_a].mass, m_b = world_.bodies.mass[row.body_b].mass;
  const Real up = -dot(row.n, gravity_);
  const Real above = up > Real(0) ? m_b : m_a, below = up > Real(0) ? m_a : m_b;
  const bool lies = std::abs(up) > tolerance::kLies * g_;
  if (lies && above > tolerance::kLightest * below) return Call::Mass;
  if (pressed > tolerance::kMostLoad * std::min(m_a, m_b) * g_ * world_.h) return Call::Load;
  const Real slop =
      row.push_speed * (detail::tolerance::kSlopFraction / detail::tolerance::kPushRate);
  return gap < -tolerance::kMostOverlap * slop ? Call::Overlap : Call::None;
}

void hear_calls(WorldState& world, const Call* of_row) {
  BodyStore& bodies = world.bodies;
  Calls& calls = world.newton_calls;
  calls = {};
  const auto rows = static_cast<std::uint32_t>(world.rows.size());
  StepList<Call> loudest(&world.memory);  // per dense body
  for (std::uint32_t k = 0; k < rows; ++k) {
    const Call call = of_row[k];
    if (call == Call::None) continue;
    ++(call == Call::Mass ? calls.mass : call == Call::Load ? calls.load : calls.overlap);
    if (loudest.empty()) loudest.assign(bodies.awake_end, Call::None);
    for (const std::uint32_t body : {world.rows[k].body_a, world.rows[k].body_b})
      if (loudest[body] != Call::Mass) loudest[body] = call;
  }
  if (loudest.empty() && !bodies.some_called) return;
  bodies.some_called = false;
  for (std::uint32_t i = bodies.awake_begin; i < bodies.awake_end; ++i) {
    BodyInfo& info = bodies.info[bodies.slot_of[i]];
    const Call call = loudest.empty() ? Call::None : loudest[i];
    const std::uint8_t before = info.newton_calls;
    if (info.newton_steps > 0) --info.newton_steps;
    if (info.newton_pause > 0) {
      --info.newton_pause;
    } else if (call == Call::None) {
      info.newton_calls = before > 0 ? static_cast<std::uint8_t>(before - 1) : before;
    } else {
      if (before < tolerance::kStepsToBeLoad) ++info.newton_calls;
      if (call == Call::Mass || info.newton_calls == tolerance::kStepsToBeLoad)
        info.newton_steps = tolerance::kStepsToStay;
    }
    if (info.newton_calls > 0 || info.newton_steps > 0 || info.newton_pause > 0)
      bodies.some_called = true;
  }
}

void hear_no_more(WorldState& world, const Island& island) {
  for (const IslandBody& body : island.bodies) {
    BodyInfo& info = world.bodies.info[world.bodies.slot_of[body.dense]];
    info.newton_calls = info.newton_steps = info.newton_overruns = 0;
    info.newton_pause = tolerance::kStepsOfPause;
  }
}

bool is_tree(const Island& island) {
  return island.matrix.products() <= tolerance::kTreeProducts * island.bodies.size();
}

bool is_within_means(const Island& island) {
  const std::size_t products = island.matrix.products();
  return products <= tolerance::kMostProducts &&
         (is_tree(island) ||
          products * tolerance::kFewFactorizations <= tolerance::kMostClusterWork);
}

std::uint32_t budget_of(const Island& island, std::uint32_t islands) {
  const std::size_t work =
      is_tree(island)
          ? std::min(tolerance::kMostWork, tolerance::kWorkPerBody * island.bodies.size())
          : tolerance::kMostClusterWork;
  const std::size_t each = island.matrix.products() + tolerance::kProductsBeside;
  return static_cast<std::uint32_t>(work / islands / each);
}

void note_effort(WorldState& world, const Island& island) {
  const bool overrun = island.total_factorizations > island.budget;
  const std::uint8_t most = is_tree(island) ? tolerance::kMostOverruns : 1;
  std::uint8_t overruns = 0;
  for (const IslandBody& body : island.bodies) {
    BodyInfo& info = world.bodies.info[world.bodies.slot_of[body.dense]];
    info.newton_overruns = overrun ? static_cast<std::uint8_t>(info.newton_overruns + 1) : 0;
    overruns = std::max(overruns, info.newton_overruns);
  }
  if (overruns >= most) hear_no_more(world, island);
}

bool is_called(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  if (!bodies.some_called) return false;
  for (std::uint32_t i = bodies.awake_begin; i < bodies.awake_end; ++i)
    if (bodies.info[bodies.slot_of[i]].newton_steps > 0) return true;
  return false;
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
