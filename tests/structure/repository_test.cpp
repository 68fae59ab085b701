// Invariants of the tree itself: the folders depend on each other as the design says, a file is
// short enough to hold one idea, and nothing lies in the root that no tool looks for there.
#include <gtest/gtest.h>

#include "structure/include_rules.h"

namespace plumb::structure {
namespace {

// Above this a file holds more than one idea.
constexpr int kMaxLines = 500;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

TEST(Repository, NoFolderIncludesWhatItMustNotSee) {
  const auto violations = find_forbidden_includes(PLUMB_SOURCE_DIR);
  EXPECT_TRUE(violations.empty()) << joined(violations);
}

TEST(Repository, NoFileIsLongerThanOneIdea) {
  const auto violations = find_long_files(PLUMB_SOURCE_DIR, kMaxLines);
  EXPECT_TRUE(violations.empty()) << joined(violations);
}

TEST(Repository, RootHoldsOnlyWhatToolsLookForThere) {
  const auto violations = find_stray_root_entries(PLUMB_SOURCE_DIR);
  EXPECT_TRUE(violations.empty()) << joined(violations);
}

}  // namespace
}  // namespace plumb::structure
