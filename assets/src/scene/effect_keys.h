// The keys of effects in a scene file, kind by kind.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

using Keys = std::span<const std::string_view>;

namespace keys {

inline constexpr std::string_view kPointGravity[] = {"kind",   "name", "body",
                                                     "center", "mu",   "softening"};
inline constexpr std::string_view kThrust[] = {"kind",  "name",  "body",
                                               "force", "point", "in_world_axes"};
inline constexpr std::string_view kExplosion[] = {
    "kind",      "name",    "body",           "center",         "impulse",
    "reference", "falloff", "speed",          "thickness",      "range",
    "area",      "updraft", "chimney_radius", "chimney_height", "updraft_duration"};
inline constexpr std::string_view kDrag[] = {
    "kind", "name", "body", "linear", "quadratic", "angular_linear", "angular_quadratic", "medium"};
inline constexpr std::string_view kMagnus[] = {"kind", "name", "body", "coefficient", "medium"};
inline constexpr std::string_view kAttractor[] = {"kind",     "name", "body",  "center",
                                                  "strength", "law",  "range", "softening"};
inline constexpr std::string_view kWind[] = {"kind",    "name",     "body",    "velocity",
                                             "density", "pressure", "friction"};
inline constexpr std::string_view kAeroSurface[] = {"kind",        "name",    "body",    "tensor",
                                                    "minimum",     "maximum", "control", "point",
                                                    "orientation", "wind"};
inline constexpr std::string_view kBuoyancy[] = {
    "kind",  "name",    "body",        "density",        "normal",
    "level", "current", "linear_drag", "quadratic_drag", "angular_drag"};
inline constexpr std::string_view kSpring[] = {"kind",    "name",        "body",        "other",
                                               "point",   "other_point", "rest_length", "stiffness",
                                               "damping", "acts"};

}  // namespace keys

// In the order of EffectKind; a field of the user's own is a function and has no word.
struct EffectKeys {
  std::string_view kind;
  Keys keys;
};
inline constexpr std::array<EffectKeys, 11> kEffectKeys{{{"point_gravity", keys::kPointGravity},
                                                         {"", {}},
                                                         {"thrust", keys::kThrust},
                                                         {"explosion", keys::kExplosion},
                                                         {"drag", keys::kDrag},
                                                         {"magnus", keys::kMagnus},
                                                         {"attractor", keys::kAttractor},
                                                         {"wind", keys::kWind},
                                                         {"aero_surface", keys::kAeroSurface},
                                                         {"buoyancy", keys::kBuoyancy},
                                                         {"spring", keys::kSpring}}};
inline constexpr std::string_view kAttractorLaws[] = {"constant", "linear", "inverse_square"};
inline constexpr std::string_view kSpringActs[] = {"always", "when_stretched", "when_compressed"};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
