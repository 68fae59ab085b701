// What the rest of the world does with joints. Every call below is behind a test for their being
// any.
#pragma once

#include "plumb/snapshot.h"
#include "solver/joints/joint_kinds.h"
#include "world/snapshot_table.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

Status check_softness(const JointSoftness& softness);
Status check_limit(const JointLimit& limit);
Status check_motor(const JointMotor& motor);
Status check_joint(const WorldState& world, const Joint& joint);
Status check_joint_moves(const WorldState& world,
                         const Joint& joint);  // something, when it is made

// Whether a joint between the bodies keeps them from colliding.
bool joined_without_contact(const WorldState& world, std::uint32_t body_a, std::uint32_t body_b);
// Kinematic bodies sleep alone: when one is moved, what it carries wakes.
void wake_joined(WorldState& world, std::uint32_t body);
void remove_joint(WorldState& world, std::uint32_t slot);
void remove_joints_of(WorldState& world, std::uint32_t body);
// Calls link(slot_a, slot_b) for every two awake dynamic bodies that a joint connects.
void link_joined(WorldState& world);
void link_bodies(WorldState& world, std::uint32_t body_a, std::uint32_t body_b);  // islands.cpp
void break_joints(WorldState& world);
// Joints that hold no dynamic body carry nothing, and remember nothing of what they carried.
void rest_idle_joints(WorldState& world);

void save_joints(ColumnWriter& out, const WorldState& world);
bool restore_joints(const Snapshot& in, WorldState& world);
std::uint64_t digest_of_joints(const WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
