// What a run was like, gathered step by step and printed at its end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/recording_file.h"
#include "plumb/assets/scene.h"
#include "plumb/world.h"

namespace plumb::cli {

struct RunSummary {
  std::uint64_t steps = 0;
  double step_seconds = 0;  // [s] wall time in step(), the recorder's share included
  std::uint64_t body_steps = 0;
  std::uint64_t contact_points = 0;  // at the end
  std::uint64_t most_contact_points = 0;
  double largest_penetration = 0;  // [m]
  // Bodies whose state became non-finite.
  struct Lost {
    std::uint64_t step = 0;
    BodyId body;
  };
  std::vector<Lost> lost;
  double first_energy = 0;         // [J]
  double last_energy = 0;          // [J]
  double lowest_energy = 0;        // [J] so far
  double energy_gained = 0;        // [J] the most that it ever stood above an earlier value
  double largest_kinetic = 0;      // [J]
  std::uint64_t planned = 0;       // items of the plan at the end
  std::uint64_t plan_changes = 0;  // of items that went on or off

  void begin(const PhysicsWorld& world);
  void add(const PhysicsWorld& world, const StepReport& report);
  // A line for each of the first bodies that were taken out of the run, and one for the others.
  [[nodiscard]] std::vector<std::string> lost_bodies(const assets::SceneInstance& instance,
                                                     const PhysicsWorld& world) const;
  void print(const assets::Scene& scene, const assets::SceneInstance& instance,
             const PhysicsWorld& world, const RecordingFile& recording,
             const std::string& output) const;
};

}  // namespace plumb::cli
