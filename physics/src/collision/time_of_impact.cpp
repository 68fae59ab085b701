#include "collision/time_of_impact.h"

#include "collision/core_support.h"
#include "collision/shape_gap.h"

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

// A shape in motion, evaluated at one time.
class Mover {
 public:
  explicit Mover(const SweptShape& swept) : swept_(swept) {
    const CollisionShape& shape = swept.shape;
    radius_ = static_cast<Num>(shape.radius);
    if (is_plane()) return;
    core_size_ = static_cast<Num>(bounding_radius(shape)) - radius_;
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
  [[nodiscard]] NumRotation rotation() const { return q_; }
  // Farthest point of the core, from the body's centre.
  [[nodiscard]] NumVec from_centre(NumVec d) const {
    return rows_ * core_support(swept_.shape, transpose_times(rows_, d)) + arm_;
  }

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
      return std::max(std::abs(middle + dot(local, core_support(swept_.shape, local))),
                      std::abs(middle + dot(local, core_support(swept_.shape, -local))));
    };
    const Num e1 = extent(t1), e2 = extent(t2);
    return std::min(reach_, std::sqrt(e1 * e1 + e2 * e2));
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
    const Gap gap = gap_between({a_.shape(), a_.origin(), a_.rotation()},
                                {b_.shape(), b_.origin(), b_.rotation()}, guess_);
    guess_ = gap.normal;
    return {gap.distance, gap.normal, Num(0.5) * (gap.on_a + gap.on_b)};
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

}  // namespace

Impact time_of_impact(const SweptShape& a, const SweptShape& b, const ImpactSearch& search) {
  if (a.shape.type == ShapeType::HalfSpace && b.shape.type == ShapeType::HalfSpace) {
    Impact apart;
    apart.time = search.end;
    return apart;
  }
  return Search(a, b, search).run();
}

}  // namespace plumb::inline PLUMB_ABI::detail
