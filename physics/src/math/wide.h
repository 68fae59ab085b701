// W numbers side by side, each with its own rounding: what is written for one number also serves
// for W of them, with the same bits in every lane.
//
// Only + - * / sqrt, comparison and selection: operations that IEEE 754 rounds in one way only.
// Code that shall run wide chooses with select() where it would branch, and asks any() or all()
// before it leaves something out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "math/choose.h"

namespace plumb::inline PLUMB_ABI::detail {

template <class R, int W>
struct Lanes {
  typedef R Reals __attribute__((vector_size(W * sizeof(R))));
  using Integer = std::conditional_t<sizeof(R) == 4, std::int32_t, std::int64_t>;
  typedef Integer Bits __attribute__((vector_size(W * sizeof(R))));
};

template <class R, int W>
struct WideMask {
  typename Lanes<R, W>::Bits bits;  // all ones or all zeros in each lane
};
template <class R, int W>
WideMask<R, W> operator&(WideMask<R, W> a, WideMask<R, W> b) {
  return {a.bits & b.bits};
}
template <class R, int W>
WideMask<R, W> operator|(WideMask<R, W> a, WideMask<R, W> b) {
  return {a.bits | b.bits};
}
template <class R, int W>
WideMask<R, W>& operator&=(WideMask<R, W>& a, WideMask<R, W> b) {
  return a = a & b;
}
template <class R, int W>
WideMask<R, W> negate(WideMask<R, W> a) {
  return {~a.bits};
}
// Bit i: lane i.
template <class R, int W>
std::uint32_t bits_of(WideMask<R, W> a) {
#if defined(__AVX__)
  if constexpr (W * sizeof(R) == 32 && sizeof(R) == 4)
    return static_cast<std::uint32_t>(_mm256_movemask_ps((__m256)a.bits));
  if constexpr (W * sizeof(R) == 32 && sizeof(R) == 8)
    return static_cast<std::uint32_t>(_mm256_movemask_pd((__m256d)a.bits));
#endif
#if defined(__SSE2__)
  if constexpr (W * sizeof(R) == 16 && sizeof(R) == 4)
    return static_cast<std::uint32_t>(_mm_movemask_ps((__m128)a.bits));
  if constexpr (W * sizeof(R) == 16 && sizeof(R) == 8)
    return static_cast<std::uint32_t>(_mm_movemask_pd((__m128d)a.bits));
#endif
#if defined(__AVX512DQ__)
  if constexpr (W * sizeof(R) == 64 && sizeof(R) == 4)
    return static_cast<std::uint32_t>(_mm512_movepi32_mask((__m512i)a.bits));
  if constexpr (W * sizeof(R) == 64 && sizeof(R) == 8)
    return static_cast<std::uint32_t>(_mm512_movepi64_mask((__m512i)a.bits));
#endif
  std::uint32_t out = 0;
  for (int i = 0; i < W; ++i) out |= (a.bits[i] != 0 ? 1u : 0u) << i;
  return out;
}
template <class R, int W>
bool any(WideMask<R, W> a) {
  return bits_of(a) != 0;
}
template <class R, int W>
bool all(WideMask<R, W> a) {
  return bits_of(a) == (1u << W) - 1u;
}

template <class R, int W>
struct Wide {
  typename Lanes<R, W>::Reals v;
  Wide() = default;
  Wide(R all) : v(all - typename Lanes<R, W>::Reals{}) {}  // NOLINT: as a plain number would
  explicit Wide(typename Lanes<R, W>::Reals lanes) : v(lanes) {}
};

template <class R, int W>
struct MaskFor<Wide<R, W>> {
  using Type = WideMask<R, W>;
};

template <class R, int W>
Wide<R, W> operator+(Wide<R, W> a, Wide<R, W> b) {
  return Wide<R, W>(a.v + b.v);
}
template <class R, int W>
Wide<R, W> operator-(Wide<R, W> a, Wide<R, W> b) {
  return Wide<R, W>(a.v - b.v);
}
template <class R, int W>
Wide<R, W> operator*(Wide<R, W> a, Wide<R, W> b) {
  return Wide<R, W>(a.v * b.v);
}
template <class R, int W>
Wide<R, W> operator/(Wide<R, W> a, Wide<R, W> b) {
  return Wide<R, W>(a.v / b.v);
}
template <class R, int W>
Wide<R, W> operator-(Wide<R, W> a) {
  return Wide<R, W>(-a.v);
}
template <class R, int W>
Wide<R, W>& operator+=(Wide<R, W>& a, Wide<R, W> b) {
  return a = a + b;
}
template <class R, int W>
Wide<R, W>& operator-=(Wide<R, W>& a, Wide<R, W> b) {
  return a = a - b;
}
template <class R, int W>
WideMask<R, W> operator<(Wide<R, W> a, Wide<R, W> b) {
  return {(typename Lanes<R, W>::Bits)(a.v < b.v)};
}
template <class R, int W>
WideMask<R, W> operator>(Wide<R, W> a, Wide<R, W> b) {
  return {(typename Lanes<R, W>::Bits)(a.v > b.v)};
}
template <class R, int W>
Wide<R, W> select(WideMask<R, W> condition, Wide<R, W> yes, Wide<R, W> no) {
  return Wide<R, W>(condition.bits ? yes.v : no.v);
}

template <class R, int W>
Wide<R, W> root_of(Wide<R, W> a) {
#if defined(__AVX512F__)
  if constexpr (W * sizeof(R) == 64 && sizeof(R) == 4)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm512_maskz_sqrt_ps(0xffff, (__m512)a.v));
  if constexpr (W * sizeof(R) == 64 && sizeof(R) == 8)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v));
