// The component that holds two bodies together: a frame in each, and what the frames may do
// relative to one another.
//
//   Joint door;
//   door.body_a = frame;  door.frame_a = joint_frame({0.4f, 1, 0}, Vec3::UnitY());
//   door.body_b = leaf;   door.frame_b = joint_frame({-0.4f, 0, 0}, Vec3::UnitY());
//   door.kind = HingeJoint{{.limit = JointLimit{-1.5f, 1.5f}, .friction = 2}};
//   world.create_joint(door);
//
// Conventions. The axis of a joint is the x axis of its frames: hinges turn about it, sliders run
// along it, cones open around it. A coordinate is that of frame B seen from frame A; it is zero
// where the frames coincide. Forces and torques are those that A exerts on B. "Effort" is a force
// along a linear coordinate [N] and a torque along an angular one [N m].
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include "plumb/ids.h"
#include "plumb/math.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

inline constexpr Real kUnlimited = std::numeric_limits<Real>::infinity();

// A spring given by what it does to what it holds: its natural frequency and damping ratio with the
// masses that the joint sees. Frequency 0 is no spring but a rigid hold.
struct JointSoftness {
  Real frequency = 0;      // [Hz] >= 0; 0: rigid
  Real damping_ratio = 1;  // [-] >= 0; 1: no swinging
};

// lower <= coordinate <= upper, held rigidly or by a one-sided spring.
struct JointLimit {
  Real lower = 0, upper = 0;  // [m] or [rad], lower <= upper; angles beyond a turn are counted
  JointSoftness softness{};
  Real restitution = 0;  // [-] 0..1, of a rigid limit that is hit
};

struct JointMotor {
  enum class Mode : std::uint8_t {
    Velocity,  // brings the coordinate's rate to `target`
    Position,  // brings the coordinate to `target`, as a spring of `softness`
  } mode = Mode::Velocity;
  Real target = 0;               // [m/s], [rad/s], or [m], [rad]
  Real max_effort = kUnlimited;  // [N] or [N m] >= 0
  JointSoftness softness{Real(5), Real(1)};
};

// effort = -stiffness (coordinate - rest) - damping rate
struct JointSpring {
  Real rest = 0;       // [m] or [rad]
  Real stiffness = 0;  // [N/m] or [N m/rad] >= 0
  Real damping = 0;    // [N s/m] or [N m s/rad] >= 0
};

// What may act along a coordinate that a joint leaves free.
struct JointAxis {
  std::optional<JointLimit> limit{};
  std::optional<JointMotor> motor{};
  std::optional<JointSpring> spring{};
  Real friction = 0;  // [N] or [N m] >= 0: largest effort with which it resists motion
};

// --- kinds ---------------------------------------------------------------------------------------

struct BallJoint {    // origins coincide
  Real friction = 0;  // [N m] >= 0 against turning, the same in every direction
};
struct HingeJoint {  // origins and x axes coincide; one angle about x
  JointAxis axis{};
};
struct SliderJoint {  // attitudes coincide, B's origin stays on A's x axis; one path along x
  JointAxis axis{};
};
struct FixedJoint {};  // frames coincide

struct DistanceJoint {  // a rigid rod between the origins
  Real length = 1;      // [m] > 0
};
struct RopeJoint {      // origins no farther apart
  Real max_length = 1;  // [m] > 0
};
struct SpringJoint {        // a spring between the origins
  Real rest_length = 1;     // [m] >= 0
  Real stiffness = 0;       // [N/m] >= 0
  Real damping = 0;         // [N s/m] >= 0
  bool pulls_only = false;  // a bungee: slack when shorter than its rest length
};

struct ConeTwistJoint {   // origins coincide; the x axes stay within a cone, the twist in a range
  Real cone = Real(0.5);  // [rad] 0..pi, largest angle between the x axes
  Real twist_lower = 0, twist_upper = 0;  // [rad] within -pi..pi
  JointSoftness softness{};               // of these limits
  Real friction = 0;                      // [N m] >= 0
};

