// Effects: making, changing, reading, and what ends them.
#include <algorithm>
#include <cmath>

#include "effects/effect_numbers.h"
#include "effects/effect_stage.h"
#include "effects/effect_world.h"
#include "world/inputs.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

Status stale_effect() {
  return {StatusCode::StaleHandle,
          "no such effect: the handle is null, or the effect or its body was destroyed"};
}

EffectStore& store_of(WorldState& world) {
  if (world.effects == nullptr) world.effects = std::make_shared<EffectStore>();
  return *world.effects;
}

// Whatever the effect may set in motion.
void wake_reached(WorldState& world, const EffectInfo& effect) {
  for (const std::uint32_t body : {effect.body, effect.other})
    if (body != kEveryBody) wake_body(world, body);
  if (effect.body != kEveryBody) return;
  for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot) {
    const BodyInfo& info = world.bodies.info[slot];
    if (info.alive && info.island != kNone && may_act(world, effect, slot, true))
      wake_body(world, slot);
  }
}

Status check_new(const WorldState& world, const Effect& effect) {
  if (const Status status = check_effect(world, effect); !status) return status;
  if (!effect.body.is_null() && world.bodies.info[effect.body.index].type != MotionType::Dynamic)
    return {StatusCode::WrongMotionType, "effects act on dynamic bodies only"};
  return {};
}

template <class Visit>
void for_bodies_of(const WorldState& world, const EffectInfo& effect, Visit&& visit) {
  if (effect.body != kEveryBody) {
    visit(effect.body);
    return;
  }
  for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot)
    if (world.bodies.info[slot].alive) visit(slot);
}

double total_potential(const WorldState& world, const EffectInfo& effect) {
  double sum = 0;
  for_bodies_of(world, effect,
                [&](std::uint32_t body) { sum += potential_of(world, effect, body); });
  return sum;
}

}  // namespace

void note_effects(WorldState& world) { world.has_effects = !world.effects->empty(); }

void remove_effects_of(WorldState& world, std::uint32_t body) {
  EffectStore& store = *world.effects;
  for (std::uint32_t slot = 0; slot < store.info.size(); ++slot) {
    const EffectInfo& effect = store.info[slot];
    if (!effect.alive || (effect.body != body && effect.other != body)) continue;
    if (body == kEveryBody) continue;
    const std::uint32_t other = effect.body == body ? effect.other : effect.body;
    if (other != kEveryBody) wake_body(world, other);
    store.destroy(slot);
  }
  store.forget_surface(body);
  note_effects(world);
}

void wake_tied(WorldState& world, std::uint32_t body) {
  const EffectStore& store = *world.effects;
  for (const std::uint32_t slot : store.pool[EffectKind(std::in_place_type<Spring>).index()]) {
    const EffectInfo& effect = store.info[slot];
    if (effect.body != body && effect.other != body) continue;
    const std::uint32_t other = effect.body == body ? effect.other : effect.body;
    if (other != kEveryBody && world.bodies.info[other].island != kNone) wake_body(world, other);
  }
}

void link_bodies(WorldState& world, std::uint32_t body_a, std::uint32_t body_b);  // islands.cpp

void link_tied(WorldState& world) {
  const EffectStore& store = *world.effects;
  const auto linkable = [&](std::uint32_t body) {
    return body != kEveryBody && world.bodies.info[body].type == MotionType::Dynamic &&
           world.bodies.is_awake(body);
  };
  for (const std::uint32_t slot : store.pool[EffectKind(std::in_place_type<Spring>).index()]) {
    const EffectInfo& effect = store.info[slot];
    if (linkable(effect.body) && linkable(effect.other))
      link_bodies(world, effect.body, effect.other);
  }
}

std::uint32_t effects_of_kind(const WorldState& world, std::size_t kind) {
  if (world.effects == nullptr) return 0;
  return static_cast<std::uint32_t>(world.effects->pool[kind].size());
}

std::uint32_t bodies_reached(const WorldState& world, std::size_t kind) {
  std::vector<bool> reached(world.bodies.info.size());
  for (const std::uint32_t slot : world.effects->pool[kind]) {
    const EffectInfo& effect = world.effects->info[slot];
    const auto note = [&](std::uint32_t body) {
      if (body == kEveryBody) return;
      const bool moves =
          world.bodies.info[body].type == MotionType::Dynamic && world.bodies.is_awake(body);
      if (moves && may_act(world, effect, body, false)) reached[body] = true;
    };
    for_bodies_of(world, effect, note);
    note(effect.other);
  }
  return static_cast<std::uint32_t>(std::count(reached.begin(), reached.end(), true));
}

