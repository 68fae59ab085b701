// Invariant: a scene that is no JSON is refused in one line that names the file, the line and
// column of the slip, and its remedy, and speaks of the slip instead of the parser's tokens.
#include <algorithm>
#include <string>

#include "assets/bad_scene.h"
#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using plumb::bad_scenes::BadScene;
using plumb::bad_scenes::expect_error_of;

class SceneJsonErrors : public testing::TestWithParam<BadScene> {};

TEST_P(SceneJsonErrors, NameThePlaceAndTheRemedy) {
  expect_error_of(GetParam());
  const std::string error = plumb::assets::parse_scene(GetParam().text, "bad.json").error();
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
  for (const char* word : {"syntax error", "unexpected", "expected end", "last read"})
    EXPECT_EQ(error.find(word), std::string::npos) << error;
}

const BadScene kBadJson[] = {
    {"EmptyFile", "", 1, "the file is empty", "write a scene", 1},
    {"OnlyBlanks", " \n\t\n", 3, "the file is empty", "write a scene", 1},
    {"MissingComma", "{\n\"plumb_scene\": 1\n\"bodies\": []\n}", 3,
     "a comma is missing before \"bodies\"", "add it", 1},
    {"MissingCommaAfterList", "{\n\"bodies\": [] \"plumb_scene\": 1}", 2,
     "a comma is missing before \"plumb_scene\"", "add it", 14},
    {"MissingCommaInList", "{\"bodies\": [{}\n {}]}", 2, "a comma is missing before {", "add it",
     2},
    {"CommaBeforeBrace", "{\n\"plumb_scene\": 1,\n\"bodies\": [],\n}", 3,
     "JSON does not allow a comma before }", "remove it", 13},
    {"CommaBeforeBracket", "{\n\"gravity\": [0, -10, 0 , ]}", 2,
     "JSON does not allow a comma before ]", "remove it", 23},
    {"TwoCommas", "{\n\"a\": [0,, 1]}", 2, ", stands where a value is expected", "comma", 9},
    {"CommaBeforeAKey", "{\n, \"a\": 1}", 2, ", stands where a key is expected",
     "no comma too many", 1},
    {"LineComment", "{\n  // a comment\n\"plumb_scene\": 1, \"bodies\": []}", 2,
     "JSON has no comments", "remove it", 3},
    {"BlockComment", "{\n\"plumb_scene\": /* one */ 1}", 2, "JSON has no comments", "remove it",
     16},
    {"HashComment", "{\n\"plumb_scene\": 1 # one\n}", 2, "JSON has no comments", "remove it", 18},
    {"CommentBeforeAll", "# a scene\n{}", 1, "JSON has no comments", "remove it", 1},
    {"CutOff", "{\n\"plumb_scene\": 1,\n\"bodies\": [", 3, "before the bracket of line 3 is closed",
     "close it", 11},
    {"CutOffInAnObject", "{\"bodies\": [{\n\"name\": \"a\"", 2,
     "before the bracket of line 1 is closed", "close it", 11},
    {"CutOffInAText", "{\n\"name\": \"a scene", 2, "does not end in its line", "close it with \"",
     9},
    {"TextOverLines", "{\n\"name\": \"one\ntwo\"}", 2, "the text \"one does not end in its line",
     "close it with \"", 9},
    {"SingleQuotes", "{\n'name': \"a\"}", 2, "double quotes", "write \"...\"", 1},
    {"KeyWithoutQuotes", "{\n\"plumb_scene\": 1, name: \"a\"}", 2, "the key name has no quotes",
     "write \"name\"", 19},
    {"MissingColon", "{\n\"name\" \"a\"}", 2, "a colon is missing before \"a\"", "add it", 8},
    {"EqualsForColon", "{\n\"name\" = \"a\"}", 2, "a colon is missing before =", "add it", 8},
    {"WrongBracket", "{\n\"bodies\": [1, 2}\n}", 2, "} closes a bracket of the other kind",
     "too few or too many", 16},
    {"BracketTooMany", "{\n\"bodies\": []}\n}", 3, "more after the end of the scene",
     "closes too early", 1},
    {"CapitalTrue", "{\n\"flag\": True}", 2, "True is no value of JSON", "true, false or null", 9},
    {"NotANumber", "{\n\"mass\": NaN}", 2, "NaN is no value of JSON", "write a number", 9},
    {"HugeNumber", "{\n\"plumb_scene\": 1e999, \"bodies\": []}", 2, "the number 1e999 is too large",
     "below 1e308", 16},
    {"PlusSign", "{\n\"mass\": +1}", 2, "+1 is no number of JSON", "begin it with a digit", 9},
    {"PointFirst", "{\n\"mass\": .5}", 2, ".5 is no number of JSON", "both sides of a point", 9},
    {"PointLast", "{\n\"mass\": [5.]}", 2, "5. is no number of JSON", "both sides of a point", 10},
    {"LeadingZero", "{\n\"mass\": 01}", 2, "01 is no number of JSON", "leading zeros", 9},
    {"Backslash", "{\n\"file\": \"a\\mesh.obj\"}", 2, "a \\ or a control character", "write \\\\",
     9},
    {"TabInAText", "{\n\"file\": \"a\tb\"}", 2, "a \\ or a control character", "\\t for a tab", 9},
    {"OtherEncoding", "{\n\"name\": \"caf\xe9\"}", 2, "is not in UTF-8", "save the file as UTF-8",
     9},
    {"ColumnsAreCharacters", "{\n\"name\": \"\xc3\xa9\xc3\xa9\", }", 2,
     "JSON does not allow a comma before }", "remove it", 13},
};

INSTANTIATE_TEST_SUITE_P(, SceneJsonErrors, testing::ValuesIn(kBadJson),
                         [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
