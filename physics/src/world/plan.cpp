// The plan: what the coming step needs, from a few counts, and the same in words when somebody
// asks.
#include "plumb/plan.h"

#include <string>

#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "world/forced.h"
#include "world/plan_losses.h"
#include "world/plan_tally.h"

namespace plumb::inline PLUMB_ABI {

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::Plan:
      return "plan";
    case Stage::Broadphase:
      return "broadphase";
    case Stage::Narrowphase:
      return "narrowphase";
    case Stage::Islands:
      return "islands";
    case Stage::Coloring:
      return "coloring";
    case Stage::Rows:
      return "rows";
    case Stage::Impacts:
      return "impacts";
    case Stage::Substeps:
      return "substeps";
    case Stage::Continuous:
      return "continuous";
    case Stage::Finalize:
      return "finalize";
    case Stage::Sleep:
      return "sleep";
    case Stage::Count:
      break;
  }
  return "";
}

namespace detail {

void plan_step(WorldState& world, double dt) {
  world.dt = static_cast<Real>(dt);
  world.h = world.dt / static_cast<Real>(world.settings.substeps);
  world.falls_in_a_step = world.dt * world.dt * static_cast<Real>(world.settings.gravity.norm());
  world.flags.gravity = world.settings.gravity.squaredNorm() > 0;
  world.flags.sleeping = may_sleep(world.settings);
  world.flags.sensors = world.counts.sensors > 0;

  StepReport& report = world.report;
  report = {};
  report.step = ++world.step_count;
  report.dt = dt;
  report.bodies = world.bodies.alive_count;
}

namespace {

std::string of(std::uint32_t part, std::uint32_t whole, const char* what) {
  return std::to_string(part) + " of " + std::to_string(whole) + " " + what;
}
std::string pairs(std::uint32_t count, const char* what) {
  return std::to_string(count) + " pairs that touch " + what;
}

std::string why_accurate(const WorldState& world, const PlanTally& t) {
  if (world.settings.contact_solver == ContactSolver::SoftStep)
    return "the settings ask for soft steps";
  if (world.settings.contact_solver == ContactSolver::Newton) return "the settings ask for it";
  if (world.settings.contact_solver == ContactSolver::WorstFirst)
    return "the settings ask for the worst contact first";
  const std::string beyond =
      t.refused == 0
          ? ""
          : "; " + std::to_string(t.refused) +
                " bodies go on in soft steps for a while: too many, too costly, or held by joints";
  if (t.staying == 0)
    return "no contact carries much more than the lighter body, or overlaps deeply, for long" +
           beyond;
  return std::to_string(t.calls.mass) + " contacts have a heavy body on a light one, " +
         std::to_string(t.calls.load) + " press with many weights, " +
         std::to_string(t.calls.overlap) + " overlap under load; " + std::to_string(t.staying) +
         " bodies stay with it for a while" + beyond;
}

std::string why_sleeping(const WorldState& world, const PlanTally& t) {
  if (!world.settings.sleeping) return "switched off in the settings";
  return of(t.body.awake, t.body.dynamic + t.body.kinematic, "moving bodies are awake");
}

std::string why_effect(const PlanTally& t, PlanItem item) {
  const std::size_t kind =
      static_cast<std::size_t>(item) - static_cast<std::size_t>(PlanItem::PointGravity);
  if (t.effects[kind] == 0) return "there is none";
  return std::to_string(t.effects[kind]) + " in the world, within reach of " +
         of(t.reached[kind], t.body.dynamic, "dynamic bodies");
}

std::string why_step_levels(const WorldState& world, const BodyTally& body) {
  const WorldSettings& settings = world.settings;
  if (!(settings.step_tolerance > Real(0)))
    return "step_tolerance is 0: all islands take the world's " +
           std::to_string(settings.substeps) + " substeps";
  std::string bodies = of(body.coarse, body.awake, "awake bodies do with fewer substeps than ") +
                       std::to_string(settings.substeps);
  if (body.coarse > 0) bodies += ", down to " + std::to_string(settings.substeps >> body.halvings);
  return bodies + "; " + std::to_string(world.report.coarse_bodies) + " did in the last step";
}

// Who calls for an item, or why nothing does.
std::string why(const WorldState& world, const PlanTally& t, PlanItem item) {
  const BodyTally& body = t.body;
  switch (item) {
    case PlanItem::Gravity:
      if (world.settings.gravity.squaredNorm() == 0) return "the gravity of the settings is zero";
      return of(body.dynamic - body.weightless, body.dynamic, "dynamic bodies have weight");
    case PlanItem::Forces:
      return of(body.forced, body.dynamic, "dynamic bodies have a force or torque waiting");
    case PlanItem::Damping:
      return of(body.damped, body.dynamic, "dynamic bodies are damped");
    case PlanItem::Gyroscopic:
      return of(body.tumbling, body.dynamic, "dynamic bodies (") + std::to_string(body.isotropic) +
             " isotropic, " + std::to_string(body.steady) + " with w x I w dt below 1e-6 I w, " +
             std::to_string(body.unturnable) + " do not turn freely)";
    case PlanItem::MotionLocks:
      return of(body.locked, body.dynamic, "dynamic bodies have a locked axis");
    case PlanItem::Contacts:
      return std::to_string(t.pair.pairs) + " awake pairs have overlapping bounds, " +
             std::to_string(world.query_list.size()) + " colliders seek new ones";
    case PlanItem::Friction:
      return pairs(t.pair.frictional, "have friction");
    case PlanItem::Restitution:
      return world.counts.restitution == 0 ? "no collider has restitution"
                                           : pairs(t.pair.bouncing, "bounce");
    case PlanItem::LookAhead:
      return std::to_string(t.pair.swept) +
             " pairs approach by more than a quarter of their thickness in a step";
    case PlanItem::Continuous:
      return of(body.far, body.awake,
                "awake bodies move by more than a quarter of their thickness in a step");
    case PlanItem::Sensors:
      return std::to_string(world.counts.sensors) + " colliders are sensors";
    case PlanItem::Sleeping:
      return why_sleeping(world, t);
    case PlanItem::DoublePositions:
      return std::string("this build is ") + kPrecisionName;
    case PlanItem::Joints:
      return world.joints.empty()
                 ? "there is no joint"
                 : of(t.joint.joints, world.joints.alive_count, "joints hold a body that is awake");
    case PlanItem::RollingFriction:
      return pairs(t.pair.turning, "resist rolling or turning");
    case PlanItem::SurfaceVelocity:
      return pairs(t.pair.driven, "have a surface that runs");
    case PlanItem::OneWay:
      return std::to_string(world.counts.one_way) + " colliders are solid from one side only";
    case PlanItem::AnisotropicFriction:
      return pairs(t.pair.grained, "have a grain") +
             (t.pair.grained > 0 ? "; they are left to soft steps" : "");
    case PlanItem::Adhesion:
      return pairs(t.pair.adhesive, "hold on to what they touch");
    case PlanItem::AccurateContacts:
      return why_accurate(world, t);
    case PlanItem::FastTurns:
      return std::to_string(body.fast) +
             " bodies that touch something turn by more than 0.25 rad in a step";
    case PlanItem::DeepOverlap:
      return std::to_string(t.pair.deep) + " contact points are deeper than 2 % of a thickness";
    case PlanItem::KeptManifolds:
      return of(t.pair.touching, t.pair.pairs, "awake pairs touch; ") +
             std::to_string(world.report.kept_pairs) + " were taken over in the last step";
    case PlanItem::DirectJoints:
      return of(t.joint.grouped, world.joints.alive_count, "joints share a body with another one");
    case PlanItem::JointSubsteps:
      return "groups of joints asked for " + std::to_string(t.joint.wanted) +
             " substeps of their own in the last step, up to " + std::to_string(t.joint.most) +
             " in one of the world's";
    case PlanItem::StepLevels:
      return why_step_levels(world, body);
    default:
      return why_effect(t, item);
  }
}

PlanDecision decide(const WorldState& world, const PlanTally& tally, PlanItem item, bool called) {
  PlanDecision decision{item, called, why(world, tally, item)};
  decision.choice = world.settings.forced.of(item);
  if (decision.choice == Choice::Automatic) return decision;
  decision.active = decision.choice == Choice::On;
  decision.reason = (decision.active ? "forced on; " : "forced off; ") + decision.reason;
  if (!decision.active) decision.loss = called ? loss_of(world, tally, item) : "nothing at present";
  return decision;
}

}  // namespace
}  // namespace detail

StepPlan PhysicsWorld::plan() const {
  const detail::PlanTally tally = detail::tally_plan(*state_);
  const std::uint64_t called = detail::called_items(*state_, tally);
  StepPlan plan;
  for (std::size_t k = 0; k < kPlanItemCount; ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    plan.decisions.push_back(detail::decide(*state_, tally, item, (called & bit_of(item)) != 0));
  }
  return plan;
}

}  // namespace plumb::inline PLUMB_ABI
