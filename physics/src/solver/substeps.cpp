// The substeps: known forces, bounces, contacts, motion, relaxation [Catto 2024].
//
//   for each substep of length h
//     impacts     bounces at their own time inside the substep (impacts.cpp)
//     kick        v += h a, L += h torque; damping exact
//     warm start  the impulses of the last substep
//     solve       one pass, overlap worked off softly
//     drift       dp += h v; rotation by the torque-free flow with L fixed
//     relax       one pass without the bias: the velocities that push out overlap do not stay
//                 (as many of each as velocity_iterations says)
//     trapezoid   dp += theta (h/2)(v_start - v_end): free fall, sliding and rolling become exact
//     to
//                 second order; theta is the share of the substep during which contacts slid
#include <algorithm>
#include <cmath>

#include "effects/effect_world.h"
#include "math/prefetch.h"
#include "motion/body_motion.h"
#include "solver/body_substep.h"
#include "solver/contact_kernel.h"
#include "solver/deep_bodies.h"
#include "solver/facet_cone.h"
#include "solver/joints/joint_stages.h"
#include "solver/newton/newton_solver.h"
#include "solver/plain_bodies.h"
#include "solver/row_end.h"
#include "solver/row_velocities.h"
#include "solver/step_groups.h"
#include "solver/step_levels.h"
#include "solver/surface_drive.h"
#include "solver/turning_kernel.h"
#include "solver/worst_first.h"
#include "world/forced.h"
#include "world/ledger_charges.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

void run_impacts(WorldState& world);

namespace {

// Rows of one colour share no dynamic body, so they may run in any order, or at once.
template <class Sweep, class Task>
void for_rows_by_color(WorldState& world, const StepGroup& group, const BlockPass& pass,
                       Sweep sweep, Task&& task, bool only_deep = false) {
  const ContactBlocks& blocks = group.blocks;
  for (const ContactBlocks::Color& color : blocks.colors) {
    IndexRange wide = color.heads, loose = color.loose;
    if (only_deep) {
      wide.end = color.deep_heads;
      loose.end = color.deep_loose;
    }
    parallel_for(group.jobs, wide.end - wide.begin, tolerance::kBlockGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   sweep(pass, wide.begin + begin, wide.begin + end);
                 });
    parallel_for(group.jobs, loose.end - loose.begin, tolerance::kRowGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t i = loose.begin + begin; i < loose.begin + end; ++i)
                     task(world.rows[blocks.loose[i]]);
                 });
  }
}

BlockPass pass_over_blocks(WorldState& world, StepGroup& group) {
  static_assert(sizeof(BodyVelocity) == 8 * sizeof(Real) && sizeof(BodyDelta) == 8 * sizeof(Real));
  BlockPass pass;
  pass.heads = group.blocks.heads.data();
  pass.numbers = group.blocks.data();
  pass.velocity = &world.bodies.velocity.data()->v.x;
  pass.delta = &world.delta.data()->dp.x;
  pass.contacts_changed = world.contacts_changed.data();
  pass.inverse_h = Real(1) / group.h;
  return pass;
}

// Enters what a row does, part by part, when the ledger is kept.
class RowCharge {
 public:
  RowCharge(WorldState& world, const ContactRow<Real>& row, bool on)
      : world_(world), row_(row), on_(on), energy_(on ? row_energy(world, row) : 0) {}
  void as(double EnergyLedger::*entry, const RowVelocities<Real>& u) {
    if (!on_) return;
    write_velocities(world_, row_, u);
    energy_ = charge_row(world_, row_, energy_, entry);
  }

 private:
  WorldState& world_;
  const ContactRow<Real>& row_;
  bool on_;
  double energy_;
};

// Bodies that only joints hold have a loop of their own (joints/joint_flight.cpp).
bool in_contact_loop(const SubstepBody& s) { return s.constrained && !s.split; }

void drift_body(WorldState& world, std::uint32_t i, Real h) {
  if (in_contact_loop(world.substep[i])) {
    drift(world, i, h);
    world.bodies.velocity[i].load = Real(0);
    world.bodies.velocity[i].sliding_load = Real(0);
  } else if (!(world.bodies.mass[i].mass > Real(0))) {  // kinematic: as told
    BodyDelta& delta = world.delta[i];
    delta.dp += h * world.bodies.velocity[i].v;
    delta.dq = normalized(from_rotation_vector(h * world.bodies.velocity[i].w) * delta.dq);
  }
}

