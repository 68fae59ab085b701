// One contact manifold as the solver sees it, in manifold space.
//
// All points of a manifold share the normal n. With c their centre, r = c - x the arms, and point i
// at c + a_i t1 + b_i t2, three numbers carry everything about the relative motion along n:
//
//   u0 = n . (vB + wB x rB - vA - wA x rA)      u1 = t1 . (wB - wA)      u2 = t2 . (wB - wA)
//   normal speed of point i:   vn_i = u0 + b_i u1 - a_i u2
//
// An impulse l at point i is the generalised impulse p = l (1, b_i, -a_i) and changes u by K p, K
// the 3x3 response of both bodies. So the points are solved among three numbers; each body is read
// once and written once. Friction is the same with
//
//   (x, y, z) = (t1 . vrel, t2 . vrel, n . wrel)      vt_i = (x - b_i z, y + a_i z)
//
// A surface that runs over its body (a belt) adds its own three numbers to (x, y, z).
//
// The impulse of one contact in four steps, as the textbooks have it [Millington 2010, ch. 14]: the
// velocity change per unit impulse (K), the wanted change, the impulse, and its application with
// opposite signs to both bodies.
#pragma once

#include <cstdint>

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

// Motion within the running step, measured from where it began; the solver's view of a pose.
struct BodyDelta {
  Vec dp{0, 0, 0};  // [m]
  Real pad = 0;
  Rotation dq{0, 0, 0, 1};  // world axes
};

// What a body in contact remembers within a step. Eight times four Reals, so that the wide kernel
// can read several.
struct SubstepBody {
  Vec v_start{0, 0, 0};  // [m/s] after the previous substep
  Real stiffness = 0;    // [rad^2/s^2] of what pulls at it through joints
  Vec L_start{0, 0, 0};  // [kg m^2/s]
  Real pad1 = 0;
  Vec w_in{0, 0, 0};  // [rad/s] before the rows acted
  Real pad2 = 0;
  Vec acceleration{0, 0, 0};  // [m/s^2] from gravity and forces
  Real pad3 = 0;
  Symmetric3<Real> I{};  // [kg m^2] world axes at the start of the step, as the rows see it
  Symmetric3<Real> I_inverse{};
  alignas(4 * sizeof(Real)) bool constrained = false;  // some row holds it
  bool bounced = false;                                // in this substep
  bool driven = false;    // a surface, a motor, an effect carries it on: it does not rest
  bool jointed = false;   // some joint holds it
  bool split = false;     // ... and nothing that hangs on it touches anything
  bool affected = false;  // some effect acts on it
  bool balanced = false;  // water or springs hold it, with nothing left over
  bool turned = false;    // fast: its rows are told anew within the step (turned_rows.h)
  bool spun = false;      // ... it became fast within the step: they see its inertia as of now
};

// Spring-like softness of a contact, from a frequency, a damping ratio and the effective masses s
// that the spring is made for [Catto 2024], who takes s = 1:
//   bias_rate = w/(2 z + h w), mass_scale = s h w (2 z + h w)/(1 + s h w (2 z + h w)),
//   impulse_scale = 1 - mass_scale
struct Softness {
  Real bias_rate;      // [1/s]
  Real mass_scale;     // [-]
  Real impulse_scale;  // [-]
};
Softness make_softness(Real frequency, Real damping_ratio, Real masses, Real h);

struct WorldState;
template <class T>
struct ContactRow;
// Makes a row's softness that of substeps of a length [s] (rows.cpp).
void soften_row(const WorldState& world, ContactRow<Real>& row, Real h);
// [s] the longest substep that can follow the row's contact at its full stiffness.
Real longest_substep(const WorldState& world, const ContactRow<Real>& row);

