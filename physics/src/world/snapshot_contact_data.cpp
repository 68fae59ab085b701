#include "world/snapshot_contact_data.h"

#include <array>

#include "world/validate.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

template <class Table>
void visit_entry(Table& t, std::uint64_t& key, bool (&has)[4], Real (&value)[4]) {
  t("kinds", key);
  t("has", has[0], has[1], has[2], has[3]);
  t("values", value[0], value[1], value[2], value[3]);
}

template <class Entry>
auto fields_of(Entry& values) {
  return std::array{&values.friction, &values.restitution, &values.rolling_friction,
                    &values.torsional_friction};
}

void save_keys(ColumnWriter& out, const char* name, const ExclusionList& list) {
  if (list.empty()) return;
  out.add("excluded", name, 1, false).integers = list.keys;
}

// alive(slot): whether a pair may name it.
template <class Alive>
bool restore_keys(const Snapshot& in, const char* name, ExclusionList& list, Alive&& alive) {
  const SnapshotColumn* column = in.find(name);
  if (column == nullptr) return true;
  if (column->type != SnapshotColumn::Type::Uint64) return false;
  for (const std::uint64_t key : column->integers) {
    const std::uint64_t a = key >> 32, b = key & 0xffffffffu;
    if (a >= b || !alive(a) || !alive(b)) return false;
    if (!list.keys.empty() && list.keys.back() >= key) return false;
    list.keys.push_back(key);
  }
  return true;
}

}  // namespace

void save_contact_data(ColumnWriter& out, const WorldState& world) {
  const ContactData& data = world.contact_data;
  if (!data.materials.entries.empty()) {
    TableWriter table(out, "material_pair", data.materials.entries.size());
    for (MaterialTable::Entry entry : data.materials.entries) {
      bool has[4]{};
      Real value[4]{};
      const auto fields = fields_of(entry.values);
      for (std::size_t i = 0; i < 4; ++i) {
        has[i] = fields[i]->has_value();
        value[i] = fields[i]->value_or(Real(0));
      }
      table.next_row();
      visit_entry(table, entry.key, has, value);
    }
  }
  save_keys(out, "bodies", data.excluded_bodies);
  save_keys(out, "colliders", data.excluded_colliders);
}

bool restore_contact_data(const Snapshot& in, WorldState& world) {
  ContactData& data = world.contact_data;
  TableReader table(in, "material_pair");
  if (table.rows() == 0 && in.find("material_pair.kinds") != nullptr) return false;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    MaterialTable::Entry entry;
    bool has[4]{};
    Real value[4]{};
    table.next_row();
    visit_entry(table, entry.key, has, value);
    if (!table.ok()) return false;
    const auto fields = fields_of(entry.values);
    for (std::size_t k = 0; k < 4; ++k)
      if (has[k]) *fields[k] = value[k];
    const std::uint64_t a = entry.key >> 32, b = entry.key & 0xffffffffu;
    if (a == 0 || a > b || !check_material_pair(entry.values).ok()) return false;
    if (!data.materials.entries.empty() && data.materials.entries.back().key >= entry.key)
      return false;
    data.materials.set(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), entry.values);
  }
  const auto body = [&](std::uint64_t slot) {
    return slot < world.bodies.info.size() && world.bodies.info[slot].alive;
  };
  const auto collider = [&](std::uint64_t slot) {
    return slot < world.colliders.info.size() && world.colliders.info[slot].alive;
  };
  return restore_keys(in, "excluded.bodies", data.excluded_bodies, body) &&
         restore_keys(in, "excluded.colliders", data.excluded_colliders, collider);
}

}  // namespace plumb::inline PLUMB_ABI::detail