// How much of what the rows took from the velocities counts backwards [s]; ends the substep's
// notes.
Real trapezoid_weight(WorldState& world, std::uint32_t i, Real h) {
  SubstepBody& s = world.substep[i];
  const bool changed = world.contacts_changed[i] != 0;
  world.contacts_changed[i] = 0;
  s.bounced = false;
  if (changed || s.jointed) return Real(0);
  const BodyVelocity& velocity = world.bodies.velocity[i];
  const Real theta = velocity.load > Real(0) ? velocity.sliding_load / velocity.load : Real(1);
  return Real(0.5) * h * theta;
}

void finish_body(WorldState& world, std::uint32_t i, Real h) {
  SubstepBody& s = world.substep[i];
  if (!in_contact_loop(s)) return;
  collect_momentum(world, i);
  const Real weight = trapezoid_weight(world, i, h);
  BodyDelta& delta = world.delta[i];
  delta.dp += weight * (s.v_start - world.bodies.velocity[i].v);
  const Vec lost = s.L_start - world.bodies.momentum[i].L;
  if (keeps_momentum(rotation_of(world.settings)))
    delta.dq = turned_further(
        delta.dq,
        weight * angular_velocity_of(world.bodies.mass[i], orientation_now(world, i), lost));
}

void note_resistance(TurningRow<Real>& turning) {
  turning.resisted = std::max({turning.resisted, turning.k11 * std::abs(turning.impulse1),
                               turning.k22 * std::abs(turning.impulse2),
                               turning.k33 * std::abs(turning.impulse3)});
}

// Rolling and torsional friction of a row that has it, then friction, with a grain if it has one.
// Returns whether the contact turns nevertheless.
template <class Cone>
bool rub_within(const Cone& cone, WorldState& world, ContactRow<Real>& row, bool first_pass,
                RowVelocities<Real>& u, Real& load, Real& sliding) {
  if (row.turning == ContactRow<Real>::kNoTurning) {
    solve_friction(row, u, load, sliding, cone);
    return false;
  }
  TurningRow<Real>& turning = world.turning_rows[row.turning];
  if (first_pass) turning.impulse1 = turning.impulse2 = turning.impulse3 = Real(0);
  const bool turns = solve_turning(row, turning, u);
  note_resistance(turning);
  solve_friction(row, u, load, sliding, GrainCone<Real, Cone>{cone, row.along});
  return turns;
}
bool rub(WorldState& world, ContactRow<Real>& row, bool first_pass, RowVelocities<Real>& u,
         Real& load, Real& sliding) {
  const FrictionCone cone = world.settings.friction_cone;
  return cone == FrictionCone::Exact
             ? rub_within(RoundCone{}, world, row, first_pass, u, load, sliding)
             : rub_within(FacetCone{cone}, world, row, first_pass, u, load, sliding);
}

// What a pass over a row does to it and its bodies.
struct RowPass {
  Real load = 0, sliding = 0;  // [N s] normal impulse, and the part of it that slides
  bool turns = false;          // although it resists
};
RowPass pass_over_row(WorldState& world, ContactRow<Real>& row, Real inverse_h, bool soft,
                      bool first_pass) {
  RowPass pass;
  if (row.watched) note_pressing(row, load_of(row));
  const auto change = separation_change(row, delta_of_a(world, row), delta_of_b(world, row));
  RowVelocities<Real> u = read_velocities(world, row);
  RowCharge charged(world, row, world.diagnostics.ledger);
  solve_normal(row, change, inverse_h, soft, u);
  charged.as(&EnergyLedger::normal, u);
  pass.turns = rub(world, row, first_pass, u, pass.load, pass.sliding);
  charged.as(&EnergyLedger::friction, u);
  write_velocities(world, row, u);
  if (row.watched) note_pressing(row, load_of(row));
  return pass;
}

void relax_row(WorldState& world, ContactRow<Real>& row, Real inverse_h) {
  if (row.skip) return;
  const RowPass pass = pass_over_row(world, row, inverse_h, false, false);
  // The speeds of what turns ramp as those of what slides.
  note_load(world, row, pass.load, pass.turns ? pass.load : pass.sliding);
}

// Whether rolling or torsional friction showed in this step.
bool resisted(const WorldState& world, const ContactRow<Real>& row) {
  return row.turning != ContactRow<Real>::kNoTurning &&
         world.turning_rows[row.turning].resisted * world.dt > kVisible;
}

