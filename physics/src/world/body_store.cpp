#include "world/body_store.h"

#include <utility>

#include "world/slots.h"

namespace plumb::inline PLUMB_ABI::detail {

void BodyStore::push_dense(std::uint32_t slot) {
  velocity.emplace_back();
  pose.emplace_back();
  momentum.emplace_back();
  mass.emplace_back();
  force.emplace_back();
  slot_of.push_back(slot);
}

void BodyStore::swap_dense(std::uint32_t i, std::uint32_t j) {
  if (i == j) return;
  std::swap(velocity[i], velocity[j]);
  std::swap(pose[i], pose[j]);
  std::swap(momentum[i], momentum[j]);
  std::swap(mass[i], mass[j]);
  std::swap(force[i], force[j]);
  std::swap(slot_of[i], slot_of[j]);
  dense_of[slot_of[i]] = info[slot_of[i]].dense = i;
  dense_of[slot_of[j]] = info[slot_of[j]].dense = j;
}

std::uint32_t BodyStore::create() {
  const std::uint32_t slot = take_slot(info, free_slots);
  dense_of.resize(info.size());
  travel.resize(info.size());
  extent.resize(info.size());
  acceleration.resize(info.size());
  travel[slot] = {};
  extent[slot] = {};
  acceleration[slot] = {0, 0, 0};
  dense_of[slot] = info[slot].dense = dense_count();
  push_dense(slot);
  ++alive_count;
  return slot;
}

void BodyStore::destroy(std::uint32_t slot) {
  rest(slot);
  swap_dense(info[slot].dense, dense_count() - 1);
  velocity.pop_back();
  pose.pop_back();
  momentum.pop_back();
  mass.pop_back();
  force.pop_back();
  slot_of.pop_back();
  free_slot(info, free_slots, slot);
  --alive_count;
}

void BodyStore::wake(std::uint32_t slot) {
  if (is_awake(slot)) return;
  swap_dense(info[slot].dense, awake_end);
  ++awake_end;
  some_called |= info[slot].newton_calls + info[slot].newton_steps + info[slot].newton_pause > 0;
}

void BodyStore::rest(std::uint32_t slot) {
  if (!is_awake(slot)) return;
  standing.push_back(slot);
  --awake_end;
  swap_dense(info[slot].dense, awake_end);
}

}  // namespace plumb::inline PLUMB_ABI::detail
