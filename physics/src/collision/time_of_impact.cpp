#include "collision/time_of_impact.h"

#include <limits>
#include <vector>

#include "collision/core_support.h"
#include "collision/gjk.h"
#include "collision/shape_gap.h"
#include "collision/surface/composite_shape.h"
#include "collision/surface/heightfield_surface.h"
#include "collision/surface/mesh_surface.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Advances of one search [-]. A few serve almost always; a blade that grazes while it turns many
// times needs the most. What is not decided then is reported as met, which is safe.
constexpr int kMaxAdvances = 256;
// Evaluations in the search for the largest certified advance [-]: each halves the error or better.
constexpr int kRootSteps = 12;
// The root is near enough when the interval around it is this part of the advance [-].
constexpr Num kRootWidth = 0.02;
// What an advance leaves of the tolerance [-].
constexpr Num kAimedRoom = 0.125;
// An axis serves again while an advance along it leaves more than this part of the room [-].
constexpr Num kKeepAxis = 0.25;

// A point deep inside of a shape, in its frame.
NumVec middle_of(const CollisionShape& shape) {
  return shape.type == ShapeType::Hull ? to_num(shape.hull->interior_point()) : NumVec{0, 0, 0};
}

// A shape in motion, evaluated at one time.
class Mover {
 public:
  explicit Mover(const SweptShape& swept) : swept_(swept) {
    const CollisionShape& shape = swept.shape;
    radius_ = swept.scale * static_cast<Num>(shape.radius);
    if (is_plane()) return;
    if (swept.triangle != nullptr) {
      radius_ = 0;
      for (const NumVec& v : swept.triangle->corner) core_size_ = std::max(core_size_, length(v));
    } else {
      core_size_ = static_cast<Num>(bounding_radius(shape) - shape.radius);
    }
    const Num offset = length(swept.p);
    // Half a rounding of single precision must not make a point out of a sphere's centre.
    reach_ = offset + std::max(core_size_, Num(0));
    if (!(reach_ > Num(0))) return;
    spin_ = swept.sweep.fastest_spin();
    if (!swept.sweep.tumbles && spin_ > Num(0)) reach_ = reach_from_axis();
  }

  void place(Num t) {
    const Sweep& sweep = swept_.sweep;
    const NumRotation body = sweep.rotation_at(t);
    q_ = normalized(body * swept_.q);
    rows_ = to_matrix(q_);
    centre_ = sweep.centre_at(t);
    arm_ = rotate(body, swept_.p);
    velocity_ = sweep.velocity_at(t);
    w_ = reach_ > Num(0) ? sweep.spin_at(body) : NumVec{0, 0, 0};
  }

  [[nodiscard]] bool is_plane() const { return swept_.shape.type == ShapeType::HalfSpace; }
  [[nodiscard]] const CollisionShape& shape() const { return swept_.shape; }
  [[nodiscard]] Num plane_offset(NumVec n) const {
    return dot(n, origin()) + static_cast<Num>(swept_.shape.offset);
  }
  [[nodiscard]] NumVec origin() const { return centre_ + arm_; }
  [[nodiscard]] NumVec centre() const { return centre_; }
  [[nodiscard]] NumRotation rotation() const { return q_; }
  // Farthest point of the core, from the body's centre.
  [[nodiscard]] NumVec from_centre(NumVec d) const {
    return rows_ * local_support(transpose_times(rows_, d)) + arm_;
  }
  [[nodiscard]] bool is_triangle() const { return swept_.triangle != nullptr; }
  // Of a triangle, in the world.
  [[nodiscard]] NumVec front() const { return rows_ * swept_.triangle->normal; }
  [[nodiscard]] Num radius() const { return radius_; }
  [[nodiscard]] Num core_size() const { return std::max(core_size_, Num(0)); }

