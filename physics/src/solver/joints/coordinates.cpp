#include "solver/joints/coordinates.h"

#include "math/arc_tangent.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kTwoPi = Real(6.283185307179586476925);
// Below this, relative to unit vectors, a direction is not defined and any will do [-].
constexpr Real kNoDirection = Real(1e-6);
// Sine of half a turn [-] up to which its rotation vector is twice the sine: to 2e-7 of it.
constexpr Real kSmallTurn = Real(1e-3);

Vec unit(int i) {
  return {i == 0 ? Real(1) : Real(0), i == 1 ? Real(1) : Real(0), i == 2 ? Real(1) : Real(0)};
}
Vec axis(const Rotation& q, int i) { return rotate(q, unit(i)); }
Rotation relative(const PlacedPair& at) {
  const Rotation q = conjugate(at.frame_a) * at.frame_b;
  return q.w < Real(0) ? Rotation{-q.x, -q.y, -q.z, -q.w} : q;
}
int index_after(Coordinate coordinate, Coordinate first) {
  return static_cast<int>(coordinate) - static_cast<int>(first);
}

// The turn without twist that takes axis k of A to axis k of B, as a rotation vector. In the axes
// k, k + 1, k + 2 of A, counted round: cos = c, the rest of B's axis = (p1, p2) = sin (e1, e2).
struct Swing {
  int k, about;  // the axis that swings; which of the others the coordinate counts about: 1 or 2
  Real c, e1, e2, sine, angle;
  Real ratio;  // angle / sine [-]
};
constexpr Real kSmallSquare = Real(1e-3);  // of a sine, up to which five terms of asin do
// Sine [-] below which directions near half a turn are noise, and the one from which a turn of them
// is measured.
constexpr Real kNoSine = Real(1e-6), kLeastSine = Real(0.05);

Swing swing_of(Coordinate coordinate, const PlacedPair& at) {
  const int place = index_after(coordinate, Coordinate::AxisXAboutY);
  Swing s;
  s.k = place / 2;
  s.about = 1 + place % 2;
  const Vec x = axis(at.frame_b, s.k);
  s.c = dot(x, axis(at.frame_a, s.k));
  const Real p1 = dot(x, axis(at.frame_a, (s.k + 1) % 3));
  const Real p2 = dot(x, axis(at.frame_a, (s.k + 2) % 3));
  const Real square = p1 * p1 + p2 * p2;
  s.sine = std::sqrt(square);
  if (s.c > Real(0) && square < kSmallSquare) {
    s.ratio =
        Real(1) +
        square * (Real(1) / Real(6) +
                  square * (Real(3) / Real(40) +
                            square * (Real(5) / Real(112) + square * (Real(35) / Real(1152)))));
    s.angle = s.ratio * s.sine;
  } else {
    s.angle = arc_tangent(s.sine, s.c);
    s.ratio = s.angle / std::max(s.sine, kLeastSine);
  }
  const bool directed = s.sine > Real(0) && (s.c > Real(0) || s.sine > kNoSine);
  s.e1 = directed ? p1 / s.sine : Real(1);
  s.e2 = directed ? p2 / s.sine : Real(0);
  return s;
}
Real value_of(const Swing& s) { return s.about == 1 ? -s.angle * s.e2 : s.angle * s.e1; }
Vec gradient_of(const Swing& s, const PlacedPair& at) {
  const Vec side1 = axis(at.frame_a, (s.k + 1) % 3), side2 = axis(at.frame_a, (s.k + 2) % 3);
  const Real e = s.about == 1 ? s.e1 : s.e2;
  return (s.about == 1 ? side1 : side2) +
         ((s.ratio * s.c - Real(1)) * e) * (s.e1 * side1 + s.e2 * side2) -
         (s.angle * e) * axis(at.frame_a, s.k);
}

// The rotation vector that takes A's axes to B's, in the axes of A, and k of its gradient.
struct WholeTurn {
  Vec r;   // [rad]
  Real k;  // [-]
};
WholeTurn turn_of(const PlacedPair& at) {
  const Rotation q = relative(at);
  const Vec v{q.x, q.y, q.z};
  const Real sine = length(v);
  if (!(sine > kSmallTurn)) return {Real(2) * v, Real(1) / Real(12)};
  const Real half = arc_tangent(sine, q.w);
  return {(Real(2) * half / sine) * v, (Real(1) - half * q.w / sine) / (Real(4) * half * half)};
}

}  // namespace

PlacedPair place_pair(const FramePair& pair, const Moved& a, const Moved& b) {
  PlacedPair at;
  at.arm_a = rotate(a.dq, pair.arm_a);
  at.arm_b = rotate(b.dq, pair.arm_b);
  at.frame_a = a.dq * pair.frame_a;
  at.frame_b = b.dq * pair.frame_b;
  at.d = (pair.between + (b.dp - a.dp)) + (at.arm_b - at.arm_a);
  return at;
}

bool is_linear(Coordinate coordinate) {
  return coordinate <= Coordinate::LinearZ ||
         (coordinate >= Coordinate::Distance && coordinate <= Coordinate::PulleyB);
}