#endif
#if defined(__AVX__)
  if constexpr (W * sizeof(R) == 32 && sizeof(R) == 4)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm256_sqrt_ps((__m256)a.v));
  if constexpr (W * sizeof(R) == 32 && sizeof(R) == 8)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm256_sqrt_pd((__m256d)a.v));
#endif
#if defined(__SSE2__)
  if constexpr (W * sizeof(R) == 16 && sizeof(R) == 4)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm_sqrt_ps((__m128)a.v));
  if constexpr (W * sizeof(R) == 16 && sizeof(R) == 8)
    return Wide<R, W>((typename Lanes<R, W>::Reals)_mm_sqrt_pd((__m128d)a.v));
#endif
  for (int i = 0; i < W; ++i) a.v[i] = std::sqrt(a.v[i]);
  return a;
}

// --- records to lanes and back -------------------------------------------------------------------

// Four numbers from each of W records, turned so that each of the four becomes one Wide. Where the
// four of lane i begin is told by at(i).
template <class R, int W>
struct Quad {
  Wide<R, W> x, y, z, w;
};

namespace quads {

template <class V, int W, class Pattern>
V shuffle(V a, V b, Pattern pattern) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return __builtin_shufflevector(a, b, pattern(static_cast<int>(I))...);
  }(std::make_index_sequence<static_cast<std::size_t>(W)>());
}

// In every group of four lanes: four rows of four become four columns, and back.
template <class R, int W>
void transpose(typename Lanes<R, W>::Reals (&r)[4]) {
  using V = typename Lanes<R, W>::Reals;
  constexpr auto low = [](int i) constexpr { return i / 4 * 4 + i % 4 / 2 + i % 2 * W; };
  constexpr auto high = [](int i) constexpr { return i / 4 * 4 + 2 + i % 4 / 2 + i % 2 * W; };
  constexpr auto first = [](int i) constexpr { return i / 4 * 4 + i % 2 + i % 4 / 2 * W; };
  constexpr auto second = [](int i) constexpr { return i / 4 * 4 + 2 + i % 2 + i % 4 / 2 * W; };
  const V t0 = shuffle<V, W>(r[0], r[1], low), t1 = shuffle<V, W>(r[0], r[1], high);
  const V t2 = shuffle<V, W>(r[2], r[3], low), t3 = shuffle<V, W>(r[2], r[3], high);
  r[0] = shuffle<V, W>(t0, t2, first);
  r[1] = shuffle<V, W>(t0, t2, second);
  r[2] = shuffle<V, W>(t1, t3, first);
  r[3] = shuffle<V, W>(t1, t3, second);
}

