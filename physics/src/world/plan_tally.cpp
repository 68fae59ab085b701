#include "world/plan_tally.h"

#include <algorithm>
#include <cmath>

#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "solver/joints/joint_groups.h"
#include "solver/joints/joint_scratch.h"
#include "solver/turned_rows.h"
#include "world/far_movers.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/visible.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// What overlaps by more than this part of a slop [-] is pushed out by enough to be rubbed.
constexpr Real kPushedOut = Real(0.1);

bool hardly_tumbles(const WorldState& world, const BodyInfo& info, bool held, Real dt,
                    Real gyroscopic_torque) {
  const BodyMass& m = world.bodies.mass[info.dense];
  const Real g = static_cast<Real>(world.settings.gravity.norm()) * std::abs(m.gravity_scale);
  const Real company = held ? m.mass * g * gyration_of(m) * dt : Real(0);
  return gyroscopic_torque * dt <=
         kSteadyTurn * (length(world.bodies.momentum[info.dense].L) + company);
}

// What holds a body.
constexpr std::uint8_t kTouches = 1, kJointed = 2;

void tally_turning(const WorldState& world, std::uint32_t slot, std::uint8_t held, Real dt,
                   BodyTally& t) {
  const BodyInfo& info = world.bodies.info[slot];
  const BodyMass& m = world.bodies.mass[info.dense];
  if (m.angular_locks != 0 || length_squared(m.moments) == Real(0)) {
    ++t.unturnable;
    return;
  }
  const Vec w = world.bodies.velocity[info.dense].w, L = world.bodies.momentum[info.dense].L;
  if ((held & kTouches) != 0) {
    const Real turn = dt * visible_turning(m, world.bodies.pose[info.dense].q, w);
    if (turn > tolerance::kFastTurn) ++t.fast;
    t.turn.note(slot, turn);
  }
  if (classify_inertia(m.moments) == RotationKind::Isotropic) {
    ++t.isotropic;
    return;
  }
  const Real torque = length(cross(w, L));
  const bool tumbled =
      std::find(world.tumbled.begin(), world.tumbled.end(), slot) != world.tumbled.end();
  if (!tumbled && hardly_tumbles(world, info, held != 0, dt, torque)) {
    ++t.steady;
    return;
  }
  ++t.tumbling;
  t.tilt.note(slot, length(L) > Real(0) ? torque / length(L) : Real(0));
}

void tally_bodies(const WorldState& world, const std::vector<std::uint8_t>& held, Real dt,
                  BodyTally& t) {
  const BodyStore& bodies = world.bodies;
  for (std::uint32_t slot = 0; slot < bodies.info.size(); ++slot) {
    const BodyInfo& info = bodies.info[slot];
    if (!info.alive || info.type == MotionType::Static) continue;
    const bool awake = bodies.is_awake(slot);
    if (awake) {
      ++t.awake;
      const Real path = path_ahead(world, slot, dt);
      if (path > tolerance::kContinuousFraction * bodies.extent[slot].size &&
          !info.colliders.empty())
        ++t.far;
      t.path.note(slot, path);
    }
    if (info.type == MotionType::Kinematic) ++t.kinematic;
    if (info.type != MotionType::Dynamic) continue;
    ++t.dynamic;
    if (awake && info.level.halvings > 0) {
      ++t.coarse;
      t.halvings = std::max(t.halvings, int{info.level.halvings});
    }
    const BodyMass& m = bodies.mass[info.dense];
    const BodyForce& f = bodies.force[info.dense];
    t.thickness.note(slot, bodies.extent[slot].size);
    if (length_squared(f.force) > Real(0) || length_squared(f.torque) > Real(0)) ++t.forced;
    if (f.linear_damping > Real(0) || f.angular_damping > Real(0)) ++t.damped;
    if (m.gravity_scale == Real(0)) ++t.weightless;
    if (m.angular_locks != 0 || info.locks.linear_x || info.locks.linear_y || info.locks.linear_z)
      ++t.locked;
    tally_turning(world, slot, held[slot], dt, t);
  }
}