  // At least the largest n . x over the shape after a further time u.
  [[nodiscard]] Num highest_after(NumVec n, Num u) const {
    if (is_plane()) return plane_offset(n);
    const NumVec across = cross(n, w_);
    const NumVec m = n + u * across;
    const Num path = dot(n, centre_) + u * dot(n, velocity_) +
                     u * u * std::max(dot(n, swept_.sweep.bend), Num(0));
    return path + dot(m, from_centre(m)) + Num(0.5) * u * u * curvature(across) + radius_;
  }
  // The same from the ball about the centre that holds the shape however it turns.
  [[nodiscard]] Num ball_after(NumVec n, Num u) const {
    return dot(n, centre_) + u * dot(n, velocity_) +
           u * u * std::max(dot(n, swept_.sweep.bend), Num(0)) + ball();
  }
  [[nodiscard]] Num ball() const {
    return length(swept_.p) + std::max(core_size_, Num(0)) + radius_;
  }

 private:
  // Bound of |n . x''| that rotation brings, for all later times.
  [[nodiscard]] Num curvature(NumVec across) const {
    // A free top: x'' = w x (w x r) + w' x r with w' = -I^-1 (w x L), |I^-1 L| the largest spin.
    if (swept_.sweep.tumbles) return Num(2) * spin_ * spin_ * reach_;
    return spin_ * length(across) * reach_;
  }
  // Largest distance of a point of the core from the axis of the turn (or a little more).
  [[nodiscard]] Num reach_from_axis() const {
    const NumRotation q0 = swept_.sweep.start;
    const NumVec axis = rotate(conjugate(q0), (Num(1) / spin_) * swept_.sweep.turn);  // body axes
    NumVec t1, t2;
    tangent_frame(axis, t1, t2);
    const NumMatrix rows = to_matrix(normalized(swept_.q));
    const auto extent = [&](NumVec d) {
      const NumVec local = transpose_times(rows, d);
      const Num middle = dot(d, swept_.p);
      return std::max(std::abs(middle + dot(local, local_support(local))),
                      std::abs(middle + dot(local, local_support(-local))));
    };
    const Num e1 = extent(t1), e2 = extent(t2);
    return std::min(reach_, std::sqrt(e1 * e1 + e2 * e2));
  }

  [[nodiscard]] NumVec local_support(NumVec d) const {
    if (swept_.triangle == nullptr) {
      const NumVec farthest = core_support(swept_.shape, d);
      if (swept_.scale == Num(1)) return farthest;
      const NumVec middle = middle_of(swept_.shape);
      return middle + swept_.scale * (farthest - middle);
    }
    const NumVec* corner = swept_.triangle->corner;
    const Num a = dot(corner[0], d), b = dot(corner[1], d), c = dot(corner[2], d);
    return corner[a >= b ? (a >= c ? 0 : 2) : (b >= c ? 1 : 2)];
  }

  const SweptShape& swept_;
  Num radius_ = 0, core_size_ = 0, reach_ = 0, spin_ = 0;
  NumRotation q_{0, 0, 0, 1};
  NumMatrix rows_{};
  NumVec centre_{}, arm_{}, velocity_{}, w_{};
};

struct Look {
  Num distance;  // [m] signed
  NumVec normal, point;
};

class Search {
 public:
  Search(const SweptShape& a, const SweptShape& b, const ImpactSearch& search)
      : a_(a), b_(b), search_(search) {}

  Impact run() {
    Num t = search_.begin;
    Num goal = search_.separation;
    place(t);
    guess_ = b_.origin() - a_.origin();
    Look look = look_now();
    result_.first_distance = look.distance;
    result_.first_normal = look.normal;
    result_.first_point = look.point;
    if (look.distance < search_.touching) {
      result_.touched = true;
      goal = search_.allowance > Num(0) ? std::min(look.distance - Num(2) * search_.tolerance,
                                                   search_.separation - search_.allowance)
                                        : std::min(look.distance, search_.separation);
    }
    while (result_.advances < kMaxAdvances) {
      if (result_.touched && goal < search_.separation &&
          look.distance > search_.touching + search_.tolerance)
        goal = search_.separation;  // they have parted: from now on like any other pair
      if (look.distance <= goal + search_.tolerance) {
        const bool deepens = search_.allowance > Num(0) && goal < search_.separation;
        return report(deepens ? ImpactStatus::Deepens : ImpactStatus::Meets, t, look);
      }
      if (!(t < search_.end)) return report(ImpactStatus::Apart, search_.end, look);
      const Num before = look.distance - goal;
      // Along one axis as far as it serves.
      while (result_.advances < kMaxAdvances) {
        const Num u = certified_advance(look.normal, goal, search_.end - t);
        ++result_.advances;
        const Num next = u < search_.end - t ? t + u : search_.end;
        if (!(next > t)) return report(ImpactStatus::Unfinished, t, look);
        t = next;
        place(t);
        if (!(t < search_.end)) break;
        const Num room = room_along(look.normal);
        if (!(room - goal > std::max(kKeepAxis * before, search_.tolerance))) break;
      }
      if (!(t < search_.end)) {
        // Certified up to the end: only the distance there is still to be told.
        return report(ImpactStatus::Apart, t, {room_along(look.normal), look.normal, look.point});
      }
      look = look_now();
    }
    return report(ImpactStatus::Unfinished, t, look);
  }

