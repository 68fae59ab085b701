#include "accuracy/catalogue.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "accuracy/setups/setup.h"

namespace plumb::accuracy {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

// F7 after ten seconds: exp(L t/I1) exp(-(I3/I1 - 1) w3 t e3), as the readings put an attitude.
std::vector<double> symmetric_top() {
  const double t = 10;
  const Eigen::Vector3d L(0.3, 0, 1.8 * 4);
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(Eigen::AngleAxisd(L.norm() * t, L.normalized())) *
      Eigen::Quaterniond(Eigen::AngleAxisd(-0.8 * 4 * t, Eigen::Vector3d::UnitZ()));
  const Eigen::Matrix3d R = q.toRotationMatrix() / std::numbers::sqrt2;
  return {R.data(), R.data() + 9};
}

// [s] that SimBenchmark's tower of boards has to stand. With 1000 iterations RaiSim's stands; it
// says nothing of how far the boards have moved: less than their height of 0.1 m. All others fall.
constexpr double kKaplaPublished = 600;

// SimBenchmark's rolling scene. ODE and DART stick, with pyramids for cones.
CaseInfo pulled(const char* name, const char* title) {
  return {.name = name,
          .family = Family::Published,
          .title = title,
          .unit = "m/s",
          .scale = 3,
          .exact = std::vector<double>{0},
          .touches = true,
          .measure = 1,
          .measure_unit = "m^2/s^2",
          .body_seconds = 26 * 4,
          .published = {{"RaiSim", 1e-3, 4.1e-7, 0.31},
                        {"Bullet", 1e-3, 4.4e-15, 0.91},
                        {"ODE", 1e-3, 3.145, 0},
                        {"DART", 1e-3, 3.145, 0},
                        {"MuJoCo 4", 1e-3, 5.5e-3, 0.63}}};
}

// C2: v^2/(2 mu g) in every heading, as slides_meter() puts it.
std::vector<double> slides() {
  const double way = 25.0 * 25 / (2 * 0.6 * kGravity) / std::sqrt(double{kHeadings});
  std::vector<double> out;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    out.insert(out.end(), {way * std::cos(heading), way * std::sin(heading)});
  }
  return out;
}

