#include "record/effect_list.h"

#include <algorithm>
#include <variant>

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

bool is_drawn(const EffectKind& kind) {
  return std::holds_alternative<Spring>(kind) || std::holds_alternative<Buoyancy>(kind);
}

// The same of an effect that is about to be made; its numbers begin with the body and the user
// data in two each, then comes the kind.
bool makes_drawn(const InputRecord& input) {
  constexpr std::size_t kKindAt = 4;
  if (input.numbers.size() <= kKindAt) return true;  // look for oneself
  const double kind = input.numbers[kKindAt];
  return kind == static_cast<double>(EffectKind(Spring{}).index()) ||
         kind == static_cast<double>(EffectKind(Buoyancy{}).index());
}

}  // namespace

void EffectList::collect(const PhysicsWorld& world) {
  drawn_.clear();
  if (world.effect_count() == 0) return;
  const auto add = [&](BodyId body) {
    for (const EffectId id : world.effects_of(body)) {
      const Effect effect = world.effect(id);
      // A spring is found at both its ends.
      if (effect.body == body && is_drawn(effect.kind)) drawn_.emplace_back(id, effect);
    }
  };
  add(BodyId{});
  std::vector<BodyState> bodies;
  world.copy_body_states(bodies);
  for (const BodyState& body : bodies) add(body.id);
  std::sort(drawn_.begin(), drawn_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
}

void EffectList::renew(const PhysicsWorld& world) {
  for (auto& [id, effect] : drawn_) effect = world.effect(id);
  std::erase_if(drawn_, [&](const auto& entry) {
    return !world.is_valid(entry.first) || !is_drawn(entry.second.kind);
  });
}

bool EffectList::follow(std::span<const InputRecord> inputs, const PhysicsWorld& world) {
  bool is_new = false, is_changed = false;
  for (const InputRecord& input : inputs) {
    const bool sets = input.kind == InputKind::SetEffect;
    if (input.kind == InputKind::CreateEffect) {
      is_new |= makes_drawn(input);
    } else if (sets || input.kind == InputKind::DestroyEffect) {
      const EffectId id = EffectId::from_value(input.target);
      const bool known = std::any_of(drawn_.begin(), drawn_.end(),
                                     [&](const auto& entry) { return entry.first == id; });
      is_changed |= known;
      is_new |= sets && !known && makes_drawn(input);
    } else if (input.kind == InputKind::DestroyBody) {
      is_changed |= !drawn_.empty();
    }
  }
  if (is_new) {
    collect(world);
  } else if (is_changed) {
    renew(world);
  }
  return is_new || is_changed;
}

void EffectList::copy_to(std::vector<Effect>& out) const {
  out.clear();
  for (const auto& [id, effect] : drawn_) out.push_back(effect);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
