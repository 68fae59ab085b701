// A heightfield as collision sees it: triangles made from the grid when they are asked for.
//
// Cell (i, k) lies between samples (i, k) and (i + 1, k + 1). Its triangles, numbered 2 cell and
// 2 cell + 1 with cell = k * (samples_x - 1) + i:
//   first    (i, k), (i, k+1), (i+1, k+1)     edges: the cell's low-x side, high-z side, diagonal
//   second   (i, k), (i+1, k+1), (i+1, k)     edges: diagonal, high-x side, low-z side
#pragma once

#include "collision/surface/static_bvh.h"
#include "collision/surface/surface_triangle.h"
#include "plumb/heightfield.h"

namespace plumb::inline PLUMB_ABI::detail {

class HeightfieldSurface final : public SurfaceSource {
 public:
  explicit HeightfieldSurface(const HeightfieldGeometry& field)
      : field_(field), cells_x_(field.samples_x() - 1), cells_z_(field.samples_z() - 1) {}

  [[nodiscard]] NumBox bounds() const;
  void triangle(std::uint32_t t, SurfaceTriangle& out) const;  // without its neighbours
  void complete(SurfaceTriangle& t) const override;
  [[nodiscard]] bool corner_allows(const SurfaceTriangle& t, int corner, NumVec n) const override;

  // visit(const SurfaceTriangle&), in ascending order, for those whose cells overlap the box.
  template <class Visit>
  void query(const NumBox& box, Visit&& visit) const {
    std::uint32_t i0, i1, k0, k1;
    if (!range(box.lower.x, box.upper.x, field_.spacing_x(), cells_x_, i0, i1) ||
        !range(box.lower.z, box.upper.z, field_.spacing_z(), cells_z_, k0, k1))
      return;
    SurfaceTriangle t;
    for (std::uint32_t k = k0; k <= k1; ++k) {
      for (std::uint32_t i = i0; i <= i1; ++i) {
        if (!cell_meets(i, k, box.lower.y, box.upper.y)) continue;
        for (std::uint32_t half = 0; half < 2; ++half) {
          triangle(2 * (k * cells_x_ + i) + half, t);
          visit(t);
        }
      }
    }
  }
  // Walks the cells under the segment in the order in which it passes them.
  template <class Visit>
  void cast_segment(NumVec origin, NumVec direction, Num max_fraction, Visit&& visit) const;
  // Rings of cells around the box, nearest first.
  template <class Visit>
  void nearest(const NumBox& box, Num largest, Visit&& visit) const;

