// What a scene file says about pairs: the table of materials, and who never meets whom.
#pragma once

#include <vector>

#include "plumb/assets/scene.h"
#include "scene/object_reader.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

void read_material_pairs(const JsonNode& list, std::vector<SceneMaterialPair>& pairs,
                         Problems& problems);
// Of a scene whose bodies have been read.
void read_excluded_pairs(const JsonNode& list, Scene& scene, Problems& problems);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
