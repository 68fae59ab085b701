// Effects within a step: from the pools to the forces by which the substeps move bodies.
//
//   begin    who acts on whom: awake dynamic bodies within reach
//   act      every pool in turn, then the implicit solve of what resists, springs last; what
//            comes out stands where users' forces and damping stand, so that contacts, joints and
//            impacts see it without knowing effects. Bodies that no row holds fly the substep.
//   settle   the work of each effect, from the path that the bodies took
//   end      users' forces and damping are put back
#include "effects/effect_stage.h"

#include <algorithm>
#include <cmath>

#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "solver/body_substep.h"
#include "world/body_sweep.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/visible.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A body that water and springs hold counts as resting when what is left of all forces is below
// this fraction of theirs [-].
constexpr double kBalanced = 1e-3;

NumVec widened(Vec v) { return cast<Num>(v); }
Vec narrowed(NumVec v) { return cast<Real>(v); }

// The affected body of a slot, made on first use; kNone where it does not move or sleeps.
std::uint32_t affect(WorldState& world, EffectScratch& scratch, std::uint32_t slot) {
  BodyStore& bodies = world.bodies;
  const std::uint32_t dense = bodies.info[slot].dense;
  if (!bodies.is_awake(slot) || !(bodies.mass[dense].mass > Real(0))) return kNone;
  if (scratch.stamp[dense] == scratch.now) return scratch.affected_of[dense];
  scratch.stamp[dense] = scratch.now;
  const std::uint32_t index = static_cast<std::uint32_t>(scratch.bodies.size());
  scratch.affected_of[dense] = index;
  AffectedBody& body = scratch.bodies.emplace_back();
  SubstepBody& s = world.substep[dense];
  s.affected = true;
  body.slot = slot;
  body.dense = dense;
  body.base_acceleration = s.acceleration;
  body.base_torque = bodies.force[dense].torque;
  body.base_damping = bodies.force[dense].linear_damping;
  body.mass = static_cast<double>(bodies.mass[dense].mass);
  body.inverse.linear = widened(bodies.mass[dense].inverse_mass);
  body.free = !s.constrained;
  return index;
}

void link_bodies_of(WorldState& world, EffectScratch& scratch, std::uint32_t slot) {
  const EffectInfo& effect = world.effects->info[slot];
  const auto add = [&](std::uint32_t body) {
    if (!may_act(world, effect, body, false)) return;
    EffectLink link;
    link.effect = slot;
    link.body = affect(world, scratch, body);
    if (link.body == kNone) return;
    scratch.links.push_back(link);
  };
  if (effect.body != kEveryBody) {
    add(effect.body);
    return;
  }
  StepList<std::uint32_t> awake(world.bodies.slot_of.begin() + world.bodies.awake_begin,
                                world.bodies.slot_of.begin() + world.bodies.awake_end,
                                &world.memory);
  std::sort(awake.begin(), awake.end());
  for (const std::uint32_t body : awake) {
    if (world.bodies.info[body].type != MotionType::Dynamic) continue;
    if (is_awaited(world, effect, body)) world.substep[world.bodies.info[body].dense].driven = true;
    add(body);
  }
}

void link_spring(WorldState& world, EffectScratch& scratch, std::uint32_t slot) {
  const EffectInfo& effect = world.effects->info[slot];
  EffectLink link;
  link.effect = slot;
  link.body = affect(world, scratch, effect.body);
  if (effect.other != kEveryBody) link.other = affect(world, scratch, effect.other);
  if (link.body == kNone && link.other == kNone) return;
  // What a moving kinematic body pulls at does not come to rest.
  const auto carried = [&](std::uint32_t body, std::uint32_t by) {
    if (body == kNone || by == kEveryBody) return;
    if (world.bodies.info[by].type == MotionType::Kinematic && world.bodies.is_awake(by))
      world.substep[scratch.bodies[body].dense].driven = true;
  };
  carried(link.body, effect.other);
  carried(link.other, effect.body);
  scratch.links.push_back(link);
}

// What each effect of the last step did begins anew.
void clear_books(EffectStore& store) {
  for (EffectInfo& effect : store.info) {
    effect.memory.step_work = 0;
    effect.memory.force = effect.memory.torque = {0, 0, 0};
  }
}

