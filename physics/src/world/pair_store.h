// Pairs of colliders whose bounds overlap, and the contacts found in them.
//
// A pair is small and lives as long as the bounds overlap; the awake ones are kept sorted by key,
// so that every stage meets them in the same order whatever the history. A contact is one manifold
// and what the solver remembers of it; all of them are made anew in every step, in the order of
// their pairs, and the last step's are kept until the new ones have taken over their impulses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/manifold.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// What a pair with a one-way collider remembers from its first meeting until its shapes part.
enum class Passage : std::uint8_t {
  Apart,    // nothing yet
  Held,     // met from the solid side: it stays solid
  Passing,  // met from elsewhere: no contact
};

struct Pair {                            // 64 bytes in f32
  std::uint64_t key = 0;                 // smaller collider slot << 32 | larger one
  std::uint32_t body_a = 0, body_b = 0;  // slots
  Real friction = 0, restitution = 0;    // combined [-]
  Real rolling = 0, torsional = 0;       // combined [m]
  Real slop = 0;                         // [m]
  std::uint32_t first_contact = 0;       // where its contacts lie, in order of their part
  std::uint32_t contact_count = 0;
  std::uint32_t began = 0;  // step in which the touch began, low 32 bits
  bool sensor : 1 = false;
  bool relative_to_b : 1 = false;  // positions of its contacts are seen from B's centre, else A's
  bool driven : 1 = false;         // the surface of one of them runs
  bool one_way : 1 = false;        // one of them is solid from one side only
  bool grained : 1 = false;        // one of them has less friction along a grain
  bool curved : 1 = false;         // one of them is a cylinder or cone
  bool on_surface : 1 = false;     // one of them is a mesh or heightfield
  bool touching = false;           // has contacts (sensor: overlaps)
  bool was_touching = false;       // after the previous step
  Passage passage = Passage::Apart;
  PairMemory memory;  // as last seen, less what both bodies have moved since (clearance.h)
  Real adhesion = 0;  // combined [N]

  [[nodiscard]] std::uint32_t collider_a() const { return static_cast<std::uint32_t>(key >> 32); }
  [[nodiscard]] std::uint32_t collider_b() const {
    return static_cast<std::uint32_t>(key & 0xffffffffu);
  }
};

struct KeptPose {
  PosVec x{0, 0, 0};  // [m] centre of mass
  Rotation q{0, 0, 0, 1};
};
// How a manifold was found, from which it is told anew while the bodies hardly move (recycling.h).
struct KeptManifold {
  Real margin = -1;  // [m] of the search that found it; negative: it may not be kept
  KeptPose a, b;     // of the bodies then
  Vec normal{0, 0, 0};
  Vec position[Manifold::kMaxPoints]{};
  Real separation[Manifold::kMaxPoints]{};
};

// What readers and events look at lies in front, so that they pass over the rest.
struct Contact {
  std::uint32_t pair = 0;  // index into the awake pairs, valid within the step
  std::uint32_t part = 0;  // of a shape made of parts: which one; else 0
  // Slot of the body from whose centre of mass positions are seen; kNone: the pair does not touch.
  // Valid after the step until a pair is changed (WorldState::contacts_fit).
  std::uint32_t seen_from = kNone;
  Real step_normal_impulse[Manifold::kMaxPoints]{};  // [N s] summed over the last step
  Manifold manifold;         // positions from that body's centre of mass, world axes
  bool at_rest = false;      // the contact solver, not a bounce, carried it in the last substep
  bool resisted = false;     // rolling or torsional friction showed in the last step
  bool seen_anyway = false;  // a swept pair's: the one that is seen from where the bodies are
  Real radius_a = 0, radius_b = 0;  // [m] of the rounded shapes that touch; 0 for the others
  // A swept pair's manifold is that of the moment of first touch: B is then this much farther
  // along, seen from A [m], and the separations are those of the step's start again.
  Vec advance{0, 0, 0};
  Real advanced_gap = 0;                         // [m] what that added to the separations
  Real normal_impulse[Manifold::kMaxPoints]{};   // [N s] of the last substep: the warm start
  Vec friction_impulse[Manifold::kMaxPoints]{};  // [N s] on B, world axes
  Vec step_friction_impulse[Manifold::kMaxPoints]{};
  KeptManifold kept;
};

inline std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t{a} << 32 | b) : (std::uint64_t{b} << 32 | a);
}

// The contacts of one pair, wherever they are kept.
inline std::span<Contact> contacts_of(const Pair& pair, std::vector<Contact>& store) {
  return std::span(store).subspan(pair.first_contact, pair.contact_count);
}
inline std::span<const Contact> contacts_of(const Pair& pair, const std::vector<Contact>& store) {
  return std::span(store).subspan(pair.first_contact, pair.contact_count);
}
// Moves a pair's contacts from one store to the end of another.
inline void move_contacts(Pair& pair, const std::vector<Contact>& from, std::vector<Contact>& to) {
  const std::span<const Contact> contacts = contacts_of(pair, from);
  pair.first_contact = static_cast<std::uint32_t>(to.size());
  to.insert(to.end(), contacts.begin(), contacts.end());
}

class PairStore {
 public:
  // Awake pairs in order of key.
  [[nodiscard]] std::size_t size() const { return pairs_.size(); }
  [[nodiscard]] Pair& operator[](std::size_t i) { return pairs_[i]; }
  [[nodiscard]] const Pair& operator[](std::size_t i) const { return pairs_[i]; }
  [[nodiscard]] auto begin() const { return pairs_.begin(); }
  [[nodiscard]] auto end() const { return pairs_.end(); }

  // Adds pairs (sorted by key, none of them present) in one merge.
  void insert_sorted(const std::vector<Pair>& added);
  // Removes those for which `gone(pair)` holds, keeping the order; called once for each, in order.
  template <class Gone>
  void remove_if(Gone&& gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (gone(pairs_[i])) continue;
      if (kept != i) pairs_[kept] = pairs_[i];
      ++kept;
    }
    pairs_.resize(kept);
    ++changes_;
  }
  // Grows whenever places in the list may have moved.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  [[nodiscard]] const Pair* find(std::uint64_t key) const;  // null: there is none
  [[nodiscard]] bool contains(std::uint64_t key) const { return find(key) != nullptr; }

 private:
  std::vector<Pair> pairs_, merged_;
  std::uint64_t changes_ = 1;
};

}  // namespace plumb::inline PLUMB_ABI::detail
