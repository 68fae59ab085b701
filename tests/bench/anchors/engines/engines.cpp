#include "bench/anchors/engines/engine.h"

namespace plumb::anchors {

const std::vector<EngineKind>& engine_kinds() {
  static const std::vector<EngineKind> kinds = [] {
    std::vector<EngineKind> all = plumb_kinds();
#ifdef PLUMB_ANCHORS_RAPIER
    all.push_back(rapier_kind());
#endif
#ifdef PLUMB_ANCHORS_BOX3D
    all.push_back(box3d_kind());
#endif
#ifdef PLUMB_ANCHORS_BULLET
    all.push_back(bullet_kind());
#endif
#ifdef PLUMB_ANCHORS_ODE
    all.push_back(ode_kind());
#endif
#ifdef PLUMB_ANCHORS_MUJOCO
    for (EngineKind& kind : mujoco_kinds()) all.push_back(std::move(kind));
#endif
    return all;
  }();
  return kinds;
}

}  // namespace plumb::anchors
