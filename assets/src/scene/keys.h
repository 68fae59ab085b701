// Every key that a scene file may hold, object by object. The loader refuses all others, and a test
// holds this table against the published schema (assets/schema/scene.schema.json).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "plumb/precision.h"
#include "scene/effect_keys.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

namespace keys {

inline constexpr std::string_view kScene[] = {
    "$schema",  "plumb_scene", "name",           "description", "step",
    "settings", "materials",   "material_pairs", "meshes",      "heightfields",
    "bodies",   "joints",      "excluded_pairs", "effects"};
inline constexpr std::string_view kStep[] = {"dt", "rate", "duration"};
inline constexpr std::string_view kSettings[] = {"gravity",
                                                 "substeps",
                                                 "step_tolerance",
                                                 "contact_frequency",
                                                 "contact_damping_ratio",
                                                 "rotation",
                                                 "contact_solver",
                                                 "velocity_iterations",
                                                 "friction_cone",
                                                 "joint_order",
                                                 "warm_starting",
                                                 "sleeping",
                                                 "time_to_sleep",
                                                 "forced"};
// Items of the plan (plumb/plan_items.h), with '_' between their words.
inline constexpr std::string_view kForced[] = {"gyroscopic",
                                               "friction",
                                               "restitution",
                                               "look_ahead",
                                               "continuous",
                                               "sleeping",
                                               "rolling_friction",
                                               "surface_velocity",
                                               "anisotropic_friction",
                                               "adhesion",
                                               "accurate_contacts",
                                               "fast_turns",
                                               "deep_overlap",
                                               "kept_manifolds",
                                               "direct_joints",
                                               "joint_substeps",
                                               "step_levels",
                                               "point_gravity",
                                               "force_field",
                                               "thrust",
                                               "explosion",
                                               "drag",
                                               "magnus",
                                               "attractor",
                                               "wind",
                                               "aero_surface",
                                               "buoyancy",
                                               "spring"};
inline constexpr std::string_view kMaterial[] = {
    "friction",           "restitution", "friction_rule", "restitution_rule", "rolling_friction",
    "torsional_friction", "kind",        "grain",         "grain_friction",   "adhesion"};
inline constexpr std::string_view kMaterialPair[] = {"kinds", "friction", "restitution",
                                                     "rolling_friction", "torsional_friction"};
inline constexpr std::string_view kExcludedPair[] = {"body_a", "body_b", "collider_a",
                                                     "collider_b"};
inline constexpr std::string_view kMesh[] = {
    "file",    "metres_per_unit",   "up",      "repair", "collision",
    "density", "max_hull_vertices", "mass_of", "parts"};
inline constexpr std::string_view kMeshRepair[] = {"weld_tolerance", "orient"};
inline constexpr std::string_view kMeshParts[] = {"max_distance", "max_parts", "max_vertices"};
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
                                             "continuous",
                                             "can_sleep",
                                             "starts_awake",
                                             "mass",
                                             "colliders",
                                             "repeat"};
inline constexpr std::string_view kMass[] = {"mass", "center", "inertia"};
inline constexpr std::string_view kOrientation[] = {"quaternion", "euler_degrees", "axis_angle"};
inline constexpr std::string_view kCollider[] = {
    "shape",   "radius", "half_extents",  "half_length", "rounding", "normal",           "offset",
    "mesh",    "scale",  "heightfield",   "children",    "position", "orientation",      "material",
    "density", "layers", "collides_with", "group",       "sensor",   "surface_velocity", "one_way"};
inline constexpr std::string_view kSurfaceVelocity[] = {"linear", "angular"};
inline constexpr std::string_view kChild[] = {"shape",    "radius", "half_extents", "half_length",
                                              "rounding", "mesh",   "position",     "orientation"};
inline constexpr std::string_view kHeightfield[] = {"file", "heights", "spacing", "height_scale"};
inline constexpr std::string_view kRepeat[] = {"count", "spacing", "jitter", "random_orientation",
                                               "seed"};

// Of all kinds of joints together; which of them belong to which kind stands in kJointKeys.
inline constexpr std::string_view kJoint[] = {"name",
                                              "kind",
                                              "body_a",
                                              "body_b",
                                              "anchor",
                                              "anchor_a",
                                              "anchor_b",
                                              "axis",
                                              "orientation",
                                              "frame_a",
                                              "frame_b",
                                              "softness",
                                              "collide_connected",
                                              "break_force",
                                              "break_torque",
                                              "friction",
                                              "limit",
                                              "motor",
                                              "spring",
                                              "length",
                                              "max_length",
                                              "rest_length",
                                              "stiffness",
                                              "damping",
                                              "pulls_only",
                                              "cone",
                                              "cone_degrees",
                                              "twist",
                                              "twist_degrees",
                                              "limit_softness",
                                              "coordinates",
                                              "first",
                                              "second",
                                              "ratio",
                                              "pinion",
                                              "rack",
                                              "radius",
                                              "over_a",
                                              "over_b",
                                              "stiff",
                                              "mode",
                                              "linear",
                                              "angular",
                                              "angular_degrees",
                                              "max_force",
                                              "max_torque"};
inline constexpr std::string_view kJointFrame[] = {"position", "axis", "orientation"};
inline constexpr std::string_view kJointSoftness[] = {"frequency", "damping_ratio"};
inline constexpr std::string_view kJointLimit[] = {"range", "range_degrees", "softness",
                                                   "restitution"};
inline constexpr std::string_view kJointMotor[] = {"mode", "target", "target_degrees", "max_effort",
                                                   "softness"};