void see_body(const WorldState& world, const EffectScratch& scratch, AffectedBody& body) {
  const std::uint32_t i = body.dense;
  const BodyVelocity& velocity = world.bodies.velocity[i];
  const BodyDelta& delta = world.delta[i];
  const double half = 0.5 * scratch.h;
  body.v = widened(velocity.v);
  body.w = widened(velocity.w);
  body.x = cast<Num>(world.bodies.pose[i].x) + widened(delta.dp) + half * body.v;
  const NumRotation q0 = to_num(orientation_now(world, i));
  body.q = normalized(from_rotation_vector(half * body.w) * q0);
  const Symmetric3<Real> I_inverse = world_inverse_inertia(world.bodies.mass[i], to_real(body.q));
  body.inverse.angular = {static_cast<double>(I_inverse.xx), static_cast<double>(I_inverse.yy),
                          static_cast<double>(I_inverse.zz), static_cast<double>(I_inverse.xy),
                          static_cast<double>(I_inverse.xz), static_cast<double>(I_inverse.yz)};
  body.soft.force = body.mass * widened(body.base_acceleration);
  body.soft.torque = widened(body.base_torque);
  body.rate = static_cast<double>(body.base_damping);
  body.drawn = {0, 0, 0};
  body.stiff = kNone;
  body.springs = body.spring_torque = {0, 0, 0};
  body.held = 0;
  body.path_start = delta.dp;
}

void solve_resistance(EffectScratch& scratch) {
  const double h = scratch.h;
  for (StiffBody& stiff : scratch.stiff) {
    AffectedBody& body = scratch.bodies[stiff.affected];
    stiff.theta = fitted_theta(h * fastest_rate(stiff.D, body.inverse));
    // f0 was seen at the middle of the substep; damping counts from theta of it.
    const Wrench soft = body.inverse.times(body.soft);
    const Wrench later = stiff.D.times(soft);
    const double shift = (stiff.theta - 0.5) * h;
    Matrix6 B;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        B.m[i][j] = stiff.theta * h * stiff.D.m[i][j] + 0.25 * h * h * stiff.K.m[i][j];
    const Wrench right = {stiff.f0.force - shift * later.force,
                          stiff.f0.torque - shift * later.torque};
    const Wrench f = solve_stiff(B, body.inverse, right);
    stiff.acceleration = body.inverse.times(f);
    body.soft = body.soft + f;
  }
  // Each effect's part in it.
  for (EffectLink& link : scratch.links) {
    if (link.stiff == kNone) continue;
    const AffectedBody& body = scratch.bodies[link.body];
    const StiffBody& stiff = scratch.stiff[body.stiff];
    const StiffShare& share = scratch.shares[link.stiff];
    const Wrench soft = body.inverse.times(body.soft);  // f is in it by now
    const Wrench known = soft - stiff.acceleration;
    const double shift = (stiff.theta - 0.5) * h;
    const Wrench damped = {stiff.theta * h * stiff.acceleration.force + shift * known.force,
                           stiff.theta * h * stiff.acceleration.torque + shift * known.torque};
    const Wrench moved = {0.25 * h * h * stiff.acceleration.force,
                          0.25 * h * h * stiff.acceleration.torque};
    link.wrench = share.f0 - share.D.times(damped) - share.K.times(moved);
  }
}

// Where the substeps look for users' forces. The weight of a locked axis stays out.
void hand_over(WorldState& world, AffectedBody& body) {
  const BodyMass& mass = world.bodies.mass[body.dense];
  const Wrench all = body.soft + Wrench{body.springs, body.spring_torque};
  const NumVec beyond = all.force - body.mass * widened(body.base_acceleration);
  SubstepBody& s = world.substep[body.dense];
  s.acceleration = body.base_acceleration + narrowed(multiply_each(body.inverse.linear, beyond));
  if (body.rate > static_cast<double>(body.base_damping)) {
    const auto free_axis = [](Real inverse, Num a) { return inverse > Real(0) ? a : Num(0); };
    s.acceleration += narrowed({free_axis(mass.inverse_mass.x, body.drawn.x),
                                free_axis(mass.inverse_mass.y, body.drawn.y),
                                free_axis(mass.inverse_mass.z, body.drawn.z)});
  }
  world.bodies.force[body.dense].torque = narrowed(all.torque);
  world.bodies.force[body.dense].linear_damping = static_cast<Real>(body.rate);
  const NumVec left = all.force - body.mass * body.rate * body.v + body.mass * body.drawn;
  const NumVec turning = body.inverse.angular * all.torque;
  const double radius = static_cast<double>(world.bodies.extent[body.slot].radius);
  s.balanced = body.held > 0 && length(left) < kBalanced * body.held &&
               body.mass * length(turning) * radius < kBalanced * body.held;
}