std::vector<CaseInfo> make_catalogue() {
  const double c5_time = 2 * 7.0 / (7 * 0.3 * kGravity);  // [s] until the ball rolls
  const double c5 = 7 * c5_time - 0.5 * 0.3 * kGravity * c5_time * c5_time + 5 * (2 - c5_time);
  const double c3 = 2 * kGravity * (0.5 - 0.3 * std::sqrt(0.75)), c6 = 2 * kGravity * 0.5 * 5 / 7;
  using V = std::vector<double>;
  return {
      {.name = "F2",
       .family = Family::Free,
       .title = "thrown with linear drag: place after 4 s",
       .unit = "m",
       .scale = 57.4,
       .exact = V{51.87988300580, 24.62262082687, 0}},
      {.name = "F5",
       .family = Family::Free,
       .title = "Kepler ellipse, e = 0.5: energy over 10 orbits",
       .unit = "of the energy",
       .scale = 1,
       .exact = V{0}},
      {.name = "F6",
       .family = Family::Free,
       .title = "tumbling (1,2,3): attitude after 10 s",
       .unit = "rad",
       .scale = 1,
       .exact = {},
       .turns = true},
      {.name = "F7",
       .family = Family::Free,
       .title = "symmetric top: attitude after 10 s",
       .unit = "rad",
       .scale = 1,
       .exact = symmetric_top(),
       .turns = true},
      {.name = "H7",
       .family = Family::Free,
       .title = "thin rod 1:190 at 29 rad/s: attitude after 10 s",
       .unit = "rad",
       .scale = 1,
       .exact = {},
       .turns = true},
      {.name = "I1",
       .family = Family::Bouncing,
       .title = "ball, e = 0.8: time until it rests",
       .unit = "s",
       .scale = 4.063712768872,
       .exact = V{4.063712768872},
       .touches = true},
      {.name = "I3",
       .family = Family::Bouncing,
       .title = "ball, e = 1: energy over 10 s",
       .unit = "of the energy",
       .scale = 1,
       .exact = V{0},
       .touches = true},
      {.name = "I4",
       .family = Family::Bouncing,
       .title = "rough bounce: sideways speed after it",
       .unit = "m/s",
       .scale = 2,
       .exact = V{2 * 5.0 / 7},
       .touches = true},
      {.name = "H12",
       .family = Family::Bouncing,
       .title = "300 m/s at loose plates of 1 mm: share that passes",
       .unit = "of the shots",
       .scale = 1,
       .exact = V{0},
       .flies_fast = true},
      {.name = "C1",
       .family = Family::Sliding,
       .title = "block slides to a stop: path",
       .unit = "m",
       .scale = 10.19,
       .exact = V{100 / (2 * 0.5 * kGravity)},
       .touches = true},
      {.name = "C2",
       .family = Family::Sliding,
       .title = "plates slide to a stop in 48 headings: places (rms)",
       .unit = "m",
       .scale = 53.09,
       .exact = slides(),
       .touches = true,
       .rubs_askew = true},
      {.name = "C3",
       .family = Family::Sliding,
       .title = "block slides down 30 degrees: path in 2 s",
       .unit = "m",
       .scale = 4.71,
       .exact = V{c3},
       .touches = true,
       .rubs_askew = true},
      {.name = "C5",
       .family = Family::Sliding,
       .title = "ball slides, then rolls: path in 2 s",
       .unit = "m",
       .scale = 10.7,
       .exact = V{c5},
       .touches = true},
      {.name = "C6",
       .family = Family::Sliding,
       .title = "ball rolls down 30 degrees: path in 2 s",
       .unit = "m",
       .scale = 7.01,
       .exact = V{c6},
       .touches = true},
      {.name = "F8",
       .family = Family::Jointed,
       .title = "heavy top on a ball joint: precession in 10 s",
       .unit = "rad",
       .scale = 2.479,
       .exact = V{2.479112965},
       .swings = true},
      {.name = "F9",
       .family = Family::Jointed,
       .title = "pendulum from 90 degrees: period",
       .unit = "s",
       .scale = 2.368,
       .exact = V{2.3678419476 * std::sqrt(1 + 1e-6)},
       .swings = true},
      {.name = "chain",
       .family = Family::Jointed,
       .title = "chain of 10 links: places after 1 s",
       .unit = "m",
       .scale = 2,
       .exact = {},
       .swings = true},
      {.name = "C18",
       .family = Family::Stacked,
       .title = "column of 10 boxes: contact forces",
       .unit = "of the force",
       .scale = 1,
       .exact = V{0},
       .touches = true},
      {.name = "H4",
       .family = Family::Stacked,
       .title = "a box on one 100 times lighter: contact forces",
       .unit = "of the force",
       .scale = 1,
       .exact = V{0},
       .touches = true},
      {.name = "pile",
       .family = Family::Stacked,
       .title = "18 boxes and balls fall on a heap",
       .unit = "m",
       .scale = 2,
       .exact = {},
       .chaotic = true},
      pulled("rolling", "a plate pulled from under 25 balls: velocities (rms)"),
      pulled("rolling60", "the same, pulled at 60 degrees: velocities (rms)"),
      {.name = "bouncing49",
       .family = Family::Published,
       .title = "49 elastic balls, 20 s: energy (rms)",
       .unit = "of the energy",
       .scale = 1,
       .exact = V{0},
       .measure = 24034.5 * 24034.5,
       .measure_unit = "J^2",
       .body_seconds = 49 * 20,
       .published = {{"RaiSim", 1e-3, 0.0186, 0.235},
                     {"RaiSim", 1e-2, 186, 0},
                     {"RaiSim", 0.1, 1.8e6, 0},
                     {"ODE", 1e-3, 185, 0},
                     {"ODE", 1e-2, 18808, 0},
                     {"ODE", 0.1, 2.0e6, 0},
                     {"Bullet", 1e-3, 75245, 0},
                     {"Bullet", 1e-2, 7.4e6, 0},
                     {"Bullet", 0.1, 7.7e8, 0}}},
      {.name = "666",
       .family = Family::Published,
       .title = "216 balls, 10 s: penetration (rms)",
       .unit = "m",
       .scale = 0.2,
       .exact = V{0},
       .measure = 1,
       .measure_unit = "m^2",
       .body_seconds = 216 * 10,
       .published = {{"RaiSim", 1e-3, 1.4e-4, 1.51},
                     {"RaiSim", 1e-2, 0.0153, 0.168},
                     {"Bullet", 1e-3, 0.38, 0},
                     {"Bullet", 1e-2, 37, 0},
                     {"MuJoCo 4", 1e-2, 2.2e-4, 0.35}}},
      {.name = "elastic666",
       .family = Family::Published,
       .title = "216 elastic balls, 10 s: energy (rms)",
       .unit = "of the energy",
       .scale = 1,
       .exact = V{0},
       .measure = 34465.0 * 34465.0,
       .measure_unit = "J^2",
       .body_seconds = 216 * 10,
       .published = {{"RaiSim", 1e-3, 8.4, 0}, {"ODE", 1e-3, 112, 0}, {"Bullet", 1e-3, 4.1e4, 0}}},
      {.name = "kapla",
       .family = Family::Published,
       .title = "a tower of 102 boards: moved within 60 s (rms)",
       .unit = "m",
       .scale = 0.1,
       .exact = V{0},
       .touches = true,
       .measure = 1,
       .measure_unit = "m^2",
       .body_seconds = 102 * kKaplaPublished,
       .published = {{"RaiSim", 1e-2, 0.01, 2885, true}},
       .rates = {60, 100}},  // a minute is simulated
  };
}

}  // namespace

const char* name_of(Family family) {
  constexpr const char* kNames[kFamilyCount] = {"free",    "bouncing", "sliding",
                                                "jointed", "stacked",  "published"};
  return kNames[static_cast<int>(family)];
}

const std::vector<CaseInfo>& catalogue() {
  static const std::vector<CaseInfo> cases = make_catalogue();
  return cases;
}

const CaseInfo* find_case(const std::string& name) {
  for (const CaseInfo& info : catalogue())
    if (info.name == name) return &info;
  return nullptr;
}

}  // namespace plumb::accuracy
