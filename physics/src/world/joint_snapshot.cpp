// Joints in snapshots and in the digest of a world's state.
#include <bit>

#include "world/joint_inputs.h"
#include "world/joint_world.h"
#include "world/snapshot_table.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

template <class Table>
void visit_joint(Table& t, JointInfo& j, std::uint32_t& size) {
  JointMemory& m = j.memory;
  t("generation", j.generation);
  t("flags", j.alive, m.split, m.at_lower, m.at_upper);
  t("bodies", j.body_a, j.body_b);
  t("numbers", size);
  t("angle", m.angle, m.zero);
  t.unbounded("force", m.force.x, m.force.y, m.force.z);
  t.unbounded("torque", m.torque.x, m.torque.y, m.torque.z);
  t.unbounded("effort", m.effort);
  static constexpr const char* kNames[kMaxJointRows][2] = {
      {"first0", "second0"}, {"first1", "second1"}, {"first2", "second2"}, {"first3", "second3"},
      {"first4", "second4"}, {"first5", "second5"}, {"first6", "second6"}, {"first7", "second7"}};
  for (int i = 0; i < kMaxJointRows; ++i) {
    Real *a = m.rows[i].first, *b = m.rows[i].second;
    t.unbounded(kNames[i][0], a[0], a[1], a[2], a[3], a[4], a[5]);
    t.unbounded(kNames[i][1], b[0], b[1], b[2], b[3], b[4], b[5]);
  }
}

}  // namespace

void save_joints(ColumnWriter& out, const WorldState& world) {
  if (world.joints.info.empty()) return;
  std::vector<double> numbers;
  {
    TableWriter table(out, "joint", world.joints.info.size());
    for (JointInfo info : world.joints.info) {
      const std::size_t before = numbers.size();
      if (info.alive) append(numbers, info.component);
      std::uint32_t size = static_cast<std::uint32_t>(numbers.size() - before);
      table.next_row();
      visit_joint(table, info, size);
    }
  }
  out.add("joint_numbers", "value", 1, true).reals = std::move(numbers);
  out.add("joint_free", "slot", 1, false)
      .integers.assign(world.joints.free_slots.begin(), world.joints.free_slots.end());
}

bool restore_joints(const Snapshot& in, WorldState& world) {
  TableReader table(in, "joint");
  if (table.rows() == 0) return true;
  const SnapshotColumn* numbers = in.find("joint_numbers.value");
  const SnapshotColumn* unused = in.find("joint_free.slot");
  if (numbers == nullptr || unused == nullptr || numbers->type != SnapshotColumn::Type::Float64 ||
      unused->type != SnapshotColumn::Type::Uint64)
    return false;
  JointStore& joints = world.joints;
  std::size_t at = 0;
  for (std::size_t slot = 0; slot < table.rows(); ++slot) {
    JointInfo info;
    std::uint32_t size = 0;
    table.next_row();
    visit_joint(table, info, size);
    if (!table.ok() || size > numbers->reals.size() - at) return false;
    if (info.alive) {
      NumberReader reader(std::span(numbers->reals).subspan(at, size));
      bool ok = true;
      info.component = read_joint(reader, ok);
      if (!ok || !reader.complete()) return false;
      ++joints.alive_count;
    } else if (size != 0) {
      return false;
    }
    at += size;
    joints.info.push_back(std::move(info));
  }
  if (at != numbers->reals.size()) return false;
  // Couplings name joints that may stand behind them: everything is there before it is checked.
  for (std::uint32_t slot = 0; slot < joints.info.size(); ++slot) {
    const JointInfo& info = joints.info[slot];
    if (!info.alive) continue;
    if (!check_joint(world, info.component).ok()) return false;
    JointId first, second;
    const bool coupling = coupled_joints(info.component.kind, first, second);
    const auto fits = [&](std::uint32_t body, BodyId named) {
      return coupling || named.is_null() ? body == kWorldBody : body == named.index;
    };
    if (!fits(info.body_a, info.component.body_a) || !fits(info.body_b, info.component.body_b))
      return false;
    joints.link(slot);
  }
  for (const std::uint64_t slot : unused->integers) {
    if (slot >= joints.info.size() || joints.info[slot].alive) return false;
    joints.free_slots.push_back(static_cast<std::uint32_t>(slot));
  }
  return true;
}

std::uint64_t digest_of_joints(const WorldState& world) {
  std::uint64_t state = 0x9e3779b97f4a7c15u;
  const auto add = [&](std::uint64_t word) {  // as in state_hash.cpp [Steele 2014]
    state = std::rotl(state ^ (word * 0x9e3779b97f4a7c15u), 29) * 0xbf58476d1ce4e5b9u;
  };
  const auto add_real = [&](Real v) { add(std::bit_cast<std::uint64_t>(static_cast<double>(v))); };
  for (std::uint32_t slot = 0; slot < world.joints.info.size(); ++slot) {
    const JointInfo& info = world.joints.info[slot];
    if (!info.alive) continue;
    add(std::uint64_t{info.generation} << 32 | slot);
    add_real(info.memory.angle);
    add(info.memory.split ? 1 : 0);
    for (const RowImpulses& row : info.memory.rows) {
      for (int p = 0; p < kRowParts; ++p) {
        add_real(row.first[p]);
        add_real(row.second[p]);
      }
    }
  }
  return state;
}

}  // namespace plumb::inline PLUMB_ABI::detail
