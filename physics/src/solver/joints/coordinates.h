// Coordinates of a pair of frames and their gradients.
//
//   d = (x_B + r_B) - (x_A + r_A)      origins; r: centre of mass to origin, world axes
//   x, y, z: axes of frame A; x', y', z': of frame B; w = w_B - w_A; all in world axes
//
//   coordinate  C                      rate J V                               terms on (v_B, w_B)
//   Linear n    n . d, n fixed in A    n . (v_B + w_B x r_B - v_A - w_A x (r_A + d))     n, r_B x n
//   Align y     y . x'                 w . (x' x y)
//   Axis e      e . r, r the turn without twist from x to x'  e + (a cot a - 1) e.p p - a e.q x,
//                                                             p, q: unit, across x; a = |r|
//   Turn e      2 e . vec(q)           w . (q_w e + vec(q) x e), q = R_A^-1 R_B with q_w >= 0
//   Rotation e  e . r, r = a u the turn from A to B     w . (e + r x e / 2 + k r x (r x e)),
//                                                       k = (1 - (a/2) cot(a/2)) / a^2
//   Twist       2 atan2(q_x, q_w)      w . (x + x') / (1 + x . x')
//   Cone        atan2(|x x x'|, x.x')  w . (x x x') / |x x x'|
//   Rate e      none                   w . e
//   Distance    |d|                    n . (v_B + w_B x r_B - v_A - w_A x r_A), n = d / |d|
//
// All are exact at any error, so that a velocity that keeps J V = 0 keeps C to second order. The
// impulses on A and B act at one common point (Linear: origin B; Distance: along the line through
// both), so that two free bodies keep their linear and angular momentum.
#pragma once

#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

// A body's motion since the step began.
struct Moved {
  Vec dp{0, 0, 0};
  Rotation dq{0, 0, 0, 1};
};

struct PlacedPair {
  Vec arm_a, arm_b, d;
  Rotation frame_a, frame_b;
};

PlacedPair place_pair(const FramePair& pair, const Moved& a, const Moved& b);
// last_angle: from which whole turns are counted.
Real coordinate_of(Coordinate coordinate, const PlacedPair& at, Real last_angle);
void gradient_of(Coordinate coordinate, const PlacedPair& at, BodyJacobian& a, BodyJacobian& b);
[[nodiscard]] bool is_linear(Coordinate coordinate);

}  // namespace plumb::inline PLUMB_ABI::detail
