// The plan: what the coming step needs, from a few counts, and the same in words when somebody
// asks.
#include "plumb/plan.h"

#include <algorithm>
#include <string>

#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "motion/rotation_flow.h"
#include "solver/newton/choose.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {

const char* name_of(PlanItem item) {
  switch (item) {
    case PlanItem::Gravity:
      return "gravity";
    case PlanItem::Forces:
      return "forces";
    case PlanItem::Damping:
      return "damping";
    case PlanItem::Gyroscopic:
      return "gyroscopic";
    case PlanItem::MotionLocks:
      return "motion locks";
    case PlanItem::Contacts:
      return "contacts";
    case PlanItem::Friction:
      return "friction";
    case PlanItem::Restitution:
      return "restitution";
    case PlanItem::Continuous:
      return "look-ahead";
    case PlanItem::Sensors:
      return "sensors";
    case PlanItem::Sleeping:
      return "sleeping";
    case PlanItem::DoublePositions:
      return "double positions";
    case PlanItem::Joints:
      return "joints";
    case PlanItem::RollingFriction:
      return "rolling friction";
    case PlanItem::SurfaceVelocity:
      return "surface velocity";
    case PlanItem::OneWay:
      return "one-way colliders";
    case PlanItem::AnisotropicFriction:
      return "anisotropic friction";
    case PlanItem::Adhesion:
      return "adhesion";
    case PlanItem::AccurateContacts:
      return "accurate contacts";
    default:
      break;
  }
  const std::size_t effect =
      static_cast<std::size_t>(item) - static_cast<std::size_t>(PlanItem::PointGravity);
  return name_of_effect(effect);  // empty for what is none
}

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
  world.flags.gravity = world.settings.gravity.squaredNorm() > 0;
  world.flags.sleeping = world.settings.sleeping;
  world.flags.sensors = world.counts.sensors > 0;

  StepReport& report = world.report;
  report = {};
  report.step = ++world.step_count;
  report.dt = dt;
  report.bodies = world.bodies.alive_count;
}

namespace {

struct Tally {
  std::uint32_t dynamic = 0, kinematic = 0, fixed = 0, awake = 0;
  std::uint32_t forced = 0, damped = 0, isotropic = 0, symmetric = 0, asymmetric = 0,
                unturnable = 0, steady = 0;
  std::uint32_t locked = 0, frictional = 0, bouncing = 0, sensors = 0, weightless = 0;
};

// Below this |w x L| h / |L| [-] the gyroscopic term turns L in the body by less than rounding does
// in single precision.
constexpr Real kSteadyTurn = Real(1e-6);

bool turns_steadily(const WorldState& world, std::uint32_t dense) {
  const Vec L = world.bodies.momentum[dense].L, w = world.bodies.velocity[dense].w;
  const Real h = world.h > Real(0) ? world.h : Real(1.0 / 240);
  return length(cross(w, L)) * h <= kSteadyTurn * length(L);
}

Tally tally(const WorldState& world) {
  Tally t;
  const BodyStore& bodies = world.bodies;
  for (std::uint32_t slot = 0; slot < bodies.info.size(); ++slot) {
    const BodyInfo& info = bodies.info[slot];
    if (!info.alive) continue;
    if (info.type == MotionType::Static) ++t.fixed;
    if (info.type == MotionType::Kinematic) ++t.kinematic;
    if (bodies.is_awake(slot)) ++t.awake;
    if (info.type != MotionType::Dynamic) continue;
    ++t.dynamic;
    const BodyMass& m = bodies.mass[info.dense];
    const BodyForce& f = bodies.force[info.dense];
    if (length_squared(f.force) > Real(0) || length_squared(f.torque) > Real(0)) ++t.forced;
    if (f.linear_damping > Real(0) || f.angular_damping > Real(0)) ++t.damped;
    if (m.gravity_scale == Real(0)) ++t.weightless;
    const bool locked =
        m.angular_locks != 0 || info.locks.linear_x || info.locks.linear_y || info.locks.linear_z;
    if (locked) ++t.locked;
    if (m.angular_locks != 0 || length_squared(m.moments) == Real(0)) {
      ++t.unturnable;
      continue;
    }
    if (classify_inertia(m.moments) != RotationKind::Isotropic && turns_steadily(world, info.dense))
      ++t.steady;
    switch (classify_inertia(m.moments)) {
      case RotationKind::Isotropic:
        ++t.isotropic;
        break;
      case RotationKind::Symmetric:
        ++t.symmetric;
        break;
      case RotationKind::Asymmetric:
        ++t.asymmetric;
        break;
    }
  }
  for (const ColliderInfo& collider : world.colliders.info) {
    if (!collider.alive) continue;
    if (collider.component.is_sensor) {
      ++t.sensors;
    } else {
      if (collider.component.material.friction > Real(0)) ++t.frictional;
      if (collider.component.material.restitution > Real(0)) ++t.bouncing;
    }
  }
  return t;
}

struct AccurateChoice {
  bool active = false;
  std::string reason;
};
AccurateChoice accurate_choice(const WorldState& world) {
  if (world.settings.contact_solver == ContactSolver::SoftStep)
    return {false, "the settings ask for soft steps"};
  if (world.settings.contact_solver == ContactSolver::WorstFirst)
    return {false, "the settings ask for the worst contact first"};
  if (world.settings.contact_solver == ContactSolver::Newton)
    return {!world.contacts.empty() || !world.joints.empty(), "the settings ask for it"};
  std::uint32_t staying = 0, refused = 0;
  for (const BodyInfo& info : world.bodies.info) {
    if (info.alive && info.newton_steps > 0) ++staying;
    if (info.alive && info.newton_pause > 0) ++refused;
  }
  const std::string beyond =
      refused == 0
          ? ""
          : "; " + std::to_string(refused) +
                " bodies go on in soft steps for a while: too many, too costly, or held by joints";
  const newton::Calls& calls = world.newton_calls;
  if (staying == 0)
    return {false,
            "no contact carries much more than the lighter body, or overlaps deeply, for long" +
                beyond};
  return {true, std::to_string(calls.mass) + " contacts have a heavy body on a light one, " +
                    std::to_string(calls.load) + " press with many weights, " +
                    std::to_string(calls.overlap) + " overlap under load; " +
                    std::to_string(staying) + " bodies stay with it for a while" + beyond};
}

std::string of(std::uint32_t part, std::uint32_t whole, const char* what) {
  return std::to_string(part) + " of " + std::to_string(whole) + " " + what;
}

}  // namespace
}  // namespace detail

