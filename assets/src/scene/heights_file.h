// Files of heights: a line of numbers for each row along z, x running along the line, with commas,
// blanks or tabs between them; nan is a hole, # begins a comment.
#pragma once

#include <string>

#include "plumb/assets/scene.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Fills in samples and heights from `path`; the reason, with file and line, if that fails.
std::string read_heights_file(SceneHeightfield& field);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
