// What a world knows about pairs beyond their two colliders: the table of material pairs, and who
// never meets whom. Sorted lists, read when a pair is made, never during the step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "plumb/material.h"

namespace plumb::inline PLUMB_ABI::detail {

// Two numbers as one, whatever their order.
inline std::uint64_t unordered_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t{a} << 32 | b) : (std::uint64_t{b} << 32 | a);
}

class MaterialTable {
 public:
  struct Entry {
    std::uint64_t key = 0;  // of the two kinds
    MaterialPair values;
  };

  [[nodiscard]] const MaterialPair* find(std::uint32_t kind_a, std::uint32_t kind_b) const {
    if (entries.empty()) return nullptr;
    const std::uint64_t key = unordered_key(kind_a, kind_b);
    const auto at = place_of(key);
    return at != entries.end() && at->key == key ? &at->values : nullptr;
  }
  void set(std::uint32_t kind_a, std::uint32_t kind_b, const std::optional<MaterialPair>& values) {
    const std::uint64_t key = unordered_key(kind_a, kind_b);
    const auto at = entries.begin() + (place_of(key) - entries.cbegin());
    const bool there = at != entries.end() && at->key == key;
    if (!values.has_value()) {
      if (there) entries.erase(at);
    } else if (there) {
      at->values = *values;
    } else {
      entries.insert(at, {key, *values});
    }
    resists_turning_ = std::any_of(entries.begin(), entries.end(), [](const Entry& entry) {
      return entry.values.rolling_friction.value_or(Real(0)) > Real(0) ||
             entry.values.torsional_friction.value_or(Real(0)) > Real(0);
    });
  }
  // Whether some entry asks for rolling or torsional friction.
  [[nodiscard]] bool resists_turning() const { return resists_turning_; }

  std::vector<Entry> entries;  // by key; changed by set() only

 private:
  bool resists_turning_ = false;
  [[nodiscard]] std::vector<Entry>::const_iterator place_of(std::uint64_t key) const {
    return std::lower_bound(entries.begin(), entries.end(), key,
                            [](const Entry& entry, std::uint64_t k) { return entry.key < k; });
  }
};

// Pairs of slots.
class ExclusionList {
 public:
  [[nodiscard]] bool empty() const { return keys.empty(); }
  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(keys.begin(), keys.end(), unordered_key(a, b));
  }
  void set(std::uint32_t a, std::uint32_t b, bool excluded) {
    const std::uint64_t key = unordered_key(a, b);
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    const bool there = at != keys.end() && *at == key;
    if (excluded && !there) keys.insert(at, key);
    if (!excluded && there) keys.erase(at);
  }
  void forget(std::uint32_t slot) {  // what it named is gone
    std::erase_if(keys, [slot](std::uint64_t key) {
      return key >> 32 == slot || (key & 0xffffffffu) == slot;
    });
  }

  std::vector<std::uint64_t> keys;  // ascending
};

struct ContactData {
  MaterialTable materials;
  ExclusionList excluded_bodies, excluded_colliders;
};

}  // namespace plumb::inline PLUMB_ABI::detail
