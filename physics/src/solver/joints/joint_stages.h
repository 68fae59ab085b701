// What the stages of the step do with joints. None of it is called in a world without any.
#pragma once

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// Colours the joints that are awake, marks their bodies as held, and fills the blocks.
void build_joints(WorldState& world);
// Taut lines that touch something: inertia as rows see it in this step.
void stiffen_taut_joints(WorldState& world);
// Groups that touch nothing: the whole substep of their bodies.
void fly_joint_groups(WorldState& world);
// The others: impulses of the last substep, then the passes before the drift.
void warm_start_joints(WorldState& world);
void solve_joints(WorldState& world);
// Where the drift has ended: the passes on velocities alone.
void relax_joints(WorldState& world);
// Impulses, angles and reactions go back to the joints.
void store_joints(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
