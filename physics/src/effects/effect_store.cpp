#include "effects/effect_store.h"

#include <algorithm>

#include "world/slots.h"

namespace plumb::inline PLUMB_ABI {

const char* name_of_effect(std::size_t kind) {
  static constexpr const char* kNames[kEffectKindCount] = {
      "point gravity", "force field", "thrust",       "explosion", "drag",  "magnus",
      "attractor",     "wind",        "aero surface", "buoyancy",  "spring"};
  return kind < kEffectKindCount ? kNames[kind] : "";
}

namespace detail {

void EffectStore::link(std::uint32_t slot) {
  EffectInfo& made = info[slot];
  made.body = made.component.body.is_null() ? kEveryBody : made.component.body.index;
  made.other = kEveryBody;
  if (const auto* spring = std::get_if<Spring>(&made.component.kind))
    if (!spring->other.is_null()) made.other = spring->other.index;
  std::vector<std::uint32_t>& list = pool[made.component.kind.index()];
  list.insert(std::lower_bound(list.begin(), list.end(), slot), slot);
}

void EffectStore::unlink(std::uint32_t slot) {
  if (slot < hulls.size()) hulls[slot].reset();
  std::erase(pool[info[slot].component.kind.index()], slot);
}

std::uint32_t EffectStore::create(const Effect& component) {
  const std::uint32_t slot = take_slot(info, free_slots);
  info[slot].component = component;
  ++alive_count;
  link(slot);
  return slot;
}

void EffectStore::replace(std::uint32_t slot, const Effect& component) {
  unlink(slot);
  EffectInfo& changed = info[slot];
  if (changed.component.kind.index() != component.kind.index()) changed.memory = {};
  changed.component = component;
  link(slot);
}

void EffectStore::destroy(std::uint32_t slot) {
  unlink(slot);
  free_slot(info, free_slots, slot);
  --alive_count;
}

const FieldHook* EffectStore::hook(std::uint32_t field) const {
  for (const FieldHook& hook : hooks)
    if (hook.field == field) return &hook;
  return nullptr;
}

}  // namespace detail
}  // namespace plumb::inline PLUMB_ABI
