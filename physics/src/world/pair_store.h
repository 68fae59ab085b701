// Pairs of colliders whose bounds overlap, and what is remembered of their contact. The awake ones
// are kept sorted by key, so that every stage meets them in the same order whatever the history.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/manifold.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Pair {
  std::uint64_t key = 0;                 // smaller collider slot << 32 | larger one
  std::uint32_t body_a = 0, body_b = 0;  // slots
  Real friction = 0, restitution = 0;    // combined [-]
  Real slop = 0;                         // [m]
  bool sensor = false;
  bool touching = false;       // has points (sensor: overlaps)
  bool was_touching = false;   // after the previous step
  bool at_rest = false;        // the contact solver, not a bounce, carried it in the last substep
  bool relative_to_b = false;  // else to A
  // A swept pair's manifold is that of the moment of first touch: B is then this much farther
  // along, seen from A [m], and the separations are those of the step's start again.
  Vec advance{0, 0, 0};
  Real advanced_gap = 0;  // [m] what that added to the separations
  Manifold manifold;      // positions from that body's centre of mass, world axes
  Real normal_impulse[Manifold::kMaxPoints]{};       // [N s] of the last substep: the warm start
  Vec friction_impulse[Manifold::kMaxPoints]{};      // [N s] on B, world axes
  Real step_normal_impulse[Manifold::kMaxPoints]{};  // [N s] summed over the last step
  Vec step_friction_impulse[Manifold::kMaxPoints]{};

  [[nodiscard]] std::uint32_t collider_a() const { return static_cast<std::uint32_t>(key >> 32); }
  [[nodiscard]] std::uint32_t collider_b() const {
    return static_cast<std::uint32_t>(key & 0xffffffffu);
  }
};

inline std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t{a} << 32 | b) : (std::uint64_t{b} << 32 | a);
}

class PairStore {
 public:
  // Awake pairs in order of key.
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] Pair& operator[](std::size_t i) { return records_[order_[i].record]; }
  [[nodiscard]] const Pair& operator[](std::size_t i) const { return records_[order_[i].record]; }
  [[nodiscard]] Pair* find(std::uint64_t key);

  // Adds pairs (sorted by key, none of them present) in one merge.
  void insert_sorted(const std::vector<Pair>& pairs);
  // Removes those for which `gone(pair)` holds, keeping the order.
  template <class Gone>
  void remove_if(Gone&& gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (gone(records_[order_[i].record])) {
        free_.push_back(order_[i].record);
      } else {
        order_[kept++] = order_[i];
      }
    }
    order_.resize(kept);
  }
  [[nodiscard]] bool contains(std::uint64_t key) const;
  void clear();

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t record;
  };
  std::vector<Entry> order_, merged_;
  std::vector<Pair> records_;
  std::vector<std::uint32_t> free_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
