// Invariant: the `plumb` program says what a person who waits or wonders wants to know: what it is
// doing, on terminals only; which body was lost and when; how much sleeps; where a file cannot be
// written, and where a scene is no JSON, in one line each.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "integration/run_program.h"

namespace {

using namespace plumb_program;  // NOLINT(google-build-using-namespace)

// [m/s] Fast enough to leave the build's numbers within a step of 1000 s.
#if defined(PLUMB_PRECISION_F64)
constexpr const char* kBeyondNumbers = "1e307";
#else
constexpr const char* kBeyondNumbers = "1e38";
#endif

class ProgramTells : public Program {};

// What the program writes to a terminal that is its stderr. Must be little: nobody reads meanwhile.
std::string on_terminal(const std::string& arguments) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return "no terminal";
  const std::string name = ptsname(terminal);
  const int kept = open(name.c_str(), O_RDWR | O_NOCTTY);  // so that nothing is lost at its end
  (void)shell("{ " + std::string(PLUMB_PROGRAM) + " " + arguments + " 2>" + name + "; }");
  (void)fcntl(terminal, F_SETFL, O_NONBLOCK);
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(terminal, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(kept);
  close(terminal);
  return text;
}

TEST_F(ProgramTells, WhatItDoesWithAMeshOnATerminalOnly) {
  const std::string knot = kModels + "knot.glb";
  const std::string scene = write(
      "scene.json", R"({"plumb_scene": 1, "meshes": {"knot": {"file": ")" + knot +
                        R"(", "collision": "hull"}}, "bodies": [{"name": "b", "colliders": )" +
                        R"([{"shape": "mesh", "mesh": "knot"}]}]})");
  for (const std::string& arguments :
       {"mesh " + knot, "run " + scene + " --steps 1", "plan " + scene}) {
    const std::string text = on_terminal(arguments);
    EXPECT_NE(text.find("knot"), std::string::npos) << arguments << ": " << text;
    for (const char* work : {"reading", "convex hull of"})
      EXPECT_NE(text.find(work), std::string::npos) << arguments << ": " << text;
    // Each work wipes the one before it, and nothing of the last is left.
    const std::string last = text.substr(text.rfind('\r') + 1);
    EXPECT_EQ(last.find("..."), std::string::npos) << arguments << ": " << text;
    EXPECT_FALSE(says(plumb(arguments), "reading")) << arguments;
  }
  EXPECT_EQ(on_terminal("run -q " + scene + " --steps 1"), "");
}

TEST_F(ProgramTells, WhichBodyWasLostAndWhen) {
  // Points, so that none touches another.
  const std::string scene =
      write("wild.json", R"({"plumb_scene": 1, "step": {"dt": 1000, "duration": 3000}, "bodies": [)"
                         R"({"name": "calm"}, {"name": "wild", "linear_velocity": [)" +
                             std::string(kBeyondNumbers) +
                             R"(, 0, 0], "repeat": {"count": [1, 1, 12]}}]})");
  const Outcome run = plumb("run " + scene);
  EXPECT_EQ(run.code, 1) << run.output;
  EXPECT_TRUE(says(run, "step 1: body 'wild[0]' became non-finite")) << run.output;
  EXPECT_TRUE(says(run, "body 'wild[9]'") && says(run, "and 2 more bodies")) << run.output;
  EXPECT_FALSE(says(run, "'calm'")) << run.output;
  EXPECT_TRUE(says(run, "Asleep       0 of 13 dynamic bodies")) << run.output;
}

TEST_F(ProgramTells, HowManyBodiesSleep) {
  const std::string scene = "run " + kScenes + "stack_of_ten.json --steps ";
  EXPECT_TRUE(says(plumb(scene + "2"), "Asleep       0 of 10 dynamic bodies"));
  const Outcome asleep = plumb(scene + "600");
  EXPECT_TRUE(says(asleep, "Asleep       10 of 10 dynamic bodies")) << asleep.output;
  EXPECT_TRUE(says(asleep, "Contacts     0 points at the end") &&
              says(asleep, "not counting what sleeps"))
      << asleep.output;
}

#if defined(__linux__)
// Folders of the system's own make no files for anybody, whatever their permissions say.
TEST_F(ProgramTells, WhereAFileCannotBeWritten) {
  std::vector<std::string> ways{"effects --csv /proc/x"};
#if defined(PLUMB_WITH_REPLAY)
  ways.push_back("run -q " + kScenes + "ball_drop.json --steps 2 -o /proc/x");
#endif
  for (const std::string& way : ways) {
    const Outcome outcome = plumb(way);
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_TRUE(says(outcome, "/proc/x cannot be written: no files can be made in the folder"))
        << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}
#endif

TEST_F(ProgramTells, WhereASceneIsNoJson) {
  const std::string scene =
      write("comma.json", "{\n\"plumb_scene\": 1,\n\"bodies\": [\n{},\n]\n}\n");
  const Outcome run = plumb("run " + scene);
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.output,
            "plumb: " + scene + ":4:3: JSON does not allow a comma before ]; remove it\n");
}

}  // namespace
