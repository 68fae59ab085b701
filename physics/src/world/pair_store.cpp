#include "world/pair_store.h"

#include <algorithm>

namespace plumb::inline PLUMB_ABI::detail {

const Pair* PairStore::find(std::uint64_t key) const {
  const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), key,
                                   [](const Pair& pair, std::uint64_t k) { return pair.key < k; });
  return at != pairs_.end() && at->key == key ? &*at : nullptr;
}

void PairStore::insert_sorted(const std::vector<Pair>& added) {
  if (added.empty()) return;
  merged_.resize(pairs_.size() + added.size());
  std::merge(pairs_.begin(), pairs_.end(), added.begin(), added.end(), merged_.begin(),
             [](const Pair& a, const Pair& b) { return a.key < b.key; });
  pairs_.swap(merged_);
  ++changes_;
}

}  // namespace plumb::inline PLUMB_ABI::detail
