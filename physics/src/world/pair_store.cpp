#include "world/pair_store.h"

#include <algorithm>

namespace plumb::inline PLUMB_ABI::detail {

bool PairStore::contains(std::uint64_t key) const {
  const auto at = std::lower_bound(order_.begin(), order_.end(), key,
                                   [](const Entry& e, std::uint64_t k) { return e.key < k; });
  return at != order_.end() && at->key == key;
}

Pair* PairStore::find(std::uint64_t key) {
  const auto at = std::lower_bound(order_.begin(), order_.end(), key,
                                   [](const Entry& e, std::uint64_t k) { return e.key < k; });
  return at != order_.end() && at->key == key ? &records_[at->record] : nullptr;
}

void PairStore::insert_sorted(const std::vector<Pair>& pairs) {
  if (pairs.empty()) return;
  merged_.clear();
  merged_.reserve(order_.size() + pairs.size());
  auto old = order_.begin();
  for (const Pair& pair : pairs) {
    while (old != order_.end() && old->key < pair.key) merged_.push_back(*old++);
    std::uint32_t record;
    if (free_.empty()) {
      record = static_cast<std::uint32_t>(records_.size());
      records_.push_back(pair);
    } else {
      record = free_.back();
      free_.pop_back();
      records_[record] = pair;
    }
    merged_.push_back({pair.key, record});
  }
  merged_.insert(merged_.end(), old, order_.end());
  order_.swap(merged_);
}

void PairStore::clear() {
  order_.clear();
  records_.clear();
  free_.clear();
}

}  // namespace plumb::inline PLUMB_ABI::detail