// Exactly, as bodies without effects fly the whole step (substeps.cpp, fly()).
void fly_substep(WorldState& world, std::uint32_t i) {
  const Real h = world.h;
  const SubstepBody& s = world.substep[i];
  const BodyMass& mass = world.bodies.mass[i];
  BodyVelocity& velocity = world.bodies.velocity[i];
  const BodyForce& force = world.bodies.force[i];
  BodyDelta& delta = world.delta[i];
  if (force.linear_damping > Real(0)) {
    const DampedMotion damped = damped_motion(force.linear_damping, h);
    delta.dp += damped.gain * velocity.v + damped.lift * s.acceleration;
    velocity.v = damped.decay * velocity.v + damped.gain * s.acceleration;
  } else {
    delta.dp += h * (velocity.v + (Real(0.5) * h) * s.acceleration);
    velocity.v += h * s.acceleration;
  }
  Vec& L = world.bodies.momentum[i].L;
  const bool damps = force.angular_damping > Real(0);
  const DampedMotion half = damps ? damped_motion(force.angular_damping, Real(0.5) * h)
                                  : DampedMotion{1, Real(0.5) * h, 0};
  L = half.decay * L + half.gain * force.torque;
  Rotation q = orientation_now(world, i);
  turn(world.settings, mass, q, L, h);
  L = half.decay * L + half.gain * force.torque;
  delta.dq = normalized(q * conjugate(world.bodies.pose[i].q));
  velocity.w = angular_velocity_of(mass, q, L);
}

template <class Task>
void for_bodies(WorldState& world, Task&& task) {
  std::vector<AffectedBody>& bodies = world.effects->scratch->bodies;
  parallel_for(world, static_cast<std::uint32_t>(bodies.size()), tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) task(bodies[i]);
               });
}

// Force times path over one body's substep. Drag's mean velocity is that of the path.
double work_on(const WorldState& world, const EffectScratch& scratch, const AffectedBody& body,
               const Wrench& wrench) {
  const NumVec path = widened(world.delta[body.dense].dp - body.path_start);
  const NumVec turn = (0.5 * scratch.h) * (body.w + widened(world.bodies.velocity[body.dense].w));
  return dot(wrench.force, path) + dot(wrench.torque, turn);
}

// Whether a link has changed its body's motion by more than rounding does.
bool shows(const WorldState& world, const EffectScratch& scratch, const EffectLink& link) {
  if (link.body == kNone) return link.other != kNone;
  const AffectedBody& body = scratch.bodies[link.body];
  const NumVec dv = multiply_each(body.inverse.linear, link.given.force);
  const NumVec dw = body.inverse.angular * link.given.torque;
  return parts_visibly(world.bodies.mass[body.dense], narrowed(dv), narrowed(dw), world.dt);
}

}  // namespace

StiffView stiff_view(const EffectScratch& scratch, const AffectedBody& body) {
  const Wrench a = body.inverse.times(body.soft);
  const NumVec dragged = a.force + body.drawn - body.rate * body.v;
  const double h = scratch.h;
  return {body.x + (0.25 * h * h) * dragged, body.v + (0.5 * h) * dragged,
          body.w + (0.5 * h) * a.torque};
}

StiffShare& stiff_share(EffectScratch& scratch, EffectLink& link) {
  link.stiff = static_cast<std::uint32_t>(scratch.shares.size());
  return scratch.shares.emplace_back();
}

void add_stiff(EffectScratch& scratch, EffectLink& link) {
  AffectedBody& body = scratch.bodies[link.body];
  if (body.stiff == kNone) {
    body.stiff = static_cast<std::uint32_t>(scratch.stiff.size());
    scratch.stiff.emplace_back().affected = link.body;
  }
  const StiffShare& share = scratch.shares[link.stiff];
  StiffBody& stiff = scratch.stiff[body.stiff];
  stiff.D += share.D;
  stiff.K += share.K;
  stiff.f0 = stiff.f0 + share.f0;
}

NumRotation body_axes(const WorldState& world, const AffectedBody& body) {
  return body.q * conjugate(to_num(world.bodies.info[body.slot].R_BP));
}
NumVec arm_of(const WorldState& world, const AffectedBody& body, const Vec3& p_B) {
  return rotate(body_axes(world, body),
                widened(to_inner(p_B) - world.bodies.info[body.slot].center_B));
}

