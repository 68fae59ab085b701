// A case that other engines are put through is the lab's case: built as a neutral scene in our own
// engine it gives the lab's readings. What plumb-peers prints becomes curves with the right errors,
// or is refused with a text; nothing is made of a program that fails or is not there.
#include "accuracy/peers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "accuracy/cell.h"
#include "accuracy/report.h"
#include "accuracy/setups/setup.h"
#include "bench/anchors/engines/plumb_world.h"
#include "bench/peers/run.h"

namespace plumb::accuracy {
namespace {

namespace fs = std::filesystem;

const anchors::EngineKind& ours() {
  static const std::vector<anchors::EngineKind> kinds = anchors::plumb_kinds();
  return kinds.front();
}

Precision precision_of_build() {
  int place = 0;
  while (std::string(kPrecisionNames[place]) != kPrecisionName) ++place;
  return static_cast<Precision>(place);
}

constexpr double kStands =
    0.02;  // [m] rms that boards have moved; fallen ones move by 0.5 and more

// --- the scenes ----------------------------------------------------------------------------------

TEST(PeerCases, AreCasesOfTheCatalogue) {
  for (const accuracy::Setup& setup : setups()) {
    EXPECT_NE(find_case(setup.name), nullptr) << setup.name;
    EXPECT_EQ(find_setup(setup.name), &setup);
  }
  EXPECT_EQ(find_setup("F99"), nullptr);
}

TEST(PeerCases, ScenesHaveTheMassesOfTheSetups) {
  for (const accuracy::Setup& setup : setups()) {
    const anchors::Scene scene = peers::scene_of(setup);
    EXPECT_FALSE(scene.sleeping);
    ASSERT_EQ(scene.bodies.size(), setup.bodies.size());
    PhysicsWorld world(anchors::settings_of(scene));
    const std::vector<BodyId> ids = anchors::build_in(world, scene);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const MassProperties made = world.mass_properties(ids[i]);
      const SetupBody& body = setup.bodies[i];
      EXPECT_NEAR(made.mass, body.mass, 1e-6 * body.mass) << setup.name;
      const Eigen::Matrix3d off = made.I_Bcm_B - Eigen::Matrix3d(body.moments.asDiagonal());
      EXPECT_LT(off.norm(), 2e-6 * body.moments.norm()) << setup.name;
    }
  }
}

TEST(PeerCases, CopiesStandApartAndAreJoinedAmongThemselves) {
  const accuracy::Setup& one = *find_setup("chain");
  const accuracy::Setup all = repeated(one, 3);
  ASSERT_EQ(all.bodies.size(), 3 * one.bodies.size());
  ASSERT_EQ(all.joints.size(), 3 * one.joints.size());
  for (std::size_t i = 0; i < all.joints.size(); ++i) {
    const int copy = static_cast<int>(i / one.joints.size());
    EXPECT_EQ(all.joints[i].b / 10, copy);
    EXPECT_EQ(all.joints[i].a < 0, i % 10 == 0);
    const Eigen::Vector3d& p = all.bodies[static_cast<std::size_t>(all.joints[i].b)].position;
    EXPECT_NEAR((p - all.joints[i].at).norm(), 0.1, 1e-12);
  }
}

// The same motion up to round-off: masses go through a density and a ball joint stands for a hinge.
// What balls in a grid do with that round-off is chaotic: of them the statistic is compared. How
// far the boards of a tower creep is too: of them that they stand.
TEST(PeerCases, OurEngineReadsTheSameThroughTheNeutralScene) {
  Knobs knobs;
  knobs.precision = precision_of_build();
  for (const accuracy::Setup& setup : setups()) {
    const Readings lab = cells_of(knobs.precision)->run(setup.name, knobs);
    const peers::Outcome neutral = peers::run(ours(), setup, knobs.dt);
    ASSERT_TRUE(neutral.built && neutral.finite && lab.finite) << setup.name;
    ASSERT_EQ(neutral.readings.size(), lab.values.size()) << setup.name;
    const double apart = distance(neutral.readings, lab.values);
    const bool grid = setup.bodies.size() == 216;
    const double bound = grid ? 0.1 * lab.values[0] : 1e-5 * find_case(setup.name)->scale;
    if (setup.name == "kapla") {
      EXPECT_LT(std::max(lab.values[0], neutral.readings[0]), kStands);
    } else {
      EXPECT_LE(apart, bound) << setup.name;
    }
  }
}

// SimBenchmark's tower of boards, which of the engines published RaiSim's alone keeps up.
TEST(PeerCases, KaplaTowerStandsAMinute) {
  const peers::Outcome outcome = peers::run(ours(), *find_setup("kapla"), 1.0 / 60);
  ASSERT_TRUE(outcome.built && outcome.finite);
  EXPECT_LT(outcome.readings[0], kStands);
}

// --- what the program prints ---------------------------------------------------------------------

TEST(PeerRows, AreReadAsTheyArePrinted) {
  peers::Outcome outcome;
  outcome.built = true;
  outcome.readings = {1.0 / 3, -2e-17};
  const std::string line = peers::row_of("F6", ours(), 1.0 / 60, outcome, 2.5e-6);
  const std::optional<PeerRow> row = parse_peer_row(line.substr(0, line.size() - 1));
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(row->name, "F6");
  EXPECT_EQ(row->engine, ours().name);
  EXPECT_EQ(row->settings, ours().settings);
  EXPECT_EQ(row->dt, 1.0 / 60);
  EXPECT_DOUBLE_EQ(row->cost, 2.5e-6);
  EXPECT_TRUE(row->finite);
  EXPECT_EQ(row->readings, outcome.readings);
}

TEST(PeerRows, WhatIsNoneIsRefused) {
  EXPECT_TRUE(parse_peer_row("F9,ode,\"0.16, f64\",0.01,3,1,2.4").has_value());
  for (const char* bad :
       {"", "F9", "F9,ode,s,0.01,3,1", "F9,ode,s,0.01,3,1,2,4", "F9,ode,s,0,3,1,2.4",
        "F9,ode,s,x,3,1,2.4", "F9,ode,s,0.01,-3,1,2.4", "F9,ode,s,0.01,3,yes,2.4",
        "F9,ode,s,0.01,3,1,", "F9,ode,s,0.01,3,1,2.4x", "F9,ode,s,0.01,3,1,2 4 y",
        ",ode,s,0.01,3,1,2.4", "F9,,s,0.01,3,1,2.4", "F9,ode,\"s,0.01,3,1,2.4"})
    EXPECT_FALSE(parse_peer_row(bad).has_value()) << bad;
}

CaseResult pendulum() {
  CaseResult result;
  result.info = find_case("F9");
  result.right = {2};
  return result;
}

TEST(PeerRows, BecomeCurvesWithErrorsAgainstTheRightReadings) {
  CaseResult result = pendulum();
  std::vector<std::string> notes;
  for (const char* line : {"case,engine,settings,dt_s,us_per_body_second,finite,readings",
                           "F9,ode,\"0.16, f64, QuickStep\",0.1,3,1,2.5",
                           "F9,ode,\"0.16, f64, QuickStep\",0.05,6,0,nan",
                           "# F9: rapier cannot build it", "F9,box3d,0.1,0.1,4,1,1.75"})
    EXPECT_EQ(add_peer_line(line, result, notes), "") << line;
  EXPECT_EQ(notes, std::vector<std::string>{"F9: rapier cannot build it"});
  ASSERT_EQ(result.peers.size(), 2u);
  EXPECT_EQ(label_of(result.peers[0]), "ODE 0.16, f64, QuickStep");
  EXPECT_EQ(short_label_of(result.peers[0]), "ODE 0.16, f64");
  EXPECT_EQ(short_label_of(result.peers[1]), "Box3D 0.1");
  ASSERT_EQ(result.peers[0].points.size(), 2u);
  EXPECT_EQ(result.peers[0].points[0].error, 0.5);
  EXPECT_TRUE(std::isinf(result.peers[0].points[1].error));
  EXPECT_DOUBLE_EQ(result.peers[0].points[1].cost, 6e-6);
  EXPECT_EQ(result.peers[1].points[0].error, 0.25);
  // Of another case, or of another number of readings.
  EXPECT_NE(add_peer_line("F8,ode,s,0.1,3,1,2.5", result, notes), "");
  EXPECT_NE(add_peer_line("F9,ode,s,0.1,3,1,2.5 1", result, notes), "");
  EXPECT_NE(add_peer_line("who knows", result, notes), "");
}

// Two ways of one engine are two curves under its one name.
TEST(PeerRows, OfVariantsOfAnEngineAreTwoCurves) {
  CaseResult result = pendulum();
  std::vector<std::string> notes;
  for (const char* line : {"F9,mujoco,\"4.0.0, f64, Euler\",0.1,3,1,2.5",
                           "F9,mujoco-rk4,\"4.0.0 RK4, f64, elliptic\",0.1,3,1,2.25"})
    EXPECT_EQ(add_peer_line(line, result, notes), "") << line;
  ASSERT_EQ(result.peers.size(), 2u);
  EXPECT_EQ(label_of(result.peers[0]), "MuJoCo 4.0.0, f64, Euler");
  EXPECT_EQ(short_label_of(result.peers[1]), "MuJoCo 4.0.0 RK4, f64");
}

TEST(PeerRows, AreMarkedInReportsAndLeaveOurFrontAlone) {
  CaseResult result = pendulum();
  result.series = {{"dt, f64", {}, true}};
  CellResult cell;
  cell.error = 1e-3;
  cell.cost = 1e-5;
  result.cells = {cell};
  mark_pareto(result.cells);
  result.peers = {{"ode", "0.16, f64", {{1.0 / 60, 1e-4, 1e-6}}, {}}};  // better in both
  EXPECT_TRUE(result.cells[0].pareto);
  EXPECT_EQ(cheapest(result, 1), &result.cells[0]);
  EXPECT_NE(table_of(result).find("ODE 0.16, f64"), std::string::npos);
  const std::string csv = csv_of({result}, {"m", "c", "abc", "today"});
  EXPECT_NE(csv.find(",plumb,\"dt, f64\",f64,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",ode,\"ODE 0.16, f64\",,"), std::string::npos) << csv;
  const std::string script = chart_script({&result}, Family::Jointed, "png", "x");
  EXPECT_NE(script.find("title 'ODE 0.16, f64'"), std::string::npos);
  EXPECT_NE(script.find("title 'Plumb: dt, f64'"), std::string::npos);
}

// --- the program ---------------------------------------------------------------------------------

// A script in its place, so that this holds without any other engine.
class PeerProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumb peers " + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string script(const std::string& body) {
    const fs::path path = folder_ / "plumb-peers";
    std::ofstream(path) << "#!/bin/sh\n" << body;
    fs::permissions(path, fs::perms::owner_all);
    return path.string();
  }
  std::string add(const std::string& program, CaseResult& result) {
    done_ = 0;
    return add_peers(
        program, result, {0.1, 0.05, 0.025}, true, [&](std::size_t n) { done_ += n; }, notes_);
  }
  fs::path folder_;
  std::size_t done_ = 0;
  std::vector<std::string> notes_;
};