void tally_contacts(const WorldState& world, const Pair& pair, Real dt, PairTally& t) {
  Real pressed = 0;     // [N s]
  bool pushes = false;  // what overlaps is pushed out, even where no impulse is left of it
  bool resists = false;
  for (const Contact& contact : contacts_of(pair, world.contacts)) {
    resists = resists || contact.resisted;
    for (int i = 0; i < contact.manifold.count; ++i) {
      pressed += contact.step_normal_impulse[i];
      const Real depth = -contact.manifold.points[i].separation;
      if (depth > tolerance::kDeepSlops * pair.slop) ++t.deep;
      pushes = pushes || depth > kPushedOut * pair.slop;
    }
  }
  if (pair.restitution > Real(0)) ++t.bouncing;
  if (pair.adhesion > Real(0)) ++t.adhesive;
  if (!(pressed > Real(0)) && !pushes && !resists) return;
  if (pair.friction > Real(0)) ++t.frictional;
  if (pair.rolling > Real(0) || pair.torsional > Real(0)) ++t.turning;
  if (pair.driven) ++t.driven;
  if (pair.grained) ++t.grained;
  const Real push = pressed / dt;
  t.push = std::max(t.push, static_cast<double>(push));
  t.friction = std::max(t.friction, pair.friction * push);
  t.resistance = std::max(t.resistance, std::max(pair.rolling, pair.torsional) * push);
}

void tally_pairs(const WorldState& world, std::vector<std::uint8_t>& held, Real dt, PairTally& t) {
  const bool forced = world.settings.forced != PlanChoices{};
  for (const Pair& stored : world.pairs) {
    if (stored.sensor) continue;
    const Pair& pair = forced ? without_forcing(world, stored) : stored;
    ++t.pairs;
    t.restitution = std::max(t.restitution, pair.restitution);
    t.adhesion = std::max(t.adhesion, pair.adhesion);
    const BodyInfo &a = world.bodies.info[pair.body_a], &b = world.bodies.info[pair.body_b];
    const BodyVelocity &u = world.bodies.velocity[a.dense], &w = world.bodies.velocity[b.dense];
    const Vec v = w.v - u.v;
    const Real radius_a = world.bodies.extent[pair.body_a].radius;
    const Real radius_b = world.bodies.extent[pair.body_b].radius;
    t.approach = std::max(t.approach, length(v) + radius_a * length(u.w) + radius_b * length(w.w));
    const Real thickness = pair.slop / tolerance::kSlopFraction;
    if (dt * length(v) > tolerance::kSweptFraction * thickness) ++t.swept;
    if (pair.contact_count == 0) continue;
    ++t.touching;
    for (const std::uint32_t body : {pair.body_a, pair.body_b}) held[body] |= kTouches;
    tally_contacts(world, pair, dt, t);
  }
}

void tally_joints(const WorldState& world, std::vector<std::uint8_t>& held_at_all, JointTally& t) {
  if (world.joints.empty()) return;
  std::vector<std::uint8_t> held(world.bodies.info.size(), 0);  // by how many joints, up to 2
  const auto for_awake = [&](std::uint32_t joint, auto&& task) {
    const JointBodies bodies = bodies_of(world, joint);
    for (int k = 0; k < bodies.count; ++k)
      if (is_dynamic_awake(world, bodies.slot[k])) task(bodies.slot[k]);
  };
  for (std::uint32_t joint = 0; joint < world.joints.info.size(); ++joint) {
    if (!world.joints.info[joint].alive) continue;
    bool any = false;
    for_awake(joint, [&](std::uint32_t body) {
      any = true;
      held_at_all[body] |= kJointed;
      if (held[body] < 2) ++held[body];
    });
    if (any) ++t.joints;
  }
  for (std::uint32_t joint = 0; joint < world.joints.info.size(); ++joint) {
    if (!world.joints.info[joint].alive) continue;
    bool shares = false;
    for_awake(joint, [&](std::uint32_t body) { shares = shares || held[body] > 1; });
    if (shares) ++t.grouped;
  }
  if (world.joints.scratch == nullptr) return;
  t.wanted = world.joints.scratch->own_substeps_wanted;
  t.most = world.joints.scratch->most_cycles_wanted;
}

}  // namespace

