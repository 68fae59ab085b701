#include "audit/audit.h"

#include <algorithm>
#include <limits>

#include "audit/must.h"
#include "audit/samples.h"
#include "audit/twins.h"
#include "plumb/snapshot.h"

namespace plumb::inline PLUMB_ABI::audit {
namespace {

// What the two ways of computing may differ by without meaning anything [-]: some roundings of a
// place that is tens of sizes from the origin.
constexpr double kRounding = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());

bool was_chosen(PlanItem item, const PhysicsWorld& world, std::uint64_t planned) {
  const StepReport& report = world.last_report();
  switch (item) {
    case PlanItem::LookAhead:
      return report.looked_ahead > 0;
    case PlanItem::Continuous:
      return report.continuous > 0;
    case PlanItem::FastTurns:
      return report.fast_turning > 0;
    case PlanItem::DeepOverlap:
      return report.deep_bodies > 0;
    case PlanItem::KeptManifolds:
      return report.kept_pairs > 0;
    case PlanItem::DirectJoints:
      return report.direct_joints > 0;
    case PlanItem::JointSubsteps:
      return report.joint_substeps > 0;
    case PlanItem::AccurateContacts:
      return report.newton_islands > 0;
    default:
      break;
  }
  if (item < PlanItem::PointGravity) return (planned & bit_of(item)) != 0;
  const auto kind =
      static_cast<std::size_t>(item) - static_cast<std::size_t>(PlanItem::PointGravity);
  for (const EffectLedger::Row& row : world.effect_ledger().rows)
    if (row.kind == kind) return row.acted > 0;
  return false;
}

// The snapshot with one more item forced.
Snapshot forcing(const Snapshot& snapshot, PlanItem item, Choice choice) {
  Snapshot out = snapshot;
  for (SnapshotColumn& column : out.columns)
    if (column.name == "world.forced")
      column.integers[choice == Choice::Off ? 0 : 1] |= bit_of(item);
  return out;
}

class Auditor {
 public:
  Auditor(double dt, Counts& counts) : dt_(dt), counts_(counts) {}

  void look(const PhysicsWorld& world) {
    const Snapshot snapshot = world.save();
    must(usual_.restore(snapshot));
    before_ = sample_of(usual_, dt_);
    std::uint64_t planned = usual_.planned_items();
    usual_.step(dt_);
    planned |= usual_.planned_items();
    const Sample as_planned = sample_of(usual_, dt_);
    Twins twins(snapshot, before_, as_planned, dt_);
    for (std::size_t k = 0; k < kPlanItemCount; ++k) {
      const PlanItem item = static_cast<PlanItem>(k);
      if (is_audited(item) && concerns(item)) compare(item, snapshot, as_planned, planned, twins);
    }
  }

 private:
  // Leaves out what the scene has no place for.
  [[nodiscard]] bool concerns(PlanItem item) const {
    if (item >= PlanItem::PointGravity) return usual_.effect_count() > 0;
    if (item == PlanItem::DirectJoints || item == PlanItem::JointSubsteps)
      return usual_.joint_count() > 0;
    if (item == PlanItem::AccurateContacts)
      return usual_.settings().contact_solver == ContactSolver::Auto;
    return true;
  }

  Sample sample_with(PlanItem item, Choice choice, const Snapshot& snapshot) {
    must(other_.restore(item == PlanItem::Sleeping ? snapshot : forcing(snapshot, item, choice)));
    if (item == PlanItem::Sleeping) {  // who sleeps is woken
      WorldSettings settings = other_.settings();
      settings.forced.set(item, choice);
      must(other_.set_settings(settings));
    }
    other_.step(dt_);
    return sample_of(other_, dt_);
  }

  // Whether roundings do as much, to the step as planned or to the one without the item.
  bool is_chance(PlanItem item, const Snapshot& snapshot, const Sample& as_planned,
                 const Sample& without, Twins& twins) const {
    if (twins.explain(item, without)) return true;
    if (item == PlanItem::Sleeping) return false;
    const Snapshot forced = forcing(snapshot, item, Choice::Off);
    return Twins(forced, before_, without, dt_).explain(item, as_planned);
  }

  void compare(PlanItem item, const Snapshot& snapshot, const Sample& as_planned,
               std::uint64_t planned, Twins& twins) {
    Count& count = counts_[static_cast<std::size_t>(item)];
    ++count.steps;
    const bool chosen = was_chosen(item, usual_, planned);
    const Sample without = sample_with(item, Choice::Off, snapshot);
    const double off = largest_change(item, as_planned, without, dt_);
    const bool matters = off > tolerance_of(item);
    if (chosen) ++count.chosen;
    if (chosen && !is_saving(item)) {
      if (!matters) ++count.needless;
      return;
    }
    if (matters)
      ++(is_chance(item, snapshot, as_planned, without, twins) ? count.by_chance : count.missed);
    count.off_change = std::max(count.off_change, off);
    if (!is_saving(item) && may_force(item, Choice::On))
      count.on_change =
          std::max(count.on_change,
                   largest_change(item, as_planned, sample_with(item, Choice::On, snapshot), dt_));
  }

  double dt_;
  Counts& counts_;
  PhysicsWorld usual_, other_;
  Sample before_;
};

}  // namespace

bool is_audited(PlanItem item) {
  switch (item) {
    case PlanItem::Gyroscopic:
    case PlanItem::LookAhead:
    case PlanItem::Continuous:
    case PlanItem::Sleeping:
    case PlanItem::RollingFriction:
    case PlanItem::AccurateContacts:
    case PlanItem::FastTurns:
    case PlanItem::DeepOverlap:
    case PlanItem::KeptManifolds:
    case PlanItem::DirectJoints:
    case PlanItem::JointSubsteps:
      return true;
    case PlanItem::Explosion:  // the effects that look how far they reach
    case PlanItem::Attractor:
    case PlanItem::Buoyancy:
      return true;
    default:
      return false;
  }
}

bool is_saving(PlanItem item) {
  return item == PlanItem::KeptManifolds || item == PlanItem::Sleeping;
}

double tolerance_of(PlanItem item) {
  switch (item) {
    case PlanItem::Gyroscopic:
      return 1e-6;  // as the plan's own test
    case PlanItem::KeptManifolds:
      // The creep up to which manifolds are kept is 8e-5 of a thickness, which is 2.6 radii of
      // gyration at most (a ball's).
      return 2.1e-4;
    case PlanItem::Sleeping:
      return 1;  // the speed below which a body counts as resting
    default:
      return kRounding;
  }
}

void audit(PhysicsWorld& world, double dt, const Sampling& sampling, Counts& counts) {
  Auditor auditor(dt, counts);
  for (int step = 0; step < sampling.steps; ++step) {
    if (step % sampling.every == 0) auditor.look(world);
    world.step(dt);
    if (sampling.progress) sampling.progress();
  }
}

}  // namespace plumb::inline PLUMB_ABI::audit