 private:
  [[nodiscard]] NumVec sample(std::uint32_t i, std::uint32_t k) const {
    return {static_cast<Num>(i) * static_cast<Num>(field_.spacing_x()),
            static_cast<Num>(field_.height(i, k)),
            static_cast<Num>(k) * static_cast<Num>(field_.spacing_z())};
  }
  [[nodiscard]] bool is_solid(std::int64_t i, std::int64_t k) const {
    return i >= 0 && k >= 0 && i < cells_x_ && k < cells_z_ &&
           !field_.is_hole(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
  }
  // Whether cell (i, k) is no hole and reaches into [low, high] [m]. NaN fails every comparison.
  [[nodiscard]] bool cell_meets(std::uint32_t i, std::uint32_t k, Num low, Num high) const;
  static bool range(Num low, Num high, Real spacing, std::uint32_t cells, std::uint32_t& first,
                    std::uint32_t& last);
  static std::int64_t cell_at(Num x, Real spacing, std::uint32_t cells);
  [[nodiscard]] NumBox cell_box(std::uint32_t i, std::uint32_t k) const;

  const HeightfieldGeometry& field_;
  std::uint32_t cells_x_, cells_z_;
};

template <class Visit>
void HeightfieldSurface::cast_segment(NumVec origin, NumVec direction, Num max_fraction,
                                      Visit&& visit) const {
  const SegmentQuery ray(origin, direction);
  Num enter = 0;
  if (!ray.meets(bounds(), max_fraction, enter)) return;
  const NumVec start = origin + enter * direction;
  std::int64_t i = cell_at(start.x, field_.spacing_x(), cells_x_);
  std::int64_t k = cell_at(start.z, field_.spacing_z(), cells_z_);
  const int step_i = direction.x > Num(0) ? 1 : -1, step_k = direction.z > Num(0) ? 1 : -1;
  constexpr Num kNever = std::numeric_limits<Num>::infinity();
  // The fraction at which the segment crosses a line of the grid, computed from the line's number,
  // so that no error adds up along the way.
  const auto crossing = [&](std::int64_t cell, int step, Real spacing, Num from, Num d) {
    if (d == Num(0)) return kNever;
    const Num line = static_cast<Num>(cell + (step > 0 ? 1 : 0)) * static_cast<Num>(spacing);
    return (line - from) / d;
  };
  SurfaceTriangle t;
  Num largest = max_fraction;
  const auto look = [&](std::int64_t ci, std::int64_t ck) {
    if (!is_solid(ci, ck)) return;
    const std::uint32_t cell =
        static_cast<std::uint32_t>(ck) * cells_x_ + static_cast<std::uint32_t>(ci);
    for (std::uint32_t half = 0; half < 2; ++half) {
      triangle(2 * cell + half, t);
      largest = visit(t, largest);
    }
  };
  while (i >= 0 && k >= 0 && i < cells_x_ && k < cells_z_) {
    look(i, k);
    const Num next_x = crossing(i, step_i, field_.spacing_x(), origin.x, direction.x);
    const Num next_z = crossing(k, step_k, field_.spacing_z(), origin.z, direction.z);
    if (!(std::min(next_x, next_z) <= largest)) return;
    // Through a corner of the grid, to rounding: the two cells beside it count as passed.
    if (std::abs(next_x - next_z) <= Num(1e-12) * std::abs(next_x)) {
      look(i + step_i, k);
      look(i, k + step_k);
      i += step_i;
      k += step_k;
    } else if (next_x < next_z) {
      i += step_i;
    } else {
      k += step_k;
    }
  }
}

template <class Visit>
void HeightfieldSurface::nearest(const NumBox& box, Num largest, Visit&& visit) const {
  const std::int64_t i0 = cell_at(box.lower.x, field_.spacing_x(), cells_x_);
  const std::int64_t i1 = cell_at(box.upper.x, field_.spacing_x(), cells_x_);
  const std::int64_t k0 = cell_at(box.lower.z, field_.spacing_z(), cells_z_);
  const std::int64_t k1 = cell_at(box.upper.z, field_.spacing_z(), cells_z_);
  const Num spacing =
      std::min(static_cast<Num>(field_.spacing_x()), static_cast<Num>(field_.spacing_z()));
  SurfaceTriangle t;
  const auto look = [&](std::int64_t i, std::int64_t k) {
    if (!is_solid(i, k)) return;
    const auto ci = static_cast<std::uint32_t>(i), ck = static_cast<std::uint32_t>(k);
    if (squared_gap(cell_box(ci, ck), box) > largest) return;
    for (std::uint32_t half = 0; half < 2; ++half) {
      triangle(2 * (ck * cells_x_ + ci) + half, t);
      largest = visit(t, largest);
    }
  };
  const std::int64_t rings = std::max(cells_x_, cells_z_);
  for (std::int64_t ring = 0; ring <= rings; ++ring) {
    // Cells of this ring lie at least ring - 1 cells beside those under the box.
    const Num beside = static_cast<Num>(std::max<std::int64_t>(ring - 1, 0)) * spacing;
    if (beside * beside > largest) return;
    const std::int64_t low_k = k0 - ring, high_k = k1 + ring, low_i = i0 - ring, high_i = i1 + ring;
    for (std::int64_t k = std::max<std::int64_t>(low_k, 0);
         k <= std::min<std::int64_t>(high_k, cells_z_ - 1); ++k) {
      const bool whole = ring == 0 || k == low_k || k == high_k;
      if (whole) {
        for (std::int64_t i = std::max<std::int64_t>(low_i, 0);
             i <= std::min<std::int64_t>(high_i, cells_x_ - 1); ++i)
          look(i, k);
      } else {
        look(low_i, k);
        look(high_i, k);
      }
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
