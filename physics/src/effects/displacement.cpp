#include "effects/displacement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/arc_tangent.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr double kPi = std::numbers::pi;

void add_second(Symmetric3<double>& sum, double s, NumVec r) {
  sum.xx += s * r.x * r.x;
  sum.yy += s * r.y * r.y;
  sum.zz += s * r.z * r.z;
  sum.xy += s * r.x * r.y;
  sum.xz += s * r.x * r.z;
  sum.yz += s * r.y * r.z;
}

// --- triangles -----------------------------------------------------------------------------------

class TriangleCut {
 public:
  TriangleCut(Displacement& out, NumVec n, double level, double fill)
      : out_(out), n_(n), level_(level), o_(level * n), fill_(fill) {}

  void add(const SurfaceTriangle& t) {
    const NumVec corner[3] = {t.a, t.b, t.c};
    double depth[3];
    int below = 0;
    for (int k = 0; k < 3; ++k) {
      depth[k] = level_ - dot(n_, corner[k]);
      if (depth[k] > 0) ++below;
    }
    if (below == 0) return;
    if (below == 3) {
      add_wet(t.a, t.b, t.c);
      return;
    }
    // Sutherland and Hodgman's clip of one triangle by one plane: three or four corners.
    NumVec wet[4];
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (depth[k] > 0) wet[count++] = corner[k];
      if ((depth[k] > 0) != (depth[next] > 0)) {
        const double s = depth[k] / (depth[k] - depth[next]);
        wet[count++] = corner[k] + s * (corner[next] - corner[k]);
      }
    }
    for (int k = 2; k < count; ++k) add_wet(wet[0], wet[k - 1], wet[k]);
  }

 private:
  void add_wet(NumVec a, NumVec b, NumVec c) {
    const NumVec p = a - o_, q = b - o_, r = c - o_;
    const double volume = fill_ * dot(p, cross(q, r)) / 6;
    out_.volume += volume;
    out_.first += volume * (o_ + 0.25 * (p + q + r));
    const double shadow = -0.5 * fill_ * dot(n_, cross(q - p, r - p));
    const auto flat = [&](NumVec v) { return v + (level_ - dot(n_, v)) * n_; };
    const NumVec u = flat(a), v = flat(b), w = flat(c), sum = u + v + w;
    out_.area += shadow;
    out_.line += (shadow / 3) * sum;
    for (const NumVec corner : {u, v, w, sum}) add_second(out_.line_second, shadow / 12, corner);
  }

  Displacement& out_;
  NumVec n_;
  double level_;
  NumVec o_;
  double fill_;
};

// --- balls ---------------------------------------------------------------------------------------

void add_disc(Displacement& out, NumVec center, NumVec n, double radius) {
  const double area = kPi * radius * radius;
  out.area += area;
  out.line += area * center;
  add_second(out.line_second, area, center);
  const double own = area * radius * radius / 4;  // about each diameter
  out.line_second.xx += own;
  out.line_second.yy += own;
  out.line_second.zz += own;
  add_second(out.line_second, -own, n);
}

// The cap of height t = r + depth of the centre: V = pi t^2 (r - t/3), its centre at
// 3/4 (2r - t)^2/(3r - t) below the ball's.
void add_ball(Displacement& out, const SurfaceBall& ball, NumVec n, double level) {
  const double r = ball.radius, depth = level - dot(n, ball.center);
  if (depth <= -r) return;
  const double t = std::min(2 * r, r + depth);
  const double volume = kPi * t * t * (r - t / 3);
  const double below = 0.75 * (2 * r - t) * (2 * r - t) / (3 * r - t);
  out.volume += volume;
  out.first += volume * (ball.center - below * n);
  if (depth < r)
    add_disc(out, ball.center + depth * n, n, std::sqrt(std::max(0.0, r * r - depth * depth)));
}

template <int N>
void sort_few(double (&a)[N]) {  // insertion
  for (int i = 1; i < N; ++i)
    for (int k = i; k > 0 && a[k] < a[k - 1]; --k) std::swap(a[k], a[k - 1]);
}

// --- figures of revolution -----------------------------------------------------------------------

class RoundCut {
 public:
  RoundCut(Displacement& out, const SurfaceRound& round, NumVec n, double level)
      : out_(out), round_(round), n_(n), along_(dot(n, round.axis)) {
    const NumVec down = along_ * round.axis - n;  // across the axis, towards the depth
    slope_ = length(down);
    down_ = slope_ > 1e-9 ? (1 / slope_) * down : NumVec{0, 0, 0};
    if (!(slope_ > 1e-9)) slope_ = 0;
    depth_ = level - dot(n, round.center);
  }

  void add() {
    const auto& p = round_.profile;
    const double low = p[0].y - round_.rounding, high = p[1].y + round_.rounding;
    if (slope_ == 0) {
      add_upright(low, high);
      return;
    }
    double breaks[6] = {low, p[0].y, p[1].y, high, high, high};
    if (round_.rounding > 0) {  // where the arcs end and the slanted side begins
      const double dr = p[0].r - p[1].r, dy = p[1].y - p[0].y;
      const double shift = round_.rounding * dr / std::sqrt(dr * dr + dy * dy);
      breaks[4] = std::clamp(p[0].y + shift, low, high);
      breaks[5] = std::clamp(p[1].y + shift, low, high);
    }
    sort_few(breaks);
    for (int k = 0; k < 5; ++k) add_smooth_piece(breaks[k], breaks[k + 1]);
  }

