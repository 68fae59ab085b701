// Invariant: what the `plumb` program writes is whole or absent and takes the place of nothing but
// the file that the user named; what cannot be written, or read, is named before the work begins,
// with its remedy, and nothing that was asked for is left out without a word.
#include <sys/stat.h>

#include <algorithm>
#include <string>

#include "gtest/gtest.h"
#include "integration/run_program.h"

namespace {

using namespace plumb_program;  // NOLINT(google-build-using-namespace)

class ProgramOutput : public Program {};
class ProgramInput : public Program {};

// A variable of the shell that was never set must not turn a recording into none.
TEST_F(ProgramOutput, AnEmptyNameIsRefused) {
  for (const std::string& arguments :
       {"run -q " + kScenes + "ball_drop.json --steps 2 -o \"\"", std::string("run -q \"\""),
        std::string("plan \"\""), std::string("effects --csv \"\"")}) {
    const Outcome outcome = plumb(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.output;
    EXPECT_FALSE(outcome.output.empty()) << arguments;
  }
}

TEST_F(ProgramOutput, AListOfPricesThatCannotBeWrittenIsRefusedBeforeTheyAreMeasured) {
  for (const std::string& bad : {file("no/such/folder/prices.csv"), folder_.string()}) {
    const Outcome outcome = plumb("effects --csv " + bad);
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_TRUE(says(outcome, bad)) << outcome.output;
    EXPECT_FALSE(says(outcome, "Nanoseconds")) << outcome.output;
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(ProgramOutput, AChartThatCannotBeDrawnIsRefusedBeforeItIsMeasured) {
  for (const std::string& bad :
       {"--chart " + file("no/such/folder/chart.png"), "--chart " + file("chart.txt"),
        std::string("--chart \"\""), "--csv " + folder_.string()}) {
    const Outcome outcome = plumb("effects --scaling " + bad);
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_FALSE(says(outcome, "a step more")) << outcome.output;
  }
  const Outcome without = plumb("effects --chart " + file("chart.png"));
  EXPECT_EQ(without.code, 2);
  EXPECT_TRUE(says(without, "--scaling")) << without.output;
  EXPECT_EQ(files(), 0u);
}

TEST_F(ProgramInput, AWordThatIsNoCommandIsNamedAndTheCommandsAre) {
  const Outcome fly = plumb("fly " + kScenes + "ball_drop.json");
  EXPECT_EQ(fly.code, 2);
  EXPECT_TRUE(says(fly, "'fly'") && says(fly, "run, mesh, plan")) << fly.output;
  const Outcome what_if = plumb("replay what-if run.rrd");
  EXPECT_EQ(what_if.code, 2);
  EXPECT_TRUE(says(what_if, "'what-if'") && says(what_if, "info, verify, diff")) << what_if.output;
}

TEST_F(ProgramInput, AFolderOrAPipeInPlaceOfAFileIsCalledOne) {
  for (const std::string command : {"run ", "plan ", "mesh "}) {
    const Outcome folder = plumb(command + folder_.string());
    EXPECT_EQ(folder.code, 2) << command;
    EXPECT_TRUE(says(folder, "is a folder")) << command << folder.output;
  }
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  const Outcome pipe = plumb("run " + file("pipe"));
  EXPECT_EQ(pipe.code, 2);
  EXPECT_TRUE(says(pipe, "a pipe")) << pipe.output;
}

TEST_F(ProgramInput, OptionsOfAMeshThatCannotBeAreRefusedBeforeTheFileIsRead) {
  const std::string missing = file("no_such_mesh.obj");
  for (const std::string options :
       {"--density -1", "--density nan", "--density 0", "--density inf", "--method shell",
        "--method shell --thickness 0", "--method shell --thickness nan", "--max-parts 0",
        "--max-parts 1000000", "--weld -1", "--metres-per-unit 0", "--parts-distance -1"}) {
    const Outcome outcome = plumb("mesh " + missing + " " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    const std::string option = options.starts_with("--method")
                                   ? std::string("--thickness")
                                   : options.substr(0, options.find(' '));
    EXPECT_TRUE(says(outcome, "plumb: " + option + ": ")) << options << ": " << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

TEST_F(ProgramInput, AStepMayBeWrittenAsAFraction) {
  const std::string run = "run " + kScenes + "ball_drop.json --steps 3 --dt ";
  const Outcome fraction = plumb(run + "1/60");
  EXPECT_EQ(fraction.code, 0) << fraction.output;
  EXPECT_TRUE(says(fraction, "0.050 s in 3 steps of 16.667 ms")) << fraction.output;
  for (const std::string bad : {"1/0", "1/", "/60", "1/60s", "nan", "sixtieth", "0/1", "-1/60"}) {
    const Outcome outcome = plumb(run + bad);
    EXPECT_EQ(outcome.code, 2) << bad << outcome.output;
    EXPECT_TRUE(says(outcome, "--dt: ")) << bad << outcome.output;
  }
}

// Steps of a nanosecond are not steps of "0.000 ms".
TEST_F(ProgramOutput, ShortStepsAreShownWithTheirDigits) {
  const Outcome run = plumb("run " + kScenes + "ball_drop.json --steps 4 --dt 2.5e-8");
  EXPECT_TRUE(says(run, "Simulated    1e-07 s in 4 steps of 2.5e-05 ms")) << run.output;
}

#if defined(PLUMB_WITH_REPLAY)

const std::string kShortRun = "run -q " + kScenes + "ball_drop.json --steps 5 -o ";

// The finished recording is renamed to its name: onto a device, it would take the device's place.
TEST_F(ProgramOutput, NothingButAFileIsEverReplaced) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  const Outcome run = plumb(kShortRun + file("pipe"));
  EXPECT_EQ(run.code, 2) << run.output;
  EXPECT_TRUE(says(run, file("pipe")) && says(run, "leave out -o")) << run.output;
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
  EXPECT_EQ(files(), 1u);
}

TEST_F(ProgramOutput, ARecordingGoesToWhereALinkPoints) {
  fs::create_directory(file("elsewhere"));
  (void)write("elsewhere/old.rrd", "what was there before");
  fs::create_symlink("elsewhere/old.rrd", file("link.rrd"));
  const Outcome run = plumb(kShortRun + file("link.rrd"));
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_TRUE(fs::is_symlink(file("link.rrd")));
  EXPECT_EQ(plumb("replay verify " + file("elsewhere/old.rrd")).code, 0);
  EXPECT_EQ(files(), 2u);
}

TEST_F(ProgramOutput, AMissingFolderIsNamedWithItsRemedy) {
  const Outcome run = plumb(kShortRun + file("results/today/run.rrd"));
  EXPECT_EQ(run.code, 2) << run.output;
  EXPECT_TRUE(says(run, "there is no folder " + file("results/today") + "; make it first"))
      << run.output;
}

// As `timeout` and batch systems end what takes too long.
TEST_F(ProgramOutput, APoliteKillEndsTheRunEarlyAndKeepsItsRecording) {
  const Outcome run =
      // Not before it has begun to record, however long a busy machine takes for that.
      shell("{ " + std::string(PLUMB_PROGRAM) + " run -q " + kScenes +
            "stack_of_ten.json --steps 100000000 -o " + file("run.rrd") +
            " & run=$!; while kill -0 $run && ! ls " + file("run.rrd") +
            "* ; do sleep 0.1; done >/dev/null 2>&1; sleep 0.5; kill -TERM $run; wait $run; }");
  EXPECT_EQ(run.code, 1) << run.output;
  EXPECT_TRUE(says(run, "stopped at step")) << run.output;
  EXPECT_EQ(files(), 1u);
  const Outcome info = plumb("replay info " + file("run.rrd"));
  EXPECT_TRUE(says(info, "Finished     yes")) << info.output;
}

// Each run grows a file of its own; whichever ends last has the name.
TEST_F(ProgramOutput, RunsThatRecordToOneNameAtATimeLeaveAWholeRecording) {
  const std::string run = std::string(PLUMB_PROGRAM) + " run -q " + kScenes +
                          "stack_of_ten.json --steps 400 -o " + file("run.rrd");
  const Outcome both = shell("{ " + run + " & first=$!; " + run + "; second=$?; wait $first && " +
                             "test $second -eq 0; }");
  EXPECT_EQ(both.code, 0) << both.output;
  EXPECT_EQ(files(), 1u);
  const Outcome verified = plumb("replay verify " + file("run.rrd"));
  EXPECT_EQ(verified.code, 0) << verified.output;
  EXPECT_TRUE(says(verified, "identical: 400 frames")) << verified.output;
}

// Runs that are equal as far as both go are not identical.
TEST_F(ProgramOutput, ADiffSaysWhichRecordingIsShorter) {
  ASSERT_EQ(plumb(kShortRun + file("a.rrd")).code, 0);
  ASSERT_EQ(plumb("run -q " + kScenes + "ball_drop.json --steps 12 -o " + file("b.rrd")).code, 0);
  for (const std::string order : {"a.rrd b.rrd", "b.rrd a.rrd"}) {
    const std::string first = file(order.substr(0, 5)), second = file(order.substr(6));
    const Outcome diff = plumb("replay diff " + first + " " + second);
    EXPECT_EQ(diff.code, 1) << diff.output;
    EXPECT_TRUE(says(diff, file("a.rrd") + " is 7 frames shorter; the 5 frames that both have"))
        << diff.output;
  }
  const Outcome same = plumb("replay diff " + file("a.rrd") + " " + file("a.rrd"));
  EXPECT_EQ(same.code, 0) << same.output;
  EXPECT_TRUE(says(same, "identical: 5 frames\n")) << same.output;
}

TEST_F(ProgramOutput, ADiffSaysWhichRecordingIsWhichAndThatTheBodiesAreOthers) {
  ASSERT_EQ(plumb(kShortRun + file("a.rrd")).code, 0);
  ASSERT_EQ(plumb("run -q " + kScenes + "domino.json --steps 5 -o " + file("b.rrd")).code, 0);
  const Outcome diff = plumb("replay diff " + file("a.rrd") + " " + file("b.rrd"));
  EXPECT_EQ(diff.code, 1) << diff.output;
  EXPECT_TRUE(says(diff, "Recorded is what " + file("a.rrd") + " holds")) << diff.output;
  EXPECT_TRUE(says(diff, "other bodies: ")) << diff.output;
  EXPECT_FALSE(says(diff, "ulp")) << diff.output;
}

#endif

}  // namespace
