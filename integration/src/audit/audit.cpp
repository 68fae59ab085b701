#include "audit/audit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/must.h"
#include "plumb/snapshot.h"

namespace plumb::inline PLUMB_ABI::audit {
namespace {

// What the two ways of computing may differ by without meaning anything [-]: some roundings of a
// place that is tens of sizes from the origin.
constexpr double kRounding = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());

struct BodySample {
  BodyState state;
  Eigen::Vector3d L, center;  // [kg m^2/s], [m]
  double size = 1;            // [m] radius of gyration of the whole body
  double weight_turn = 0;     // [kg m^2/s] what its weight may do in a step
  double rest_speed = 0;      // [m/s]
  bool held = false;
};
using Sample = std::vector<BodySample>;

Sample sample_of(const PhysicsWorld& world, double dt) {
  std::vector<BodyState> states;
  world.copy_body_states(states);
  std::vector<ContactState> contacts;
  world.copy_contacts(contacts);
  Sample out;
  for (const BodyState& state : states) {
    if (state.type != MotionType::Dynamic) continue;
    BodySample& body = out.emplace_back();
    body.state = state;
    body.L = world.angular_momentum(state.id).cast<double>();
    body.center = world.center_of_mass(state.id).cast<double>();
    const MassProperties mass = world.mass_properties(state.id);
    const double gyration = std::sqrt(mass.I_Bcm_B.trace() / (2 * mass.mass));
    if (gyration > 0) body.size = gyration;
    const double g = world.settings().gravity.cast<double>().norm();
    body.weight_turn = mass.mass * g * body.size * dt;
    body.held = std::any_of(contacts.begin(), contacts.end(), [&](const ContactState& contact) {
      return contact.body_a == state.id || contact.body_b == state.id;
    });
    body.held = body.held || !world.joints_of(state.id).empty();
    // Below this a body counts as resting (physics/src/world/tolerances.h).
    body.rest_speed = std::max(0.014 * std::sqrt(g * body.size), 1e-3 * body.size);
  }
  return out;
}

// In body sizes a step: of places and attitudes, and of what the velocities make of them.
double motion_between(const BodySample& a, const BodySample& b, double dt) {
  const Eigen::Quaterniond turn =
      a.state.pose.orientation.cast<double>().conjugate() * b.state.pose.orientation.cast<double>();
  const double turned = 2 * turn.vec().norm();
  const double moved = (b.center - a.center).norm() / a.size;
  const double v =
      (b.state.linear_velocity - a.state.linear_velocity).cast<double>().norm() * dt / a.size;
  const double w = (b.state.angular_velocity - a.state.angular_velocity).cast<double>().norm() * dt;
  return std::max({turned, moved, v, w});
}

// Of the angular momentum; what a contact or a joint holds has that of its weight for company.
double momentum_between(const BodySample& a, const BodySample& b) {
  const double whole = a.L.norm() + (a.held ? a.weight_turn : 0);
  return whole > 0 ? (b.L - a.L).norm() / whole : 0;
}

double change_between(PlanItem item, const Sample& a, const Sample& b, double dt) {
  double most = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    if (item == PlanItem::Sleeping && a[i].state.awake) continue;
    double change = item == PlanItem::Gyroscopic ? momentum_between(a[i], b[i])
                                                 : motion_between(a[i], b[i], dt);
    if (item == PlanItem::Sleeping) change *= a[i].size / (dt * a[i].rest_speed);
    most = std::max(most, change);
  }
  return most;
}

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
      return (planned & bit_of(item)) != 0;
  }
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
    std::uint64_t planned = usual_.planned_items();
    usual_.step(dt_);
    planned |= usual_.planned_items();
    const Sample as_planned = sample_of(usual_, dt_);
    for (std::size_t k = 0; k < kPlanItemCount; ++k) {
      const PlanItem item = static_cast<PlanItem>(k);
      if (is_audited(item) && concerns(item)) compare(item, snapshot, as_planned, planned);
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

  double change_with(PlanItem item, Choice choice, const Snapshot& snapshot,
                     const Sample& as_planned) {
    must(other_.restore(item == PlanItem::Sleeping ? snapshot : forcing(snapshot, item, choice)));
    if (item == PlanItem::Sleeping) {  // who sleeps is woken
      WorldSettings settings = other_.settings();
      settings.forced.set(item, choice);
      must(other_.set_settings(settings));
    }
    other_.step(dt_);
    return change_between(item, as_planned, sample_of(other_, dt_), dt_);
  }

  void compare(PlanItem item, const Snapshot& snapshot, const Sample& as_planned,
               std::uint64_t planned) {
    Count& count = counts_[static_cast<std::size_t>(item)];
    ++count.steps;
    const bool chosen = was_chosen(item, usual_, planned);
    const double off = change_with(item, Choice::Off, snapshot, as_planned);
    const bool matters = off > tolerance_of(item);
    if (chosen) ++count.chosen;
    if (is_saving(item)) {
      if (matters) ++count.missed;
      count.off_change = std::max(count.off_change, off);
      return;
    }
    if (chosen && !matters) ++count.needless;
    if (chosen) return;
    if (matters) ++count.missed;
    count.off_change = std::max(count.off_change, off);
    if (may_force(item, Choice::On))
      count.on_change =
          std::max(count.on_change, change_with(item, Choice::On, snapshot, as_planned));
  }

  double dt_;
  Counts& counts_;
  PhysicsWorld usual_, other_;
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
  }
}

}  // namespace plumb::inline PLUMB_ABI::audit