 private:
  // Radius of the slice at y: the largest that any arc or the side reaches there.
  [[nodiscard]] double radius(double y) const {
    const auto& p = round_.profile;
    const double grown = round_.rounding;
    double r = 0;
    for (const auto& corner : p) {
      const double off = y - corner.y;
      if (std::abs(off) <= grown) r = std::max(r, corner.r + std::sqrt(grown * grown - off * off));
    }
    const double dr = p[1].r - p[0].r, dy = p[1].y - p[0].y;
    const double side = std::sqrt(dr * dr + dy * dy);
    const double out_r = grown * dy / side, out_y = -grown * dr / side;
    const double t = (y - p[0].y - out_y) / dy;
    if (t >= 0 && t <= 1) r = std::max(r, p[0].r + t * dr + out_r);
    return r;
  }
  // How far the chord lies from the slice's centre, away from the depth.
  [[nodiscard]] double chord(double y) const { return (depth_ - along_ * y) / slope_; }

  // Between the places where the waterline enters or leaves the slices.
  void add_smooth_piece(double from, double to) {
    constexpr int kLooks = 8;
    if (!(to > from)) return;
    double last = from;
    const auto state = [&](double y) {
      const double t = chord(y), r = radius(y);
      return t >= r ? 1 : (t <= -r ? -1 : 0);
    };
    double left = from;
    for (int k = 1; k <= kLooks; ++k) {
      const double right = from + (to - from) * k / kLooks;
      const double inset = 1e-9 * (to - from);
      if (const int before = state(left + inset); before != state(right - inset)) {
        double a = left + inset, b = right - inset;
        for (int halving = 0; halving < 45; ++halving) {
          const double middle = 0.5 * (a + b);
          (state(middle) == before ? a : b) = middle;
        }
        add_slices(last, a);
        last = a;
      }
      left = right;
    }
    add_slices(last, to);
  }

  // Gauss's eight points; ends are approached quadratically, where radii go as square roots.
  void add_slices(double from, double to) {
    static constexpr double kPlace[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
    static constexpr double kWeight[4] = {0.3626837833783620, 0.3137066458778873,
                                          0.2223810344533745, 0.1012285362903763};
    const double half = 0.5 * (to - from), middle = 0.5 * (from + to);
    if (!(half > 0)) return;
    for (int k = 0; k < 4; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const double u = side * kPlace[k];  // y = middle + half (3u - u^3)/2
        const double y = middle + half * (1.5 * u - 0.5 * u * u * u);
        add_slice(y, kWeight[k] * half * 1.5 * (1 - u * u));
      }
    }
  }

  void add_slice(double y, double thickness) {
    const double r = radius(y), t = chord(y);
    const NumVec center = round_.center + y * round_.axis;
    if (t <= -r) return;
    if (t >= r) {
      const double volume = thickness * kPi * r * r;
      out_.volume += volume;
      out_.first += volume * center;
      return;
    }
    const double root = std::sqrt(std::max(0.0, r * r - t * t));
    const double area = r * r * (kPi - arc_tangent(root, t)) + t * root;
    const double moment = 2.0 / 3 * root * root * root;
    out_.volume += thickness * area;
    out_.first += thickness * (area * center + moment * down_);
    const double width = thickness / slope_;
    const NumVec on_line = center - t * down_, across = cross(round_.axis, down_);
    out_.area += 2 * root * width;
    out_.line += (2 * root * width) * on_line;
    add_second(out_.line_second, 2 * root * width, on_line);
    add_second(out_.line_second, 2.0 / 3 * root * root * root * width, across);
  }

  void add_upright(double low, double high) {
    const double at = along_ > 0 ? depth_ : -depth_;  // of the plane on the axis
    const bool below = along_ > 0;                    // the part with smaller y is wet
    const double cut = std::clamp(at, low, high);
    double breaks[5] = {low, round_.profile[0].y, round_.profile[1].y, high, cut};
    sort_few(breaks);
    slope_ = 1;
    for (int k = 0; k < 4; ++k) {
      if (below ? breaks[k] >= cut : breaks[k + 1] <= cut) continue;
      constexpr double kEverywhere = 1e300;
      const double depth = depth_, along = along_;
      depth_ = kEverywhere;
      along_ = 0;
      add_slices(breaks[k], breaks[k + 1]);
      depth_ = depth;
      along_ = along;
    }
    slope_ = 0;
    if (at > low && at < high) add_disc(out_, round_.center + at * round_.axis, n_, radius(at));
  }

  Displacement& out_;
  const SurfaceRound& round_;
  NumVec n_, down_{0, 0, 0};
  double along_, slope_ = 0, depth_ = 0;
};

}  // namespace

Displacement displaced_below(const BodySurface& surface, NumVec normal, double level) {
  Displacement out;
  for (const SurfaceSolid& solid : surface.solids) {
    TriangleCut cut(out, normal, level, solid.fill);
    for (std::uint32_t i = solid.begin; i < solid.end; ++i) cut.add(surface.triangles[i]);
  }
  for (const SurfaceBall& ball : surface.balls) add_ball(out, ball, normal, level);
  for (const SurfaceRound& round : surface.rounds) RoundCut(out, round, normal, level).add();
  return out;
}

}  // namespace plumb::inline PLUMB_ABI::detail
