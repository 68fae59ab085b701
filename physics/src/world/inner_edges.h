// Ghost collisions: contacts with edges and sides of one convex piece that a neighbour hides.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// Where pieces lie flush, as the tiles of a floor, the stones of a wall or the children of a
// compound, what slides from one to the next meets the edge or the side of the next, as if the
// first were not there. The normal n of a contact at p on a piece must lie in the normal cone of
// every piece that p lies on,
//
//   n . (x - p) <= 0  for all points x of the neighbour,
//
// or the neighbour would be in the way of whoever touches p from there. Contacts of which no point
// holds that are taken out, if the neighbour has a contact with the same body that stays: one that
// carries it. It may be hidden itself, by another that stays.
//
// What lies on many pieces at once rocks a little as it passes from one to the next, and where it
// is the larger one the normals of its contacts are its own side's. They miss the cone by as much
// as it rocks, and a force that leans with it would slow it down. Along a face that goes on in a
// flush neighbour they are turned to the one normal in both cones, the face's.
//
// Looks at bodies that touch several pieces of what is rigid: static bodies, or one body's
// colliders and children; all others cost one look at each contact. Surfaces (meshes, heightfields)
// see to their own edges.
void drop_hidden_contacts(WorldState& world);
// A body's colliders, type or shapes have changed: which of the colliders may have neighbours.
void note_neighbours(WorldState& world, std::uint32_t body);

}  // namespace plumb::inline PLUMB_ABI::detail