inline constexpr std::string_view kJointSpring[] = {"rest", "rest_degrees", "stiffness", "damping"};
inline constexpr std::string_view kCoordinates[] = {"x", "y", "z", "twist", "swing_y", "swing_z"};
inline constexpr std::string_view kJointAxis[] = {"limit", "motor", "spring", "friction"};

// For the test: the table above under the names that the schema's "$defs" use.
struct Named {
  std::string_view name;
  Keys keys;
};
inline constexpr std::array<Named, 37> kAll{{{"scene", kScene},
                                             {"step", kStep},
                                             {"settings", kSettings},
                                             {"forced", kForced},
                                             {"material", kMaterial},
                                             {"material_pair", kMaterialPair},
                                             {"excluded_pair", kExcludedPair},
                                             {"surface_velocity", kSurfaceVelocity},
                                             {"mesh", kMesh},
                                             {"mesh_repair", kMeshRepair},
                                             {"mesh_parts", kMeshParts},
                                             {"mass_of", kMassOf},
                                             {"body", kBody},
                                             {"mass", kMass},
                                             {"orientation", kOrientation},
                                             {"collider", kCollider},
                                             {"repeat", kRepeat},
                                             {"child", kChild},
                                             {"heightfield", kHeightfield},
                                             {"joint", kJoint},
                                             {"joint_frame", kJointFrame},
                                             {"joint_softness", kJointSoftness},
                                             {"joint_limit", kJointLimit},
                                             {"joint_motor", kJointMotor},
                                             {"joint_spring", kJointSpring},
                                             {"joint_coordinates", kCoordinates},
                                             {"joint_axis", kJointAxis},
                                             {"effect_point_gravity", kPointGravity},
                                             {"effect_thrust", kThrust},
                                             {"effect_explosion", kExplosion},
                                             {"effect_drag", kDrag},
                                             {"effect_magnus", kMagnus},
                                             {"effect_attractor", kAttractor},
                                             {"effect_wind", kWind},
                                             {"effect_aero_surface", kAeroSurface},
                                             {"effect_buoyancy", kBuoyancy},
                                             {"effect_spring", kSpring}}};

}  // namespace keys

// Which of the collider's keys belong to which shape.
struct ShapeKeys {
  std::string_view shape;
  std::array<std::string_view, 3> keys;  // empty text: none
  int needed;                            // so many of them, from the first
};
inline constexpr std::array<ShapeKeys, 9> kShapeKeys{
    {{"sphere", {"radius", "", ""}, 1},
     {"box", {"half_extents", "rounding", ""}, 1},
     {"capsule", {"half_length", "radius", ""}, 2},
     {"half_space", {"normal", "offset", ""}, 2},
     {"mesh", {"mesh", "rounding", "scale"}, 1},
     {"cylinder", {"half_length", "radius", "rounding"}, 2},
     {"cone", {"half_length", "radius", "rounding"}, 2},
     {"heightfield", {"heightfield", "", ""}, 1},
     {"compound", {"children", "", ""}, 1}}};
// The shapes that a part of a compound may have.
inline constexpr std::string_view kChildShapes[] = {"sphere", "box",      "capsule",
                                                    "mesh",   "cylinder", "cone"};

// Which of the joint's keys belong to which kind, in the order of JointKind; all others are common.
struct JointKeys {
  std::string_view kind;
  std::array<std::string_view, 6> keys;  // empty text: none
};
inline constexpr std::array<JointKeys, 13> kJointKeys{
    {{"ball", {"friction"}},
     {"hinge", {"limit", "motor", "spring", "friction"}},
     {"slider", {"limit", "motor", "spring", "friction"}},
     {"fixed", {}},
     {"distance", {"length"}},
     {"rope", {"max_length"}},
     {"spring", {"rest_length", "stiffness", "damping", "pulls_only"}},
     {"cone_twist",
      {"cone", "cone_degrees", "twist", "twist_degrees", "limit_softness", "friction"}},
     {"six_dof", {"coordinates"}},
     {"gear", {"first", "second", "ratio"}},
     {"rack_pinion", {"pinion", "rack", "radius"}},
     {"pulley", {"over_a", "over_b", "ratio", "length", "stiff"}},
     {"motor", {"mode", "linear", "angular", "angular_degrees", "max_force", "max_torque"}}}};
// What couplings, which take their bodies from other joints, do not have.
inline constexpr std::string_view kPlacementKeys[] = {
    "body_a", "body_b",      "anchor",  "anchor_a", "anchor_b",
    "axis",   "orientation", "frame_a", "frame_b",  "collide_connected"};
inline constexpr std::string_view kMotorModes[] = {"velocity", "position"};

// Words with a fixed meaning, in the order of the enum they stand for.
inline constexpr std::string_view kMotionTypes[] = {"static", "kinematic", "dynamic"};
inline constexpr std::string_view kRotationMethods[] = {
    "exact", "implicit_gyro", "book", "explicit_gyro", "splitting", "splitting4", "rk4", "jacobi"};
inline constexpr std::string_view kContactSolvers[] = {"soft_step", "newton", "auto",
                                                       "worst_first"};
inline constexpr std::string_view kFrictionCones[] = {"exact", "four_facets", "eight_facets"};
inline constexpr std::string_view kForcedChoices[] = {"automatic", "off", "on"};
inline constexpr std::string_view kCombineRules[] = {"average", "geometric_mean", "minimum",
                                                     "maximum", "multiply"};
inline constexpr std::string_view kAxes[] = {"x", "y", "z"};
inline constexpr std::string_view kCollisions[] = {"hull", "surface", "parts"};
inline constexpr std::string_view kMassMethods[] = {"solid", "shell", "hull", "voxel"};
inline constexpr std::string_view kLocks[] = {"linear_x",  "linear_y",  "linear_z",
                                              "angular_x", "angular_y", "angular_z"};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