TEST_F(PeerProgram, IsStartedWithCaseAndStepsAndItsRowsAreTaken) {
  const std::string program = script(
      "test \"$1 $2 $4\" = 'F9 --dt --window' || exit 3\n"
      "echo 'F9,ode,s,0.1,3,1,2.16'; echo 'F9,ode,s,0.05,6,1,2.04'\n"
      "echo 'F9,ode,s,0.025,12,1,2.01'; echo '# F9: box3d cannot build it'\n");
  EXPECT_EQ(missing(program), "");
  CaseResult result = pendulum();
  EXPECT_EQ(add(program, result), "");
  ASSERT_EQ(result.peers.size(), 1u);
  EXPECT_EQ(result.peers[0].points.size(), 3u);
  EXPECT_TRUE(result.peers[0].fit.found);
  EXPECT_NEAR(result.peers[0].fit.order, 2, 1e-9);
  EXPECT_EQ(done_, 3 * kMostPeers);
  EXPECT_EQ(notes_.size(), 1u);
}

TEST_F(PeerProgram, ThatFailsOrIsNotThereIsNamed) {
  const std::string nowhere = (folder_ / "none").string();
  EXPECT_NE(missing(nowhere).find("PLUMB_PEERS=ON"), std::string::npos);
  EXPECT_EQ(missing(nowhere).find('\n'), std::string::npos);
  CaseResult result = pendulum();
  EXPECT_NE(add(nowhere, result), "");
  EXPECT_NE(add(script("exit 2\n"), result), "");
  EXPECT_NE(add(script("kill -9 $$\n"), result), "");
  EXPECT_NE(add(script("echo nonsense; yes | head -100000\n"), result), "");
  EXPECT_TRUE(result.peers.empty());
}

TEST_F(PeerProgram, CasesThatItDoesNotHaveAreSaid) {
  CaseResult result;
  result.info = find_case("C18");
  EXPECT_TRUE(peer_steps(*result.info, {}).empty());
  EXPECT_EQ(add_peers("none", result, {}, true, {}, notes_), "");
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_EQ(notes_[0].rfind("C18: ", 0), 0u);
}

TEST(PeerSteps, AreThoseOfOurCurvesOrTheUsers) {
  const CaseInfo& info = *find_case("F9");
  KnobChoice choice;
  const std::vector<double> all = peer_steps(info, choice);
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all.front(), 1.0 / 15);
  EXPECT_EQ(all.back(), 1e-3);
  choice.quick = true;
  EXPECT_EQ(peer_steps(info, choice).size(), 5u);
  choice.substeps = {8};
  EXPECT_EQ(peer_steps(info, choice), std::vector<double>{1.0 / 60});
  choice.dt = {0.01, 0.02};
  EXPECT_EQ(peer_steps(info, choice), choice.dt);
}

}  // namespace
}  // namespace plumb::accuracy
