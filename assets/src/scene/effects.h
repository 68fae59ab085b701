// Effects of a scene file: reading, writing, and their way into a world.
#pragma once

#include "plumb/assets/scene.h"
#include "scene/json_words.h"
#include "scene/object_reader.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Of a scene whose bodies have been read.
void read_effects(const JsonNode& list, Scene& scene, Problems& problems);
Json json_of_effect(const SceneEffect& effect);
// With its bodies, and the length that a spring has as they stand.
Effect place_effect(const SceneEffect& effect, const PhysicsWorld& world,
                    const SceneInstance& instance);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