// What the accurate solver hears of the rows, if it listens (newton/choose.h).
class RowCalls {
 public:
  explicit RowCalls(WorldState& world)
      : calls_(world),
        of_row_(calls_.listens() ? world.rows.size() : 0, newton::Call::None, &world.memory) {}
  void note(const WorldState& world, std::uint32_t k) {
    if (!of_row_.empty()) of_row_[k] = calls_.of(world.rows[k]);
  }
  void tell(WorldState& world) const {
    if (calls_.listens()) newton::hear_calls(world, of_row_.data());
  }

 private:
  newton::CallsOfRows calls_;
  StepList<newton::Call> of_row_;
};

void store_impulses(WorldState& world, const StepGroup& group, RowCalls& calls) {
  parallel_for(group.jobs, static_cast<std::uint32_t>(group.rows.size()), tolerance::kRowGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t j = begin; j < end; ++j) {
                   const ContactRow<Real>& row = world.rows[group.rows[j]];
                   if (j + kRowsAhead < end)
                     prefetch(world.contacts[world.rows[group.rows[j + kRowsAhead]].contact]);
                   Contact& contact = world.contacts[row.contact];
                   contact.at_rest = row.at_rest;
                   contact.resisted = resisted(world, row);
                   for (int i = 0; i < row.count; ++i) {
                     const auto& point = row.points[i];
                     contact.normal_impulse[i] = point.impulse;
                     contact.friction_impulse[i] =
                         point.friction1 * row.t1 + point.friction2 * row.t2;
                     contact.step_normal_impulse[i] += point.impulse_sum;
                     contact.step_friction_impulse[i] +=
                         point.friction1_sum * row.t1 + point.friction2_sum * row.t2;
                   }
                   calls.note(world, group.rows[j]);
                 }
               });
}

bool some_body_was_spun(const StepGroups& groups) {
  return !groups.together.spun_rows.empty() ||
         std::any_of(groups.apart.begin(), groups.apart.end(),
                     [](const StepGroups::Apart& apart) { return apart.spun; });
}

// Of what was made ready for this step, the report counts what was of use.
void count_what_acted(WorldState& world) {
  StepReport& report = world.report;
  if (report.looked_ahead == 0 && world.turned_rows.empty() && world.bouncing_rows.empty() &&
      !some_body_was_spun(world.groups))
    return;
  report.looked_ahead = 0;
  for (const ContactRow<Real>& row : world.rows) {
    if (!row.watched) continue;
    const bool ahead =
        length_squared(row.advance) > Real(0) && !world.contacts[row.contact].seen_anyway;
    if (ahead && (row.bounced || shows(world, row, row.pressed))) ++report.looked_ahead;
    if (telling_showed(world, row)) ++report.fast_turning;
  }
}

bool flies(const SubstepBody& s, const BodyMass& mass) {
  return !s.constrained && !s.affected && mass.mass > Real(0);
}

// Bodies that no row holds fly the whole step at once, exactly: x = v t + a t^2/2 (or its damped
// form); half the torque, the torque-free flow, the other half.
void fly_body(WorldState& world, std::uint32_t i) {
  SubstepBody& s = world.substep[i];
  const BodyMass& mass = world.bodies.mass[i];
  if (!flies(s, mass)) return;
  BodyVelocity& velocity = world.bodies.velocity[i];
  const BodyForce& force = world.bodies.force[i];
  BodyDelta& delta = world.delta[i];
  const Real dt = world.dt;
  if (force.linear_damping > Real(0)) {
    const DampedMotion damped = damped_motion(force.linear_damping, dt);
    delta.dp = damped.gain * velocity.v + damped.lift * s.acceleration;
    velocity.v = damped.decay * velocity.v + damped.gain * s.acceleration;
  } else {
    delta.dp = dt * (velocity.v + (Real(0.5) * dt) * s.acceleration);
    velocity.v += dt * s.acceleration;
  }
  Vec& L = world.bodies.momentum[i].L;
  const DampedMotion half = damped_motion(force.angular_damping, Real(0.5) * dt);
  const auto half_kick = [&] {
    if (force.angular_damping > Real(0)) {
      L = half.decay * L + half.gain * force.torque;
    } else {
      L += (Real(0.5) * dt) * force.torque;
    }
  };
  half_kick();
  Rotation q = world.bodies.pose[i].q;
  turn(world.settings, mass, q, L, dt);
  half_kick();
  velocity.w = angular_velocity_of(mass, q, L);
  if (!is_finite(q)) return;
  delta.dq = q * conjugate(world.bodies.pose[i].q);  // for the continuous stage
  world.bodies.pose[i].q = q;
}

