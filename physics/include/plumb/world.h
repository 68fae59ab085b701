// The world: bodies, colliders, the step, and what can be asked of it.
//
//   plumb::PhysicsWorld world;
//   auto ball = world.create_body({.pose = {.position = {0, 10, 0}}});
//   world.create_collider(ball.id, {.shape = plumb::Sphere{0.5f}});
//   while (running) world.step(1.0 / 60);
//
// Not thread-safe, but: all const members may be called from several threads at once while no
// other member runs. Every mutating call returns a Status and changes nothing when it is not ok.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plumb/abi_tag.h"
#include "plumb/collider.h"
#include "plumb/effects.h"
#include "plumb/events.h"
#include "plumb/ids.h"
#include "plumb/inputs.h"
#include "plumb/job_system.h"
#include "plumb/joint.h"
#include "plumb/observer.h"
#include "plumb/plan.h"
#include "plumb/queries.h"
#include "plumb/report.h"
#include "plumb/rigid_body.h"
#include "plumb/settings.h"
#include "plumb/snapshot.h"
#include "plumb/status.h"
#include "plumb/world_image.h"

namespace plumb::inline PLUMB_ABI {

namespace detail {
struct WorldState;
}

class PhysicsWorld {
 public:
  // Settings that do not pass check() are replaced by the defaults; see set_settings().
  explicit PhysicsWorld(const WorldSettings& settings = {});
  ~PhysicsWorld();
  PhysicsWorld(PhysicsWorld&&) noexcept;
  PhysicsWorld& operator=(PhysicsWorld&&) noexcept;

  // --- building --------------------------------------------------------------------------------
  Created<BodyId> create_body(const RigidBody& body);
  Status destroy_body(BodyId body);  // with its colliders and joints; what rested on it wakes
  Created<ColliderId> create_collider(BodyId body, const Collider& collider);
  Status destroy_collider(ColliderId collider);
  // Joints wake their bodies; they end with either body, and with what they couple.
  Created<JointId> create_joint(const Joint& joint);
  Status destroy_joint(JointId joint);
  Status set_settings(const WorldSettings& settings);
  // Threads for the coming steps; null: the calling thread alone. Not owned, must outlive its use.
  void set_job_system(JobSystem* jobs);
  // What the coming steps tell about their accuracy (plumb/diagnostics.h).
  void set_diagnostics(const StepDiagnostics& diagnostics);
  [[nodiscard]] const StepDiagnostics& diagnostics() const;

  // --- acting on bodies ------------------------------------------------------------------------
  // Forces and torques act throughout the next step and are then forgotten; impulses act at once.
  // All wake the body. Vectors in world axes; "at" a world point, "at_body_point" a point of B.
  Status apply_force(BodyId body, const Vec3& force);  // [N] at the centre of mass
  Status apply_force_at(BodyId body, const Vec3& force, const Pos3& p_W);  // [N], [m]
  Status apply_force_at_body_point(BodyId body, const Vec3& force, const Vec3& p_B);
  Status apply_torque(BodyId body, const Vec3& torque);    // [N m]
  Status apply_impulse(BodyId body, const Vec3& impulse);  // [N s] at the centre of mass
  Status apply_impulse_at(BodyId body, const Vec3& impulse, const Pos3& p_W);
  Status apply_impulse_at_body_point(BodyId body, const Vec3& impulse, const Vec3& p_B);
  Status apply_angular_impulse(BodyId body, const Vec3& impulse);  // [N m s]
  Status set_pose(BodyId body, const Pose& pose);                  // teleport
  Status set_linear_velocity(BodyId body, const Vec3& velocity);   // [m/s]
  Status set_angular_velocity(BodyId body, const Vec3& velocity);  // [rad/s]
  // Gives a kinematic body the velocities that take it to the target within a time dt [s] > 0, by
  // the shorter turn. It keeps them after that.
  Status move_kinematic(BodyId body, const Pose& target, double dt);
  Status set_mass(BodyId body, const MassProperties& properties);
  Status derive_mass(BodyId body);  // takes set_mass back: from the colliders' densities again
  Status set_awake(BodyId body, bool awake);  // putting to sleep takes the whole island