 private:
  void place(Num t) {
    a_.place(t);
    b_.place(t);
  }

  Impact report(ImpactStatus status, Num t, const Look& look) {
    result_.status = status;
    result_.time = t;
    result_.distance = look.distance;
    result_.normal = look.normal;
    result_.point = look.point;
    return result_;
  }

  [[nodiscard]] Num room_along(NumVec n) const {
    return -b_.highest_after(-n, 0) - a_.highest_after(n, 0);
  }

  // Signed distance, with an axis along which the room is just that (to rounding).
  Look look_now() {
    ++result_.looks;
    if (a_.is_triangle() || b_.is_triangle()) return look_at_triangle();
    const Gap gap = gap_between({a_.shape(), a_.origin(), a_.rotation()},
                                {b_.shape(), b_.origin(), b_.rotation()}, guess_);
    guess_ = gap.normal;
    return {gap.distance, gap.normal, Num(0.5) * (gap.on_a + gap.on_b)};
  }

  // A triangle has no inside: what overlaps it is as deep as it reaches below its front.
  Look look_at_triangle() {
    const NumVec offset = b_.centre() - a_.centre();
    const GjkResult cores = gjk_distance([&](NumVec d) { return a_.from_centre(d); },
                                         [&](NumVec d) { return b_.from_centre(d) + offset; },
                                         guess_, a_.core_size() + b_.core_size());
    if (cores.overlap) {
      const NumVec n = a_.is_triangle() ? a_.front() : -b_.front();
      guess_ = n;
      const NumVec on_b = b_.from_centre(-n) + b_.centre();
      return {room_along(n), n, on_b};
    }
    guess_ = cores.normal;
    const NumVec on_a = cores.on_a + a_.radius() * cores.normal,
                 on_b = cores.on_b - b_.radius() * cores.normal;
    return {cores.distance - a_.radius() - b_.radius(), cores.normal,
            a_.centre() + Num(0.5) * (on_a + on_b)};
  }

  // The largest u found up to `longest` with room >= goal throughout [0, u].
  [[nodiscard]] Num certified_advance(NumVec n, Num goal, Num longest) const {
    if (!a_.is_plane() && !b_.is_plane() &&
        -b_.ball_after(-n, longest) - a_.ball_after(n, longest) >= goal &&
        -b_.ball_after(-n, 0) - a_.ball_after(n, 0) >= goal)
      return longest;
    const auto g = [&](Num u) { return -b_.highest_after(-n, u) - a_.highest_after(n, u) - goal; };
    Num low = 0, at_low = g(0);
    if (!(at_low > Num(0))) return least_advance(n, longest);
    Num high = longest, at_high = g(high);
    if (at_high >= Num(0)) return longest;
    // Aimed a little above zero, where rounding does not decide.
    const Num aim = kAimedRoom * search_.tolerance;
    for (int i = 0; i < kRootSteps && at_low > Num(2) * aim; ++i) {
      // g is concave, so that the chord lies below it: where it is positive, so is g.
      const Num inner = low + (high - low) * ((at_low - aim) / (at_low - at_high));
      const Num at_inner = g(inner);
      if (!(at_inner > Num(0) && inner > low)) break;
      low = inner, at_low = at_inner;
      if (high - low <= kRootWidth * low) break;
      const Num middle = Num(0.5) * (low + high);
      const Num at_middle = g(middle);
      if (at_middle > Num(0)) {
        low = middle, at_low = at_middle;
      } else {
        high = middle, at_high = at_middle;
      }
    }
    if (!(low > Num(0))) return least_advance(n, longest);
    return low;
  }