// Every coordinate chosen apart: along x, y, z of frame A; then the twist about x, and the angles
// by which B's x axis is swung about A's y and z.
struct SixDofJoint {
  enum class Freedom : std::uint8_t { Locked, Limited, Free };
  struct Coordinate {
    Freedom freedom = Freedom::Locked;
    JointAxis axis{};  // `limit` is read when Limited, the rest unless Locked
  };
  std::array<Coordinate, 6> coordinates{};
};

// Couplings take their coordinates from two joints that exist already; what they transmit is borne
// by the bodies of those joints, so that momentum is kept. They end with either of them.
struct GearJoint {        // angle_1 + ratio angle_2 = constant
  JointId first, second;  // hinges
  Real ratio = 1;         // [-] not 0: turns of the first for one of the second, against it
};
struct RackPinionJoint {  // translation - radius angle = constant
  JointId pinion, rack;   // hinge and slider
  Real radius = 1;        // [m] not 0
};

struct PulleyJoint {  // |origin_a - over_a| + ratio |origin_b - over_b| <= length
  Pos3 over_a = Pos3::Zero(), over_b = Pos3::Zero();  // [m] world: where the rope leaves
  Real ratio = 1;                                     // [-] > 0: parts of rope on the side of B
  Real length = 0;     // [m] 0: as long as it is when the joint is made
  bool stiff = false;  // true: equality, pushes as well
};

// Moves frame B relative to frame A, by velocities or towards a relative pose, with bounded effort.
struct MotorJoint {
  JointMotor::Mode mode = JointMotor::Mode::Velocity;
  Vec3 linear = Vec3::Zero();    // [m/s], or [m], axes of frame A
  Vec3 angular = Vec3::Zero();   // [rad/s] axes of frame A; or the rotation vector [rad]
  Real max_force = kUnlimited;   // [N] >= 0, length of the vector
  Real max_torque = kUnlimited;  // [N m] >= 0
  JointSoftness softness{Real(5), Real(1)};
};

using JointKind = std::variant<BallJoint, HingeJoint, SliderJoint, FixedJoint, DistanceJoint,
                               RopeJoint, SpringJoint, ConeTwistJoint, SixDofJoint, GearJoint,
                               RackPinionJoint, PulleyJoint, MotorJoint>;

struct Joint {
  // The null handle is the world itself, whose body frame is that of the world.
  BodyId body_a, body_b;
  LocalPose frame_a{}, frame_b{};  // in the body frames
  JointKind kind = BallJoint{};
  JointSoftness softness{};        // of what the kind holds: rigid unless a frequency is given
  bool collide_connected = false;  // whether the two bodies collide with each other
  Real break_force = kUnlimited;   // [N] > 0: mean over a step above which the joint breaks
  Real break_torque = kUnlimited;  // [N m] > 0
  std::uint64_t user_data = 0;     // the engine's own, never looked at
};

// The shortest turn that takes x to `axis` (any length > 0; no turn for a length of 0). Of the
// opposite direction: half a turn about z.
Quat turn_from_x(const Vec3& axis);

// A joint frame at a point of a body, its x axis along `axis` (any length > 0).
LocalPose joint_frame(const Vec3& point, const Vec3& axis = Vec3::UnitX());

// --- read-out ------------------------------------------------------------------------------------

// What the joint did during the last step, on average; world axes.
struct JointReaction {
  Vec3 force = Vec3::Zero();   // [N] on B, at the joint
  Vec3 torque = Vec3::Zero();  // [N m] on B, about the joint
  Real effort = 0;  // [N] or [N m] of motor, spring, limits and friction along the first coordinate
                    // that is not locked
};

// Where the joint stands.
struct JointState {
  Real angle = 0;          // [rad] hinge, cone-twist and 6-dof: about x, whole turns counted
  Real translation = 0;    // [m] slider, 6-dof: along x; rod, rope, spring: the distance
  Real speed = 0;          // [rad/s] or [m/s] of the joint's own coordinate
  Real linear_error = 0;   // [m] distance from where the joint holds its bodies
  Real angular_error = 0;  // [rad]
  bool at_lower = false, at_upper = false;  // a limit pushed in the last step
};

struct JointBreakEvent {
  JointId joint;  // no longer valid
  BodyId body_a, body_b;
  Real force = 0, torque = 0;  // [N], [N m] means over the step that broke it
  std::uint64_t user_data = 0;
};

}  // namespace plumb::inline PLUMB_ABI
