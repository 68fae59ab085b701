// Invariant: every malformed scene is refused with an error that names the file, the right line and
// a remedy; nothing that is wrong is passed over.
#include <string>

#include "assets/bad_scene.h"
#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using plumb::assets::parse_scene;
using plumb::bad_scenes::BadScene;
using plumb::bad_scenes::expect_error_of;

class SceneErrors : public testing::TestWithParam<BadScene> {};

TEST_P(SceneErrors, NamesFileLineAndRemedy) { expect_error_of(GetParam()); }

const BadScene kBadScenes[] = {
    {"DuplicateKey", "{\"plumb_scene\": 1,\n\"name\": \"a\",\n\"name\": \"b\", \"bodies\": []}", 3,
     "'name' stands here a second time", "the one in line 2"},
    {"NotAnObject", "[1, 2]", 1, "the scene is a list", "write an object"},
    {"NoVersion", "{\n\"bodies\": []}", 1, "which version", "\"plumb_scene\": 1"},
    {"WrongVersion", "{\"bodies\": [],\n\"plumb_scene\": 2}", 2, "not known", "\"plumb_scene\": 1"},
    {"NoBodies", "{\"plumb_scene\": 1}", 1, "has no 'bodies'", "add \"bodies\""},
    {"UnknownKey", "{\"plumb_scene\": 1,\n\"bodys\": [], \"bodies\": []}", 2, "unknown key 'bodys'",
     "did you mean 'bodies'?"},
    {"UnknownKeyFarFromAll", "{\"plumb_scene\": 1, \"bodies\": [],\n\"zzzzzzzz\": 0}", 2,
     "unknown key 'zzzzzzzz'", "use one of $schema, plumb_scene"},
    {"WrongKind", "{\"plumb_scene\": 1, \"bodies\": [{\n\"position\": \"here\"}]}", 2,
     "'position' of body 'body 0' is a text", "a list of 3"},
    {"WrongLength", "{\"plumb_scene\": 1, \"bodies\": [{\n\"position\": [1, 2]}]}", 2,
     "has 2 entries", "a list of 3"},
    {"NegativeRadius",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [\n{\"shape\": \"sphere\",\n\"radius\": "
     "-1}]}]}",
     3, "'radius' of collider 0 of body 'body 0' is -1", "> 0"},
    {"GravityBeyondAllBounds",
     "{\"plumb_scene\": 1, \"bodies\": [],\n\"settings\": {\n\"gravity\": [0, -2e15, 0]}}", 3,
     "'gravity' of settings holds -2e+15", "from -1e+15 to 1e+15"},
    {"MassTooSmallForItsNumbers",
     "{\"plumb_scene\": 1, \"bodies\": [{\n\"mass\": 1e-310, \"colliders\": [{\"shape\": "
     "\"sphere\", "
     "\"radius\": 1}]}]}",
     2, "'mass' of body 'body 0' is 1e-310", "write a number from"},
    {"MassTooLargeForItsNumbers",
     "{\"plumb_scene\": 1, \"bodies\": [{\n\"mass\": {\"mass\": 1.7e308, \"inertia\": [1, 1, "
     "1]}}]}",
     2, "is 1.7e+308", "write a number from"},
    {"DensityTooLargeForItsNumbers",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"density\": 1.7e308}]}]}",
     2, "'density' of collider 0 of body 'body 0' is 1.7e+308", "write a number from"},
    {"NoRadius", "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [\n{\"shape\": \"sphere\"}]}]}",
     2, "has no 'radius'", "in metres"},
    {"NoShape", "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [\n{\"radius\": 1}]}]}", 2,
     "has no 'shape'", "sphere, box, capsule"},
    {"UnknownShape",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\n\"shape\": \"shpere\"}]}]}", 2,
     "is 'shpere'", "did you mean 'sphere'?"},
    {"KeyOfAnotherShape",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"box\", \"half_extents\": "
     "[1, 1, 1],\n"
     "\"radius\": 1}]}]}",
     2, "is a box, which has no 'radius'", "half_extents"},
    {"MovingHalfSpace",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [\n{\"shape\": \"half_space\"}]}]}", 2,
     "half-space", "\"type\": \"static\""},
    {"UnknownMaterial",
     "{\"plumb_scene\": 1, \"materials\": {\"ice\": {}}, \"bodies\": [{\"colliders\": [{\"shape\": "
     "\"sphere\", "
     "\"radius\": 1,\n\"material\": \"icy\"}]}]}",
     2, "no material 'icy'", "did you mean 'ice'?"},
    {"UnknownMesh",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"mesh\",\n\"mesh\": "
     "\"gear\"}]}]}",
     2, "no mesh 'gear'", "\"meshes\""},
    {"MeshWithoutCollision",
     "{\"plumb_scene\": 1, \"bodies\": [], \"meshes\": {\n\"gear\": {\"file\": \"gear.dae\"}}}", 2,
     "has no 'collision'", "\"collision\": \"hull\""},
    {"MeshWithoutFile",
     "{\"plumb_scene\": 1, \"bodies\": [], \"meshes\": {\n\"gear\": {\"collision\": \"hull\"}}}", 2,
     "has no 'file'", "relative to the folder"},
    {"ShellWithoutThickness",
     "{\"plumb_scene\": 1, \"bodies\": [], \"meshes\": {\"gear\": {\"file\": \"a.obj\", "
     "\"collision\": \"hull\",\n"
     "\"mass_of\": {\"method\": \"shell\"}}}}",
     2, "has no 'thickness'", "in metres"},
    {"ThicknessOfASolid",
     "{\"plumb_scene\": 1, \"bodies\": [], \"meshes\": {\"gear\": {\"file\": \"a.obj\", "
     "\"collision\": \"hull\",\n"
     "\"mass_of\": {\"method\": \"solid\",\n\"thickness\": 0.1}}}}",
     3, "no meaning", "\"shell\""},
    {"FrictionNegative",
     "{\"plumb_scene\": 1, \"bodies\": [], \"materials\": {\"ice\":\n{\"friction\": -0.1}}}", 2,
     "'friction' of material 'ice' is -0.1", ">= 0"},
    {"RestitutionAboveOne",
     "{\"plumb_scene\": 1, \"bodies\": [], \"materials\": {\"ice\":\n{\"restitution\": 1.5}}}", 2,
     "is 1.5", "from 0 to 1"},
    {"SubstepsFraction",
     "{\"plumb_scene\": 1, \"bodies\": [], \"settings\": {\n\"substeps\": 2.5}}", 2,
     "'substeps' of settings is 2.5", "whole number"},
    {"SubstepsTooMany", "{\"plumb_scene\": 1, \"bodies\": [], \"settings\": {\n\"substeps\": 65}}",
     2, "is 65", "from 1 to 64"},
    {"NoPassOverTheContacts",
     "{\"plumb_scene\": 1, \"bodies\": [], \"settings\": {\n\"velocity_iterations\": 0}}", 2,
     "is 0", "from 1 to 64"},
    {"FrictionConeUnknown",
     "{\"plumb_scene\": 1, \"bodies\": [], \"settings\": {\n\"friction_cone\": \"square\"}}", 2,
     "square", "four_facets"},
    {"StepZero", "{\"plumb_scene\": 1, \"bodies\": [], \"step\": {\n\"dt\": 0}}", 2,
     "'dt' of step is 0", "from 1e-09"},
    {"StepTwice", "{\"plumb_scene\": 1, \"bodies\": [], \"step\": {\"dt\": 0.01,\n\"rate\": 100}}",
     2, "both 'dt' and 'rate'", "keep one"},
    {"QuaternionNotUnit",
     "{\"plumb_scene\": 1, \"bodies\": [{\"orientation\": {\n\"quaternion\": [1, 1, 1, 1]}}]}", 2,
     "has length 2", "[0, 0, 0, 1]"},
    {"AxisWithoutLength",
     "{\"plumb_scene\": 1, \"bodies\": [{\"orientation\": {\n\"axis_angle\": [0, 0, 0, 90]}}]}", 2,
     "no length", "but zero"},
    {"OrientationTwice",
     "{\"plumb_scene\": 1, \"bodies\": [{\"orientation\":\n{\"axis_angle\": [0, 1, 0, 90], "
     "\"quaternion\": [0, 0, "
     "0, 1]}}]}",
     2, "in several ways", "give one of"},
    {"DuplicateName", "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"a\"},\n{\"name\": \"a\"}]}",
     2, "another body named 'a'", "name of its own"},
    {"BracketInName", "{\"plumb_scene\": 1, \"bodies\": [{\n\"name\": \"a[0]\"}]}", 2,
     "cannot be the name", "no '['"},
    {"UnknownType", "{\"plumb_scene\": 1, \"bodies\": [{\n\"type\": \"dinamic\"}]}", 2,
     "is 'dinamic'", "did you mean 'dynamic'?"},
    {"UnknownLock", "{\"plumb_scene\": 1, \"bodies\": [{\"locks\": [\n\"linear_w\"]}]}", 2,
     "'linear_w'", "did you mean 'linear_"},
    {"RepeatWithoutCount", "{\"plumb_scene\": 1, \"bodies\": [{\"repeat\":\n{\"seed\": 1}}]}", 2,
     "has no 'count'", "[4, 1, 4]"},
    {"RepeatNothing", "{\"plumb_scene\": 1, \"bodies\": [{\"repeat\": {\n\"count\": [1, 0, 1]}}]}",
     2, "whole numbers >= 1", "[4, 1, 4]"},
    {"RepeatTooMuch",
     "{\"plumb_scene\": 1, \"bodies\": [\n{\"repeat\": {\"count\": [1000, 1000, 2]}}]}", 2,
     "more than 1000000 bodies", "lower the count"},
    {"SeedNegative",
     "{\"plumb_scene\": 1, \"bodies\": [{\"repeat\": {\"count\": [1, 1, 1],\n\"seed\": -1}}]}", 2,
     "whole number >= 0", "for example 1"},
    {"MassOfNothing", "{\"plumb_scene\": 1, \"bodies\": [{\n\"mass\": 2}]}", 2, "no colliders",
     "an object with mass"},
    {"MassImpossible",
     "{\"plumb_scene\": 1, \"bodies\": [{\n\"mass\": {\"mass\": 1, \"inertia\": [1, 1, 5]}}]}", 2,
     "mass of body 'body 0'", ""},
    {"InertiaOfFour",
     "{\"plumb_scene\": 1, \"bodies\": [{\n\"mass\": {\"mass\": 1, \"inertia\": [1, 1, 1, 0]}}]}",
     2, "'inertia' of mass of body 'body 0' has 4 entries", "write 3 numbers [xx, yy, zz], or 6"},
    {"LayerTooHigh",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"layers\": "
     "[32]}]}]}",
     2, "not a list of layers", "from 0 to 31"},
    {"GroupFraction",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"group\": 1.5}]}]}",
     2, "'group' of collider 0 of body 'body 0' is 1.5", "whole number"},
    {"GroupTooFar",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"group\": 3000000000}]}]}",
     2, "'group' of collider 0", "from -2147483648 to 2147483647"},
    {"SurfaceVelocityIsANumber",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"surface_velocity\": 3}]}]}",
     2, "surface_velocity of collider 0 of body 'body 0' is a number", "linear, angular"},
    {"SurfaceVelocityUnknownKey",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1, \"surface_velocity\": {\n\"liner\": [1, 0, 0]}}]}]}",
     2, "unknown key 'liner'", "did you mean 'linear'?"},
    {"OneWayOfTwoNumbers",
     "{\"plumb_scene\": 1, \"bodies\": [{\"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1,\n\"one_way\": [0, 1]}]}]}",
     2, "'one_way' of collider 0 of body 'body 0' has 2 entries", "a list of 3"},
    {"KindNegative",
     "{\"plumb_scene\": 1, \"bodies\": [], \"materials\": {\"ice\":\n{\"kind\": -1}}}", 2,
     "'kind' of material 'ice' is -1", "from 0 to 4294967295"},
    {"RollingFrictionNegative",
     "{\"plumb_scene\": 1, \"bodies\": [], \"materials\": {\"ice\":\n{\"rolling_friction\": -1}}}",
     2, "'rolling_friction' of material 'ice' is -1", ">= 0"},
    {"MaterialPairsAreAnObject", "{\"plumb_scene\": 1, \"bodies\": [],\n\"material_pairs\": {}}", 2,
     "'material_pairs' is an object", "write a list"},
    {"MaterialPairWithoutKinds",
     "{\"plumb_scene\": 1, \"bodies\": [], \"material_pairs\": [\n{\"friction\": 1}]}", 2,
     "material pair 0 has no 'kinds'", "[1, 2]"},
    {"MaterialPairOfKindZero",
     "{\"plumb_scene\": 1, \"bodies\": [], \"material_pairs\": [{\"friction\": 1,\n\"kinds\": [0, "
     "2]}]}",
     2, "'kinds' of material pair 0 are not two kinds", "whole numbers from 1 on"},
    {"MaterialPairSaysNothing",
     "{\"plumb_scene\": 1, \"bodies\": [], \"material_pairs\": [\n{\"kinds\": [1, 2]}]}", 2,
     "says nothing about the two", "give friction"},
    {"MaterialPairTwice",
     "{\"plumb_scene\": 1, \"bodies\": [], \"material_pairs\": [{\"kinds\": [1, 2], \"friction\": "
     "1},\n{\"kinds\": [2, 1], \"friction\": 0}]}",
     2, "have an entry already", "in line 1"},
    {"MaterialPairBounces",
     "{\"plumb_scene\": 1, \"bodies\": [], \"material_pairs\": [{\"kinds\": [1, "
     "2],\n\"restitution\": 2}]}",
     2, "'restitution' of material pair 0 is 2", "from 0 to 1"},
    {"ExcludedBodyUnknown",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"crate\"}, {\"name\": \"belt\"}], "
     "\"excluded_pairs\": [{\"body_a\": \"belt\",\n\"body_b\": \"grate\"}]}",
     2, "there is no body 'grate'", "did you mean 'crate'?"},
    {"ExcludedFromTheWorld",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"crate\"}], "
     "\"excluded_pairs\": [{\"body_a\": \"crate\",\n\"body_b\": \"world\"}]}",
     2, "there is no body 'world'", "name one of the scene's bodies"},
    {"ExcludedBodyMissing",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"crate\"}], "
     "\"excluded_pairs\": [\n{\"body_a\": \"crate\"}]}",
     2, "excluded pair 0 has no 'body_b'", "name two bodies"},
    {"ExcludedFromItself",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"crate\"}], "
     "\"excluded_pairs\": [{\"body_a\": \"crate\",\n\"body_b\": \"crate\"}]}",
     2, "names one body twice", "name two bodies"},
    {"ExcludedCopyThatIsNone",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\", \"repeat\": "
     "{\"count\": "
     "[2, 1, 1]}}], \"excluded_pairs\": [{\"body_a\": \"a\",\n\"body_b\": \"b[2]\"}]}",
     2, "'b[2]' names no copy", "'b[0]' to 'b[1]'"},
    {"ExcludedColliderThatIsNone",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"a\", \"colliders\": [{\"shape\": \"sphere\", "
     "\"radius\": 1}]}, {\"name\": \"b\"}], \"excluded_pairs\": [{\"body_a\": \"a\", \"body_b\": "
     "\"b\", \"collider_a\": 0,\n\"collider_b\": 0}]}",
     2, "body 'b' has no colliders", "remove collider_a and collider_b"},
    {"ExcludedColliderTooHigh",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"a\", \"colliders\": [{\"shape\": \"sphere\", "
     "\"radius\": 1}]}, {\"name\": \"b\", \"colliders\": [{\"shape\": \"sphere\", \"radius\": "
     "1}]}], "
     "\"excluded_pairs\": [{\"body_a\": \"a\", \"body_b\": \"b\", \"collider_a\": "
     "0,\n\"collider_b\": "
     "1}]}",
     2, "'collider_b' of excluded pair 0 is 1", "from 0 to 0"},
    {"ExcludedColliderOnOneSide",
     "{\"plumb_scene\": 1, \"bodies\": [{\"name\": \"a\", \"colliders\": [{\"shape\": \"sphere\", "
     "\"radius\": 1}]}, {\"name\": \"b\"}], \"excluded_pairs\": [\n{\"body_a\": \"a\", \"body_b\": "
     "\"b\", \"collider_a\": 0}]}",
     2, "names a collider on one side only", "or neither"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneErrors, testing::ValuesIn(kBadScenes),
                         [](const auto& test) { return std::string(test.param.name); });

// Several mistakes are told in one go, in the order of the file.
TEST(SceneErrorList, TellsAllInOrder) {
  const auto scene = parse_scene(
      "{\"plumb_scene\": 1,\n\"bodies\": [{\n\"tipe\": \"static\",\n\"position\": 3}],\n\"nam\": "
      "\"x\"}",
      "bad.json");
  const std::string error = scene.error();
  const std::size_t third = error.find("bad.json:3: ");
  const std::size_t fourth = error.find("bad.json:4: ");
  const std::size_t fifth = error.find("bad.json:5: ");
  ASSERT_NE(fifth, std::string::npos) << error;
  EXPECT_LT(third, fourth);
  EXPECT_LT(fourth, fifth);
}

// However deep the brackets go, the answer is an error and not a crash.
TEST(SceneErrorList, SurvivesDeepNesting) {
  const auto scene = parse_scene(std::string(1'000'000, '['), "bad.json");
  EXPECT_NE(scene.error().find("bad.json:1: "), std::string::npos);
}

TEST(SceneErrorList, NamesAMissingFile) {
  const auto scene = plumb::assets::load_scene("no/such/scene.json");
  EXPECT_EQ(scene.error().rfind("no/such/scene.json: ", 0), 0u) << scene.error();
}

}  // namespace