void begin_effects(WorldState& world) {
  EffectStore& store = *world.effects;
  if (store.scratch == nullptr) store.scratch = std::make_shared<EffectScratch>();
  EffectScratch& scratch = *store.scratch;
  scratch.bodies.clear();
  scratch.links.clear();
  ++scratch.now;
  const std::size_t count = world.bodies.dense_count();
  if (scratch.stamp.size() < count) {
    scratch.stamp.resize(count, 0);
    scratch.affected_of.resize(count);
  }
  scratch.h = static_cast<double>(world.h);
  scratch.time = world.time + 0.5 * scratch.h;
  scratch.gravity = widened(to_inner(world.settings.gravity));
  clear_books(store);
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind) {
    scratch.first[kind] = static_cast<std::uint32_t>(scratch.links.size());
    if (world.settings.forced.off(item_of_effect(kind))) continue;
    for (const std::uint32_t slot : store.pool[kind]) {
      if (std::holds_alternative<Spring>(store.info[slot].component.kind)) {
        link_spring(world, scratch, slot);
      } else {
        link_bodies_of(world, scratch, slot);
      }
    }
  }
  scratch.first[kEffectKindCount] = static_cast<std::uint32_t>(scratch.links.size());
}

void act_effects(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  using Act = void (*)(WorldState&);
  static constexpr Act kActs[kEffectKindCount] = {
      act_point_gravity, act_force_fields, act_thrust,        act_explosions, act_drag, act_magnus,
      act_attractors,    act_wind,         act_aero_surfaces, act_buoyancy,   nullptr};
  scratch.stiff.clear();
  scratch.shares.clear();
  for (EffectLink& link : scratch.links) {
    const EffectLink fresh{link.effect, link.body, link.other, kNone,    link.given,
                           {},          {},        0,          {0, 0, 0}};
    link = fresh;
  }
  for_bodies(world, [&](AffectedBody& body) { see_body(world, scratch, body); });
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind)
    if (kActs[kind] != nullptr && scratch.first[kind] != scratch.first[kind + 1])
      kActs[kind](world);
  if (!scratch.stiff.empty()) solve_resistance(scratch);
  const std::size_t springs = EffectKind(std::in_place_type<Spring>).index();
  if (scratch.first[springs] != scratch.first[springs + 1]) act_springs(world);
  for_bodies(world, [&](AffectedBody& body) {
    hand_over(world, body);
    if (body.free) fly_substep(world, body.dense);
  });
}

void settle_effects(WorldState& world) {
  EffectStore& store = *world.effects;
  EffectScratch& scratch = *store.scratch;
  const double share = scratch.h / static_cast<double>(world.dt);
  for (EffectLink& link : scratch.links) {
    EffectMemory& memory = store.info[link.effect].memory;
    double work = 0;
    if (link.body != kNone) {
      const AffectedBody& body = scratch.bodies[link.body];
      Wrench mean = link.wrench;
      if (link.rate > 0) {
        const NumVec path = widened(world.delta[body.dense].dp - body.path_start);
        mean.force -= (body.mass * link.rate) * ((1 / scratch.h) * path - link.medium);
      }
      work += work_on(world, scratch, body, mean);
      link.given.force += scratch.h * mean.force;
      link.given.torque += scratch.h * mean.torque;
      memory.force += share * mean.force;
      memory.torque += share * mean.torque;
    }
    if (link.other != kNone)
      work += work_on(world, scratch, scratch.bodies[link.other], link.wrench_on_other);
    if (!std::isfinite(work)) work = 0;  // the body is on its way into quarantine
    memory.step_work += work;
    memory.work += work;
  }
  const std::size_t blasts = EffectKind(std::in_place_type<Explosion>).index();
  for (const std::uint32_t slot : store.pool[blasts]) store.info[slot].memory.age += scratch.h;
  scratch.time += scratch.h;
}

void end_effects(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind)
    scratch.showed[kind] = static_cast<std::uint32_t>(
        std::count_if(scratch.links.begin() + scratch.first[kind],
                      scratch.links.begin() + scratch.first[kind + 1],
                      [&](const EffectLink& link) { return shows(world, scratch, link); }));
  for (const AffectedBody& body : world.effects->scratch->bodies) {
    BodyForce& force = world.bodies.force[body.dense];
    force.torque = body.base_torque;
    force.linear_damping = body.base_damping;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
