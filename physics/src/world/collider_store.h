// Colliders, by slot.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/aabb_tree.h"
#include "collision/collision_shape.h"
#include "plumb/collider.h"
#include "plumb/ids.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ColliderInfo {
  std::uint32_t generation = 0;
  bool alive = false;
  bool is_static = false;  // which of the two trees it is in
  std::uint32_t body = 0;  // slot
  std::int32_t proxy = AabbTree::kNull;
  bool query_pairs = false;  // its box grew since pairs were last sought
  Collider component;        // as given
  CollisionShape shape;
  Transform in_body;   // shape placed relative to the centre of mass, principal axes
  Real thickness = 0;  // [m]
};

class ColliderStore {
 public:
  std::uint32_t create() {
    std::uint32_t slot;
    if (free_slots.empty()) {
      slot = static_cast<std::uint32_t>(info.size());
      info.emplace_back();
    } else {
      slot = free_slots.back();
      free_slots.pop_back();
    }
    const std::uint32_t generation = info[slot].generation + 1;
    info[slot] = ColliderInfo{};
    info[slot].generation = generation;
    info[slot].alive = true;
    return slot;
  }
  void destroy(std::uint32_t slot) {
    const std::uint32_t generation = info[slot].generation;
    info[slot] = ColliderInfo{};
    info[slot].generation = generation;
    free_slots.push_back(slot);
  }
  [[nodiscard]] ColliderId id(std::uint32_t slot) const { return {slot, info[slot].generation}; }

  std::vector<ColliderInfo> info;
  std::vector<std::uint32_t> free_slots;
};

}  // namespace plumb::inline PLUMB_ABI::detail
