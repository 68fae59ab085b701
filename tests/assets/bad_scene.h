// A malformed scene and what its error has to say.
#pragma once

#include <ostream>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace plumb::bad_scenes {

struct BadScene {
  const char* name;  // of the test
  std::string text;
  int line;            // where the error has to point
  const char* says;    // what is wrong
  const char* remedy;  // what would be right
  int column = 0;      // where in the line, if the error has to tell
};

inline void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

inline void expect_error_of(const BadScene& bad) {
  const auto scene = assets::parse_scene(bad.text, "bad.json");
  ASSERT_FALSE(scene.ok());
  const std::string error = scene.error();
  const std::string column = bad.column > 0 ? ":" + std::to_string(bad.column) : "";
  const std::string place = "bad.json:" + std::to_string(bad.line) + column + ": ";
  EXPECT_EQ(error.rfind(place, 0), 0u) << error;
  EXPECT_NE(error.find(bad.says), std::string::npos) << error;
  EXPECT_NE(error.find(bad.remedy), std::string::npos) << error;
}

}  // namespace plumb::bad_scenes
