// The contact of one pair of convex shapes: up to four points that share a normal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ManifoldPoint {
  Vec position;     // [m] midway between the two surfaces; world axes, from A's reference point
  Real separation;  // [m] along the normal; negative when the shapes overlap
  std::uint32_t feature;  // names the pair of features that met, stable from step to step
};

struct Manifold {
  static constexpr int kMaxPoints = 4;
  Vec normal{0, 1, 0};  // unit, from A towards B, world axes
  int count = 0;
  ManifoldPoint points[kMaxPoints]{};
};

// The axis that told two polyhedra apart, or along which they touch by their edges: a face of one
// of them, or an edge of each. None: not known.
class AxisHint {
 public:
  AxisHint() = default;
  static AxisHint of_face(int face, bool of_second) {
    return AxisHint(of_second ? kFaceOfSecond : kFaceOfFirst, face, 0);
  }
  static AxisHint of_edges(int first, int second) { return AxisHint(kEdges, first, second); }

  [[nodiscard]] bool is_face() const { return kind() == kFaceOfFirst || kind() == kFaceOfSecond; }
  [[nodiscard]] bool is_edges() const { return kind() == kEdges; }
  [[nodiscard]] bool of_second() const { return kind() == kFaceOfSecond; }
  [[nodiscard]] int face() const { return number(kBits); }
  [[nodiscard]] int first_edge() const { return number(kBits); }
  [[nodiscard]] int second_edge() const { return number(kBits + kIndexBits); }
  [[nodiscard]] AxisHint swapped() const {
    if (is_edges()) return of_edges(second_edge(), first_edge());
    return is_face() ? of_face(face(), !of_second()) : *this;
  }

 private:
  static constexpr std::uint32_t kFaceOfFirst = 1, kFaceOfSecond = 2, kEdges = 3;
  static constexpr int kBits = 2, kIndexBits = 15;
  AxisHint(std::uint32_t kind, int first, int second)
      : code_(kind | static_cast<std::uint32_t>(first) << kBits |
              static_cast<std::uint32_t>(second) << (kBits + kIndexBits)) {}
  [[nodiscard]] std::uint32_t kind() const { return code_ & ((1u << kBits) - 1u); }
  [[nodiscard]] int number(int shift) const {
    return static_cast<int>(code_ >> shift & ((1u << kIndexBits) - 1u));
  }
  std::uint32_t code_ = 0;
};

// What is known of a pair of shapes from the last look at it. It saves time; no result depends on
// it.
struct PairMemory {
  AxisHint axis;  // to look at first
  Real gap = 0;   // [m] they are at least this far apart; 0: not known
};

}  // namespace plumb::inline PLUMB_ABI::detail
