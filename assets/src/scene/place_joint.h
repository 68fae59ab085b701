// From a joint as a scene describes it, by names and places, to one between the bodies of a world.
#pragma once

#include "plumb/assets/scene.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// The bodies and the joints before this one are in the world already, as `instance` says. The error
// does not name the place in the file.
Result<Joint> place_joint(const SceneJoint& joint, const PhysicsWorld& world,
                          const SceneInstance& instance);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
