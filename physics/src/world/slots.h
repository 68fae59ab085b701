// Slots: places in a list that are used again. A handle is a slot with the generation that it had,
// so that it is told from a later one at the same place. Info has `generation` and `alive`.
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

// A slot with default values, the one freed last if there is any, a generation on.
template <class Info>
std::uint32_t take_slot(std::vector<Info>& info, std::vector<std::uint32_t>& free_slots) {
  std::uint32_t slot;
  if (free_slots.empty()) {
    slot = static_cast<std::uint32_t>(info.size());
    info.emplace_back();
  } else {
    slot = free_slots.back();
    free_slots.pop_back();
  }
  const std::uint32_t generation = info[slot].generation + 1;
  info[slot] = Info{};
  info[slot].generation = generation;
  info[slot].alive = true;
  return slot;
}

template <class Info>
void free_slot(std::vector<Info>& info, std::vector<std::uint32_t>& free_slots,
               std::uint32_t slot) {
  const std::uint32_t generation = info[slot].generation;
  info[slot] = Info{};
  info[slot].generation = generation;
  free_slots.push_back(slot);
}

}  // namespace plumb::inline PLUMB_ABI::detail
