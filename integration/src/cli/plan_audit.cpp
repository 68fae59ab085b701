// plumb effects --audit [SCENE|FOLDER...]
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "accuracy/files.h"
#include "audit/audit.h"
#include "cli/commands.h"
#include "cli/output_path.h"
#include "cli/progress_bar.h"
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
    all[k].by_chance += one[k].by_chance;
    all[k].off_change = std::max(all[k].off_change, one[k].off_change);
    all[k].on_change = std::max(all[k].on_change, one[k].on_change);
  }
}

void add_rows(std::string& out, const std::string& scene, const audit::Counts& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const audit::Count& c = counts[k];
    if (c.steps == 0) continue;
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, "%u,%u,%u,%u,%u,%g,%g\n", c.steps, c.chosen, c.needless,
                  c.missed, c.by_chance, c.off_change, c.on_change);
    out += scene + "," + name_of(static_cast<PlanItem>(k)) + "," + numbers;
  }
}

double needless_share(std::uint64_t needless, std::uint64_t chosen) {
  return chosen > 0 ? kPercent * static_cast<double>(needless) / static_cast<double>(chosen) : 0.0;
}

void print(const audit::Counts& counts) {
  std::printf("%-18s %6s %7s %9s %7s %7s %10s  %9s %10s %10s\n", "Item", "steps", "chosen",
              "needless", "%", "missed", "by chance", "tolerance", "off, where", "on, where");
  std::printf("%-18s %6s %7s %9s %7s %7s %10s  %9s %10s %10s\n", "", "", "", "", "", "", "", "",
              "left out", "left out");
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const audit::Count& c = counts[k];
    if (c.steps == 0) continue;
    const PlanItem item = static_cast<PlanItem>(k);
    std::printf("%-18s %6u %7u %9u %7.2f %7u %10u  %9.1e %10.1e %10.1e\n", name_of(item), c.steps,
                c.chosen, c.needless, needless_share(c.needless, c.chosen), c.missed, c.by_chance,
                audit::tolerance_of(item), c.off_change, c.on_change);
  }
}

// Of what may be needless: savings are not.
void print_sums(const audit::Counts& counts) {
  std::uint64_t chosen = 0, needless = 0, missed = 0, by_chance = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    missed += counts[k].missed;
    by_chance += counts[k].by_chance;
    if (audit::is_saving(static_cast<PlanItem>(k))) continue;
    chosen += counts[k].chosen;
    needless += counts[k].needless;
  }
  std::printf(
      "missed %llu (and %llu by chance: roundings change as much); needless %llu of %llu, "
      "%.2f %%\n",
      static_cast<unsigned long long>(missed), static_cast<unsigned long long>(by_chance),
      static_cast<unsigned long long>(needless), static_cast<unsigned long long>(chosen),
      needless_share(needless, chosen));
}

// A folder stands for the scenes in it.
std::vector<std::string> scene_files(const std::vector<std::string>& given) {
  std::vector<std::string> files;
  for (const std::string& path : given) {
    std::error_code none;
    if (!std::filesystem::is_directory(path, none)) {
      files.push_back(path);
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    for (const auto& entry : std::filesystem::directory_iterator(path, none))
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
    std::sort(files.begin() + first, files.end());
  }
  return files;
}

}  // namespace

int audit_plans(const std::vector<std::string>& scenes, const std::string& csv) {
  if (const std::string wrong = csv.empty() ? "" : why_no_file(csv); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  const std::vector<std::string> files = scene_files(scenes);
  std::vector<std::pair<std::string, audit::Counts>> rows;
  audit::Counts all{};
  audit::Sampling sampling;
  const auto steps = static_cast<std::uint64_t>(sampling.steps);
  ProgressBar bar((files.size() + kDrawnScenes) * steps, true);
  std::uint64_t done = 0;
  sampling.progress = [&] { bar.show(++done, -1); };
  const auto take = [&](const std::string& name, PhysicsWorld& world, double dt) {
    audit::Counts counts{};
    audit::audit(world, dt, sampling, counts);
    add(counts, all);
    rows.emplace_back(name, counts);
  };
  for (const std::string& path : files) {
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
  bar.finish();
  std::printf("%zu scenes, %s. Needless: chosen, but leaving it out changes nothing.\n",
              rows.size(), kPrecisionName);
  print(all);
  print_sums(all);
  const bool none_missed =
      std::all_of(all.begin(), all.end(), [](const audit::Count& c) { return c.missed == 0; });
  if (csv.empty()) return none_missed ? kOk : kFailed;
  std::string text = "scene,item,steps,chosen,needless,missed,by_chance,off_change,on_change\n";
  for (const auto& [name, counts] : rows) add_rows(text, name, counts);
  if (const std::string wrong = accuracy::write_whole(csv, text); !wrong.empty()) {
    complain(wrong);
    return kFailed;
  }
  return none_missed ? kOk : kFailed;
}

}  // namespace plumb::cli
