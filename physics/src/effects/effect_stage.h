// Effects within a step: who acts on whom, what each body is seen as, and what it is given.
#pragma once

#include <cstdint>
#include <vector>

#include "effects/effect_store.h"
#include "effects/stiff_solve.h"
#include "math/quaternion.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// A body that some effect acts on in this step.
struct AffectedBody {
  std::uint32_t slot = 0, dense = 0;
  // What acts on it without effects, put back at the end of the step.
  Vec base_acceleration{0, 0, 0}, base_torque{0, 0, 0};
  Real base_damping = 0;

  // The body as effects see it: in the middle of the substep, where it gets by itself.
  double mass = 0;  // [kg]
  InverseMass inverse;
  NumVec x{0, 0, 0};              // [m] centre of mass
  NumRotation q{0, 0, 0, 1};      // R_WP
  NumVec v{0, 0, 0}, w{0, 0, 0};  // [m/s], [rad/s] at the start of the substep

  // What acts on it, as far as the pools have come.
  Wrench soft;                    // known forces, gravity and what users applied included
  double rate = 0;                // [1/s] of linear drag
  NumVec drawn{0, 0, 0};          // [m/s^2] sum of rate x velocity of the medium
  std::uint32_t stiff = kNone;    // its StiffBody
  NumVec springs{0, 0, 0};        // [N]
  NumVec spring_torque{0, 0, 0};  // [N m]
  double held = 0;                // [N] by springs and water

  // For the books.
  Vec path_start{0, 0, 0};  // [m] delta.dp when the substep began
  bool free = false;        // no row holds it
};

// What resists one body, of all effects together.
struct StiffBody {
  std::uint32_t affected = 0;
  Matrix6 D, K;         // [N s/m], [N/m] and their angular kin
  Wrench f0;            // where the body gets without it
  Wrench acceleration;  // M^-1 f, once solved
  double theta = 0.5;
};

// One effect on one body (a spring: on two), in this step.
struct EffectLink {
  std::uint32_t effect = 0;                   // slot
  std::uint32_t body = kNone, other = kNone;  // affected; kNone: the world, or at rest
  std::uint32_t stiff = kNone;                // its StiffShare
  Wrench given;                               // [N s], [N m s] to the body, in this step so far
  // In this substep:
  Wrench wrench, wrench_on_other;
  double rate = 0;         // [1/s] its share of the drag
  NumVec medium{0, 0, 0};  // [m/s]
};
struct StiffShare {
  Matrix6 D, K;
  Wrench f0;
};

// One end of a spring, and a spring within a substep (springs.cpp).
struct SpringEnd {
  AffectedBody* body = nullptr;              // null: it does not give way
  NumVec arm{0, 0, 0};                       // [m] world axes
  NumVec point{0, 0, 0}, velocity{0, 0, 0};  // in the middle of the substep
};
struct SpringRow {
  const Spring* spring;
  EffectLink* link;
  SpringEnd a, b;
  NumVec d{0, 1, 0};                          // A to B
  bool acts = true;                           // one-sided: whether it does
  double force = 0;                           // [N] on B along d, mean over the substep
  double known = 0;                           // [N] ... if the springs moved nothing
  double give = 0;                            // [N s^2/m] by which acceleration along d lessens it
  double rest = 0, search = 0, response = 0;  // of the conjugate gradients
};

struct EffectScratch {
  std::vector<AffectedBody> bodies;
  std::vector<StiffBody> stiff;
  std::vector<EffectLink> links;  // by kind, then slot, then body
  std::vector<StiffShare> shares;
  std::vector<SpringRow> spring_rows;
  std::uint32_t first[kEffectKindCount + 1] = {};  // links of each kind
  std::uint32_t showed[kEffectKindCount] = {};     // ... that moved their body visibly
  // By dense index: the affected body, where the stamp is that of the step.
  std::vector<std::uint64_t> stamp;
  std::vector<std::uint32_t> affected_of;
  std::uint64_t now = 0;
  double h = 0;     // [s] substep
  double time = 0;  // [s] of the world in the middle of the substep
  NumVec gravity{0, 0, 0};
};

// --- for the pools' functions --------------------------------------------------------------------

// Where soft forces, and drag, bring the body by the middle of the substep.
struct StiffView {
  NumVec x, v, w;
};
StiffView stiff_view(const EffectScratch& scratch, const AffectedBody& body);
// A place for what resists; the pool's function fills it and calls add_stiff().
StiffShare& stiff_share(EffectScratch& scratch, EffectLink& link);
void add_stiff(EffectScratch& scratch, EffectLink& link);

inline void add_soft(AffectedBody& body, EffectLink& link, const Wrench& wrench) {
  link.wrench = wrench;
  body.soft = body.soft + wrench;
}
// Point of the body frame, from its centre of mass, world axes.
NumVec arm_of(const WorldState& world, const AffectedBody& body, const Vec3& p_B);
NumRotation body_axes(const WorldState& world, const AffectedBody& body);  // R_WB

// Links of one kind.
template <class Kind, class Act>
void for_links(EffectStore& store, Act&& act) {
  EffectScratch& scratch = *store.scratch;
  const std::size_t kind = EffectKind(std::in_place_type<Kind>).index();
  for (std::uint32_t i = scratch.first[kind]; i < scratch.first[kind + 1]; ++i) {
    EffectLink& link = scratch.links[i];
    act(std::get<Kind>(store.info[link.effect].component.kind), link);
  }
}

// --- one function over each pool, in the order in which they act ---------------------------------
void act_point_gravity(WorldState& world);
void act_force_fields(WorldState& world);
void act_thrust(WorldState& world);
void act_explosions(WorldState& world);
void act_drag(WorldState& world);
void act_magnus(WorldState& world);
void act_attractors(WorldState& world);
void act_wind(WorldState& world);
void act_aero_surfaces(WorldState& world);
void act_buoyancy(WorldState& world);
void act_springs(WorldState& world);  // last: springs see what all the others do

// Whether an effect may act on a body within the next step. `ever`: at any later time, if nothing
// changes.
bool may_act(const WorldState& world, const EffectInfo& effect, std::uint32_t body, bool ever);
// Whether a body that it does not act on yet must stay awake for it.
bool is_awaited(const WorldState& world, const EffectInfo& effect, std::uint32_t body);
// Potential energy of the effect and one body now [J].
double potential_of(const WorldState& world, const EffectInfo& effect, std::uint32_t body);

}  // namespace plumb::inline PLUMB_ABI::detail
