// Where two rows of bodies part, and by how much.
#pragma once

#include "replay/load.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

BodyRow body_row(const PhysicsWorld& world);

// Fills body, quantity and the two numbers of the difference: of the first of position,
// orientation, velocities and wakefulness that is not bit-equal, the body in which it differs most.
void name_difference(const BodyRow& recorded, const BodyRow& computed, Difference& difference);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
