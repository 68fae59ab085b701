// Effects in snapshots and in the digest of a world's state.
#include "effects/effect_numbers.h"
#include "effects/effect_world.h"
#include "world/digest.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

template <class Table>
void visit_row(Table& t, EffectInfo& e, std::uint32_t& size) {
  EffectMemory& m = e.memory;
  t("generation", e.generation);
  t("alive", e.alive);
  t("numbers", size);
  t("memory", m.age, m.pull);
  t("work", m.step_work, m.work);
  t.unbounded("force", m.force.x, m.force.y, m.force.z);
  t.unbounded("torque", m.torque.x, m.torque.y, m.torque.z);
}

}  // namespace

void save_effects(ColumnWriter& out, const WorldState& world) {
  if (world.effects == nullptr || world.effects->info.empty()) return;
  std::vector<double> numbers;
  {
    TableWriter table(out, "effect", world.effects->info.size());
    for (EffectInfo info : world.effects->info) {
      const std::size_t before = numbers.size();
      if (info.alive) append(numbers, info.component);
      std::uint32_t size = static_cast<std::uint32_t>(numbers.size() - before);
      table.next_row();
      visit_row(table, info, size);
    }
  }
  out.add("effect_numbers", "value", 1, true).reals = std::move(numbers);
  out.add("effect_free", "slot", 1, false)
      .integers.assign(world.effects->free_slots.begin(), world.effects->free_slots.end());
}

bool restore_effects(const Snapshot& in, WorldState& world) {
  TableReader table(in, "effect");
  if (table.rows() == 0) return in.find("effect.generation") == nullptr;
  const SnapshotColumn* numbers = in.find("effect_numbers.value");
  const SnapshotColumn* unused = in.find("effect_free.slot");
  if (numbers == nullptr || unused == nullptr || numbers->type != SnapshotColumn::Type::Float64 ||
      unused->type != SnapshotColumn::Type::Uint64)
    return false;
  if (world.effects == nullptr) world.effects = std::make_shared<EffectStore>();
  EffectStore& store = *world.effects;
  std::size_t at = 0;
  for (std::uint32_t slot = 0; slot < table.rows(); ++slot) {
    EffectInfo info;
    std::uint32_t size = 0;
    table.next_row();
    visit_row(table, info, size);
    if (!table.ok() || size > numbers->reals.size() - at) return false;
    if (info.alive) {
      NumberReader reader(std::span(numbers->reals).subspan(at, size));
      bool ok = true;
      info.component = read_effect(reader, ok);
      if (!ok || !reader.complete()) return false;
      // The user's function may be registered later; until then the field does nothing.
      if (!std::holds_alternative<ForceField>(info.component.kind) &&
          !check_effect(world, info.component).ok())
        return false;
      ++store.alive_count;
    } else if (size != 0) {
      return false;
    }
    at += size;
    store.info.push_back(std::move(info));
    if (store.info.back().alive) store.link(slot);
  }
  if (at != numbers->reals.size()) return false;
  for (const std::uint64_t slot : unused->integers) {
    if (slot >= store.info.size() || store.info[slot].alive) return false;
    store.free_slots.push_back(static_cast<std::uint32_t>(slot));
  }
  note_effects(world);
  return true;
}

// What the next step depends on beyond the effects themselves; those that remember nothing leave
// no trace, so that an effect that never acts changes no digest.
std::uint64_t digest_of_effects(const WorldState& world) {
  Digest digest;
  bool any = false;
  for (std::uint32_t slot = 0; slot < world.effects->info.size(); ++slot) {
    const EffectInfo& effect = world.effects->info[slot];
    const double age =
        std::holds_alternative<Explosion>(effect.component.kind) ? effect.memory.age : 0;
    if (!effect.alive || (effect.memory.pull == 0 && age == 0)) continue;
    any = true;
    digest.add(std::uint64_t{effect.generation} << 32 | slot);
    digest.add(effect.memory.pull);
    digest.add(age);
  }
  return any ? digest.value() : 0;
}

}  // namespace plumb::inline PLUMB_ABI::detail
