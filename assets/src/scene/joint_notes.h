// What looks like a slip in a joint that can be made all the same: sides far apart, angles that
// read like degrees.
#pragma once

#include <string>
#include <vector>

#include "plumb/assets/scene.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// The joint is in the world already, which stands as the scene begins.
void note_slips_of(const std::string& name, JointId joint, const PhysicsWorld& world,
                   std::vector<std::string>& notes);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
