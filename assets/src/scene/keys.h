// Every key that a scene file may hold, object by object. The loader refuses all others, and a test
// holds this table against the published schema (assets/schema/scene.schema.json).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

using Keys = std::span<const std::string_view>;

namespace keys {

inline constexpr std::string_view kScene[] = {"$schema",     "plumb_scene", "name",
                                              "description", "step",        "settings",
                                              "materials",   "meshes",      "bodies"};
inline constexpr std::string_view kStep[] = {"dt", "rate", "duration"};
inline constexpr std::string_view kSettings[] = {
    "gravity",  "substeps",      "contact_frequency", "contact_damping_ratio",
    "rotation", "warm_starting", "sleeping",          "time_to_sleep"};
inline constexpr std::string_view kMaterial[] = {"friction", "restitution", "friction_rule",
                                                 "restitution_rule"};
inline constexpr std::string_view kMesh[] = {"file",    "metres_per_unit",   "up",     "collision",
                                             "density", "max_hull_vertices", "mass_of"};
inline constexpr std::string_view kMassOf[] = {"method", "thickness", "resolution"};
inline constexpr std::string_view kBody[] = {"name",
                                             "type",
                                             "position",
                                             "orientation",
                                             "linear_velocity",
                                             "angular_velocity",
                                             "linear_damping",
                                             "angular_damping",
                                             "gravity_scale",
                                             "locks",
                                             "can_sleep",
                                             "starts_awake",
                                             "mass",
                                             "colliders",
                                             "repeat"};
inline constexpr std::string_view kMass[] = {"mass", "center", "inertia"};
inline constexpr std::string_view kOrientation[] = {"quaternion", "euler_degrees", "axis_angle"};
inline constexpr std::string_view kCollider[] = {
    "shape",    "radius",  "half_extents", "half_length",   "rounding",
    "normal",   "offset",  "mesh",         "position",      "orientation",
    "material", "density", "layers",       "collides_with", "sensor"};
inline constexpr std::string_view kRepeat[] = {"count", "spacing", "jitter", "random_orientation",
                                               "seed"};

// For the test: the table above under the names that the schema's "$defs" use.
struct Named {
  std::string_view name;
  Keys keys;
};
inline constexpr std::array<Named, 11> kAll{{{"scene", kScene},
                                             {"step", kStep},
                                             {"settings", kSettings},
                                             {"material", kMaterial},
                                             {"mesh", kMesh},
                                             {"mass_of", kMassOf},
                                             {"body", kBody},
                                             {"mass", kMass},
                                             {"orientation", kOrientation},
                                             {"collider", kCollider},
                                             {"repeat", kRepeat}}};

}  // namespace keys

// Which of the collider's keys belong to which shape.
struct ShapeKeys {
  std::string_view shape;
  std::array<std::string_view, 3> keys;  // empty text: none
  int needed;                            // so many of them, from the first
};
inline constexpr std::array<ShapeKeys, 7> kShapeKeys{
    {{"sphere", {"radius", "", ""}, 1},
     {"box", {"half_extents", "rounding", ""}, 1},
     {"capsule", {"half_length", "radius", ""}, 2},
     {"half_space", {"normal", "offset", ""}, 2},
     {"mesh", {"mesh", "rounding", ""}, 1},
     {"cylinder", {"half_length", "radius", "rounding"}, 2},
     {"cone", {"half_length", "radius", "rounding"}, 2}}};

// Words with a fixed meaning, in the order of the enum they stand for.
inline constexpr std::string_view kMotionTypes[] = {"static", "kinematic", "dynamic"};
inline constexpr std::string_view kRotationMethods[] = {"exact", "implicit_gyro", "book"};
inline constexpr std::string_view kCombineRules[] = {"average", "geometric_mean", "minimum",
                                                     "maximum", "multiply"};
inline constexpr std::string_view kAxes[] = {"x", "y", "z"};
inline constexpr std::string_view kCollisions[] = {"hull"};
inline constexpr std::string_view kMassMethods[] = {"solid", "shell", "hull", "voxel"};
inline constexpr std::string_view kLocks[] = {"linear_x",  "linear_y",  "linear_z",
                                              "angular_x", "angular_y", "angular_z"};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
