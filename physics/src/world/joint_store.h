// Joints, by slot. A world without joints has none of these lists.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "plumb/joint.h"
#include "solver/joints/joint_memory.h"
#include "world/slots.h"

namespace plumb::inline PLUMB_ABI::detail {

struct JointScratch;  // solver/joints/joint_scratch.h

struct JointInfo {
  std::uint32_t generation = 0;
  bool alive = false;
  std::uint32_t body_a = kWorldBody, body_b = kWorldBody;  // slots
  Joint component;                                         // as given
  JointMemory memory;
};

class JointStore {
 public:
  std::uint32_t create() {
    const std::uint32_t slot = take_slot(info, free_slots);
    ++alive_count;
    return slot;
  }
  // Into the lists of the bodies that it holds.
  void link(std::uint32_t slot) {
    for (const std::uint32_t body : {info[slot].body_a, info[slot].body_b}) {
      if (body == kWorldBody) continue;
      if (body >= of_body.size()) of_body.resize(body + 1);
      std::vector<std::uint32_t>& list = of_body[body];
      list.insert(std::lower_bound(list.begin(), list.end(), slot), slot);
    }
  }
  void destroy(std::uint32_t slot) {
    for (const std::uint32_t body : {info[slot].body_a, info[slot].body_b})
      if (body < of_body.size()) std::erase(of_body[body], slot);
    free_slot(info, free_slots, slot);
    --alive_count;
  }
  [[nodiscard]] bool empty() const { return alive_count == 0; }
  [[nodiscard]] JointId id(std::uint32_t slot) const { return {slot, info[slot].generation}; }
  [[nodiscard]] bool is_valid(JointId joint) const {
    return joint.index < info.size() && info[joint.index].alive &&
           info[joint.index].generation == joint.generation;
  }
  // Joints at a body, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& at_body(std::uint32_t body) const {
    static const std::vector<std::uint32_t> none;
    return body < of_body.size() ? of_body[body] : none;
  }

  std::vector<JointInfo> info;
  std::vector<std::uint32_t> free_slots;  // reused last in, first out
  std::uint32_t alive_count = 0;
  std::vector<std::vector<std::uint32_t>> of_body;  // by body slot, ascending

  // Of the running step; null until there is a joint.
  std::shared_ptr<JointScratch> scratch;
};

}  // namespace plumb::inline PLUMB_ABI::detail
