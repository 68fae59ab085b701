// Invariant: the `plumb` program does what its help says, tells bad input (2) from a failed run or
// check (1), and leaves no half-written file under the final name.
#include <filesystem>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "integration/run_program.h"

namespace {

using namespace plumb_program;  // NOLINT(google-build-using-namespace)

// The line of a summary that begins with this word.
std::string line_of(const Outcome& outcome, const std::string& word) {
  const std::size_t first = outcome.output.find(word);
  return first == std::string::npos
             ? ""
             : outcome.output.substr(first, outcome.output.find('\n', first) - first);
}

TEST_F(Program, HelpsAndTellsItsVersion) {
  const Outcome help = plumb("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"run", "mesh", "plan", "replay", "Exit codes", "Example"})
    EXPECT_TRUE(says(help, word)) << word << "\n" << help.output;
  const Outcome run_help = plumb("run --help");
  EXPECT_EQ(run_help.code, 0);
  for (const char* word :
       {"SCENE", "--output", "--steps", "--dt", "--substeps", "--threads", "--labels"})
    EXPECT_TRUE(says(run_help, word)) << word << "\n" << run_help.output;
  EXPECT_EQ(plumb("--version").code, 0);
  EXPECT_TRUE(says(plumb("--version"), "plumb 0.1.0 ("));
}

TEST_F(Program, TellsBadInput) {
  const std::string scene = kScenes + "ball_drop.json";
  for (const std::string& arguments : {
           std::string(""),
           std::string("fly"),
           std::string("--frobnicate"),
           std::string("run"),
           "run " + scene + " --frobnicate",
           "run " + scene + " --steps many",
           "run " + scene + " --steps -1",
           "run " + scene + " --dt 0",
           "run " + scene + " --dt -0.01",
           "run " + scene + " --dt nan",
           "run " + scene + " --substeps 0",
           "run " + scene + " --substeps 65",
           "run " + scene + " --ledger",  // shows in a recording only
           "run " + scene + " --threads -1",
           "run " + scene + " --threads 1000",
           std::string("mesh"),
           "mesh " + kModels + "torus.stl --method guess",
           "mesh " + kModels + "torus.stl --up w",
           std::string("replay"),
           std::string("replay verify"),
       }) {
    const Outcome outcome = plumb(arguments);
    EXPECT_EQ(outcome.code, 2) << "plumb " << arguments << "\n" << outcome.output;
    EXPECT_FALSE(outcome.output.empty()) << "plumb " << arguments;
  }
  for (const std::string command : {"run ", "plan ", "mesh ", "replay info ", "replay verify "}) {
    const Outcome outcome = plumb(command + file("missing.file"));
    EXPECT_EQ(outcome.code, 2) << command << outcome.output;
  }
  EXPECT_TRUE(says(plumb("run " + file("missing.json")), file("missing.json")));
}

TEST_F(Program, NamesTheLineOfAMalformedScene) {
  const std::string scene = write("bad.json", "{\n  \"plumb_scene\": 1,\n  \"bodys\": []\n}\n");
  for (const std::string command : {"run ", "plan "}) {
    const Outcome outcome = plumb(command + scene);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(says(outcome, scene + ":3: unknown key 'bodys'")) << outcome.output;
    EXPECT_TRUE(says(outcome, "did you mean 'bodies'?")) << outcome.output;
  }
}

TEST_F(Program, RunsAndSumsUp) {
  const Outcome run =
      plumb("run " + kScenes + "stack_of_ten.json --steps 30 --dt 0.01 --substeps 5");
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_TRUE(says(run, "11 bodies")) << run.output;
  EXPECT_TRUE(says(run, "0.300 s in 30 steps of 10.000 ms, 5 substeps each")) << run.output;
  for (const char* word : {"x real time", "Contacts", "Energy", "drift", "State hash"})
    EXPECT_TRUE(says(run, word)) << word << "\n" << run.output;
  // Not a terminal: no bar.
  EXPECT_EQ(run.output.find('\r'), std::string::npos);
  EXPECT_EQ(plumb("run -q " + kScenes + "ball_drop.json --steps 2").output, "");
}

TEST_F(Program, RunsAlikeForAnyNumberOfThreads) {
  const std::string command = "run " + kScenes + "default.json --steps 60 --threads ";
  const std::string one = line_of(plumb(command + "1"), "State hash");
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(line_of(plumb(command + "2"), "State hash"), one);
}

TEST_F(Program, PrintsThePlanWithReasons) {
  const Outcome plan = plumb("plan " + kScenes + "ball_drop.json");
  EXPECT_EQ(plan.code, 0) << plan.output;
  EXPECT_TRUE(says(plan, "Reason")) << plan.output;
  // A sphere has no gyroscopic term, a rubber ball bounces.
  EXPECT_TRUE(says(plan, "yes")) << plan.output;
  EXPECT_TRUE(says(plan, "no ")) << plan.output;
}

TEST_F(Program, LooksAtMeshes) {
  const Outcome torus = plumb("mesh " + kModels + "torus.stl");
  EXPECT_EQ(torus.code, 0) << torus.output;
  const Outcome json = plumb("mesh --json " + kModels + "torus.stl");
  EXPECT_EQ(json.code, 0);
  EXPECT_TRUE(says(json, "plumb-mesh/1")) << json.output;
  // One triangle has no inside: the check fails, the input was readable.
  const std::string open = write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(plumb("mesh " + open).code, 1);
  const std::string garbage = write("garbage.stl", "this is no mesh");
  EXPECT_EQ(plumb("mesh " + garbage).code, 2);
}

#if defined(PLUMB_WITH_REPLAY)

TEST_F(Program, RecordsAndVerifies) {
  const std::string recording = file("run.rrd");
  const Outcome run = plumb("run " + kScenes + "stack_of_ten.json --steps 90 -o " + recording);
  ASSERT_EQ(run.code, 0) << run.output;
  EXPECT_TRUE(says(run, "bytes a body and frame")) << run.output;
  EXPECT_FALSE(says(run, " 0.0 bytes")) << run.output;
  EXPECT_FALSE(says(run, "cost 0.000 us")) << run.output;
  EXPECT_GT(fs::file_size(recording), 0u);
  EXPECT_EQ(files(), 1u);  // nothing is left beside it

  const Outcome info = plumb("replay info " + recording);
  EXPECT_EQ(info.code, 0) << info.output;
  EXPECT_TRUE(says(info, "90 steps")) << info.output;
  EXPECT_TRUE(says(info, "Finished     yes")) << info.output;
  for (const std::string threads : {"1", "2"}) {
    const Outcome verify = plumb("replay verify " + recording + " --threads " + threads);
    EXPECT_EQ(verify.code, 0) << verify.output;
    EXPECT_TRUE(says(verify, "identical: 90 frames")) << verify.output;
  }
}

// Joints that break, surfaces, heightfields, compounds and labels in the recording as well.
TEST_F(Program, RecordsAndVerifiesEveryShapeAndJoint) {
  for (const std::string scene : {"gallery", "terrain"}) {
    const std::string recording = file(scene + ".rrd");
    const Outcome run =
        plumb("run -q --labels --steps 150 " + kScenes + scene + ".json -o " + recording);
    ASSERT_EQ(run.code, 0) << run.output;
    const Outcome verify = plumb("replay verify --threads 2 " + recording);
    EXPECT_EQ(verify.code, 0) << verify.output;
    EXPECT_TRUE(says(verify, "identical: 150 frames")) << verify.output;
  }
}

// Two runs that are not the same: the check fails and names the first frame.
TEST_F(Program, TellsTheFrameWhereRecordingsPart) {
  const std::string a = file("a.rrd"), b = file("b.rrd"), c = file("c.rrd");
  const std::string run = "run -q " + kScenes + "ball_drop.json --steps 120 ";
  ASSERT_EQ(plumb(run + "-o " + a).code, 0);
  ASSERT_EQ(plumb(run + "-o " + b).code, 0);
  ASSERT_EQ(plumb(run + "--substeps 2 -o " + c).code, 0);
  EXPECT_EQ(plumb("replay diff " + a + " " + b).code, 0);
  const Outcome differ = plumb("replay diff " + a + " " + c);
  EXPECT_EQ(differ.code, 1) << differ.output;
  EXPECT_TRUE(says(differ, "DIFFERENT")) << differ.output;
}

TEST_F(Program, LeavesNoFileWhereItCannotWrite) {
  const std::string run = "run -q " + kScenes + "ball_drop.json --steps 2 -o ";
  for (const std::string& bad : {file("no/such/folder/run.rrd"), folder_.string()}) {
    const Outcome outcome = plumb(run + bad);
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_TRUE(says(outcome, bad)) << outcome.output;
  }
  EXPECT_EQ(files(), 0u);
  const std::string garbage = write("garbage.rrd", "this is no recording");
  EXPECT_EQ(plumb("replay info " + garbage).code, 2);
  EXPECT_EQ(plumb("replay verify " + garbage).code, 2);
}

TEST_F(Program, DoesNotOverwriteTheScene) {
  std::ifstream original(kScenes + "ball_drop.json");
  const std::string text((std::istreambuf_iterator<char>(original)),
                         std::istreambuf_iterator<char>());
  const std::string scene = write("scene.json", text);
  EXPECT_EQ(plumb("run -q " + scene + " -o " + scene).code, 2);
  EXPECT_EQ(fs::file_size(scene), text.size());
}

#else

TEST_F(Program, SaysThatItCannotRecord) {
  const Outcome run = plumb("run -q " + kScenes + "ball_drop.json --steps 2 -o " + file("run.rrd"));
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(says(run, "PLUMB_REPLAY=ON")) << run.output;
  EXPECT_EQ(files(), 0u);
}

#endif

}  // namespace
