// Manifolds that are kept: while the bodies of a pair have hardly moved, seen from one another,
// since its manifolds were found, they are found again by moving their points with the bodies, at a
// tenth of the cost. However far the two went together, the manifold went with them.
//
// A point p of the contact is carried by A to p + d_A and by B to p + d_B. So its separation is
//   s = s0 + n . (d_B - d_A),   d = x - x0 + (Q - 1)(p - x0),   Q the rotation since then,
// exactly for translations, to second order in the relative turn otherwise. The normal goes with
// the body that does not yield, or half with either. What lay outside the margin then has come
// nearer by less than the tolerance.
#pragma once

#include "world/pair_store.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// Notes from where the contacts of a pair, found just now with `margin` [m], may be kept.
void keep(const WorldState& world, const Pair& pair, Real margin, std::span<Contact> contacts);
// Tells the last step's contacts of the pair as of now, where they lie, if they are what a search
// with `margin` [m] would find, and returns true; else they are to be found anew. `reach` [m]: by
// which surfaces may approach in this step.
bool recycle(WorldState& world, const Pair& pair, Real margin, Real reach);

}  // namespace plumb::inline PLUMB_ABI::detail