  // --- changing bodies -------------------------------------------------------------------------
  // The fields of RigidBody, with its ranges. Handles stay valid, and so do colliders and joints;
  // what a change may set in motion wakes.
  // The motion goes on: only what becomes static stops. Contacts and overlaps with what it can meet
  // no more end. A joint that holds no dynamic body rests until it does. BadShape: a half-space
  // needs a static body, a mesh or heightfield one that is not dynamic.
  Status set_motion_type(BodyId body, MotionType type);
  Status set_locks(BodyId body, const MotionLocks& locks);     // ends the motion that is locked
  Status set_damping(BodyId body, Real linear, Real angular);  // [1/s] >= 0
  Status set_gravity_scale(BodyId body, Real scale);           // [-] finite
  Status set_can_sleep(BodyId body, bool can_sleep);
  Status set_continuous(BodyId body, bool continuous);
  Status set_user_data(BodyId body, std::uint64_t user_data);

  // --- changing colliders ----------------------------------------------------------------------
  // The fields of Collider, with its ranges; a mass that is not the body's own follows. All but
  // set_user_data wake the body and what lies on it. Contacts last where the surfaces still touch.
  Status set_shape(ColliderId collider, const Shape& shape);
  Status set_local_pose(ColliderId collider, const LocalPose& pose);  // in the body frame
  Status set_material(ColliderId collider, const Material& material);
  Status set_density(ColliderId collider, double density);  // [kg/m^3] >= 0
  // Contacts end when it becomes a sensor, overlaps when it becomes solid; the others begin with
  // the next step.
  Status set_sensor(ColliderId collider, bool is_sensor);
  // Pairs that met it one-way keep their side, solid or passing, until they part.
  Status set_one_way(ColliderId collider, const Vec3& direction);  // zero: solid from everywhere
  Status set_user_data(ColliderId collider, std::uint64_t user_data);

  // --- acting on joints ------------------------------------------------------------------------
  // axis: 0 of a hinge or slider; 0 to 5 of a six-dof joint. Empty: none. Both wake the bodies.
  Status set_joint_motor(JointId joint, const std::optional<JointMotor>& motor, int axis = 0);
  Status set_joint_limit(JointId joint, const std::optional<JointLimit>& limit, int axis = 0);

  // --- effects (plumb/effects.h) ---------------------------------------------------------------
  // Each is checked, recorded and part of the state. All wake what they may set in motion; effects
  // end with their bodies.
  Created<EffectId> create_effect(const Effect& effect);
  Status set_effect(EffectId effect, const Effect& changed);  // may name another kind or body
  Status destroy_effect(EffectId effect);
  // What ForceField::field stands for; null takes it away. Neither recorded nor saved: whoever
  // replays or restores registers it again, before.
  Status set_force_field(std::uint32_t field, ForceFieldFunction function, void* context = nullptr);

  // --- contact data ----------------------------------------------------------------------------
  // Sets the belt running, or stops it; wakes the body and what lies on it.
  Status set_surface_velocity(ColliderId collider, const SurfaceVelocity& velocity);
  Status set_filter(ColliderId collider, const Filter& filter);  // wakes the body and what it meets
  // What two kinds of material (Material::kind, not 0; the order does not matter) do when they
  // meet. Empty: what their colliders' numbers combine to. Wakes what touches that way.
  Status set_material_pair(std::uint32_t kind_a, std::uint32_t kind_b,
                           const std::optional<MaterialPair>& values);
  [[nodiscard]] std::optional<MaterialPair> material_pair(std::uint32_t kind_a,
                                                          std::uint32_t kind_b) const;
  // Two that are excluded never touch nor sense each other, whatever their filters say, until they
  // are let again (excluded = false) or either is destroyed. Wakes both. Not the same one twice.
  Status exclude_pair(BodyId a, BodyId b, bool excluded = true);
  Status exclude_pair(ColliderId a, ColliderId b, bool excluded = true);
  [[nodiscard]] bool is_excluded(BodyId a, BodyId b) const;
  [[nodiscard]] bool is_excluded(ColliderId a, ColliderId b) const;  // themselves, not the bodies

