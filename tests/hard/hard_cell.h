// One cell of the hard cases: a scene at one value of its knob, one solver, one step, judged by the
// common rule of the reference cases (section 6): all finite, no energy out of nothing, overlap at
// most 5 % of the smallest thickness and 1 % after the first second, and what the scene itself
// asks.
//
// Every figure is a ratio to its bound: at most 1 passes. What is known to fail stands in
// frontiers.h with the ratio that was measured; it must not get worse.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <string>

#include "frontiers.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace hard {

using namespace scenes;
using Eigen::Vector3d;

inline constexpr double kFell = 1e6;  // worse than any ratio that means something

struct Cell {
  ContactSolver solver;
  double dt;  // [s]
};
inline const char* word(ContactSolver solver) {
  return solver == ContactSolver::SoftStep ? "soft"
         : solver == ContactSolver::Newton ? "newton"
                                           : "auto";
}
inline std::string name_of(const std::string& scene, const Cell& cell) {
  return scene + " " + word(cell.solver) + " 1/" + std::to_string(std::lround(1 / cell.dt));
}
inline WorldSettings settings_of(const Cell& cell) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = cell.solver;
  return settings;
}

struct Rules {
  double thickness = 1;     // [m] smallest
  double energy_scale = 0;  // [J] 1 % of it may appear; 0: of what the scene could fall by
  bool overlaps_at_first = false;
  std::vector<BodyId> stands;  // bodies that may move by `way`
  double way = 0.5;            // [m]
};

// Runs a world and returns the worst ratio.
inline double judge(PhysicsWorld& world, const Cell& cell, double seconds, const Rules& rules,
                    const std::function<double()>& own = {}) {
  std::vector<Vector3d> start;
  for (const BodyId body : rules.stands) start.push_back(position(world, body));
  const EnergyReport first = world.energy();
  const double scale = std::max(rules.energy_scale, first.kinetic_linear + first.kinetic_angular);
  double worst = 0, lowest = first.total();
  run(world, seconds, cell.dt, [&] {
    if (worst >= kFell) return;
    if (!all_finite(world) || world.last_report().quarantined > 0) {
      worst = kFell;
      return;
    }
    const double energy = world.energy().total();
    if (scale > 0)
      worst = std::max(worst, (energy - std::max(lowest, first.total())) / (0.01 * scale));
    lowest = std::min(lowest, energy);
    const bool settled = world.time() > 1;
    if (!rules.overlaps_at_first || settled) {
      const double allowed = (settled ? 0.01 : 0.05) * rules.thickness;
      worst = std::max(worst, deepest(world) / allowed);
    }
    if (own) worst = std::max(worst, own());
  });
  for (std::size_t i = 0; i < start.size() && worst < kFell; ++i)
    worst = std::max(worst, (position(world, rules.stands[i]) - start[i]).norm() / rules.way);
  return std::min(worst, kFell);
}

inline void expect_at_frontier(const std::string& scene, const Cell& cell, double worst) {
  const std::string name = name_of(scene, cell);
  const double known = known_frontier(name, kDouble);
  // What falls, falls chaotically: from 10 on only that it does is known.
  const double allowed = known <= 1 ? 1 : known >= 10 ? kFell : 1.5 * known;
  if (worst > 1)
    std::printf("[ FRONTIER ] {\"%s\", %d, %.3g},\n", name.c_str(), kDouble ? 64 : 32, worst);
  EXPECT_LE(worst, allowed) << name;
}

template <class Judge>
void for_cells(const std::string& scene, const Judge& judge_cell) {
  for (const ContactSolver solver : {ContactSolver::SoftStep, ContactSolver::Newton})
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
      const Cell cell{solver, dt};
      expect_at_frontier(scene, cell, judge_cell(cell));
    }
}

}  // namespace hard
}  // namespace plumb::inline PLUMB_ABI
