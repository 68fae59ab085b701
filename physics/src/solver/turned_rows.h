// Rows of bodies that turn fast. A row holds its arms, the places of its points and the inertia for
// a step; a body that turns by a good part of a radian meanwhile would be pushed at points that
// have long gone elsewhere, and gain energy by it. Such rows are told anew twice a substep: where
// the contact points have been carried, how deep they are, and how the bodies yield there now.
#pragma once

#include "solver/contact_row.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

struct StepGroup;
struct WorldState;

// Motion of the bodies up to which a row is told.
struct TurnedRow {
  std::uint32_t row = 0;
  BodyDelta a, b;
  ContactRow<Real> as_begun;  // the row when the step began
};

// [rad/s] of the turning that shows: about the axis of a body of revolution nothing changes.
Real visible_turning(const BodyMass& m, Rotation q, Vec w);
// Which rows of this step are such, once they are built.
void find_turned_rows(WorldState& world);
// Tells them, and the inertia of their bodies, as of now. Angular velocity and momentum of the
// bodies must agree (no row has acted since the last kick or drift).
void renew_turned_rows(WorldState& world);

// Rows that may bounce keep their arms: a bounce needs the places of the step's start. But a body
// that it has set spinning is told to them with its inertia as of now; that of the step's start
// would make energy out of every impulse. As above, before rows act.
void renew_bouncing_rows(WorldState& world);

// Bodies of a group that rows have set spinning within the step: their rows leave the blocks
// (contact_blocks.h) and see the inertia as of now, by which momentum becomes velocity, in place of
// the step's start. Returns whether blocks were filled anew. As above, before rows act.
bool renew_spun_rows(WorldState& world, StepGroup& group);

// Whether it showed in this step that a row was told anew.
bool telling_showed(const WorldState& world, const ContactRow<Real>& row);

// Motion of a row's bodies since the row was told.
BodyDelta delta_of_a(const WorldState& world, const ContactRow<Real>& row);
BodyDelta delta_of_b(const WorldState& world, const ContactRow<Real>& row);

// Responses of a row from its arms, points and inertia (rows.cpp).
void fill_responses(ContactRow<Real>& row);

}  // namespace plumb::inline PLUMB_ABI::detail
