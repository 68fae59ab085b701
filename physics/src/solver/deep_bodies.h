// What a step does to bodies that overlap deeply: how many of them have another velocity for being
// relaxed more than once, and which tumble while they are pushed out, although neither before the
// step nor after it.
#pragma once

#include <algorithm>

#include "world/forced.h"
#include "world/visible.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

class DeepBodies {
 public:
  // Of all bodies, or of a group without such.
  DeepBodies(WorldState& world, bool some)
      : world_(world),
        bodies_(deep_bodies(world, some)),
        after_one_(bodies_.size(), &world.memory),
        seen_(bodies_.size(), &world.memory) {}

  // Before the drift.
  void note_tumbling() {
    for_all([&](std::uint32_t body, std::size_t k) {
      const Vec w = world_.bodies.velocity[body].w;
      const Symmetric3<Real>& I = world_.substep[body].I;
      seen_[k].tumbled += world_.h * length(cross(w, I * w));
    });
  }
  void note_one_pass() {
    for_all(
        [&](std::uint32_t body, std::size_t k) { after_one_[k] = world_.bodies.velocity[body]; });
  }
  void note_all_passes() {
    for_all([&](std::uint32_t body, std::size_t k) {
      const BodyVelocity &now = world_.bodies.velocity[body], &then = after_one_[k];
      seen_[k].dv += length(now.v - then.v);
      seen_[k].dw += length(now.w - then.w);
    });
  }
  [[nodiscard]] std::uint32_t bodies_that_gained() const {
    std::uint32_t count = 0;
    for_all([&](std::uint32_t body, std::size_t k) {
      const Vec dv{seen_[k].dv, 0, 0}, dw{seen_[k].dw, 0, 0};
      if (parts_visibly(world_.bodies.mass[body], dv, dw, world_.dt)) ++count;
    });
    return count;
  }
  // For the plan.
  void list_tumblers() {
    world_.tumbled.clear();
    const Real g = static_cast<Real>(world_.settings.gravity.norm());
    for_all([&](std::uint32_t body, std::size_t k) {
      const BodyMass& mass = world_.bodies.mass[body];
      const Real company = mass.mass * g * gyration_of(mass) * world_.dt;
      const Real whole = length(world_.bodies.momentum[body].L) + company;
      if (seen_[k].tumbled > kSteadyTurn * whole && !is_round(mass) && mass.angular_locks == 0)
        world_.tumbled.push_back(world_.bodies.slot_of[body]);
    });
  }

 private:
  struct Seen {
    Real dv = 0, dw = 0;  // [m/s], [rad/s] by all passes but the first, summed over the step
    Real tumbled = 0;     // [kg m^2/s] |w x I w| over the step
  };

  static StepList<std::uint32_t> deep_bodies(WorldState& world, bool some) {
    StepList<std::uint32_t> bodies(&world.memory);
    if (!some) return bodies;
    for (std::uint32_t i = world.bodies.awake_begin; i < world.bodies.awake_end; ++i)
      if (world.overlaps_deeply[i] != 0) bodies.push_back(i);
    return bodies;
  }
  template <class Task>
  void for_all(Task&& task) const {
    for (std::size_t k = 0; k < bodies_.size(); ++k) task(bodies_[k], k);
  }

  WorldState& world_;
  StepList<std::uint32_t> bodies_;    // dense
  StepList<BodyVelocity> after_one_;  // pass, in this substep
  StepList<Seen> seen_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