template <class R>
typename Lanes<R, 4>::Reals load(const R* from) {
  typename Lanes<R, 4>::Reals v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
// The quads of lanes k, k + 4, k + 8 ... behind one another.
template <class R, int W, class At>
typename Lanes<R, W>::Reals row(At& at, int k) {
  if constexpr (W == 4) {
    return load<R>(at(k));
  } else {
    const auto a = row<R, W / 2>(at, k), b = row<R, W / 2>(at, k + W / 2);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return __builtin_shufflevector(a, b, static_cast<int>(I)...);
    }(std::make_index_sequence<static_cast<std::size_t>(W)>());
  }
}
// Lanes 4 Group to 4 Group + 3.
template <class R, int W, int Group>
void store(const typename Lanes<R, W>::Reals& v, R* to) {
  const typename Lanes<R, 4>::Reals four =
      __builtin_shufflevector(v, v, 4 * Group, 4 * Group + 1, 4 * Group + 2, 4 * Group + 3);
  std::memcpy(to, &four, sizeof four);
}

}  // namespace quads

template <class R, int W, class At>
Quad<R, W> read_quad(At at) {
  Quad<R, W> out;
  if constexpr (W >= 4) {
    typename Lanes<R, W>::Reals r[4];
    for (int k = 0; k < 4; ++k) r[k] = quads::row<R, W>(at, k);
    quads::transpose<R, W>(r);
    out = {Wide<R, W>(r[0]), Wide<R, W>(r[1]), Wide<R, W>(r[2]), Wide<R, W>(r[3])};
  } else {
    for (int i = 0; i < W; ++i) {
      const R* record = at(i);
      out.x.v[i] = record[0];
      out.y.v[i] = record[1];
      out.z.v[i] = record[2];
      out.w.v[i] = record[3];
    }
  }
  return out;
}
// Writes the records whose bit is set in `which`.
template <class R, int W, class At>
void write_some(const Quad<R, W>& in, At at, std::uint32_t which) {
  if constexpr (W >= 4) {
    typename Lanes<R, W>::Reals r[4] = {in.x.v, in.y.v, in.z.v, in.w.v};
    quads::transpose<R, W>(r);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const auto put = [&]<int i>() {
        if ((which >> i & 1u) != 0) quads::store<R, W, i / 4>(r[i % 4], at(i));
      };
      (put.template operator()<static_cast<int>(I)>(), ...);
    }(std::make_index_sequence<static_cast<std::size_t>(W)>());
  } else {
    for (int i = 0; i < W; ++i) {
      if ((which >> i & 1u) == 0) continue;
      R* record = at(i);
      record[0] = in.x.v[i];
      record[1] = in.y.v[i];
      record[2] = in.z.v[i];
      record[3] = in.w.v[i];
    }
  }
}

template <class R, int W, class At>
void write_quad(const Quad<R, W>& in, At at, std::uint32_t which) {
  constexpr std::uint32_t kAll = (1u << W) - 1u;
  // Most often all of them: no question per record then.
  if (which == kAll) {
    write_some(in, at, kAll);
  } else {
    write_some(in, at, which);
  }
}

// Record i begins at base + index[i] * stride.
template <class R, int W>
Quad<R, W> gather_quad(const R* base, std::size_t stride, const std::uint32_t* index) {
  return read_quad<R, W>([=](int i) { return base + index[i] * stride; });
}
// One loop with one question, unlike write_quad: which records are written differs from call to
// call, and a question at sixteen places is guessed wrong more often.
template <class R, int W>
void scatter_quad(const Quad<R, W>& in, R* base, std::size_t stride, const std::uint32_t* index,
                  std::uint32_t which) {
  if constexpr (W >= 4) {
    typename Lanes<R, W>::Reals r[4] = {in.x.v, in.y.v, in.z.v, in.w.v};
    quads::transpose<R, W>(r);
    for (int i = 0; i < W; ++i)
      if ((which >> i & 1u) != 0)
        std::memcpy(base + index[i] * stride, reinterpret_cast<const R*>(&r[i % 4]) + i / 4 * 4,
                    4 * sizeof(R));
  } else {
    write_some(
        in, [=](int i) { return base + index[i] * stride; }, which);
  }
}

// Records behind one another, from `base` on.
template <class R, int W>
Quad<R, W> read_run(const R* base, std::size_t stride) {
  return read_quad<R, W>([=](int i) { return base + static_cast<std::size_t>(i) * stride; });
}
template <class R, int W>
void write_run(const Quad<R, W>& in, R* base, std::size_t stride, std::uint32_t which) {
  write_quad(
      in, [=](int i) { return base + static_cast<std::size_t>(i) * stride; }, which);
}

}  // namespace plumb::inline PLUMB_ABI::detail
