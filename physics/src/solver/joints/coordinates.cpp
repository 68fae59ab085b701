#include "solver/joints/coordinates.h"

#include "math/arc_tangent.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kTwoPi = Real(6.283185307179586476925);
// Below this, relative to unit vectors, a direction is not defined and any will do [-].
constexpr Real kNoDirection = Real(1e-6);

Vec axis(const Rotation& q, int i) {
  return rotate(
      q, Vec{i == 0 ? Real(1) : Real(0), i == 1 ? Real(1) : Real(0), i == 2 ? Real(1) : Real(0)});
}
Rotation relative(const PlacedPair& at) {
  const Rotation q = conjugate(at.frame_a) * at.frame_b;
  return q.w < Real(0) ? Rotation{-q.x, -q.y, -q.z, -q.w} : q;
}
int index_after(Coordinate coordinate, Coordinate first) {
  return static_cast<int>(coordinate) - static_cast<int>(first);
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
  return coordinate <= Coordinate::LinearZ || coordinate == Coordinate::Distance ||
         coordinate == Coordinate::Pulley;
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
    case Coordinate::Twist: {
      const Rotation q = relative(at);
      const Real angle = Real(2) * arc_tangent(q.x, q.w);
      return angle + kTwoPi * std::nearbyint((last_angle - angle) / kTwoPi);
    }
    case Coordinate::SwingY: {
      const Vec x = axis(at.frame_b, 0);
      return arc_tangent(-dot(x, axis(at.frame_a, 2)), dot(x, axis(at.frame_a, 0)));
    }
    case Coordinate::SwingZ: {
      const Vec x = axis(at.frame_b, 0);
      return arc_tangent(dot(x, axis(at.frame_a, 1)), dot(x, axis(at.frame_a, 0)));
    }
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
      const Vec e{i == 0 ? Real(1) : Real(0), i == 1 ? Real(1) : Real(0),
                  i == 2 ? Real(1) : Real(0)};
      g = rotate(at.frame_a, q.w * e + cross(Vec{q.x, q.y, q.z}, e));
      break;
    }
    case Coordinate::Twist: {
      const Vec x = axis(at.frame_a, 0), x_b = axis(at.frame_b, 0);
      const Real c = Real(1) + dot(x, x_b);
      g = c > kNoDirection ? (Real(1) / c) * (x + x_b) : x;
      break;
    }
    case Coordinate::SwingY:
    case Coordinate::SwingZ: {
      const bool about_y = coordinate == Coordinate::SwingY;
      const Vec x = axis(at.frame_a, 0), side = axis(at.frame_a, about_y ? 2 : 1);
      const Vec x_b = axis(at.frame_b, 0);
      const Real c = dot(x_b, x), p = dot(x_b, side), size = c * c + p * p;
      if (size > kNoDirection)
        g = ((about_y ? Real(-1) : Real(1)) / size) * (c * cross(x_b, side) - p * cross(x_b, x));
      else
        g = axis(at.frame_a, about_y ? 1 : 2);
      break;
    }
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
    case Coordinate::Coupling:
      break;
  }
  a = {{0, 0, 0}, -g};
  b = {{0, 0, 0}, g};
}

}  // namespace plumb::inline PLUMB_ABI::detail