double effect_potential(const WorldState& world) {
  double sum = 0;
  for (const EffectInfo& effect : world.effects->info)
    if (effect.alive) sum += total_potential(world, effect);
  return sum;
}

}  // namespace detail

Created<EffectId> PhysicsWorld::create_effect(const Effect& effect) {
  detail::WorldState& world = *state_;
  if (world.stepping) return {{}, detail::inside_step()};
  if (const Status status = detail::check_new(world, effect); !status) return {{}, status};
  detail::note_input(world, InputKind::CreateEffect, 0,
                     [&](auto& out) { detail::append(out, effect); });
  detail::EffectStore& store = detail::store_of(world);
  const std::uint32_t slot = store.create(effect);
  detail::note_effects(world);
  detail::wake_reached(world, store.info[slot]);
  return {store.id(slot), {}};
}

Status PhysicsWorld::set_effect(EffectId effect, const Effect& changed) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(effect)) return detail::stale_effect();
  if (const Status status = detail::check_new(world, changed); !status) return status;
  detail::note_input(world, InputKind::SetEffect, effect.value(),
                     [&](auto& out) { detail::append(out, changed); });
  detail::EffectStore& store = *world.effects;
  detail::wake_reached(world, store.info[effect.index]);
  store.replace(effect.index, changed);
  detail::wake_reached(world, store.info[effect.index]);
  return {};
}

Status PhysicsWorld::destroy_effect(EffectId effect) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(effect)) return detail::stale_effect();
  detail::note_input(world, InputKind::DestroyEffect, effect.value(), [](auto&) {});
  detail::wake_reached(world, world.effects->info[effect.index]);
  world.effects->destroy(effect.index);
  detail::note_effects(world);
  return {};
}

Status PhysicsWorld::set_force_field(std::uint32_t field, ForceFieldFunction function,
                                     void* context) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  detail::EffectStore& store = detail::store_of(world);
  std::erase_if(store.hooks, [field](const detail::FieldHook& h) { return h.field == field; });
  if (function != nullptr) store.hooks.push_back({field, function, context});
  return {};
}

bool PhysicsWorld::is_valid(EffectId effect) const {
  return state_->effects != nullptr && state_->effects->is_valid(effect);
}

Effect PhysicsWorld::effect(EffectId effect) const {
  return is_valid(effect) ? state_->effects->info[effect.index].component : Effect{};
}

std::size_t PhysicsWorld::effect_count() const {
  return state_->effects != nullptr ? state_->effects->alive_count : 0;
}

std::vector<EffectId> PhysicsWorld::effects_of(BodyId body) const {
  std::vector<EffectId> out;
  const bool of_all = body.is_null();
  if ((!of_all && !is_valid(body)) || state_->effects == nullptr) return out;
  const detail::EffectStore& store = *state_->effects;
  for (std::uint32_t slot = 0; slot < store.info.size(); ++slot) {
    const detail::EffectInfo& effect = store.info[slot];
    const bool is_of = of_all ? effect.body == detail::kEveryBody
                              : effect.body == body.index || effect.other == body.index;
    if (effect.alive && is_of) out.push_back(store.id(slot));
  }
  return out;
}

EffectReport PhysicsWorld::effect_report(EffectId effect) const {
  if (!is_valid(effect)) return {};
  const detail::EffectInfo& info = state_->effects->info[effect.index];
  const detail::EffectMemory& memory = info.memory;
  EffectReport report;
  report.potential = detail::total_potential(*state_, info);
  report.step_work = memory.step_work;
  report.work = memory.work;
  report.force = {memory.force.x, memory.force.y, memory.force.z};
  report.torque = {memory.torque.x, memory.torque.y, memory.torque.z};
  return report;
}

EffectLedger PhysicsWorld::effect_ledger() const {
  EffectLedger ledger;
  if (state_->effects == nullptr) return ledger;
  const detail::EffectStore& store = *state_->effects;
  for (std::size_t kind = 0; kind < kEffectKindCount; ++kind) {
    if (store.pool[kind].empty()) continue;
    EffectLedger::Row row;
    row.kind = kind;
    for (const std::uint32_t slot : store.pool[kind]) {
      const detail::EffectInfo& info = store.info[slot];
      ++row.count;
      row.potential += detail::total_potential(*state_, info);
      row.step_work += info.memory.step_work;
      row.work += info.memory.work;
    }
    if (store.scratch != nullptr) row.acted = store.scratch->showed[kind];
    ledger.rows.push_back(row);
  }
  return ledger;
}

}  // namespace plumb::inline PLUMB_ABI