  // --- stepping --------------------------------------------------------------------------------
  // dt: [s] finite, >= 0; 0 does nothing. Returns the report, also available as last_report().
  const StepReport& step(double dt);
  [[nodiscard]] const StepReport& last_report() const;
  [[nodiscard]] Events events() const;
  [[nodiscard]] StepPlan plan() const;  // for the scene as it stands
  // The active items of plan() without words, bit by bit_of(item): some nanoseconds a body.
  [[nodiscard]] std::uint64_t planned_items() const;
  // Observers see every step from now on. Not owned.
  void attach(StepObserver* observer);
  void detach(StepObserver* observer);

  // --- reading ---------------------------------------------------------------------------------
  [[nodiscard]] bool is_valid(BodyId body) const;
  [[nodiscard]] bool is_valid(ColliderId collider) const;
  [[nodiscard]] bool is_valid(JointId joint) const;
  // For handles that are not valid these return default values.
  [[nodiscard]] BodyState state(BodyId body) const;
  [[nodiscard]] Pose pose(BodyId body) const;
  [[nodiscard]] Vec3 linear_velocity(BodyId body) const;   // [m/s] of the centre of mass
  [[nodiscard]] Vec3 angular_velocity(BodyId body) const;  // [rad/s] world axes
  [[nodiscard]] Vec3 velocity_at(BodyId body, const Pos3& p_W) const;  // [m/s]
  [[nodiscard]] Vec3 angular_momentum(BodyId body) const;  // [kg m^2/s] about its centre of mass
  [[nodiscard]] Pos3 center_of_mass(BodyId body) const;    // [m] world
  [[nodiscard]] Vec3 last_acceleration(
      BodyId body) const;  // [m/s^2] from forces and gravity in the last step
  [[nodiscard]] MassProperties mass_properties(
      BodyId body) const;  // in the body frame; mass 0 for static
  [[nodiscard]] bool is_awake(BodyId body) const;
  [[nodiscard]] std::span<const ColliderId> colliders_of(BodyId body) const;
  [[nodiscard]] BodyId body_of(ColliderId collider) const;
  [[nodiscard]] Collider collider(ColliderId collider) const;
  [[nodiscard]] RigidBody body(BodyId body) const;  // as it could be created again now
  [[nodiscard]] std::size_t body_count() const;
  [[nodiscard]] Joint joint(JointId joint) const;
  [[nodiscard]] JointState joint_state(JointId joint) const;
  [[nodiscard]] JointReaction joint_reaction(JointId joint) const;  // of the last step
  [[nodiscard]] std::vector<JointId> joints_of(BodyId body) const;  // by index
  [[nodiscard]] std::size_t joint_count() const;
  [[nodiscard]] bool is_valid(EffectId effect) const;
  [[nodiscard]] Effect effect(EffectId effect) const;
  [[nodiscard]] std::vector<EffectId> effects_of(
      BodyId body) const;  // by index; null: those of all
  [[nodiscard]] std::size_t effect_count() const;
  [[nodiscard]] EffectReport effect_report(EffectId effect) const;
  [[nodiscard]] EffectLedger effect_ledger() const;
  [[nodiscard]] const WorldSettings& settings() const;
  [[nodiscard]] double time() const;  // [s]
  [[nodiscard]] std::uint64_t step_count() const;

  // In bulk, in order of their index; the vector is cleared first and keeps its storage.
  void copy_body_states(std::vector<BodyState>& out) const;
  void copy_moved_body_states(std::vector<BodyState>& out) const;  // only those the last step moved
  void copy_contacts(std::vector<ContactState>& out) const;
  void copy_contact_points(std::vector<ContactPoint>& out) const;  // the same, without whose
  // The same one by one, with no list: false when there is no further one.
  bool next_contact(ContactCursor& at, ContactState& out) const;
  template <class Visit>
  void each_contact(Visit&& visit) const {
    ContactState contact;
    for (ContactCursor at; next_contact(at, contact);) visit(contact);
  }
  // What one sensor sees: its part of Events::overlaps.
  [[nodiscard]] std::span<const SensorOverlap> overlaps_of(ColliderId sensor) const;
  [[nodiscard]] EnergyReport energy() const;
  // All of the above lists in a few block copies, to be read on another thread.
  void copy_image(WorldImage& image) const;