void fly_free_bodies(WorldState& world, BlockKernel kernel) {
  PlainBodies::fly(world, kernel, [&](std::uint32_t i) { fly_body(world, i); });
}

// The stages that a group has besides the plain passes over its bodies and rows.
struct ExtraStages {
  bool effects = false, joints = false, newton = false, worst_first = false, ledger = false;
  bool running_surfaces = false, bounces = false, fast_turns = false, adhesion = false;
  bool deep = false;  // some bodies overlap deeply
};
ExtraStages extra_stages_of(const WorldState& world) {
  return {.effects = world.has_effects,
          .joints = !world.joints.empty(),
          .newton = world.newton != nullptr && world.newton->count > 0,
          .worst_first = resolves_worst_first(world),
          .ledger = world.diagnostics.ledger,
          .running_surfaces = !world.spinning_rows.empty(),
          .bounces = !world.bouncing_rows.empty(),
          .fast_turns = !world.turned_rows.empty(),
          .adhesion = !world.adhesive_rows.empty(),
          .deep = world.deep_overlap};
}

// All substeps of one group.
void run_group(WorldState& world, StepGroup& group, const ExtraStages& has) {
  const int extra_passes = has.deep ? tolerance::kDeepRelaxPasses - 1 : 0;
  const int iterations = world.settings.velocity_iterations;
  const Real h = group.h;
  if (has.ledger) {
    world.ledger.group = group.number;
    world.ledger.h = static_cast<double>(h);
  }
  fill_blocks(world, group);
  const BlockKernel kernel = group.blocks.kernel;
  BlockPass pass = pass_over_blocks(world, group);
  PlainBodies bodies(world, kernel, group);
  DeepBodies deep(world, has.deep);
  StepErrors errors(world, group);
  for (int substep = 0; substep < group.substeps; ++substep) {
    if (has.effects) act_effects(world);
    if (has.effects && has.ledger) charge_effects(world);
    if (has.running_surfaces) carry_drives(world);
    if (has.bounces) run_impacts(world);
    if (has.ledger) charge_bounces(world);
    bodies.kick([&](std::uint32_t i) {
      if (in_contact_loop(world.substep[i])) kick(world, i, h);
    });
    if (has.fast_turns) renew_turned_rows(world);
    if (has.bounces) renew_bouncing_rows(world);
    if (renew_spun_rows(world, group)) pass = pass_over_blocks(world, group);
    if (has.ledger) charge_kick(world);
    if (has.adhesion) pull_together(world);
    if (has.joints) fly_joint_groups(world);
    if (has.ledger && group.number == kTogether) charge_joint_flight(world);
    if (has.joints) warm_start_joints(world);
    if (has.ledger) charge(world, &EnergyLedger::joints);
    for_rows_by_color(world, group, pass, kernel.warm, [&](ContactRow<Real>& row) {
      if (row.skip) return;
      RowVelocities<Real> u = read_velocities(world, row);
      const RowVelocities<Real> before = u;
      const double energy = has.ledger ? row_energy(world, row) : 0;
      warm_start(row, u);
      write_velocities(world, row, u);
      if (has.ledger) charge_warm_start(world, row, energy, before, u);
    });
    if (has.ledger) charge(world, &EnergyLedger::normal);
    for (int i = 0; i < iterations; ++i) {
      const bool first = i == 0;
      if (has.ledger && !first) charge(world, &EnergyLedger::normal);
      if (has.joints) solve_joints(world);
      if (has.ledger) charge(world, &EnergyLedger::joints);
      for_rows_by_color(world, group, pass, kernel.solve, [&](ContactRow<Real>& row) {
        if (!row.skip) pass_over_row(world, row, pass.inverse_h, true, first);
      });
    }
    if (has.newton) solve_newton_islands(world);
    if (has.ledger) charge(world, &EnergyLedger::normal);
    if (has.deep) deep.note_tumbling();
    bodies.drift([&](std::uint32_t i) { drift_body(world, i, h); });
    if (has.ledger) charge_drift(world);
    if (has.fast_turns) renew_turned_rows(world);
    if (has.bounces) renew_bouncing_rows(world);
    if (renew_spun_rows(world, group)) pass = pass_over_blocks(world, group);
    if (has.newton) settle_newton_islands(world);
    if (has.newton && has.ledger) charge(world, &EnergyLedger::normal);
    if (has.joints) relax_joints(world);
    if (has.ledger) charge(world, &EnergyLedger::joints);
    const auto relax = [&](bool ends_substep, bool only_deep) {
      pass.ends_substep = ends_substep;
      for_rows_by_color(
          world, group, pass, kernel.relax,
          [&](ContactRow<Real>& row) {
            relax_row(world, row, pass.inverse_h);
            if (ends_substep) close_row(world, row);
          },
          only_deep);
    };
    for (int i = 0; i < extra_passes; ++i) {
      relax(false, true);
      if (i == 0) deep.note_one_pass();
    }
    if (has.deep) deep.note_all_passes();
    for (int i = 1; i < iterations; ++i) relax(false, false);
    relax(true, false);
    if (has.worst_first) resolve_worst_first(world);
    if (has.ledger) charge(world, &EnergyLedger::normal);
    bodies.finish([&](std::uint32_t i) { return trapezoid_weight(world, i, h); },
                  [&](std::uint32_t i) { finish_body(world, i, h); });
    if (has.effects) settle_effects(world);
    if (has.ledger) charge_finish(world);
    errors.note_substep();
  }
  empty_blocks(world, group);
  group.body_count = errors.settle();
  if (!has.deep) return;
  world.report.deep_bodies = deep.bodies_that_gained();
  deep.list_tumblers();
}

