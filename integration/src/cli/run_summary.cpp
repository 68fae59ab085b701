#include "cli/run_summary.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <utility>

namespace plumb::cli {
namespace {

constexpr double kMillimetres = 1e3;   // per metre
constexpr double kMilliseconds = 1e3;  // per second
constexpr double kMicroseconds = 1e6;
constexpr double kShownDecimals = 1e-3;
constexpr double kMegabyte = 1e6;  // [bytes]

constexpr std::size_t kNamedBodies = 10;  // of those lost; more help nobody

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

// Three decimals, or three digits where nothing would be left of it.
std::string readable(double x) {
  char text[64];
  std::snprintf(text, sizeof text, x != 0 && std::abs(x) < kShownDecimals ? "%.3g" : "%.3f", x);
  return text;
}

// What moves by itself, and how much of that sleeps; what was lost lies still but does not sleep.
struct Sleepers {
  std::size_t dynamic = 0, asleep = 0;
};

Sleepers sleepers_of(const PhysicsWorld& world, const std::vector<RunSummary::Lost>& lost) {
  std::vector<BodyState> states;
  world.copy_body_states(states);
  Sleepers out;
  for (const BodyState& state : states) {
    if (state.type != MotionType::Dynamic) continue;
    ++out.dynamic;
    if (!state.awake) ++out.asleep;
  }
  for (const RunSummary::Lost& gone : lost) {
    const BodyState state = world.state(gone.body);
    if (state.type == MotionType::Dynamic && !state.awake) --out.asleep;
  }
  return out;
}

}  // namespace

void RunSummary::begin(const PhysicsWorld& world) {
  const EnergyReport energy = world.energy();
  first_energy = last_energy = lowest_energy = energy.total();
  largest_kinetic = energy.kinetic_linear + energy.kinetic_angular;
  planned = world.planned_items();
}

void RunSummary::add(const PhysicsWorld& world, const StepReport& report) {
  ++steps;
  body_steps += report.bodies;
  contact_points = report.contact_points;
  most_contact_points = std::max<std::uint64_t>(most_contact_points, report.contact_points);
  largest_penetration = std::max(largest_penetration, report.largest_penetration);
  for (const QuarantineEvent& event : world.events().quarantined)
    lost.push_back({report.step, event.body});
  const EnergyReport energy = world.energy();
  last_energy = energy.total();
  lowest_energy = std::min(lowest_energy, last_energy);
  energy_gained = std::max(energy_gained, last_energy - lowest_energy);
  largest_kinetic = std::max(largest_kinetic, energy.kinetic_linear + energy.kinetic_angular);
  const std::uint64_t before = std::exchange(planned, world.planned_items());
  plan_changes += static_cast<std::uint64_t>(std::popcount(planned ^ before));
}

std::vector<std::string> RunSummary::lost_bodies(const assets::SceneInstance& instance,
                                                 const PhysicsWorld& world) const {
  const std::size_t named = std::min(lost.size(), kNamedBodies);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < named; ++k) {
    // A body of a scene carries its place in the instance.
    const std::string& name = instance.bodies[world.state(lost[k].body).user_data].name;
    lines.push_back("step " + std::to_string(lost[k].step) + ": body '" + name +
                    "' became non-finite and was taken out of the run");
  }
  if (lost.size() > named) {
    lines.push_back("and " + std::to_string(lost.size() - named) +
                    " more bodies became non-finite");
  }
  return lines;
}

void RunSummary::print(const assets::Scene& scene, const assets::SceneInstance& instance,
                       const PhysicsWorld& world, const RecordingFile& recording,
                       const std::string& output) const {
  const double simulated = static_cast<double>(steps) * scene.step.dt;
  const double stepping = std::max(0.0, step_seconds - recording.seconds());
  std::printf("Scene        %s: %zu bodies, %zu meshes\n", scene.name.c_str(),
              instance.bodies.size(), instance.meshes.size());
  std::printf("Simulated    %s s in %" PRIu64 " steps of %s ms, %d substeps each\n",
              readable(simulated).c_str(), steps, readable(kMilliseconds * scene.step.dt).c_str(),
              scene.settings.substeps);
  std::printf("Speed        %.1f x real time: %.3f ms a step, %.3f us a body and step\n",
              ratio(simulated, stepping),
              kMilliseconds * ratio(stepping, static_cast<double>(steps)),
              kMicroseconds * ratio(stepping, static_cast<double>(body_steps)));
  const Sleepers sleepers = sleepers_of(world, lost);
  std::printf("Contacts     %" PRIu64 " points at the end, at most %" PRIu64
              ", not counting what sleeps; deepest overlap %.3f mm\n",
              contact_points, most_contact_points, kMillimetres * largest_penetration);
  std::printf("Asleep       %zu of %zu dynamic bodies at the end\n", sleepers.asleep,
              sleepers.dynamic);
  std::printf(
      "Energy       %.6g J at the start, %.6g J at the end; upward drift at most"
      " %.3g J (%.3g %% of the largest kinetic energy)\n",
      first_energy, last_energy, energy_gained, 100 * ratio(energy_gained, largest_kinetic));
  std::printf("Plan         %d of %zu items at the end; %" PRIu64 " times one went on or off\n",
              std::popcount(planned), kPlanItemCount, plan_changes);
  std::printf("State hash   %016" PRIx64 "\n", world.state_hash());
  if (!recording.is_open() || recording.bytes() == 0) return;
  std::printf(
      "Recording    %s: %.2f MB, %.1f bytes a body and frame; cost %.3f us a body and frame\n",
      output.c_str(), static_cast<double>(recording.bytes()) / kMegabyte,
      ratio(static_cast<double>(recording.bytes()), static_cast<double>(recording.body_steps())),
      kMicroseconds * recording.seconds_per_body_step());
}

}  // namespace plumb::cli
