// Effects, by slot, and one list of slots for each kind. A world that never had an effect has no
// store at all.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "collision/collision_tolerances.h"
#include "plumb/effects.h"

namespace plumb::inline PLUMB_ABI::detail {

struct EffectScratch;  // effect_stage.h
struct BodySurface;    // body_surface.h

inline constexpr std::uint32_t kEveryBody = 0xffffffffu;  // or the world, as a spring's other end

// What an effect remembers from step to step.
struct EffectMemory {
  double age = 0;                  // [s] of an explosion
  double pull = 0;                 // [N] of a spring in the last substep: where the next begins
  double step_work = 0, work = 0;  // [J]
  NumVec force{0, 0, 0}, torque{0, 0, 0};  // [N], [N m] means over the last step
};

struct EffectInfo {
  std::uint32_t generation = 0;
  bool alive = false;
  std::uint32_t body = kEveryBody, other = kEveryBody;  // slots
  Effect component;                                     // as given
  EffectMemory memory;
};

struct FieldHook {
  std::uint32_t field = 0;
  ForceFieldFunction function = nullptr;
  void* context = nullptr;
};

class EffectStore {
 public:
  std::uint32_t create(const Effect& component);
  void replace(std::uint32_t slot, const Effect& component);
  void destroy(std::uint32_t slot);
  [[nodiscard]] bool empty() const { return alive_count == 0; }
  [[nodiscard]] EffectId id(std::uint32_t slot) const { return {slot, info[slot].generation}; }
  [[nodiscard]] bool is_valid(EffectId effect) const {
    return effect.index < info.size() && info[effect.index].alive &&
           info[effect.index].generation == effect.generation;
  }
  [[nodiscard]] const FieldHook* hook(std::uint32_t field) const;
  // The colliders of a body changed: what was derived from them is no more.
  void forget_surface(std::uint32_t body) {
    if (body < surfaces.size()) surfaces[body].reset();
    hulls.clear();
  }
  void link(std::uint32_t slot);  // into the pool of its kind

  std::vector<EffectInfo> info;
  std::vector<std::uint32_t> free_slots;  // reused last in, first out
  std::uint32_t alive_count = 0;
  std::vector<std::uint32_t> pool[kEffectKindCount];         // slots, ascending
  std::vector<FieldHook> hooks;                              // not part of the state
  std::vector<std::shared_ptr<const BodySurface>> surfaces;  // by body slot, made when asked for
  std::vector<std::shared_ptr<const BodySurface>> hulls;     // by effect slot, the same
  std::shared_ptr<EffectScratch> scratch;                    // of the running step

 private:
  void unlink(std::uint32_t slot);
};

}  // namespace plumb::inline PLUMB_ABI::detail
