// A joint as it stands in a scene file.
#pragma once

#include "plumb/assets/scene.h"
#include "scene/json_words.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

Json json_of_joint(const SceneJoint& joint);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
