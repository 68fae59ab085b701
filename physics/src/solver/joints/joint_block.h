// One joint as the solver sees it: up to eight scalar rows between two bodies (couplings: one row
// among up to four).
//
// Row i has a coordinate C_i of the bodies' poses and its exact gradient, the Jacobian J_i:
//   C_i' = u_i = J_i V = sum over bodies k of  linear_ik . v_k + angular_ik . w_k
// An impulse l_i changes the velocities by M^-1 J_i^T l_i, hence u by K l, K = J M^-1 J^T, the
// inverse of the effective mass. The rows that hold rigidly ("held") come first; the others carry
// whatever acts along a free coordinate: spring, motor, friction, limits.
//
// Held rows and what acts on free ones are solved together over all joints that hang together
// (joint_system.h, joint_laws.h).
#pragma once

#include <cstdint>

#include "math/quaternion.h"
#include "plumb/joint.h"
#include "solver/contact_row.h"
#include "solver/joints/joint_memory.h"

namespace plumb::inline PLUMB_ABI::detail {

// What a row measures. x, y, z are the axes of frame A; d leads from origin A to origin B.
enum class Coordinate : std::uint8_t {
  LinearX,  // d . x, and so on
  LinearY,
  LinearZ,
  AlignY,  // y . (x of B): zero when B's x axis lies across A's y axis
  AlignZ,
  TurnX,  // twice the vector part of the relative quaternion, along the axes of A
  TurnY,
  TurnZ,
  RotationX,  // the relative rotation vector, along the axes of A: the same, but good to half a
              // turn
  RotationY,
  RotationZ,
  Twist,   // angle about x, whole turns counted
  TwistY,  // about y and z, within half a turn
  TwistZ,
  AxisXAboutY,  // the turn without twist that takes A's x axis to B's, as a rotation vector
  AxisXAboutZ,
  AxisYAboutZ,  // the same of the y axes
  AxisYAboutX,
  AxisZAboutX,
  AxisZAboutY,
  Cone,   // angle between the x axes
  RateX,  // no coordinate, only a rate: relative angular velocity along the axes of A
  RateY,
  RateZ,
  Distance,  // |d|
  Pulley,
  PulleyA,  // what one end of a pulley's rope has beyond all of it
  PulleyB,
  Coupling,  // first + ratio * second
};

struct BodyJacobian {
  Vec linear, angular;
};

// One free row's springs and bounds, in the numbers that a pass needs.
struct FreeRow {
  bool spring = false;
  Real rest = 0, stiffness = 0, damping = 0;
  bool servo = false;  // position motor
  Real servo_target = 0, servo_frequency = 0, servo_damping_ratio = 0;
  Real servo_stiffness = 0, servo_damping = 0;
  bool motor = false;   // velocity motor
  Real speed = 0;       // [m/s] or [rad/s]
  Real max_effort = 0;  // of motor or servo
  Real friction = 0;    // [N] or [N m]
  bool limited = false, pulls_only = false;
  bool limit_aside = false;  // it has limits, out of reach, that are left out for the moment
  Real lower = 0, upper = 0;
  Real limit_frequency = 0, limit_damping_ratio = 0;
  Real limit_stiffness = 0, limit_damping = 0;
  Real restitution = 0;
  // Soft hold: a spring given by frequency.
  Real hold_frequency = 0, hold_damping_ratio = 0;
  // Part of a spring's impulse that comes before the drift where impulses are split [-]: 1/2 to 1,
  // the more the stiffer it is (joint_laws.h).
  Real spring_share = Real(0.5), servo_share = Real(0.5), limit_share = Real(0.5);
};

struct JointRow {
  Coordinate coordinate = Coordinate::LinearX;
  bool needs_value = true;
  Real value = 0;           // coordinate where the running substep began
  Real target = 0;          // of a held row
  Real rate = 0;            // [m/s] or [rad/s] after the last substep
  Real approach = 0;        // the same, as a limit that is hit sees it
  bool may_bounce = false;  // it has restitution, and no limit pushed in the last substep
  RowImpulses impulses;
  RowImpulses kept;          // before the last of Newton's steps
  RowImpulses begun;         // before the first
  Real sum[kRowParts] = {};  // [N s] over the step
};

// A frame pair within the running step.
struct FramePair {
  Vec arm_a{0, 0, 0}, arm_b{0, 0, 0};  // [m] centres of mass to the origins, at the step's start
  Rotation frame_a{0, 0, 0, 1}, frame_b{0, 0, 0, 1};  // R_WA, R_WB of the frames, then
  Vec between{0, 0, 0};                               // [m] from A's centre of mass to B's, then
  Coordinate measured = Coordinate::Twist;            // couplings: what is taken from this pair
  bool counts_turns = false;
  Real angle = 0;  // [rad] last value of Twist, to count turns from
};

struct JointBlock {
  std::uint32_t joint = 0;                   // slot
  std::uint32_t body[kMaxJointBodies] = {};  // dense; 0: nothing that moves
  bool moves[kMaxJointBodies] = {};
  int bodies = 0;         // different ones
  int place[2 * 2] = {};  // which of them is A and B of each frame pair
  int pairs = 1;
  int rows = 0, held = 0;
  bool split = false;
  int friction_group = -1;  // first of three rows whose friction is bounded as a vector
  int motor_groups = 0;     // rows 0-2 and 3-5 have motors bounded as vectors
  Real ratio = 1;           // couplings, pulley
  Vec over_a{0, 0, 0}, over_b{0, 0, 0};  // [m] pulley: from the step's centres of mass
  Real zero = 0;
  Real size = 0;  // [m] longest arm or radius: what linear errors are measured by
  FramePair pair[2];
  Vec inverse_mass[kMaxJointBodies];
  Symmetric3<Real> inverse_inertia[kMaxJointBodies];
  JointRow row[kMaxJointRows];
  FreeRow free[kMaxFree];
  BodyJacobian J[kMaxJacobians];  // row by row
  // [1/kg] or [1/(kg m^2)] of a free coordinate while this joint's held rows hold: the mass that a
  // spring given by its frequency sees. Known where it is asked for.
  bool needs_inverse_mass = false;
  Real free_inverse_mass[kMaxFree] = {};
  Vec force_sum{0, 0, 0}, torque_sum{0, 0, 0};  // [N s], [N m s] on B over the step
  Real h = 0;                                   // [s] its substep
  Real elapsed = 0;     // [s] of the substep; what is not dynamic has moved on for so long
  Real correction = 1;  // part of the position error that one substep takes away
};

}  // namespace plumb::inline PLUMB_ABI::detail
