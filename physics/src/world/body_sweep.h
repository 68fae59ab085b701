// How a body moves during the running step, seen after the substeps: as a sweep over the step.
#pragma once

#include "collision/contact_points.h"
#include "collision/time_of_impact.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

inline NumRotation to_num(Rotation q) {
  return {static_cast<Num>(q.x), static_cast<Num>(q.y), static_cast<Num>(q.z),
          static_cast<Num>(q.w)};
}
inline Rotation to_real(NumRotation q) {
  return normalized(Rotation{static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z),
                             static_cast<Real>(q.w)});
}

// A dynamic body that no contact holds and no effect moves: it has flown the whole step at once.
inline bool flies_free(const WorldState& world, std::uint32_t dense) {
  const SubstepBody& s = world.substep[dense];
  return !s.constrained && !s.affected && world.bodies.mass[dense].mass > Real(0);
}
// ... and whose path is a parabola, without damping.
inline bool flies_a_parabola(const WorldState& world, std::uint32_t dense) {
  return flies_free(world, dense) && world.bodies.force[dense].linear_damping == Real(0);
}

// Centre of mass relative to `reference`; bodies that do not move in this step are at rest. Free
// bodies follow their true path, others the straight one between the step's ends.
Sweep sweep_of_step(const WorldState& world, std::uint32_t dense, PosVec reference);
// Its two parts: most paths meet nothing, and how the body turns on them is never asked.
Sweep path_of_step(const WorldState& world, std::uint32_t dense, PosVec reference);
void add_turn_of_step(const WorldState& world, std::uint32_t dense, Sweep& sweep);

inline SweptShape swept_shape(const ColliderInfo& collider, const Sweep& sweep) {
  return {collider.shape, to_num(collider.in_body.p), to_num(collider.in_body.q), sweep};
}

}  // namespace plumb::inline PLUMB_ABI::detail
