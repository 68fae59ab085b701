// A recording survives the process that writes it, and whatever is wrong with a file or a disk is
// said, with the file's name, and never harms the world that is being recorded.
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <random>

#include "recorded_run.h"

namespace plumb {
namespace {

using namespace replay_test;
namespace schema = rrd::schema;

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Records in a child process that dies without closing anything; returns after its death.
void record_and_die(const std::string& path, int steps, bool flush) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    PhysicsWorld world;
    scenes::build_stack(world, {.count = 5, .shift = 0.1});
    replay::Recorder recorder;
    if (!recorder.open({.path = path, .snapshot_every = 20, .rows_per_chunk = 10}).ok()) ::_exit(2);
    world.attach(&recorder);
    for (int step = 0; step < steps; ++step) world.step(kDt);
    if (flush && !recorder.flush().ok()) ::_exit(3);
    ::kill(::getpid(), SIGKILL);
    ::_exit(4);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended with " << WEXITSTATUS(status);
}

TEST(KilledProcess, LeavesAllThatWasFlushed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("killed.rrd");
  record_and_die(path, 47, true);
  const auto info = replay::info(path);
  EXPECT_TRUE(info.outcome.ok()) << info.outcome.error;
  EXPECT_FALSE(info.finished);
  EXPECT_EQ(info.steps, 47u);
  const auto result = replay::verify(path);
  EXPECT_TRUE(result.identical()) << result.outcome.error;
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.steps, 47u);
}

// Wherever a file is cut, what lies before the cut is either verified or named as missing.
TEST(CutFile, IsReadUpToTheCutAndReportedAsUnfinished) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), 60, {.snapshot_every = 20, .rows_per_chunk = 10});
  const std::uintmax_t size = size_of(folder.file("run.rrd"));
  std::uint64_t most_steps = 0;
  for (int part = 1; part < 40; ++part) {
    const std::string path = folder.file("cut.rrd");
    std::filesystem::copy_file(folder.file("run.rrd"), path,
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path, size * static_cast<std::uintmax_t>(part) / 40);
    const auto result = replay::verify(path);
    EXPECT_FALSE(result.finished) << part;
    EXPECT_FALSE(result.difference.has_value()) << part;
    if (result.outcome.ok()) {
      most_steps = std::max(most_steps, result.steps);
    } else {
      EXPECT_TRUE(mentions(result.outcome.error, path)) << result.outcome.error;
    }
  }
  EXPECT_GE(most_steps, 50u);
  EXPECT_LE(most_steps, 60u);
}

TEST(MalformedFile, IsNamedWithItsReason) {
  const TemporaryFolder folder;
  const auto error_for = [&](const std::string& content) {
    const std::string path = folder.file("bad.rrd");
    std::ofstream(path, std::ios::binary) << content;
    const auto result = replay::verify(path);
    EXPECT_TRUE(mentions(result.outcome.error, path)) << result.outcome.error;
    EXPECT_TRUE(mentions(replay::info(path).outcome.error, path));
    return result.outcome.error;
  };
  EXPECT_TRUE(mentions(error_for(""), "too short"));
  EXPECT_TRUE(mentions(error_for("RRF2"), "too short"));
  EXPECT_TRUE(
      mentions(error_for("{\"this\": \"is a scene, not a recording\"}"), "not a recording"));
  EXPECT_TRUE(mentions(error_for(std::string(4096, '\0')), "not a recording"));

  const auto missing = replay::verify(folder.file("none.rrd")).outcome.error;
  EXPECT_TRUE(mentions(missing, "No such file")) << missing;
}

// Garbage in the middle is no end: it is told where it stands.
TEST(MalformedFile, GarbageInTheMiddleIsFound) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  record_run(path, 60);
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(size_of(path) / 2));
    file << std::string(2000, '\x5a');
  }
  const auto result = replay::verify(path);
  EXPECT_FALSE(result.outcome.ok());
  EXPECT_TRUE(mentions(result.outcome.error, path)) << result.outcome.error;
}