PlanTally tally_plan(const WorldState& world) {
  PlanTally t;
  t.dt = coming_step(world);
  std::vector<std::uint8_t> held(world.bodies.info.size(), 0);  // per slot
  tally_pairs(world, held, t.dt, t.pair);
  tally_joints(world, held, t.joint);
  tally_bodies(world, held, t.dt, t.body);
  if (solver_of(world.settings) == ContactSolver::Auto ||
      world.settings.contact_solver == ContactSolver::Auto) {
    t.calls = world.newton_calls;
    for (const BodyInfo& info : world.bodies.info) {
      if (info.alive && info.newton_steps > 0) ++t.staying;
      if (info.alive && info.newton_pause > 0) ++t.refused;
    }
  }
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind) {
    t.effects[kind] = effects_of_kind(world, kind);
    if (t.effects[kind] > 0) t.reached[kind] = bodies_reached(world, kind);
  }
  return t;
}

std::uint64_t called_items(const WorldState& world, const PlanTally& t) {
  const WorldSettings& settings = world.settings;
  const SceneCounts& counts = world.counts;
  std::uint64_t items = 0;
  const auto call = [&items](PlanItem item, bool called) {
    if (called) items |= bit_of(item);
  };
  // Which pairs there are is known from the first step on.
  const bool fresh = world.step_count == 0 && !world.query_list.empty();
  call(PlanItem::Gravity, settings.gravity.squaredNorm() > 0 && t.body.dynamic > t.body.weightless);
  call(PlanItem::Forces, t.body.forced > 0);
  call(PlanItem::Damping, t.body.damped > 0);
  call(PlanItem::Gyroscopic, settings.rotation != RotationMethod::Book && t.body.tumbling > 0);
  call(PlanItem::MotionLocks, t.body.locked > 0);
  call(PlanItem::Contacts, fresh || t.pair.pairs > 0);
  call(PlanItem::Friction, t.pair.frictional > 0 || fresh);
  call(PlanItem::Restitution, t.pair.bouncing > 0 || (fresh && counts.restitution > 0));
  call(PlanItem::LookAhead, t.pair.swept > 0);
  call(PlanItem::Continuous, t.body.far > 0);
  call(PlanItem::Sensors, counts.sensors > 0);
  call(PlanItem::Sleeping, settings.sleeping);
  call(PlanItem::DoublePositions, !std::is_same_v<PosReal, float>);
  call(PlanItem::Joints, t.joint.joints > 0);
  const bool by_table = world.contact_data.materials.resists_turning();
  call(PlanItem::RollingFriction,
       t.pair.turning > 0 || (fresh && (counts.turning > 0 || by_table)));
  call(PlanItem::SurfaceVelocity, t.pair.driven > 0 || (fresh && counts.driven > 0));
  call(PlanItem::OneWay, counts.one_way > 0);
  call(PlanItem::AnisotropicFriction, t.pair.grained > 0 || (fresh && counts.grained > 0));
  call(PlanItem::Adhesion, t.pair.adhesive > 0 || (fresh && counts.adhesive > 0));
  const bool accurate = settings.contact_solver == ContactSolver::Newton
                            ? !world.contacts.empty() || !world.joints.empty()
                            : settings.contact_solver == ContactSolver::Auto && t.staying > 0;
  call(PlanItem::AccurateContacts, accurate);
  call(PlanItem::FastTurns, t.body.fast > 0);
  call(PlanItem::DeepOverlap, t.pair.deep > 0);
  call(PlanItem::KeptManifolds, t.pair.touching > 0);
  call(PlanItem::DirectJoints, t.joint.grouped > 0);
  call(PlanItem::JointSubsteps, t.joint.wanted > 0);
  call(PlanItem::StepLevels, settings.step_tolerance > 0 && t.body.coarse > 0);
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind)
    call(item_of_effect(kind), t.reached[kind] > 0);
  return items;
}

std::uint64_t decided_items(const WorldSettings& settings, std::uint64_t called) {
  return (called | settings.forced.items_on()) & ~settings.forced.items_off();
}

}  // namespace plumb::inline PLUMB_ABI::detail

namespace plumb::inline PLUMB_ABI {

std::uint64_t PhysicsWorld::planned_items() const {
  const detail::PlanTally tally = detail::tally_plan(*state_);
  return detail::decided_items(state_->settings, detail::called_items(*state_, tally));
}

}  // namespace plumb::inline PLUMB_ABI
