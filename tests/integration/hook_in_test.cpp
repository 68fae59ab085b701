// Invariant: an engine hooks Plumb in with fewer than 40 lines, and the page that says so shows the
// very lines of the example; the version is the same everywhere.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "gtest/gtest.h"
#include "plumb/integration/version.h"

namespace {

std::string text_of(const char* path) {
  std::ifstream file(std::filesystem::path(PLUMB_SOURCE_DIR) / path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The lines between the markers.
std::string hook_in() {
  const std::string text = text_of("integration/examples/minimal_engine.cpp");
  const std::string begin = "// --- hook-in: begin ---\n";
  const std::size_t first = text.find(begin);
  const std::size_t last = text.find("// --- hook-in: end ---");
  if (first == std::string::npos || last == std::string::npos) return {};
  return text.substr(first + begin.size(), last - first - begin.size());
}

TEST(HookIn, TakesFewerThanFortyLines) {
  const std::string lines = hook_in();
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.find("FixedStepLoop"), std::string::npos);
  EXPECT_LT(std::count(lines.begin(), lines.end(), '\n'), 40);
}

TEST(HookIn, IsWhatTheReadmeShows) {
  EXPECT_NE(text_of("integration/README.md").find(hook_in()), std::string::npos);
}

TEST(Version, IsTheSameEverywhere) {
  EXPECT_NE(text_of("CMakeLists.txt").find("VERSION " PLUMB_VERSION_STRING " "), std::string::npos);
}

}  // namespace