// Bits that tip over in transit: whatever they hit, an error names the file and says that it is
// damaged, the libraries below keep their own words and traces to themselves, and nothing crashes.
TEST(MalformedFile, TippedBitsAreToldAsDamageAndNothingElseIsPrinted) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  record_run(path, 20, {.visuals = false, .contacts = false, .plots = false, .text_log = false});
  std::string whole;
  {
    std::ifstream file(path, std::ios::binary);
    whole.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  std::minstd_rand random(1);
  int damaged = 0;
  testing::internal::CaptureStderr();
  for (int k = 0; k < 400; ++k) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] ^= static_cast<char>(1u << random() % 8);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    const std::string error = replay::verify(path).outcome.error;
    EXPECT_TRUE(error.empty() || mentions(error, path)) << error;
    EXPECT_FALSE(mentions(error, "a defect in the recording bridge")) << error;
    if (mentions(error, "damaged at byte")) ++damaged;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(damaged, 20);
}

TEST(MalformedFile, AFolderIsCalledOne) {
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(replay::info(folder.path()).outcome.error, "it is a folder"));
}

TEST(MalformedFile, ARecordingOfSomebodyElseIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("other.rrd");
  {
    rrd::Writer writer;
    ASSERT_TRUE(writer.open(path, "other", "other").ok());
    rrd::Table table("points");
    const auto column = table.add_column<float>("Points3D:positions", 3);
    table.column(column).append(std::span<const float>(std::array{1.0f, 2.0f, 3.0f}));
    table.end_row(0, 0);
    table.send(writer);
    ASSERT_TRUE(writer.close(60).ok());
  }
  EXPECT_TRUE(mentions(replay::verify(path).outcome.error, "not written by Plumb's recorder"));
}

TEST(ForeignRecording, OfAnotherPrecisionSaysWhichBuildReadsIt) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), 20);
  const std::string path = folder.file("other.rrd");
  rewrite(folder.file("run.rrd"), path, [](EditableCell& cell) {
    if (cell.component == schema::recording::kPrecision) cell.texts[0] = "f16";
    return true;
  });
  const auto result = replay::verify(path);
  EXPECT_TRUE(mentions(result.outcome.error, "was recorded by the f16 build"))
      << result.outcome.error;
  EXPECT_TRUE(mentions(result.outcome.error, std::string("this is the ") + kPrecisionName));
  EXPECT_EQ(replay::info(path).precision, "f16");
  EXPECT_TRUE(replay::info(path).outcome.ok());
}

TEST(ForeignRecording, OfAnotherSchemaSaysSo) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), 20);
  const std::string path = folder.file("newer.rrd");
  rewrite(folder.file("run.rrd"), path, [](EditableCell& cell) {
    if (cell.component == schema::recording::kSchemaVersion)
      cell.set<std::uint32_t>(0, schema::kVersion + 1);
    return true;
  });
  EXPECT_TRUE(mentions(replay::verify(path).outcome.error, "schema version"));
}

TEST(ForeignRecording, WithoutASnapshotColumnOrAStepSaysWhich) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), 20);
  std::string dropped;
  rewrite(folder.file("run.rrd"), folder.file("column.rrd"), [&](EditableCell& cell) {
    if (dropped.empty() && cell.component.starts_with(schema::snapshot::kColumnPrefix))
      dropped = cell.component;
    return cell.component != dropped;
  });
  ASSERT_FALSE(dropped.empty());
  EXPECT_TRUE(mentions(replay::verify(folder.file("column.rrd")).outcome.error,
                       dropped.substr(std::string(schema::snapshot::kColumnPrefix).size())));
  rewrite(folder.file("run.rrd"), folder.file("step.rrd"), [](EditableCell& cell) {
    return !(cell.entity == schema::step::kEntity && cell.frame == 9u);
  });
  EXPECT_TRUE(mentions(replay::verify(folder.file("step.rrd")).outcome.error, "lacks step 9"));
}

TEST(UnwritablePath, IsNamedAndTheWorldGoesOn) {
  const TemporaryFolder folder;
  for (const std::string& path : {folder.path() + "/no/such/folder/x.rrd", folder.path()}) {
    PhysicsWorld world;
    scenes::build_stack(world, {.count = 3});
    replay::Recorder recorder;
    const auto opened = recorder.open({.path = path});
    EXPECT_FALSE(opened.ok());
    EXPECT_TRUE(mentions(opened.error, path)) << opened.error;
    world.attach(&recorder);
    for (int step = 0; step < 5; ++step) EXPECT_TRUE(world.step(kDt).status.ok());
    EXPECT_EQ(recorder.status().error, opened.error);
    EXPECT_EQ(recorder.close().error, opened.error);
  }
}