  // Where rounding hides the room (a look said there is more than the tolerance): what the fastest
  // points need for half the tolerance.
  [[nodiscard]] Num least_advance(NumVec n, Num longest) const {
    const Num rate = a_.highest_after(n, longest) - a_.highest_after(n, 0) +
                     b_.highest_after(-n, longest) - b_.highest_after(-n, 0);
    if (!(rate > Num(0))) return longest;
    return longest * std::min(Num(1), Num(0.5) * search_.tolerance / rate);
  }

  Mover a_, b_;
  const ImpactSearch& search_;
  NumVec guess_{0, 1, 0};
  Impact result_;
};

// ---- shapes made of parts -----------------------------------------------------------------------

// Bounds of all that the convex shape `other` passes over, in the frame of a surface.
NumBox swept_bounds(const SweptShape& surface, const SweptShape& other,
                    const ImpactSearch& search) {
  const Sweep& s = surface.sweep;
  const Sweep& o = other.sweep;
  const Num ball = length(other.p) + static_cast<Num>(bounding_radius(other.shape));
  const Num time = search.end - search.begin;
  const NumRotation q = normalized(s.rotation_at(search.begin));
  const NumVec centre = s.centre_at(search.begin);
  const NumVec from = o.centre_at(search.begin) - centre, to = o.centre_at(search.end) - centre;
  // What the surface itself does meanwhile, at the place of the other.
  const Num far = std::max(length(from), length(to)) + ball;
  const Num moved = length(s.centre_at(search.end) - centre) + time * length(s.bend) +
                    std::min(time * s.fastest_spin(), Num(2)) * far;
  const Num room = ball + time * length(o.bend) + moved + std::max(search.touching, Num(0)) +
                   std::max(search.separation, Num(0)) + search.tolerance;
  const auto local = [&](NumVec v) {
    return rotate(conjugate(surface.q), rotate(conjugate(q), v) - surface.p);
  };
  const NumVec a = local(from), b = local(to), r{room, room, room};
  return {min_each(a, b) - r, max_each(a, b) + r};
}

// The first of all pairs of parts.
class PartSearch {
 public:
  explicit PartSearch(const ImpactSearch& search) : search_(search) {
    best_.time = search.end;
    best_.first_distance = std::numeric_limits<Num>::infinity();
  }

  void search(const SweptShape& a, const SweptShape& b) {
    if (a.shape.type == ShapeType::Compound) {
      for_children(a, [&](const SweptShape& child) { search(child, b); });
    } else if (b.shape.type == ShapeType::Compound) {
      for_children(b, [&](const SweptShape& child) { search(a, child); });
    } else if (is_surface(a.shape.type) && is_surface(b.shape.type)) {
      return;  // never asked about one another
    } else if (is_surface(a.shape.type)) {
      search_surface(a, b,
                     [&](const SweptShape& part, const SweptShape& core, const ImpactSearch& how) {
                       search_parts(part, core, how);
                     });
    } else if (is_surface(b.shape.type)) {
      search_surface(b, a,
                     [&](const SweptShape& part, const SweptShape& core, const ImpactSearch& how) {
                       search_parts(core, part, how);
                     });
    } else {
      search_parts(a, b, search_);
    }
  }
  [[nodiscard]] Impact result() const { return best_; }

