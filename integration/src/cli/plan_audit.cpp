// plumb effects --audit [SCENE...]
#include <algorithm>
#include <cstdio>
#include <fstream>

#include "accuracy/files.h"
#include "audit/audit.h"
#include "cli/commands.h"
#include "cli/output_path.h"
#include "cli/status_line.h"
#include "plumb/assets/scene.h"

namespace plumb::cli {
namespace {

constexpr std::uint32_t kDrawnScenes = 36;  // each of the nine parts comes first four times
constexpr double kStep = 1.0 / 60;          // [s] of drawn scenes
constexpr double kPercent = 100;

void add(const audit::Counts& one, audit::Counts& all) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].steps += one[k].steps;
    all[k].chosen += one[k].chosen;
    all[k].needless += one[k].needless;
    all[k].missed += one[k].missed;
    all[k].off_change = std::max(all[k].off_change, one[k].off_change);
    all[k].on_change = std::max(all[k].on_change, one[k].on_change);
  }
}

void add_rows(std::string& out, const std::string& scene, const audit::Counts& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const audit::Count& c = counts[k];
    if (c.steps == 0) continue;
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, "%u,%u,%u,%u,%g,%g\n", c.steps, c.chosen, c.needless,
                  c.missed, c.off_change, c.on_change);
    out += scene + "," + name_of(static_cast<PlanItem>(k)) + "," + numbers;
  }
}

void print(const audit::Counts& counts) {
  std::printf("%-18s %6s %7s %9s %7s  %9s %10s %10s\n", "Item", "steps", "chosen", "needless",
              "missed", "tolerance", "off, where", "on, where");
  std::printf("%-18s %6s %7s %9s %7s  %9s %10s %10s\n", "", "", "", "", "", "", "left out",
              "left out");
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const audit::Count& c = counts[k];
    if (c.steps == 0) continue;
    const PlanItem item = static_cast<PlanItem>(k);
    std::printf("%-18s %6u %7u %9u %7u  %9.1e %10.1e %10.1e\n", name_of(item), c.steps, c.chosen,
                c.needless, c.missed, audit::tolerance_of(item), c.off_change, c.on_change);
  }
}

}  // namespace

int audit_plans(const std::vector<std::string>& scenes, const std::string& csv) {
  if (const std::string wrong = csv.empty() ? "" : why_no_file(csv); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  std::vector<std::pair<std::string, audit::Counts>> rows;
  audit::Counts all{};
  StatusLine status(true);
  const auto take = [&](const std::string& name, PhysicsWorld& world, double dt) {
    status.show(name);
    audit::Counts counts{};
    audit::audit(world, dt, {}, counts);
    add(counts, all);
    rows.emplace_back(name, counts);
  };
  for (const std::string& path : scenes) {
    const auto scene = assets::load_scene(path);
    if (!scene.ok()) {
      complain(scene.error());
      return kBadInput;
    }
    PhysicsWorld world;
    if (const auto made = assets::instantiate(*scene, world); !made.ok()) {
      complain(made.error());
      return kBadInput;
    }
    take(scene->name, world, scene->step.dt);
  }
  for (std::uint32_t seed = 0; seed < kDrawnScenes; ++seed) {
    PhysicsWorld world;
    audit::build_drawn_scene(world, seed);
    take("drawn " + std::to_string(seed), world, kStep);
  }
  status.show("");
  std::printf("%zu scenes, %s. Needless: chosen, but leaving it out changes nothing.\n",
              rows.size(), kPrecisionName);
  print(all);
  std::uint64_t chosen = 0, needless = 0, missed = 0;
  for (const audit::Count& count : all) {
    chosen += count.chosen;
    needless += count.needless;
    missed += count.missed;
  }
  std::printf(
      "missed %llu; needless %.2f %% of %llu\n", static_cast<unsigned long long>(missed),
      chosen > 0 ? kPercent * static_cast<double>(needless) / static_cast<double>(chosen) : 0.0,
      static_cast<unsigned long long>(chosen));
  if (csv.empty()) return missed == 0 ? kOk : kFailed;
  std::string text = "scene,item,steps,chosen,needless,missed,off_change,on_change\n";
  for (const auto& [name, counts] : rows) add_rows(text, name, counts);
  if (const std::string wrong = accuracy::write_whole(csv, text); !wrong.empty()) {
    complain(wrong);
    return kFailed;
  }
  return missed == 0 ? kOk : kFailed;
}

}  // namespace plumb::cli
