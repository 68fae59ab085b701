// Surface properties of a collider, how two of them combine, and what meets what.
#pragma once

#include <cstdint>
#include <optional>

#include "plumb/math.h"
#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

enum class CombineRule : std::uint8_t { Average, GeometricMean, Minimum, Maximum, Multiply };

struct Material {
  Real friction = Real(0.6);   // Coulomb coefficient [-] >= 0, finite
  Real restitution = Real(0);  // normal velocity kept by a bounce [-] 0..1
  // Where two colliders name different rules, the one that stands later in CombineRule wins.
  CombineRule friction_rule = CombineRule::GeometricMean;
  CombineRule restitution_rule = CombineRule::Maximum;
  // Resistance to turning in the contact, as the lever arm of the normal force: the torque is at
  // most this times that force. The larger of two colliders' values counts.
  Real rolling_friction = Real(0);    // [m] >= 0, finite; about axes in the contact plane
  Real torsional_friction = Real(0);  // [m] >= 0, finite; about the contact normal
  // Friction with a grain, as of skates, skis, rails or brushed surfaces: of `friction` as
  // combined, all acts across the grain and this share along it, on the ellipse between. Of two
  // colliders that have one, the smaller share counts, with its grain.
  Vec3 grain = Vec3::Zero();      // axis in the collider's frame, of any length; zero: no grain
  Real grain_friction = Real(1);  // [-] 0..1
  // Glue, mud, suction: the pull that a touching pair withstands before it parts. It acts up to a
  // gap of a few millimetres, and friction feels it as it feels a load; contact impulses are told
  // with it, as the surfaces feel them. The larger of two counts.
  Real adhesion = Real(0);  // [N] >= 0, finite
  // Names what the surface is made of, for the world's table of pairs; 0: nothing in particular.
  std::uint32_t kind = 0;
};

// What two kinds of material do when they meet, instead of what their colliders' numbers combine
// to. What is left empty is combined as ever.
struct MaterialPair {
  std::optional<Real> friction{};            // [-] >= 0, finite
  std::optional<Real> restitution{};         // [-] 0..1
  std::optional<Real> rolling_friction{};    // [m] >= 0, finite
  std::optional<Real> torsional_friction{};  // [m] >= 0, finite
  friend bool operator==(const MaterialPair&, const MaterialPair&) = default;
};

// What meets what. Two colliders of one group that is not 0 always meet if it is positive, and
// never if it is negative. All others meet when each one's `collides_with` holds a bit of the
// other's `layers`. Pairs excluded by PhysicsWorld::exclude_pair() never meet.
struct Filter {
  std::uint32_t layers = 1u;
  std::uint32_t collides_with = 0xffffffffu;
  std::int32_t group = 0;
};

}  // namespace plumb::inline PLUMB_ABI
