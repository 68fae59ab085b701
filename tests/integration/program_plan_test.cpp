// Invariant: `plumb plan` tells what is forced off with what that loses; what cannot be forced gets
// one line; `plumb run` counts how often the plan changes and takes the same options.
#include <algorithm>
#include <string>

#include "gtest/gtest.h"
#include "integration/run_program.h"

namespace {

using namespace plumb_program;  // NOLINT(google-build-using-namespace)

class ProgramPlan : public Program {};

TEST_F(ProgramPlan, TellsWhatIsLostWithoutTheGyroscopicTerm) {
  const std::string scene = kScenes + "dzhanibekov.json";
  const Outcome usual = plumb("plan " + scene);
  EXPECT_EQ(usual.code, 0);
  EXPECT_FALSE(says(usual, "lost:"));
  const Outcome without = plumb("plan --without gyroscopic " + scene + " --with look-ahead");
  EXPECT_EQ(without.code, 0) << without.output;
  EXPECT_TRUE(says(without, "forced off; "));
  EXPECT_TRUE(says(without, "forced on; "));
  EXPECT_TRUE(says(without, "lost: the angular momentum of body")) << without.output;
  EXPECT_TRUE(says(without, "|w x L| dt / |L| = "));
}

TEST_F(ProgramPlan, RefusesWhatCannotBeForced) {
  const std::string scene = kScenes + "default.json";
  for (const std::string& wrong :
       {std::string("--without gravity"), std::string("--with friction"),
        std::string("--without gyro"), std::string("--without sleeping --with sleeping")})
    for (const char* command : {"plan ", "run --steps 1 "}) {
      const Outcome outcome = plumb(command + scene + " " + wrong);
      EXPECT_EQ(outcome.code, 2) << wrong << outcome.output;
      EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1)
          << outcome.output;
    }
}

TEST_F(ProgramPlan, RunsCountHowOftenThePlanChanges) {
  const std::string scene = kScenes + "dzhanibekov.json";
  const Outcome usual = plumb("run --steps 60 " + scene);
  const Outcome without = plumb("run --steps 60 --without gyroscopic " + scene);
  EXPECT_TRUE(says(usual, "times one went on or off")) << usual.output;
  const auto hash = [](const Outcome& outcome) {
    return outcome.output.substr(outcome.output.find("State hash"), 30);
  };
  EXPECT_NE(hash(usual), hash(without));
}

}  // namespace
