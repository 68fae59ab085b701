// A group that touches nothing goes through the substep by itself:
//
//   h/2 of the forces | warm start, solve | drift | h/2 of the forces | close, relax
//
// This is symmetric, second order in h, and keeps energy over long times [Andersen 1983]. As
// nothing else is waiting for it, the group may take substeps of its own: where a light chain
// carries a heavy load the fastest vibration of what is stretched is out of reach of the world's,
// and a whip turns faster than they can follow.
//
// WorldSettings::joint_order 4 makes five of these of each, the middle one back in time: for a
// symmetric scheme the errors of third order in h cancel, 4 a^3 + b^3 = 0 with 4 a + b = 1
// [Suzuki 1990]. (Three would do, 2 a^3 + b^3 = 0, but they reach 1.7 substeps back and err a
// hundred times as much.) What loses energy has no way back: groups with friction, motors,
// dampers or limits within reach stay at second order.
#include "solver/joints/joint_flight.h"

#include <cmath>

#include "solver/body_substep.h"
#include "solver/joints/joint_levers.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// The group's own substeps within one of the world's: how many it calls for.
int cycles_of(WorldState& world, const JointPiece& piece) {
  const JointScratch& scratch = *world.joints.scratch;
  for_bodies(scratch, piece, [&](std::uint32_t i) { world.substep[i].stiffness = Real(0); });
  Real turn = 0, vibration = 0;  // [rad^2/s^2]
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointBlock& block = scratch.blocks[i];
    if (block.pairs != 1) continue;  // couplings pass on torques
    const Real f = pull_of(block, piece.h);
    const int a = block.place[0], b = block.place[1];
    const Vec arm_a = rotate(world.delta[block.body[a]].dq, block.pair[0].arm_a);
    const Vec arm_b = rotate(world.delta[block.body[b]].dq, block.pair[0].arm_b);
    const Lever at_a = lever_of(block, a, arm_a), at_b = lever_of(block, b, arm_b);
    for (const bool first : {true, false}) {
      const int k = first ? a : b;
      if (!block.moves[k]) continue;
      SubstepBody& s = world.substep[block.body[k]];
      s.stiffness += first ? stiffness(f, at_a, at_b) : stiffness(f, at_b, at_a);
      vibration = std::max(vibration, s.stiffness);
      const Vec arm = first ? arm_a : arm_b;
      const Vec across = cross(world.bodies.velocity[block.body[k]].w, arm);
      const Real r2 = length_squared(arm);
      if (r2 > Real(0)) turn = std::max(turn, length_squared(across) / r2);
    }
  }
  const Real wanted =
      world.h * std::max(std::sqrt(turn) / joint_tolerance::kTurnPerCycle,
                         std::sqrt(vibration) / joint_tolerance::kVibrationPerCycle);
  if (!(wanted > Real(1))) return 1;
  return wanted < Real(joint_tolerance::kMostCycles) ? static_cast<int>(std::ceil(wanted))
                                                     : joint_tolerance::kMostCycles;
}

// ... as many as it takes, and notes them.
int cycles_taken(WorldState& world, JointPiece& piece) {
  const int wanted = cycles_of(world, piece);
  const Choice choice = world.settings.forced.of(PlanItem::JointSubsteps);
  const int taken = choice == Choice::Automatic ? wanted
                    : choice == Choice::On      ? joint_tolerance::kMostCycles
                                                : 1;
  piece.wanted_substeps += static_cast<std::uint32_t>(wanted - 1);
  piece.most_wanted = std::max(piece.most_wanted, static_cast<std::uint32_t>(wanted));
  piece.own_substeps += static_cast<std::uint32_t>(taken - 1);
  return taken;
}

// a = 1/(4 - 4^(1/3)) and b = 1 - 4a: parts of a substep.
constexpr Real kThere = Real(0.41449077179437574), kBack = Real(-0.65796308717750294);
constexpr Real kParts[] = {kThere, kThere, kBack, kThere, kThere};

// How far from where it stands a free coordinate may get, in units of what its rate makes in a
// substep [-]: the composition stays within it, and forces may double a small rate.
constexpr Real kAhead = Real(2);

bool stays_off_limits(const JointRow& row, const FreeRow& free, Real h) {
  const Real reach = kAhead * h * std::abs(row.rate);
  return row.value - reach > free.lower && row.value + reach < free.upper;
}