// What the kernel iterates on: nothing but numbers, so that the rows of a block can be turned into
// lanes. T is one number or W of them side by side, P the points there is room for.
template <class T, int P>
struct RowNumbers {
  static constexpr int kRoom = P;
  Vector3<T> n, t1, t2;     // n from A to B
  Vector3<T> arm_a, arm_b;  // [m] from the centres of mass to c
  Vector3<T> advance;       // [m] of B seen from A at which the arms were taken (swept pairs)
  // The part of the arms that turns with the bodies: a sphere's surface does not, it rolls.
  Vector3<T> core_a, core_b;                  // [m]
  Vector3<T> inverse_mass_a, inverse_mass_b;  // [1/kg] by world axis (locks make them differ)
  Symmetric3<T> inverse_inertia_a, inverse_inertia_b;
  Symmetric3<T> K_normal, K_friction;
  Vector3<T> drive{};  // [m/s, m/s, rad/s] of B's surface over A's, added to (x, y, z)
  // [-] Shares of the path between the bodies by which the arms follow them to one common point
  // (share_path). Their sum is 1 where both bodies are dynamic, else 0.
  T follow_a = T(0), follow_b = T(0);
  T path_room = T(0);  // [m] of path that they follow at most, along each axis (place_arms)
  T friction = T(0);   // [-]
  T bias_rate = T(0), mass_scale = T(1), impulse_scale = T(0);
  // What these are where the points cannot be solved at once (choose_softness).
  T mass_scale_in_turn = T(1), impulse_scale_in_turn = T(0);
  T push_speed_now = T(0);  // [m/s] limit of the velocity that works off overlap, this substep
  T negligible = T(0);      // [N s] impulses up to this do not count as load
  // 1 where `block` holds the pseudo-inverse of the points' response matrix (upper triangle by
  // rows): all points at once. Else 0.
  T has_block = T(0);
  T block[10] = {};

  struct Point {
    T a = T(0), b = T(0);                  // [m] place in the contact plane
    T separation = T(0);                   // [m] at the start of the step
    T normal_mass = T(0);                  // [kg] 1 / (velocity change per unit impulse)
    T impulse = T(0);                      // [N s] >= 0, this substep
    T friction1 = T(0), friction2 = T(0);  // [N s]
    T k11 = T(0), k12 = T(0), k22 = T(0);  // [1/kg] tangential response at this point
    T impulse_sum = T(0), friction1_sum = T(0), friction2_sum = T(0);  // over the step
    T loaded = T(0);  // 1: it carried load in the last substep
  };
  Point points[P];
};

template <class T>
struct ContactRow : RowNumbers<T, 4> {
  static constexpr int kMaxPoints = 4;
  static constexpr std::uint32_t kNoTurning = 0xffffffffu, kNotTurned = 0xffffffffu;
  std::uint32_t body_a = 0, body_b = 0;  // dense; 0: nothing that moves
  std::uint32_t contact = 0;             // index into the world's contacts
  int count = 0;
  bool in_block = false;   // the wide kernel has it in this step (contact_blocks.h)
  bool responds = false;   // its responses have been made; in a block the kernel makes them
  bool spun = false;       // it holds a body that was set spinning within the step
  bool watched = false;    // it is noted what it bears: an effect may be about it (never in_block)
  bool told_anew = false;  // its bodies had turned when it was told last
  bool let_go = false;     // as the step began it would have pressed; told anew it did not

  Vector3<T> between;  // [m] from A's centre of mass to B's
  bool both_dynamic = false;
  T restitution = T(0);
  // Its row of rolling and torsional friction or of friction with a grain, if any.
  std::uint32_t turning = kNoTurning;
  T along = T(1);                     // [-] friction along t1, the grain, over that along t2
  std::uint32_t turned = kNotTurned;  // its place among the rows told anew, if it is one
  T push_speed = T(0);  // [m/s] limit of the velocity that works off overlap, of most substeps

  bool exact_spheres = false;            // both are spheres about their centres of mass
  T radius_a = T(0), radius_b = T(0);    // [m] then
  T surface_a = T(0), surface_b = T(0);  // [m] radius of the rounded shapes, from core to surface
  T pressed = T(0);          // [N s] watched: the most that it bore in a pass of this step
  T pressed_anew = T(0);     // [N s] ... since it was told anew
  T approach_speed = T(0);   // [m/s] when the step began, largest over the points
  T cut_unit = T(0);         // [m/s] |relative acceleration| h: unit of the bounce cuts
  bool skip = false;         // a bounce takes care of it in this substep
  bool keeps_apart = false;  // it bounced off in this substep: approach is stopped
  bool at_rest = false;
  bool bounced = false;  // in this step
  int bounces = 0;       // in this substep
};

}  // namespace plumb::inline PLUMB_ABI::detail
