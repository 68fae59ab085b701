// A scene in its recording: its meshes in place of the hulls that they collide as, its names.
#pragma once

#if defined(PLUMB_WITH_REPLAY)

#include "plumb/assets/scene.h"
#include "plumb/replay/recorder.h"

namespace plumb::inline PLUMB_ABI::integration {

// Bodies whose colliders are all meshes look like them; others are drawn as their colliders. To be
// called before the recorder is attached to the world.
void show_meshes(replay::Recorder& recorder, const assets::SceneInstance& instance);
// Labels what the scene gives a name of its own: joints that no other couples, and bodies that no
// joint holds. Copies of a repeat and static bodies that are neither surface nor sensor have none.
// To be called at the same time.
void show_labels(replay::Recorder& recorder, const assets::Scene& scene,
                 const assets::SceneInstance& instance, const PhysicsWorld& world);

}  // namespace plumb::inline PLUMB_ABI::integration

#endif
