// Bodies, split by who reads what. Records of the step lie in dense arrays with the awake bodies in
// front; everything else is found by slot, the index inside a BodyId, which never changes.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "math/quaternion.h"
#include "plumb/rigid_body.h"

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// --- dense: read by every stage of the step ------------------------------------------------------

// Bytes per record in f32 / f64 stand behind the name.
struct BodyVelocity {     // 32 / 64
  Vec v{0, 0, 0};         // [m/s] centre of mass
  Real load = 0;          // [N s] normal impulse in this substep; scratch of the solver
  Vec w{0, 0, 0};         // [rad/s] world axes
  Real sliding_load = 0;  // [N s] the part of it that slides
};

struct BodyPose {          // 28 / 56 (f32d: 40)
  PosVec x{0, 0, 0};       // [m] centre of mass
  Rotation q{0, 0, 0, 1};  // R_WP: principal axes to world
};

// The stored state of rotation is the angular momentum in world axes, not the angular velocity:
// free motion leaves it untouched, bit for bit.
struct BodyMomentum {  // 16 / 32
  Vec L{0, 0, 0};      // [kg m^2/s] about the centre of mass, world axes
  Real pad = 0;
};

struct BodyMass {                // 48 / 96
  Vec inverse_mass{0, 0, 0};     // [1/kg] by world axis; 0: locked or not dynamic
  Real mass = 0;                 // [kg]; 0: not dynamic
  Vec inverse_moments{0, 0, 0};  // [1/(kg m^2)] about the principal axes; 0: does not turn
  Real gravity_scale = 1;
  Vec moments{0, 0, 0};             // [kg m^2]; 0 where the inverse is
  std::uint32_t angular_locks = 0;  // bit i: no rotation about world axis i
};

struct BodyForce {          // 32 / 64
  Vec force{0, 0, 0};       // [N] over the next step
  Real linear_damping = 0;  // [1/s]
  Vec torque{0, 0, 0};      // [N m]
  Real angular_damping = 0;
};

// How far any point of a body's colliders has come since pairs were last looked at, and may come in
// the next step by its velocity [m]; at least, both. Of what is asleep or static: nothing.
struct BodyTravel {  // 20 / 40
  Real moved = 0, coming = 0;
  // Of the boxes of its colliders (clearance.h): the room that they leave it, at most, and what of
  // that it may need in the next step, at least.
  Real room = 0, needed = 0;
  bool room_to_turn = false;  // in them it may turn in any way: only its path counts
  bool old_reach = false;     // the reach of its colliders is an earlier step's
  bool asked = false;         // some pair asked for it in this step
};

struct BodyExtent {         // 12 / 24
  Real size = 0;            // [m] smallest thickness over its colliders
  Real radius = 0;          // [m] farthest point of its colliders from the centre of mass
  Real turning_radius = 0;  // [m] farthest one that a turn carries along (no ball's)
};

// --- by slot: read when something is built, asked for, or ends -----------------------------------

// How many substeps a body's island gets (solver/step_levels.h).
struct StepLevel {
  std::uint8_t halvings = 0;    // of the world's substeps
  std::uint8_t calm_steps = 0;  // in a row in which half as many would have done
};

struct BodyInfo {  // what states are read by comes first
  std::uint64_t user_data = 0;
  std::uint32_t generation = 0;
  bool alive = false;
  bool disabled = false;  // quarantined: its state became non-finite
  bool has_own_mass = false;
  MotionType type = MotionType::Dynamic;
  MotionLocks locks;
  bool can_sleep = true;
  bool continuous = false;  // stopped by dynamic bodies too
  std::uint32_t dense = 0;
  Vec center_B{0, 0, 0};         // centre of mass in B
  Rotation R_BP{0, 0, 0, 1};     // principal axes in B
  std::uint32_t island = kNone;  // sleeping island, or kNone
  Real rest_time = 0;            // [s] at rest without a break
  StepLevel level;
  // Of the choice of the accurate solver (newton/choose.h), in steps: in a row in which it has
  // called; for which it stays with it; for which its calls are not heard; in a row in which its
  // island took more than its share.
  std::uint8_t newton_calls = 0, newton_steps = 0, newton_pause = 0, newton_overruns = 0;
  MassProperties properties;             // in B
  std::vector<std::uint32_t> colliders;  // slots
  std::vector<ColliderId> collider_ids;
};

class BodyStore {
 public:
  BodyStore() { push_dense(kNone); }  // dense 0 stands for the world itself: infinite mass, at rest

  std::uint32_t create();  // returns the slot, asleep part
  void destroy(std::uint32_t slot);
  void wake(std::uint32_t slot);  // into the awake part of the dense arrays
  void rest(std::uint32_t slot);  // out of it
  [[nodiscard]] bool is_awake(std::uint32_t slot) const { return dense_of[slot] < awake_end; }
  [[nodiscard]] std::uint32_t dense_count() const {
    return static_cast<std::uint32_t>(slot_of.size());
  }

  std::vector<BodyVelocity> velocity;
  std::vector<BodyPose> pose;
  std::vector<BodyMomentum> momentum;
  std::vector<BodyMass> mass;
  std::vector<BodyForce> force;
  std::vector<std::uint32_t> slot_of;
  std::uint32_t awake_begin = 1, awake_end = 1;

  std::vector<BodyInfo> info;
  std::vector<std::uint32_t> dense_of;    // info[slot].dense, close together for the stages' loops
  std::vector<BodyTravel> travel;         // by slot: pairs know slots
  std::vector<BodyExtent> extent;         // by slot
  std::vector<Vec> acceleration;          // by slot: from forces and gravity in the last step
  std::vector<std::uint32_t> standing;    // slots whose travel may have ended since then
  std::vector<std::uint32_t> free_slots;  // reused last in, first out
  std::uint32_t alive_count = 0;
  bool some_called = false;  // some awake body may have called for the accurate solver

 private:
  void push_dense(std::uint32_t slot);
  void swap_dense(std::uint32_t i, std::uint32_t j);
};

}  // namespace plumb::inline PLUMB_ABI::detail