 private:
  template <class Visit>
  static void for_children(const SweptShape& x, Visit&& visit) {
    for (const CompoundData::Child& child : x.shape.compound->children) {
      const Placement placed = to_placement(child.placed);
      visit({child.shape, x.p + rotate(x.q, placed.p), normalized(x.q * placed.q), x.sweep});
    }
  }
  // Triangles in whose reach the other shape comes from their front.
  template <class Visit>
  void for_triangles(const SweptShape& x, const SweptShape& other, Visit&& visit) {
    if (other.shape.type == ShapeType::HalfSpace) return;
    const auto middle_of = [&](const SweptShape& s) {
      return s.sweep.centre_at(search_.begin) + rotate(s.sweep.rotation_at(search_.begin), s.p);
    };
    const NumRotation q = normalized(x.sweep.rotation_at(search_.begin) * x.q);
    const NumVec middle = rotate(conjugate(q), middle_of(other) - middle_of(x));
    const NumBox box = swept_bounds(x, other, search_);
    const auto each = [&](const SurfaceTriangle& t) {
      if (t.height(middle) < Num(0)) return;
      visit({x.shape, x.p, x.q, x.sweep, &t});
    };
    if (x.shape.type == ShapeType::Mesh) {
      MeshSurface(*x.shape.mesh, cast<Num>(x.shape.scale)).query(box, each);
    } else {
      HeightfieldSurface(*x.shape.heightfield).query(box, each);
    }
  }
  // By the whole shape what it does not touch, by its core what it does.
  template <class TryPart>
  void search_surface(const SweptShape& surface, const SweptShape& other, TryPart&& try_part) {
    const Num thickness = static_cast<Num>(smallest_thickness(other.shape));
    if (!(search_.allowance > Num(0)) || !(thickness > Num(2) * search_.allowance)) {
      for_triangles(surface, other,
                    [&](const SweptShape& part) { try_part(part, other, search_); });
      return;
    }
    ImpactSearch start = search_;
    start.end = start.begin;
    static thread_local std::vector<Num> at_start;  // [m] how far each is; kept for its storage
    at_start.clear();
    Num least = std::numeric_limits<Num>::infinity();
    for_triangles(surface, other, [&](const SweptShape& part) {
      at_start.push_back(Search(part, other, start).run().first_distance);
      least = std::min(least, at_start.back());
    });
    best_.touched = best_.touched || least < search_.touching;
    const Num near =
        least < search_.separation ? std::numeric_limits<Num>::infinity() : search_.touching;
    SweptShape core = other;
    core.scale = Num(1) - Num(2) * search_.allowance / thickness;
    ImpactSearch of_core = search_;
    // Where a search stopped the core, the next one finds it touching.
    of_core.touching = search_.separation + Num(2) * search_.tolerance;
    std::size_t i = 0;
    for_triangles(surface, other, [&](const SweptShape& part) {
      if (at_start[i++] < near) {
        try_part(part, core, of_core);
      } else {
        try_part(part, other, search_);
      }
    });
  }
  void search_parts(const SweptShape& a, const SweptShape& b, const ImpactSearch& how) {
    ImpactSearch search = how;
    if (best_.status != ImpactStatus::Apart) search.end = best_.time;
    if (!(search.end > search.begin) && best_.status != ImpactStatus::Apart) {
      // Met at the very beginning: only who is deepest there is still of interest.
      search.end = search.begin;
    }
    const Impact found = Search(a, b, search).run();
    if (found.first_distance < best_.first_distance) {
      best_.first_distance = found.first_distance;
      best_.first_normal = found.first_normal;
      best_.first_point = found.first_point;
    }
    best_.looks += found.looks;
    best_.advances += found.advances;
    best_.touched = best_.touched || found.touched;
    if (found.status == ImpactStatus::Apart ||
        (best_.status != ImpactStatus::Apart && !(found.time < best_.time)))
      return;
    best_.status = found.status;
    best_.time = found.time;
    best_.distance = found.distance;
    best_.normal = found.normal;
    best_.point = found.point;
  }

  const ImpactSearch& search_;
  Impact best_;
};

}  // namespace

Impact time_of_impact(const SweptShape& a, const SweptShape& b, const ImpactSearch& search) {
  if (a.shape.type == ShapeType::HalfSpace && b.shape.type == ShapeType::HalfSpace) {
    Impact apart;
    apart.time = search.end;
    return apart;
  }
  if (!has_parts(a.shape.type) && !has_parts(b.shape.type)) return Search(a, b, search).run();
  PartSearch parts(search);
  parts.search(a, b);
  return parts.result();
}

}  // namespace plumb::inline PLUMB_ABI::detail
