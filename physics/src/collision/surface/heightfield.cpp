#include "plumb/heightfield.h"

#include <algorithm>
#include <cmath>

#include "collision/surface/heightfield_surface.h"
#include "math/eigen_bridge.h"

namespace plumb::inline PLUMB_ABI {

bool HeightfieldGeometry::is_hole(std::uint32_t i, std::uint32_t k) const {
  // NaN in the sum if and only if in one of the four: finite heights cannot overflow it.
  return std::isnan(height(i, k) + height(i + 1, k) + height(i, k + 1) + height(i + 1, k + 1));
}

HeightfieldGeometry::Result HeightfieldGeometry::create(std::uint32_t samples_x,
                                                        std::uint32_t samples_z, Real spacing_x,
                                                        Real spacing_z,
                                                        std::span<const Real> heights) {
  const auto bad = [](StatusCode code, const char* message) {
    return Result{nullptr, {code, message}};
  };
  if (samples_x < 2 || samples_z < 2)
    return bad(StatusCode::BadShape, "a heightfield needs at least 2 samples along x and z");
  if (static_cast<std::uint64_t>(samples_x) * samples_z != heights.size())
    return bad(StatusCode::BadShape,
               "a heightfield needs samples_x * samples_z heights, x running first");
  if (static_cast<std::uint64_t>(samples_x) * samples_z > detail::StaticBvh::kMaxItems)
    return bad(StatusCode::CapacityExceeded,
               "a heightfield may have at most 134217728 samples: cut it into several");
  if (!std::isfinite(spacing_x) || !std::isfinite(spacing_z))
    return bad(StatusCode::NotFinite, "a heightfield's spacing must be finite [m]");
  const detail::Num largest = std::max(static_cast<detail::Num>(spacing_x) * (samples_x - 1),
                                       static_cast<detail::Num>(spacing_z) * (samples_z - 1));
  const detail::Num smallest = static_cast<detail::Num>(std::min(spacing_x, spacing_z));
  if (!(smallest >= detail::kSmallestSize) || largest > detail::kLargestSize)
    return bad(StatusCode::OutOfRange,
               "a heightfield's spacing must be at least 1e-5 m and its length at most 1e6 m");
  for (const Real h : heights) {
    if (std::isinf(h))
      return bad(StatusCode::NotFinite, "a height must be finite, or NaN for a hole [m]");
    if (std::abs(static_cast<detail::Num>(h)) > detail::kLargestSize)
      return bad(StatusCode::OutOfRange, "heights must lie within +-1e6 m");
  }
  auto field = std::make_shared<HeightfieldGeometry>();
  field->samples_x_ = samples_x;
  field->samples_z_ = samples_z;
  field->spacing_x_ = spacing_x;
  field->spacing_z_ = spacing_z;
  field->heights_.assign(heights.begin(), heights.end());
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (std::uint32_t k = 0; k + 1 < samples_z; ++k) {
    for (std::uint32_t i = 0; i + 1 < samples_x; ++i) {
      if (field->is_hole(i, k)) {
        ++field->holes_;
        continue;
      }
      for (const Real h : {field->height(i, k), field->height(i + 1, k), field->height(i, k + 1),
                           field->height(i + 1, k + 1)}) {
        low = std::min(low, h);
        high = std::max(high, h);
      }
    }
  }
  if (!(low <= high)) return bad(StatusCode::BadShape, "every cell of the heightfield is a hole");
  field->lower_ = Vec3(0, low, 0);
  field->upper_ = Vec3(spacing_x * static_cast<Real>(samples_x - 1), high,
                       spacing_z * static_cast<Real>(samples_z - 1));
  return {std::move(field), {}};
}

namespace detail {

NumBox HeightfieldSurface::bounds() const {
  const NumVec last = sample(cells_x_, cells_z_);
  return {{0, static_cast<Num>(field_.lower().y()), 0},
          {last.x, static_cast<Num>(field_.upper().y()), last.z}};
}

std::int64_t HeightfieldSurface::cell_at(Num x, Real spacing, std::uint32_t cells) {
  const Num at = std::floor(x / static_cast<Num>(spacing));
  return static_cast<std::int64_t>(std::clamp(at, Num(0), static_cast<Num>(cells - 1)));
}

bool HeightfieldSurface::range(Num low, Num high, Real spacing, std::uint32_t cells,
                               std::uint32_t& first, std::uint32_t& last) {
  if (!(high >= Num(0)) || !(low <= static_cast<Num>(cells) * static_cast<Num>(spacing)))
    return false;
  // A cell whose border the box just touches counts: rounding must not lose it.
  const std::int64_t from = cell_at(low, spacing, cells), to = cell_at(high, spacing, cells);
  const bool on_line = low <= static_cast<Num>(from) * static_cast<Num>(spacing);
  first = static_cast<std::uint32_t>(std::max<std::int64_t>(from - (on_line ? 1 : 0), 0));
  last = static_cast<std::uint32_t>(to);
  return true;
}

NumBox HeightfieldSurface::cell_box(std::uint32_t i, std::uint32_t k) const {
  const NumVec a = sample(i, k), b = sample(i + 1, k), c = sample(i, k + 1),
               d = sample(i + 1, k + 1);
  return {min_each(min_each(a, b), min_each(c, d)), max_each(max_each(a, b), max_each(c, d))};
}

bool HeightfieldSurface::cell_meets(std::uint32_t i, std::uint32_t k, Num low, Num high) const {
  if (field_.is_hole(i, k)) return false;
  const NumBox box = cell_box(i, k);
  return box.lower.y <= high && box.upper.y >= low;
}

void HeightfieldSurface::triangle(std::uint32_t t, SurfaceTriangle& out) const {
  const std::uint32_t cell = t / 2, i = cell % cells_x_, k = cell / cells_x_;
  const bool second = t % 2 != 0;
  const std::uint32_t stride = field_.samples_x();
  const auto number = [stride](std::uint32_t a, std::uint32_t b) { return b * stride + a; };
  const NumVec p00 = sample(i, k), p11 = sample(i + 1, k + 1);
  const NumVec p01 = sample(i, k + 1), p10 = sample(i + 1, k);
  out.id = t;
  out.corner[0] = p00;
  out.corner[1] = second ? p11 : p01;
  out.corner[2] = second ? p10 : p11;
  out.corner_id[0] = number(i, k);
  out.corner_id[1] = second ? number(i + 1, k + 1) : number(i, k + 1);
  out.corner_id[2] = second ? number(i + 1, k) : number(i + 1, k + 1);
  out.normal = normalized_or(doubled_area(out.corner[0], out.corner[1], out.corner[2]), {0, 1, 0});
  out.offset = dot(out.normal, p00);
}

void HeightfieldSurface::complete(SurfaceTriangle& out) const {
  const std::uint32_t cell = out.id / 2, i = cell % cells_x_, k = cell / cells_x_;
  const bool second = out.id % 2 != 0;
  const std::uint32_t stride = field_.samples_x();
  const auto number = [stride](std::uint32_t a, std::uint32_t b) { return b * stride + a; };
  // Edges are named after the sample at their low end: 0 along z, 1 along x, 2 the diagonal.
  out.edge_id[0] = second ? 3 * number(i, k) + 2 : 3 * number(i, k);
  out.edge_id[1] = second ? 3 * number(i + 1, k) : 3 * number(i, k + 1) + 1;
  out.edge_id[2] = second ? 3 * number(i, k) + 1 : 3 * number(i, k) + 2;

  // The corner beyond each edge; an edge to a hole or to the outside is open.
  struct Beyond {
    bool solid;
    std::uint32_t i, k;
  };
  const std::int64_t ci = i, ck = k;
  const Beyond beyond[3] = {
      second ? Beyond{true, i, k + 1} : Beyond{is_solid(ci - 1, ck), i - 1, k},
      second ? Beyond{is_solid(ci + 1, ck), i + 2, k + 1}
             : Beyond{is_solid(ci, ck + 1), i + 1, k + 2},
      second ? Beyond{is_solid(ci, ck - 1), i, k - 1} : Beyond{true, i + 1, k}};
  const Num noise =
      kFlatUlps * static_cast<Num>(std::numeric_limits<Real>::epsilon()) *
      std::max({std::abs(out.corner[0].y), std::abs(out.corner[1].y), std::abs(out.corner[2].y)});
  for (int e = 0; e < 3; ++e) {
    out.beyond[e] = out.normal;
    out.kind[e] = EdgeKind::Open;
    if (!beyond[e].solid) continue;
    const NumVec v0 = out.corner[e], v1 = out.corner[(e + 1) % 3];
    const NumVec far = sample(beyond[e].i, beyond[e].k);
    out.beyond[e] = normalized_or(doubled_area(v1, v0, far), {0, 1, 0});
    out.kind[e] =
        kind_of_edge(v0, v1, out.normal, out.corner[(e + 2) % 3], out.beyond[e], far, noise);
  }
}

bool HeightfieldSurface::corner_allows(const SurfaceTriangle& t, int corner, NumVec n) const {
  const std::uint32_t number = t.corner_id[corner], stride = field_.samples_x();
  const std::int64_t i = number % stride, k = number / stride;
  const NumVec p = t.corner[corner];
  const auto rises = [&](std::int64_t a, std::int64_t b) {
    const NumVec d = sample(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)) - p;
    return dot(n, d) > kConeSlack * length(d);
  };
  bool open = false;
  const bool ne = is_solid(i, k), nw = is_solid(i - 1, k), se = is_solid(i, k - 1),
             sw = is_solid(i - 1, k - 1);
  open = !(ne && nw && se && sw);
  if (ne && (rises(i + 1, k) || rises(i + 1, k + 1) || rises(i, k + 1))) return false;
  if (nw && (rises(i - 1, k) || rises(i, k + 1))) return false;
  if (se && (rises(i + 1, k) || rises(i, k - 1))) return false;
  if (sw && (rises(i - 1, k) || rises(i - 1, k - 1) || rises(i, k - 1))) return false;
  return !open || dot(n, t.normal) >= -kConeSlack;
}

}  // namespace detail
}  // namespace plumb::inline PLUMB_ABI