Real coordinate_of(Coordinate coordinate, const PlacedPair& at, Real last_angle) {
  switch (coordinate) {
    case Coordinate::LinearX:
    case Coordinate::LinearY:
    case Coordinate::LinearZ:
      return dot(at.d, axis(at.frame_a, index_after(coordinate, Coordinate::LinearX)));
    case Coordinate::AlignY:
    case Coordinate::AlignZ:
      return dot(axis(at.frame_b, 0),
                 axis(at.frame_a, 1 + index_after(coordinate, Coordinate::AlignY)));
    case Coordinate::TurnX:
      return Real(2) * relative(at).x;
    case Coordinate::TurnY:
      return Real(2) * relative(at).y;
    case Coordinate::TurnZ:
      return Real(2) * relative(at).z;
    case Coordinate::RotationX:
    case Coordinate::RotationY:
    case Coordinate::RotationZ:
      return component(turn_of(at).r, index_after(coordinate, Coordinate::RotationX));
    case Coordinate::Twist: {
      const Rotation q = relative(at);
      const Real angle = Real(2) * arc_tangent(q.x, q.w);
      return angle + kTwoPi * std::nearbyint((last_angle - angle) / kTwoPi);
    }
    case Coordinate::TwistY:
      return Real(2) * arc_tangent(relative(at).y, relative(at).w);
    case Coordinate::TwistZ:
      return Real(2) * arc_tangent(relative(at).z, relative(at).w);
    case Coordinate::AxisXAboutY:
    case Coordinate::AxisXAboutZ:
    case Coordinate::AxisYAboutZ:
    case Coordinate::AxisYAboutX:
    case Coordinate::AxisZAboutX:
    case Coordinate::AxisZAboutY:
      return value_of(swing_of(coordinate, at));
    case Coordinate::Cone: {
      const Vec x = axis(at.frame_a, 0), x_b = axis(at.frame_b, 0);
      return arc_tangent(length(cross(x, x_b)), dot(x, x_b));
    }
    case Coordinate::Distance:
      return length(at.d);
    case Coordinate::RateX:
    case Coordinate::RateY:
    case Coordinate::RateZ:
    case Coordinate::Pulley:
    case Coordinate::PulleyA:
    case Coordinate::PulleyB:
    case Coordinate::Coupling:
      break;
  }
  return Real(0);
}

void gradient_of(Coordinate coordinate, const PlacedPair& at, BodyJacobian& a, BodyJacobian& b) {
  Vec g{0, 0, 0};
  switch (coordinate) {
    case Coordinate::LinearX:
    case Coordinate::LinearY:
    case Coordinate::LinearZ: {
      const Vec n = axis(at.frame_a, index_after(coordinate, Coordinate::LinearX));
      a = {-n, -cross(at.arm_a + at.d, n)};
      b = {n, cross(at.arm_b, n)};
      return;
    }
    case Coordinate::Distance: {
      const Vec n = normalized_or(at.d, axis(at.frame_a, 0));
      a = {-n, -cross(at.arm_a, n)};
      b = {n, cross(at.arm_b, n)};
      return;
    }
    case Coordinate::AlignY:
    case Coordinate::AlignZ:
      g = cross(axis(at.frame_b, 0),
                axis(at.frame_a, 1 + index_after(coordinate, Coordinate::AlignY)));
      break;
    case Coordinate::TurnX:
    case Coordinate::TurnY:
    case Coordinate::TurnZ: {
      const Rotation q = relative(at);
      const int i = index_after(coordinate, Coordinate::TurnX);
      const Vec e = unit(i);
      g = rotate(at.frame_a, q.w * e + cross(Vec{q.x, q.y, q.z}, e));
      break;
    }
    case Coordinate::RotationX:
    case Coordinate::RotationY:
    case Coordinate::RotationZ: {
      const WholeTurn turn = turn_of(at);
      const Vec e = unit(index_after(coordinate, Coordinate::RotationX));
      const Vec across = cross(turn.r, e);
      g = rotate(at.frame_a, e + Real(0.5) * across + turn.k * cross(turn.r, across));
      break;
    }
    case Coordinate::Twist:
    case Coordinate::TwistY:
    case Coordinate::TwistZ: {
      const int i = index_after(coordinate, Coordinate::Twist);
      const Vec x = axis(at.frame_a, i), x_b = axis(at.frame_b, i);
      const Real c = Real(1) + dot(x, x_b);
      g = c > kNoDirection ? (Real(1) / c) * (x + x_b) : x;
      break;
    }
    case Coordinate::AxisXAboutY:
    case Coordinate::AxisXAboutZ:
    case Coordinate::AxisYAboutZ:
    case Coordinate::AxisYAboutX:
    case Coordinate::AxisZAboutX:
    case Coordinate::AxisZAboutY:
      g = gradient_of(swing_of(coordinate, at), at);
      break;
    case Coordinate::Cone: {
      const Vec across = cross(axis(at.frame_a, 0), axis(at.frame_b, 0));
      g = normalized_or(across, axis(at.frame_a, 1));
      break;
    }
    case Coordinate::RateX:
    case Coordinate::RateY:
    case Coordinate::RateZ:
      g = axis(at.frame_a, index_after(coordinate, Coordinate::RateX));
      break;
    case Coordinate::Pulley:
    case Coordinate::PulleyA:
    case Coordinate::PulleyB:
    case Coordinate::Coupling:
      break;
  }
  a = {{0, 0, 0}, -g};
  b = {{0, 0, 0}, g};
}

}  // namespace plumb::inline PLUMB_ABI::detail