// Whether the motion of a group can be undone: nothing damps, rubs, drives or hits.
bool is_reversible(const WorldState& world, const JointPiece& piece, Real h) {
  const JointScratch& scratch = *world.joints.scratch;
  bool reversible = keeps_momentum(rotation_of(world.settings));
  for_bodies(scratch, piece, [&](std::uint32_t i) {
    const BodyForce& force = world.bodies.force[i];
    reversible = reversible && force.linear_damping == Real(0) && force.angular_damping == Real(0);
  });
  for (std::uint32_t i = piece.begin; i < piece.end && reversible; ++i) {
    const JointBlock& block = scratch.blocks[i];
    for (int f = 0; f < block.rows - block.held && reversible; ++f) {
      const FreeRow& free = block.free[f];
      const bool soft = free.spring && (free.damping > Real(0) || free.spring_share > Real(0.5) ||
                                        free.pulls_only);
      reversible = !soft && !free.servo && !free.motor && !(free.friction > Real(0)) &&
                   (!free.limited || stays_off_limits(block.row[block.held + f], free, h));
    }
  }
  return reversible;
}

// Hides limits that are out of reach while a group goes back in time, where pushes would be pulls.
class LimitsAside {
 public:
  LimitsAside(JointScratch& scratch, const JointPiece& piece) : scratch_(scratch), piece_(piece) {
    set(false);
  }
  ~LimitsAside() { set(true); }
  LimitsAside(const LimitsAside&) = delete;
  LimitsAside& operator=(const LimitsAside&) = delete;

 private:
  void set(bool limited) {
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
      JointBlock& block = scratch_.blocks[i];
      for (int f = 0; f < block.rows - block.held; ++f) {
        FreeRow& free = block.free[f];
        if (limited ? free.limit_aside : free.limited) {
          free.limited = limited;
          free.limit_aside = !limited;
        }
      }
    }
  }
  JointScratch& scratch_;
  const JointPiece& piece_;
};

// Impulses belong to a substep of the length in which they were found.
void rescale_impulses(JointScratch& scratch, const JointPiece& piece, Real by) {
  if (by == Real(1)) return;
  for (std::uint32_t i = piece.begin; i < piece.end; ++i)
    for (int k = 0; k < scratch.blocks[i].rows; ++k)
      for (int p = 0; p < kRowParts; ++p) {
        scratch.blocks[i].row[k].impulses.first[p] *= by;
        scratch.blocks[i].row[k].impulses.second[p] *= by;
      }
}

// One symmetric step of a group by h [s]; `end` [s]: of the world's substep, where it arrives.
void fly(WorldState& world, JointPiece& piece, Real h, Real end) {
  JointScratch& scratch = *world.joints.scratch;
  const auto for_blocks = [&](auto&& task) {
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) task(scratch.blocks[i]);
  };
  const auto for_all = [&](auto&& task) { for_bodies(scratch, piece, task); };
  rescale_impulses(scratch, piece, h / piece.h);
  piece.h = h;
  for_blocks([&](JointBlock& block) { block.h = h; });
  for_all([&](std::uint32_t i) { kick(world, i, Real(0.5) * h); });
  for_blocks([&](JointBlock& block) { warm_start_joint(world, block, JointPass::Solve); });
  solve_joints_of(world, piece, JointPass::Solve);
  for_blocks([&](JointBlock& block) { sum_joint(block, world, JointPass::Solve); });
  for_all([&](std::uint32_t i) {
    drift(world, i, h);
    turn_inertia(world, i);
    kick(world, i, Real(0.5) * h);
  });
  for_blocks([&](JointBlock& block) {
    block.elapsed = end;
    prepare_joint(world, block);
  });
  close_joints_of(world, piece);
  for_blocks([&](JointBlock& block) { warm_start_joint(world, block, JointPass::Relax); });
  solve_joints_of(world, piece, JointPass::Relax);
  for_blocks([&](JointBlock& block) {
    sum_joint(block, world, JointPass::Relax);
    note_rates(block, world);
  });
  for_all([&](std::uint32_t i) {
    collect_momentum(world, i);
    world.substep[i].w_in = world.bodies.velocity[i].w;
  });
}

}  // namespace

void fly_joint_group(WorldState& world, JointPiece& piece) {
  JointScratch& scratch = *world.joints.scratch;
  const int cycles = cycles_taken(world, piece);
  const Real h = world.h / static_cast<Real>(cycles);
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const Real begin = static_cast<Real>(cycle) * h, end = static_cast<Real>(cycle + 1) * h;
    if (world.settings.joint_order == 4 && is_reversible(world, piece, h)) {
      const LimitsAside aside(scratch, piece);
      Real now = begin;
      for (const Real part : kParts) fly(world, piece, part * h, now += part * h);
    } else {
      fly(world, piece, h, end);
    }
  }
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) scratch.blocks[i].elapsed = Real(0);
}

}  // namespace plumb::inline PLUMB_ABI::detail