// /dev/full takes nothing: every write to it fails as on a full disk.
TEST(FullDisk, IsReportedAtOnceAndTheWorldGoesOn) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  PhysicsWorld world, free_world;
  scenes::build_stack(world, {.count = 3});
  scenes::build_stack(free_world, {.count = 3});
  replay::Recorder recorder;
  auto reported = recorder.open({.path = "/dev/full", .rows_per_chunk = 2});
  world.attach(&recorder);
  for (int step = 0; step < 50; ++step) {
    EXPECT_TRUE(world.step(kDt).status.ok());
    free_world.step(kDt);
  }
  if (reported.ok()) reported = recorder.flush();
  EXPECT_TRUE(mentions(reported.error, "/dev/full")) << reported.error;
  EXPECT_TRUE(mentions(reported.error, "No space left on device")) << reported.error;
  EXPECT_FALSE(recorder.close().ok());
  EXPECT_EQ(world.state_hash(), free_world.state_hash());
}

// A disk that fills up while the run goes on (here: a limit on the size of files) costs the rest of
// the recording only: what was written before is whole, and closing does not wait for the disk.
TEST(FullDisk, LeavesWhatWasWrittenBeforeReadable) {
  const TemporaryFolder folder;
  const std::string path = folder.file("full.rrd");
  constexpr rlim_t kLimit = 300'000;  // [bytes] a fifth or so of what the run needs
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{kLimit, kLimit};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(2);
    PhysicsWorld world;
    scenes::build_pyramid(world, {.base = 8});
    replay::Recorder recorder;
    if (!recorder.open({.path = path, .snapshot_every = 20, .rows_per_chunk = 10}).ok()) ::_exit(3);
    world.attach(&recorder);
    for (int step = 0; step < 400; ++step)
      if (!world.step(kDt).status.ok()) ::_exit(4);
    if (!mentions(recorder.flush().error, "File too large")) ::_exit(5);
    ::_exit(mentions(recorder.close().error, path) ? 0 : 6);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 0);
  EXPECT_LE(size_of(path), kLimit);
  const auto info = replay::info(path);
  EXPECT_TRUE(info.outcome.ok()) << info.outcome.error;
  EXPECT_FALSE(info.finished);
  EXPECT_EQ(info.cut_bytes, 0u);
  EXPECT_GE(info.steps, 20u);
  EXPECT_LT(info.steps, 400u);
  EXPECT_TRUE(replay::verify(path).identical());
}

TEST(Options, OutOfRangeAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rrd");
  for (const auto& options :
       {replay::RecorderOptions{}, replay::RecorderOptions{.path = path, .snapshot_every = 0},
        replay::RecorderOptions{.path = path, .rows_per_chunk = 0},
        replay::RecorderOptions{.path = path, .frames_per_second = 0},
        replay::RecorderOptions{.path = path, .event_lines_per_step = -1}}) {
    replay::Recorder recorder;
    EXPECT_FALSE(recorder.open(options).ok());
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

// What follows a restore is not what the recorded inputs lead to, so recording ends there, and says
// it.
TEST(Recorder, StopsWhenItsWorldIsRestored) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  PhysicsWorld world;
  scenes::build_stack(world, {.count = 3, .shift = 0.1});
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = path}).ok());
  world.attach(&recorder);
  const Snapshot start = world.save();
  for (int step = 0; step < 10; ++step) world.step(kDt);
  ASSERT_TRUE(world.restore(start).ok());
  for (int step = 0; step < 10; ++step) world.step(kDt);
  EXPECT_TRUE(mentions(recorder.status().error, "restored")) << recorder.status().error;
  EXPECT_FALSE(recorder.close().ok());
  const auto result = replay::verify(path);
  EXPECT_TRUE(result.identical()) << result.outcome.error;
  EXPECT_EQ(result.steps, 10u);
}

}  // namespace
}  // namespace plumb