// One group that goes apart, from its rows as they were built to their impulses as they are kept.
void run_apart(WorldState& world, std::uint32_t k, RowCalls& calls) {
  static thread_local StepGroup group;  // kept for its storage, which stays cached
  StepGroups& groups = world.groups;
  StepGroups::Apart& apart = groups.apart[k];
  group.number = k + 1;
  group.halvings = apart.halvings;
  group.substeps = world.settings.substeps >> apart.halvings;
  group.h = static_cast<Real>(1 << apart.halvings) * world.h;
  group.bodies = apart.bodies;
  group.rows.assign(groups.rows.begin() + apart.rows.begin, groups.rows.begin() + apart.rows.end);
  group.spun_rows.clear();
  if (apart.halvings > 0)
    for (const std::uint32_t row : group.rows) coarsen_row(world, world.rows[row], apart.halvings);
  run_group(world, group, {.ledger = world.diagnostics.ledger});
  if (apart.halvings > 0)
    for (const std::uint32_t row : group.rows) refine_row(world.rows[row], apart.halvings);
  store_impulses(world, group, calls);
  apart.spun = !group.spun_rows.empty();
  apart.body_count = group.body_count;
}

// The groups that go apart, each by one thread from its first substep to its last; one level of
// detail after the other, since those of different levels lie among one another.
void run_groups_apart(WorldState& world, RowCalls& calls) {
  std::vector<StepGroups::Apart>& groups = world.groups.apart;
  const bool levels = step_tolerance_of(world.settings) > Real(0);
  if (levels) {
    world.step_errors.resize(world.bodies.awake_end);
    forget_levels_together(world);
  }
  for (int level = levels ? most_halvings(world.settings.substeps) : 0; level >= 0; --level)
    parallel_for(world, static_cast<std::uint32_t>(groups.size()), 1,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t k = begin; k < end; ++k)
                     if (groups[k].halvings == level) run_apart(world, k, calls);
                 });
  for (const StepGroups::Apart& apart : groups)
    if (apart.halvings > 0) world.report.coarse_bodies += apart.body_count;
}

}  // namespace

void run_substeps(WorldState& world) {
  const ExtraStages has = extra_stages_of(world);
  JobSystem* const jobs = world.jobs;
  if (has.ledger) {
    world.jobs = nullptr;  // the book is written by one thread
    open_ledger(world);
  }
  if (has.effects) begin_effects(world);
  find_groups(world);
  if (has.joints || has.effects) choose_body_ways_anew(world);
  world.groups.all_fly = all_bodies_fly(world);
  fly_free_bodies(world, block_kernel_of(world));
  if (has.ledger) charge_flight(world);
  RowCalls calls(world);
  world.report.deep_bodies = 0;
  world.tumbled.clear();
  StepGroup& together = world.groups.together;
  run_group(world, together, has);
  run_groups_apart(world, calls);
  world.jobs = jobs;
  if (has.effects) end_effects(world);
  store_impulses(world, together, calls);
  calls.tell(world);
  count_what_acted(world);
  if (has.joints) store_joints(world);
  if (has.newton) report_newton_islands(world);
  world.last_h = world.h;
}

}  // namespace plumb::inline PLUMB_ABI::detail
