// Shows a scene's meshes in its recording, in place of the hulls that they collide as.
#pragma once

#if defined(PLUMB_WITH_REPLAY)

#include "plumb/assets/scene.h"
#include "plumb/replay/recorder.h"

namespace plumb::inline PLUMB_ABI::integration {

// Bodies whose colliders are all meshes look like them; others are drawn as their colliders. To be
// called before the recorder is attached to the world.
void show_meshes(replay::Recorder& recorder, const assets::SceneInstance& instance);

}  // namespace plumb::inline PLUMB_ABI::integration

#endif
