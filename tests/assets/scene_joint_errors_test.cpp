// Invariant: a scene whose joints, surfaces, heightfields or compounds are wrong is refused with an
// error that names the file, the right line and a remedy.
#include <string>

#include "assets/bad_scene.h"
#include "gtest/gtest.h"

namespace {

using plumb::bad_scenes::BadScene;
using plumb::bad_scenes::expect_error_of;

class SceneJointErrors : public testing::TestWithParam<BadScene> {};

TEST_P(SceneJointErrors, NamesFileLineAndRemedy) { expect_error_of(GetParam()); }

// Two bodies and a list of joints that begins in line 2.
std::string with_joints(const char* joints) {
  return R"({"plumb_scene": 1, "bodies": [{"name": "door"},
    {"name": "link", "repeat": {"count": [3, 1, 1]}}], "joints": )" +
         std::string(joints);
}
// A moving body whose collider stands in line 2.
std::string with_collider(const char* collider) {
  return R"({"plumb_scene": 1, "heightfields": {"hills": {"spacing": [1, 1], "heights": [[0, 0],
    [0, 0]]}}, "meshes": {"rock": {"file": "rock.obj", "collision": "surface"}, "gear": {"file":
    "gear.obj", "collision": "hull"}}, "bodies": [{"type": "kinematic", "colliders": [)" +
         std::string(collider);
}
// A heightfield whose members begin in line 2.
std::string with_field(const char* field) {
  return R"({"plumb_scene": 1, "bodies": [],
    "heightfields": {"hills": )" +
         std::string(field);
}

const BadScene kBadJoints[] = {
    {"JointsNoList", with_joints(R"({}})"), 2, "'joints' is an object", "write a list"},
    {"NoKind", with_joints(R"([{"body_b": "door", "anchor": [0, 0, 0]}]})"), 2, "has no 'kind'",
     "ball, hinge, slider"},
    {"UnknownKind", with_joints(R"([{
"kind": "hing", "body_b": "door", "anchor": [0, 0, 0]}]})"),
     3, "is 'hing'", "did you mean 'hinge'?"},
    {"UnknownKey", with_joints(R"([{"kind": "ball", "body_b": "door", "anchor": [0, 0, 0],
"breakforce": 3}]})"),
     3, "unknown key 'breakforce'", "did you mean 'break_force'?"},
    {"KeyOfAnotherKind", with_joints(R"([{"kind": "ball", "body_b": "door", "anchor": [0, 0, 0],
"limit": {"range": [0, 1]}}]})"),
     3, "is of the kind ball, which has no 'limit'", "friction"},
    {"KeyOfAFixedJoint", with_joints(R"([{"kind": "fixed", "body_b": "door", "anchor": [0, 0, 0],
"friction": 1}]})"),
     3, "is of the kind fixed, which has no 'friction'", "remove it"},
    {"NoBody", with_joints(R"([
{"kind": "ball", "anchor": [0, 0, 0]}]})"),
     3, "names no body", "body_a and body_b"},
    {"SameBodyTwice", with_joints(R"([
{"kind": "ball", "body_a": "door", "body_b": "door", "anchor": [0, 0, 0]}]})"),
     3, "names one body twice", "name two"},
    {"UnknownBody", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "dore"}]})"),
     3, "there is no body 'dore'", "did you mean 'door'?"},
    {"BodyFarFromAll", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "elephant"}]})"),
     3, "there is no body 'elephant'", "\"world\""},
    {"RepeatWithoutNumber", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "link"}]})"),
     3, "'link' names no copy of the body 'link'", "'link[0]' to 'link[2]'"},
    {"CopyBeyondTheLast", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "link[3]"}]})"),
     3, "names no copy", "'link[0]' to 'link[2]'"},
    {"CopyWithALeadingZero", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "link[01]"}]})"),
     3, "names no copy", "'link[0]' to 'link[2]'"},
    {"CopyOfASingleBody", with_joints(R"([{"kind": "ball", "anchor": [0, 0, 0],
"body_b": "door[0]"}]})"),
     3, "body 'door' has no copies", "without a number"},
    {"BodyCalledWorld", R"({"plumb_scene": 1, "bodies": [{
"name": "world"}]})",
     2, "'world' cannot be the name", "use another name"},
    {"NoAnchor", with_joints(R"([
{"kind": "ball", "body_b": "door"}]})"),
     3, "has no place on body_a", "\"anchor\": [x, y, z]"},
    {"AnchorOfOneSideOnly", with_joints(R"([
{"kind": "ball", "body_b": "door", "anchor_a": [0, 0, 0]}]})"),
     3, "has no place on body_b", "anchor_b"},
    {"AnchorTwice", with_joints(R"([
{"kind": "ball", "body_b": "door", "anchor": [0, 0, 0], "frame_a": {}}]})"),
     3, "is given several places on body_a", "keep one of anchor, anchor_a and frame_a"},
    {"AxisWithoutLength", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"axis": [0, 0, 0]}]})"),
     3, "'axis' of joint 'joint 0' has no length", "[0, 1, 0]"},
    {"AxisAndOrientation", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"axis": [0, 0, 1], "orientation": {"axis_angle": [0, 1, 0, 90]}}]})"),
     3, "both 'axis' and 'orientation'", "keep one"},
    {"AxisBesideFrames",
     with_joints(R"([{"kind": "hinge", "body_b": "door", "frame_a": {}, "frame_b": {},
"axis": [0, 0, 1]}]})"),
     3, "has no meaning beside frames", "inside frame_a and frame_b"},
    {"FrameNoObject", with_joints(R"([{"kind": "ball", "body_b": "door", "frame_a": {},
"frame_b": [0, 0, 0]}]})"),
     3, "frame_b of joint 'joint 0' is a list", "write an object"},
    {"NameTwice", with_joints(R"([
{"name": "h", "kind": "ball", "body_b": "door", "anchor": [0, 0, 0]},
{"name": "h", "kind": "ball", "body_b": "link[0]", "anchor": [0, 0, 0]}]})"),
     4, "another joint named 'h'", "name of its own"},
    {"BreakForceZero", with_joints(R"([{"kind": "ball", "body_b": "door", "anchor": [0, 0, 0],
"break_force": 0}]})"),
     3, "'break_force' of joint 'joint 0' is 0", "> 0"},
    {"NegativeFrequency", with_joints(R"([{"kind": "ball", "body_b": "door", "anchor": [0, 0, 0],
"softness": {"frequency": -1}}]})"),
     3, "'frequency' of softness of joint 'joint 0' is -1", ">= 0"},
    {"LimitWithoutRange", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"limit": {}}]})"),
     3, "has no 'range'", "[lower, upper]"},
    {"LimitUpsideDown", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"limit": {"range": [1, -1]}}]})"),
     3, "is not a range", "lower <= upper"},
    {"LimitTwice", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"limit": {"range": [0, 1], "range_degrees": [0, 90]}}]})"),
     3, "has both 'range' and 'range_degrees'", "keep one"},
    {"DegreesAlongAPath", with_joints(R"([{"kind": "slider", "body_b": "door", "anchor": [0, 0, 0],
"limit": {"range_degrees": [0, 90]}}]})"),
     3, "has no degrees", "'range' in metres"},
    {"MotorMode", with_joints(R"([{"kind": "hinge", "body_b": "door", "anchor": [0, 0, 0],
"motor": {"mode": "velosity"}}]})"),
     3, "is 'velosity'", "did you mean 'velocity'?"},
    {"SpringWithoutStiffness", with_joints(R"([
{"kind": "spring", "body_b": "door", "anchor_a": [0, 0, 0], "anchor_b": [0, 1, 0]}]})"),
     3, "has no 'stiffness'", "N/m"},
    {"RopeWithoutLength", with_joints(R"([{"kind": "rope", "body_b": "door", "anchor": [0, 0, 0],
"max_length": 0}]})"),
     3, "'max_length' of joint 'joint 0' is 0", "> 0"},
    {"NoCone", with_joints(R"([
{"kind": "cone_twist", "body_b": "door", "anchor": [0, 0, 0]}]})"),
     3, "has no 'cone'", "cone_degrees"},
    {"ConeTooWide", with_joints(R"([
{"kind": "cone_twist", "body_b": "door", "anchor": [0, 0, 0], "cone_degrees": 181}]})"),
     3, "no half angle", "0 to 180 degrees"},
    {"TwistTooFar", with_joints(R"([
{"kind": "cone_twist", "body_b": "door", "anchor": [0, 0, 0], "cone": 1, "twist_degrees": [-190, 0]}]})"),
     3, "beyond half a turn", "-180 to 180 degrees"},
    {"UnknownCoordinate", with_joints(R"([{"kind": "six_dof", "body_b": "door", "anchor": [0, 0, 0],
"coordinates": {"swing_x": {}}}]})"),
     3, "unknown key 'swing_x'", "did you mean 'swing_"},
    {"GearOfNothing", with_joints(R"([{"kind": "gear", "second": "h",
"first": "g"}]})"),
     2, "there is no joint 'h'", "a hinge that stands before it"},
    {"GearOfASlider",
     with_joints(R"([{"name": "s", "kind": "slider", "body_b": "door", "anchor": [0, 0, 0]},
{"kind": "gear", "first": "s", "second": "s"}]})"),
     3, "joint 's' is of the kind slider", "has to be a hinge"},
    {"GearWithAnAnchor",
     with_joints(R"([{"name": "h", "kind": "hinge", "body_b": "door", "anchor": [0, 0, 0]},
{"name": "i", "kind": "hinge", "body_b": "link[0]", "anchor": [0, 0, 0]},
{"kind": "gear", "first": "h", "second": "i", "anchor": [0, 0, 0]}]})"),
     4, "of the kind gear, which has no 'anchor'", "first, second, ratio"},
    {"RatioZero",
     with_joints(R"([{"name": "h", "kind": "hinge", "body_b": "door", "anchor": [0, 0, 0]},
{"name": "i", "kind": "hinge", "body_b": "link[0]", "anchor": [0, 0, 0]},
{"kind": "gear", "first": "h", "second": "i", "ratio": 0}]})"),
     4, "'ratio' of joint 'joint 2' is 0", "another number"},
    {"RackWithoutRadius",
     with_joints(R"([{"name": "h", "kind": "hinge", "body_b": "door", "anchor": [0, 0, 0]},
{"name": "s", "kind": "slider", "body_b": "link[0]", "anchor": [0, 0, 0]},
{"kind": "rack_pinion", "pinion": "h", "rack": "s"}]})"),
     4, "has no 'radius'", "in metres"},
    {"PulleyWithoutWheel", with_joints(R"([
{"kind": "pulley", "body_a": "door", "body_b": "link[0]", "anchor": [0, 0, 0], "over_a": [0, 1, 0]}]})"),
     3, "has no 'over_b'", "leaves the wheel"},
    {"MaxForceNegative", with_joints(R"([{"kind": "motor", "body_b": "door", "anchor": [0, 0, 0],
"max_force": -1}]})"),
     3, "'max_force' of joint 'joint 0' is -1", ">= 0"},

    {"SurfaceThatMoves",
     R"({"plumb_scene": 1, "meshes": {"rock": {"file": "rock.obj", "collision": "surface"}}, "bodies": [{"colliders": [
{"shape": "mesh", "mesh": "rock"}]}]})",
     2, "moves freely, but it is a surface", "\"static\" or \"kinematic\""},
    {"HeightfieldThatMoves",
     R"({"plumb_scene": 1, "heightfields": {"hills": {"spacing": [1, 1], "heights": [[0, 0], [0, 0]]}}, "bodies": [{"colliders": [
{"shape": "heightfield", "heightfield": "hills"}]}]})",
     2, "moves freely, but it is a surface", "\"static\" or \"kinematic\""},
    {"SurfaceWithADensity",
     R"({"plumb_scene": 1, "bodies": [], "meshes": {"rock": {"file": "rock.obj", "collision": "surface",
"density": 3}}})",
     2, "'density' of mesh 'rock' has no meaning for a surface", "\"hull\""},
    {"ScaleOfAHull", with_collider(R"({"shape": "mesh", "mesh": "gear", "scale": [2, 2, 2]}]}]})"),
     3, "collides as a hull, which has no 'scale'", "metres_per_unit"},
    {"RoundingOfASurface",
     with_collider(R"({"shape": "mesh", "mesh": "rock", "rounding": 0.1}]}]})"), 3,
     "collides as a surface, which has no 'rounding'", "remove it"},
    {"ScaleZero", with_collider(R"({"shape": "mesh", "mesh": "rock", "scale": [1, 0, 1]}]}]})"), 3,
     "'scale' of collider 0 of body 'body 0' holds 0", "> 0"},
    {"UnknownHeightfield", with_collider(R"({"shape": "heightfield", "heightfield": "hilsl"}]}]})"),
     3, "no heightfield 'hilsl'", "did you mean 'hills'?"},
    {"CompoundOfNothing", with_collider(R"({"shape": "compound", "children": []}]}]})"), 3,
     "is an empty list", "a list of shapes"},
    {"CompoundWithoutChildren", with_collider(R"({"shape": "compound"}]}]})"), 3,
     "has no 'children'", "a list of shapes"},
    {"ChildHalfSpace",
     with_collider(R"({"shape": "compound", "children": [{"shape": "half_space"}]}]}]})"), 3,
     "'shape' of child 0 of collider 0 of body 'body 0' is 'half_space'", "sphere, box"},
    {"ChildSurface", with_collider(R"({"shape": "compound", "children": [
{"shape": "mesh", "mesh": "rock"}]}]}]})"),
     4, "mesh 'rock' collides as a surface", "\"collision\": \"hull\""},
    {"ChildWithADensity", with_collider(R"({"shape": "compound", "children": [
{"shape": "sphere", "radius": 1, "density": 3}]}]}]})"),
     4, "unknown key 'density' in child 0", "use one of"},
    {"KeyOfAnotherChild", with_collider(R"({"shape": "compound", "children": [
{"shape": "sphere", "radius": 1, "half_length": 3}]}]}]})"),
     4, "is a sphere, which has no 'half_length'", "radius"},
    {"ContinuousNoFlag", R"({"plumb_scene": 1, "bodies": [{
"continuous": 1}]})",
     2, "'continuous' of body 'body 0' is a number", "true or false"},

    {"FieldWithoutHeights", with_field(R"({"spacing": [1, 1]}}})"), 2,
     "neither 'file' nor 'heights'", "list of rows"},
    {"FieldTwice",
     with_field(R"({"spacing": [1, 1], "file": "a.csv", "heights": [[0, 0], [0, 0]]}}})"), 2,
     "both 'file' and 'heights'", "list of rows"},
    {"FieldWithoutSpacing", with_field(R"({"heights": [[0, 0], [0, 0]]}}})"), 2, "has no 'spacing'",
     "[1, 1]"},
    {"FieldSpacingZero", with_field(R"({"spacing": [1, 0], "heights": [[0, 0], [0, 0]]}}})"), 2,
     "must be above 0", "[1, 1]"},
    {"FieldOfOneRow", with_field(R"({"spacing": [1, 1], "heights": [[0, 0]]}}})"), 2,
     "two rows of two heights", "list of rows"},
    {"FieldRagged", with_field(R"({"spacing": [1, 1], "heights": [[0, 0],
[0, 0, 0]]}}})"),
     3, "this row has 3 heights, the first one has 2", "list of rows"},
    {"FieldOfTexts", with_field(R"({"spacing": [1, 1], "heights": [[0, 0],
[0, "1"]]}}})"),
     3, "a height is a text", "null for a hole"},
    {"FieldTooHigh", with_field(R"({"spacing": [1, 1], "height_scale": 1000, "heights": [[0, 0],
[0, 1001]]}}})"),
     3, "beyond 1000 km", "list of rows"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneJointErrors, testing::ValuesIn(kBadJoints),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
