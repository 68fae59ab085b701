// Joints that hang together over dynamic bodies are a group. Seen from one of its joints, best one
// that holds on to the world, a group is a tree in which joints that share a body are neighbours;
// loops add neighbours across. Eliminated from the leaves on, a tree fills no block that was empty.
//
// A group none of whose bodies touches anything goes through the substep by itself
// (joint_flight.cpp).
#include "solver/joints/joint_groups.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "solver/joints/joint_kinds.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr int kJointColors = 64;  // bits of a mask; the last one is the overflow

void list_active(WorldState& world) {
  JointStore& joints = world.joints;
  JointScratch& scratch = *joints.scratch;
  scratch.active.clear();
  scratch.members.clear();
  for (std::uint32_t slot = 0; slot < joints.info.size(); ++slot) {
    if (!joints.info[slot].alive) continue;
    const JointBodies bodies = bodies_of(world, slot);
    JointMembers members;
    for (int k = 0; k < bodies.count; ++k) {
      if (!is_dynamic_awake(world, bodies.slot[k])) {
        members.anchored = true;
        continue;
      }
      const std::uint32_t dense = dense_of(world, bodies.slot[k]);
      std::uint32_t* end = members.body + members.count;
      if (std::find(members.body, end, dense) == end) members.body[members.count++] = dense;
    }
    if (members.count == 0) continue;
    scratch.active.push_back(slot);
    scratch.members.push_back(members);
  }
}