  // --- queries ---------------------------------------------------------------------------------
  // What holds for all of them stands in plumb/queries.h. Lists are cleared first.
  [[nodiscard]] std::optional<RayHitResult> cast_ray(const Pos3& origin, const Vec3& translation,
                                                     const QueryFilter& filter) const;
  [[nodiscard]] std::optional<RayHitResult> cast_ray(const Pos3& origin, const Vec3& translation,
                                                     std::uint32_t layers = 0xffffffffu) const;
  // Whether anything is hit: the cheapest question (line of sight).
  [[nodiscard]] bool ray_is_blocked(const Pos3& origin, const Vec3& translation,
                                    const QueryFilter& filter = {}) const;
  // Where the ray enters each collider, in order.
  void cast_ray_all(const Pos3& origin, const Vec3& translation, std::vector<RayHitResult>& out,
                    const QueryFilter& filter = {}) const;

  [[nodiscard]] std::optional<ShapeHitResult> cast_shape(const ShapeCast& cast,
                                                         const QueryFilter& filter = {}) const;
  // Where the shape would meet each collider if it went through the others, in order.
  void cast_shape_all(const ShapeCast& cast, std::vector<ShapeHitResult>& out,
                      const QueryFilter& filter = {}) const;
  // Colliders that overlap or touch the shape, in order of their id.
  void overlap_shape(const Shape& shape, const Pose& pose, std::vector<ColliderId>& out,
                     const QueryFilter& filter = {}) const;

  // The collider nearest to a point or shape, no farther than max_distance [m] >= 0.
  [[nodiscard]] std::optional<ClosestPointResult> closest_point(
      const Pos3& point, Real max_distance, const QueryFilter& filter = {}) const;
  [[nodiscard]] std::optional<ClosestPointResult> closest_point(
      const Shape& shape, const Pose& pose, Real max_distance,
      const QueryFilter& filter = {}) const;
  // All of them within that distance, nearest first.
  void closest_points(const Pos3& point, Real max_distance, std::vector<ClosestPointResult>& out,
                      const QueryFilter& filter = {}) const;
  void closest_points(const Shape& shape, const Pose& pose, Real max_distance,
                      std::vector<ClosestPointResult>& out, const QueryFilter& filter = {}) const;

  // Colliders whose own bounds meet the box, in order of their id.
  void overlap_bounds(const Bounds& box, std::vector<ColliderId>& out,
                      std::uint32_t layers = 0xffffffffu) const;  // sensors too
  void overlap_bounds(const Bounds& box, std::vector<ColliderId>& out,
                      const QueryFilter& filter) const;

  // Many at once: hits[i] answers question i, with a null collider where there is none. The spans
  // have one length, or nothing is done. jobs: threads to run on, null for the calling one.
  Status cast_rays(std::span<const Ray> rays, std::span<RayHitResult> hits,
                   const QueryFilter& filter = {}, JobSystem* jobs = nullptr) const;
  Status cast_shapes(std::span<const ShapeCast> casts, std::span<ShapeHitResult> hits,
                     const QueryFilter& filter = {}, JobSystem* jobs = nullptr) const;
  Status closest_points(std::span<const Pos3> points, Real max_distance,
                        std::span<ClosestPointResult> nearest, const QueryFilter& filter = {},
                        JobSystem* jobs = nullptr) const;

  // --- replay ----------------------------------------------------------------------------------
  [[nodiscard]] Snapshot save() const;
  void save(Snapshot& snapshot) const;       // into the storage of an older one
  Status restore(const Snapshot& snapshot);  // observers and job system stay
  // A 64-bit digest of everything that the next step depends on in bodies and contacts.
  [[nodiscard]] std::uint64_t state_hash() const;
  // Of the bodies alone: cheap enough for every frame. Whatever differs in contacts reaches the
  // bodies within the next step.
  [[nodiscard]] std::uint64_t motion_hash() const;
  // Does what a recorded call did.
  Status apply_input(const InputRecord& input);

 private:
  std::unique_ptr<detail::WorldState> state_;
};

}  // namespace plumb::inline PLUMB_ABI
