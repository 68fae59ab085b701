// The search of axes_kernel.h over vectors of PLUMB_VECTOR_BITS; included by one file per length.
#include "collision/axes_kernel.h"
// Not before the shared header, not after the others.
#include "math/wide_abi.h"
//
#include "collision/collision_tolerances.h"
#include "math/wide.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

namespace shared = plumb::PLUMB_SHARED_ABI::detail;
using shared::EdgeLanes;
using shared::EdgesAxis;
using shared::FaceAxis;
using shared::PolyhedronLanes;

constexpr int kWidth = PLUMB_VECTOR_BITS / 64;
using Number = Wide<Num, kWidth>;
using Vector = Vector3<Number>;

Number read(const Num* from) {
  Number out;
  std::memcpy(&out.v, from, sizeof out.v);
  return out;
}
Vector read(const Num* x, const Num* y, const Num* z, int i) {
  return {read(x + i), read(y + i), read(z + i)};
}
Vector all_lanes(NumVec a) { return {Number(a.x), Number(a.y), Number(a.z)}; }

template <class Which>
Num best_lane(Number a, Which&& which) {
  Num best = a.v[0];
  for (int i = 1; i < kWidth; ++i) best = which(best, static_cast<Num>(a.v[i]));
  return best;
}

// [m] the smallest n . x over the corners. The sum makes one zero of both.
Num lowest_along(const PolyhedronLanes& p, NumVec n) {
  const Vector d = all_lanes(n);
  Number lowest = dot(read(p.x, p.y, p.z, 0), d);
  for (int i = kWidth; i < p.vertex_count; i += kWidth)
    lowest = smaller_of(lowest, dot(read(p.x, p.y, p.z, i), d));
  return best_lane(lowest, [](Num a, Num b) { return b < a ? b : a; }) + Num(0);
}

NumVec normal(const PolyhedronLanes& p, int k) {
  return {p.normal_x[k], p.normal_y[k], p.normal_z[k]};
}

// Along a face's normal q starts no farther out than its ball: most faces are passed over by that.
FaceAxis best_face(const PolyhedronLanes& p, const PolyhedronLanes& q, Num floor) {
  const Vector centre = all_lanes({q.centre_x, q.centre_y, q.centre_z});
  const Number radius(q.inner_radius);
  Num bounds[shared::filled_up(kMaxHullFaces)];
  Number highest(-std::numeric_limits<Num>::infinity());
  for (int k = 0; k < p.face_count; k += kWidth) {
    const Number bound =
        dot(read(p.normal_x, p.normal_y, p.normal_z, k), centre) - read(p.offset + k) - radius;
    std::memcpy(bounds + k, &bound.v, sizeof bound.v);
    highest = larger_of(highest, bound);
  }
  const Num most = best_lane(highest, [](Num a, Num b) { return a < b ? b : a; });
  int start = 0;
  while (start + 1 < p.face_count && bounds[start] < most) ++start;
  FaceAxis best{lowest_along(q, normal(p, start)) - p.offset[start], start};
  for (int k = 0; k < p.face_count; k += kWidth) {
    const Number limit(best.separation < floor ? floor : best.separation);
    for (std::uint32_t left = bits_of(read(bounds + k) > limit); left != 0; left &= left - 1) {
      const int face = k + __builtin_ctz(left);
      if (face == start || !(bounds[face] > best.separation)) continue;
      const Num s = lowest_along(q, normal(p, face)) - p.offset[face];
      if (s > best.separation) best = {s, face};
    }
  }
  return best;
}

// An edge of A against several of B. The arc of an edge on the Gauss map runs between the normals
// of its faces; two edges touch along a direction where that of A and the mirrored one of B cross:
// where the ends of each lie on both sides of the other.
class EdgeOfA {
 public:
  EdgeOfA(const EdgeLanes& a, int i)
      : start_{all_lanes({a.x[i], a.y[i], a.z[i]})},
        along_{all_lanes({a.along_x[i], a.along_y[i], a.along_z[i]})},
        normal_a_{all_lanes({a.a_x[i], a.a_y[i], a.a_z[i]})},
        normal_b_{all_lanes({a.b_x[i], a.b_y[i], a.b_z[i]})},
        slight_(Number(kParallelSine * kParallelSine) * length_squared(along_)) {}

  // How far the shapes are apart across both edges [m]; lanes whose arcs do not cross, and those
  // that do not separate by more than `floor`, are left out of `which`.
  Number separation(const EdgeLanes& b, int k, Number floor, std::uint32_t& which) const {
    which = 0;
    const Vector b_a = read(b.a_x, b.a_y, b.a_z, k), b_b = read(b.b_x, b.b_y, b.b_z, k);
    const Number side_a = -dot(b_a, along_), side_b = -dot(b_b, along_);
    auto cross_here = side_a * side_b < Number(Num(0));
    if (!any(cross_here)) return floor;
    const Vector along = read(b.along_x, b.along_y, b.along_z, k);
    const Number of_a = dot(normal_a_, along), of_b = dot(normal_b_, along);
    cross_here &= of_a * of_b < Number(Num(0));
    cross_here &= side_a * of_b > Number(Num(0));
    if (!any(cross_here)) return floor;
    const Vector across = cross(along_, along);
    const Number squared = length_squared(across);
    cross_here &= squared > slight_ * length_squared(along);
    const Number raw = dot(across, read(b.x, b.y, b.z, k) - start_);
    const auto turned = dot(across, normal_a_ + normal_b_) < Number(Num(0));
    const Number s = select(turned, -raw, raw) / root_of(squared);
    which = bits_of(cross_here & (s > floor));
    return s;
  }

 private:
  Vector start_, along_, normal_a_, normal_b_;
  Number slight_;
};

EdgesAxis best_edges(const EdgeLanes& a, const EdgeLanes& b, Num floor) {
  EdgesAxis best{floor, -1, -1};
  for (int i = 0; i < a.count; ++i) {
    const EdgeOfA edge(a, i);
    for (int k = 0; k < b.count; k += kWidth) {
      std::uint32_t left = 0;
      const Number s = edge.separation(b, k, Number(best.separation), left);
      for (; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (s.v[lane] > best.separation) best = {s.v[lane], i, k + lane};
      }
    }
  }
  return best;
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI::detail

namespace plumb::inline PLUMB_SHARED_ABI::detail {

AxesKernel PLUMB_JOIN(axes_kernel_, PLUMB_VECTOR_BITS, )() {
  namespace here = plumb::PLUMB_ABI::detail;
  return {here::best_face, here::best_edges};
}

}  // namespace plumb::inline PLUMB_SHARED_ABI::detail