// Union-find over bodies. A joint that links what is linked closes a loop; so does a second hold on
// the world, and an axis that a body has locked.
class Groups {
 public:
  explicit Groups(WorldState& world)
      : world_(world),
        scratch_(*world.joints.scratch),
        parents_(scratch_.group),
        loops_(world.bodies.awake_end, 0, &world.memory),
        locked_(world.bodies.awake_end, 0, &world.memory),
        anchors_(world.bodies.awake_end, 0, &world.memory) {
    parents_.resize(world.bodies.awake_end);
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  void find() {
    for (const JointMembers& members : scratch_.members) {
      for (int k = 1; k < members.count; ++k) link(members.body[0], members.body[k]);
      if (members.anchored) {
        std::uint8_t& anchors = anchors_[root(members.body[0])];
        if (anchors < 2) ++anchors;
      }
      for (int k = 0; k < members.count; ++k)
        if (has_locks(members.body[k]))
          loops_[root(members.body[k])] = locked_[root(members.body[k])] = 1;
    }
    scratch_.group_touches.assign(parents_.size(), 0);
    scratch_.group_loops.assign(parents_.size(), 0);
    scratch_.group_anchored.assign(parents_.size(), 0);
    for (std::uint32_t i = world_.bodies.awake_begin; i < world_.bodies.awake_end; ++i) {
      parents_[i] = root(i);
      if (world_.substep[i].constrained) scratch_.group_touches[parents_[i]] = 1;
    }
    for (std::uint32_t i = 0; i < parents_.size(); ++i) {
      if (parents_[i] != i) continue;
      scratch_.group_loops[i] = loops_[i] != 0 || anchors_[i] > 1 ? 1 : 0;
      scratch_.group_anchored[i] = anchors_[i] > 0 || locked_[i] != 0 ? 1 : 0;
    }
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void link(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    const std::uint32_t first = std::min(a, b), last = std::max(a, b);
    parents_[last] = first;
    if (first == last) {
      loops_[first] = 1;
      return;
    }
    loops_[first] = loops_[first] | loops_[last];
    locked_[first] = locked_[first] | locked_[last];
    anchors_[first] = static_cast<std::uint8_t>(std::min(2, anchors_[first] + anchors_[last]));
  }
  [[nodiscard]] bool has_locks(std::uint32_t body) const {
    const BodyMass& mass = world_.bodies.mass[body];
    const auto locked = [](Vec a) { return a.x == Real(0) || a.y == Real(0) || a.z == Real(0); };
    return mass.angular_locks != 0 || locked(mass.inverse_mass) || locked(mass.inverse_moments);
  }

  WorldState& world_;
  JointScratch& scratch_;
  std::vector<std::uint32_t>& parents_;
  StepList<std::uint8_t> loops_, locked_, anchors_;
};

// Walks every group breadth first, then numbers its joints from the last one found to the first.
class Order {
 public:
  explicit Order(WorldState& world)
      : scratch_(*world.joints.scratch),
        choice_(world.settings.forced.of(PlanItem::DirectJoints)),
        h_(world.h),
        begin_(&world.memory),
        joints_(&world.memory),
        found_(&world.memory),
        place_(&world.memory),
        columns_(&world.memory) {
    const std::size_t bodies = scratch_.group.size(), count = scratch_.members.size();
    begin_.assign(bodies + 1, 0);
    for (const JointMembers& members : scratch_.members)
      for (int k = 0; k < members.count; ++k) ++begin_[members.body[k] + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    joints_.resize(begin_.back());
    StepList<std::uint32_t> next(begin_.begin(), begin_.end() - 1, &world.memory);
    for (std::uint32_t i = 0; i < count; ++i)
      for (int k = 0; k < scratch_.members[i].count; ++k)
        joints_[next[scratch_.members[i].body[k]]++] = i;
    found_.assign(count, 0);
    place_.assign(count, 0);
  }

  void make_pieces() {
    const std::uint32_t count = static_cast<std::uint32_t>(scratch_.members.size());
    JointSystem& system = scratch_.system;
    system.pieces.clear();
    scratch_.order.clear();
    columns_.clear();
    // Anchored joints first: elimination should end at the world.
    for (const bool anchored : {true, false}) {
      for (std::uint32_t i = 0; i < count; ++i) {
        if (found_[i] != 0 || (anchored && !scratch_.members[i].anchored)) continue;
        const std::uint32_t begin = static_cast<std::uint32_t>(scratch_.order.size());
        walk(i);
        const std::uint32_t end = static_cast<std::uint32_t>(scratch_.order.size());
        std::reverse(scratch_.order.begin() + begin, scratch_.order.end());
        for (std::uint32_t p = begin; p < end; ++p) place_[scratch_.order[p]] = p;
        const std::uint32_t group = scratch_.group[scratch_.members[i].body[0]];
        const bool loops = scratch_.group_loops[group] != 0;
        const bool held = scratch_.group_anchored[group] != 0;
        const bool apart = scratch_.group_touches[group] == 0;
        if (find_pattern(begin, end)) {
          system.pieces.push_back({begin, end, true, loops, held, apart, h_});
        } else {
          for (std::uint32_t p = begin; p < end; ++p) {
            columns_[p].clear();
            system.pieces.push_back({p, p + 1, false, loops, true, false, h_});
          }
        }
      }
    }
    system.column.assign(1, 0);
    system.entry_row.clear();
    for (const StepList<std::uint32_t>& column : columns_) {
      system.entry_row.insert(system.entry_row.end(), column.begin(), column.end());
      system.column.push_back(static_cast<std::uint32_t>(system.entry_row.size()));
    }
  }

 private:
  void walk(std::uint32_t first) {
    std::size_t next = scratch_.order.size();
    found_[first] = 1;
    scratch_.order.push_back(first);
    for (; next < scratch_.order.size(); ++next)
      for_neighbours(scratch_.order[next], [&](std::uint32_t j) {
        if (found_[j] != 0) return;
        found_[j] = 1;
        scratch_.order.push_back(j);
      });
  }
  template <class Task>
  void for_neighbours(std::uint32_t joint, Task&& task) {
    const JointMembers& members = scratch_.members[joint];
    for (int k = 0; k < members.count; ++k)
      for (std::uint32_t e = begin_[members.body[k]]; e < begin_[members.body[k] + 1]; ++e)
        task(joints_[e]);
  }
  // Column p of the factor: later neighbours of p, and what the columns whose first row is p leave.
  bool find_pattern(std::uint32_t begin, std::uint32_t end) {
    columns_.resize(end);
    std::uint64_t work = 0;
    if (choice_ == Choice::Off && end - begin > 1) return false;
    const std::uint64_t most = choice_ == Choice::On ? std::numeric_limits<std::uint64_t>::max()
                                                     : joint_tolerance::kMostWork * (end - begin);
    for (std::uint32_t p = begin; p < end; ++p) {
      StepList<std::uint32_t>& column = columns_[p];
      for_neighbours(scratch_.order[p], [&](std::uint32_t j) {
        if (place_[j] > p) column.push_back(place_[j]);
      });
      std::sort(column.begin(), column.end());
      column.erase(std::unique(column.begin(), column.end()), column.end());
      work += column.size() * column.size();
      if (work > most) return false;
      if (column.empty()) continue;
      StepList<std::uint32_t>& next = columns_[column.front()];
      next.insert(next.end(), column.begin() + 1, column.end());
    }
    return true;
  }

  JointScratch& scratch_;
  Choice choice_;  // of solving a group at once
  Real h_;
  StepList<std::uint32_t> begin_, joints_;  // joints at each body
  StepList<std::uint8_t> found_;
  StepList<std::uint32_t> place_;  // in the order, per active joint
  StepList<StepList<std::uint32_t>> columns_;
};

// Greedy. Whole groups share no body with anything and have the first colour; pieces of wide groups
// come after them.
void color_pieces(WorldState& world) {
  JointScratch& scratch = *world.joints.scratch;
  std::vector<JointPiece>& pieces = scratch.system.pieces;
  scratch.colors.clear();
  StepList<std::uint64_t> mask(scratch.group.size(), 0, &world.memory);
  StepList<std::pair<int, std::uint32_t>> colored(&world.memory);  // colour, piece
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const JointPiece& piece = pieces[i];
    int color = 0;
    if (!piece.whole) {
      const JointMembers& members = scratch.members[scratch.order[piece.begin]];
      std::uint64_t used = 1;
      for (int k = 0; k < members.count; ++k) used |= mask[members.body[k]];
      color = std::min(std::countr_one(used), kJointColors - 1);
      if (color < kJointColors - 1)
        for (int k = 0; k < members.count; ++k) mask[members.body[k]] |= std::uint64_t{1} << color;
    }
    colored.emplace_back(color, i);
  }
  std::sort(colored.begin(), colored.end());
  const StepList<JointPiece> found(pieces.begin(), pieces.end(), &world.memory);
  scratch.has_parts = false;
  for (std::uint32_t i = 0; i < colored.size(); ++i) {
    pieces[i] = found[colored[i].second];
    scratch.has_parts = scratch.has_parts || !pieces[i].whole;
    // Beyond the last colour: one after the other.
    const bool same = i > 0 && colored[i - 1].first == colored[i].first;
    if (same && colored[i].first < kJointColors - 1) {
      ++scratch.colors.back().second;
    } else {
      scratch.colors.emplace_back(i, i + 1);
    }
  }
}

}  // namespace

JointBodies bodies_of(const WorldState& world, std::uint32_t slot) {
  const JointStore& joints = world.joints;
  const JointInfo& joint = joints.info[slot];
  JointId first, second;
  if (!coupled_joints(joint.component.kind, first, second))
    return {{joint.body_a, joint.body_b}, 2};
  const JointInfo& p = joints.info[first.index];
  const JointInfo& q = joints.info[second.index];
  return {{p.body_a, p.body_b, q.body_a, q.body_b}, 4};
}

bool is_dynamic_awake(const WorldState& world, std::uint32_t slot) {
  return slot != kWorldBody && world.bodies.is_awake(slot) &&
         world.bodies.mass[world.bodies.info[slot].dense].mass > Real(0);
}
std::uint32_t dense_of(const WorldState& world, std::uint32_t slot) {
  if (slot == kWorldBody) return 0;
  const std::uint32_t dense = world.bodies.info[slot].dense;
  return dense < world.bodies.awake_end ? dense : 0;
}

void group_joints(WorldState& world) {
  list_active(world);
  Groups(world).find();
  Order(world).make_pieces();
  color_pieces(world);
}

}  // namespace plumb::inline PLUMB_ABI::detail