StepPlan PhysicsWorld::plan() const {
  const detail::WorldState& world = *state_;
  const detail::Tally t = detail::tally(world);
  StepPlan plan;
  const auto decide = [&](PlanItem item, bool active, std::string reason) {
    plan.decisions.push_back({item, active, std::move(reason)});
  };
  const bool gravity = world.settings.gravity.squaredNorm() > 0;
  decide(PlanItem::Gravity, gravity && t.dynamic > t.weightless,
         gravity ? detail::of(t.dynamic - t.weightless, t.dynamic, "dynamic bodies have weight")
                 : "the gravity of the settings is zero");
  decide(PlanItem::Forces, t.forced > 0,
         detail::of(t.forced, t.dynamic, "dynamic bodies have a force or torque waiting"));
  decide(PlanItem::Damping, t.damped > 0,
         detail::of(t.damped, t.dynamic, "dynamic bodies are damped"));
  const std::uint32_t tumbling = t.symmetric + t.asymmetric - t.steady;
  decide(PlanItem::Gyroscopic, world.settings.rotation != RotationMethod::Book && tumbling > 0,
         detail::of(tumbling, t.dynamic, "dynamic bodies (") + std::to_string(t.isotropic) +
             " isotropic, " + std::to_string(t.steady) + " with w x I w h below 1e-6 I w, " +
             std::to_string(t.unturnable) + " do not turn freely)");
  decide(PlanItem::MotionLocks, t.locked > 0,
         detail::of(t.locked, t.dynamic, "dynamic bodies have a locked axis"));
  const std::uint32_t pairs = static_cast<std::uint32_t>(world.pairs.size());
  decide(PlanItem::Contacts, pairs > 0 || !world.query_list.empty(),
         std::to_string(pairs) + " awake pairs have overlapping bounds, " +
             std::to_string(world.query_list.size()) + " colliders seek new ones");
  decide(PlanItem::Friction, t.frictional > 0,
         std::to_string(t.frictional) + " colliders have friction");
  decide(PlanItem::Restitution, t.bouncing > 0,
         t.bouncing > 0 ? std::to_string(t.bouncing) + " colliders bounce"
                        : "no collider has restitution");
  decide(PlanItem::Continuous, t.awake > 0,
         "contacts look ahead of " + std::to_string(t.awake) +
             " awake bodies; those that move far in a step are followed along their path");
  decide(PlanItem::Sensors, t.sensors > 0, std::to_string(t.sensors) + " colliders are sensors");
  decide(PlanItem::Sleeping, world.settings.sleeping,
         world.settings.sleeping
             ? detail::of(t.awake, t.dynamic + t.kinematic, "moving bodies are awake")
             : "switched off in the settings");
  constexpr bool kDouble = !std::is_same_v<PosReal, float>;
  decide(PlanItem::DoublePositions, kDouble, std::string("this build is ") + kPrecisionName);
  const std::uint32_t joints = world.joints.alive_count;
  decide(
      PlanItem::Joints, joints > 0,
      joints > 0 ? std::to_string(joints) + " joints hold bodies together" : "there is no joint");
  const detail::SceneCounts& counts = world.counts;
  const bool by_table = world.contact_data.materials.resists_turning();
  decide(PlanItem::RollingFriction, counts.turning > 0 || by_table,
         std::to_string(counts.turning) + " colliders resist rolling or turning" +
             (by_table ? ", and some pairs of materials do" : ""));
  decide(PlanItem::SurfaceVelocity, counts.driven > 0,
         std::to_string(counts.driven) + " colliders have a surface that runs");
  decide(PlanItem::OneWay, counts.one_way > 0,
         std::to_string(counts.one_way) + " colliders are solid from one side only");
  decide(PlanItem::AnisotropicFriction, counts.grained > 0,
         std::to_string(counts.grained) + " colliders have a grain" +
             (counts.grained > 0 ? "; what touches them is left to soft steps" : ""));
  decide(PlanItem::Adhesion, counts.adhesive > 0,
         std::to_string(counts.adhesive) + " colliders hold on to what they touch");
  const detail::AccurateChoice accurate = detail::accurate_choice(world);
  decide(PlanItem::AccurateContacts, accurate.active, accurate.reason);
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind) {
    const std::uint32_t effects = detail::effects_of_kind(world, kind);
    const std::uint32_t reached = effects > 0 ? detail::bodies_reached(world, kind) : 0;
    decide(static_cast<PlanItem>(static_cast<std::size_t>(PlanItem::PointGravity) + kind),
           reached > 0,
           effects == 0 ? "there is none"
                        : std::to_string(effects) + " in the world, within reach of " +
                              detail::of(reached, t.dynamic, "dynamic bodies"));
  }
  return plan;
}

}  // namespace plumb::inline PLUMB_ABI
