// Invariant: the plan stands whole where the recording begins, and from there on every item that
// goes on or off is one line on the timeline, at the step after which it did, with its reason; a
// plan of which only the numbers change adds none.
#include <algorithm>
#include <bit>
#include <map>

#include "recorded_run.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using replay_test::kDt;
using replay_test::TemporaryFolder;

struct Line {
  std::uint64_t frame;
  std::string text;
};

std::vector<Line> plan_lines(const std::string& path) {
  std::vector<Line> lines;
  const auto read = rrd::read(path, "log", [&](const rrd::Cell& cell) {
    if (cell.component() != "TextLog:text") return true;
    for (std::size_t i = 0; i < cell.instances(); ++i)
      if (cell.text(i).starts_with("plan: "))
        lines.push_back({cell.frame().value_or(0), std::string(cell.text(i))});
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  return lines;
}

// Records a world for so many steps; `act` is called before each. Returns, by step, the items that
// the world's own plan says went on or off, seen as often as the recorder looks.
template <class Act>
std::map<std::uint64_t, std::uint64_t> record(PhysicsWorld& world, const std::string& path,
                                              int steps, Act&& act) {
  std::map<std::uint64_t, std::uint64_t> changes;
  replay::Recorder recorder;
  EXPECT_TRUE(recorder.open({.path = path}).ok());
  world.attach(&recorder);
  std::uint64_t planned = world.planned_items();
  for (int i = 0; i < steps; ++i) {
    act(i);
    world.step(kDt);
    if (world.step_count() % replay::RecorderOptions::kPlanEvery != 0) continue;
    const std::uint64_t now = world.planned_items();
    if (now != planned) changes[world.step_count()] = now ^ planned;
    planned = now;
  }
  world.detach(&recorder);
  EXPECT_TRUE(recorder.close().ok());
  return changes;
}

TEST(PlanChanges, AreOneLineForEachItemThatGoesOnOrOff) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  PhysicsWorld world;
  add_floor(world);
  const BodyId box_id = add(world, body_at(at(0, 2, 0)), with(box(0.5, 0.3, 0.2)));
  const std::map<std::uint64_t, std::uint64_t> changes = record(world, path, 120, [&](int step) {
    if (step == 80) {
      must(world.set_angular_velocity(box_id, vec(3, 4, 5)));
    }
    if (step == 100) {
      WorldSettings settings = world.settings();
      settings.forced.set(PlanItem::Gyroscopic, Choice::Off);
      must(world.set_settings(settings));
    }
  });
  const std::vector<Line> lines = plan_lines(path);
  ASSERT_GE(lines.size(), kPlanItemCount);
  for (std::size_t k = 0; k < kPlanItemCount; ++k) {
    EXPECT_EQ(lines[k].frame, 0u);
    EXPECT_TRUE(
        lines[k].text.starts_with(std::string("plan: ") + name_of(static_cast<PlanItem>(k)) + " o"))
        << lines[k].text;
  }
  std::map<std::uint64_t, std::uint64_t> told;
  for (std::size_t i = kPlanItemCount; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < kPlanItemCount; ++k) {
      const PlanItem item = static_cast<PlanItem>(k);
      const std::string begin = std::string("plan: ") + name_of(item);
      if (!lines[i].text.starts_with(begin + " on: ") &&
          !lines[i].text.starts_with(begin + " off: "))
        continue;
      EXPECT_EQ(told[lines[i].frame] & bit_of(item), 0u) << "twice: " << lines[i].text;
      told[lines[i].frame] |= bit_of(item);
      EXPECT_GT(lines[i].text.size(), begin.size() + 8) << "no reason: " << lines[i].text;
    }
  }
  EXPECT_EQ(told, changes);
  // It tumbles from step 81 on, seen at 90, which is an event; and without the term what is lost is
  // told.
  ASSERT_TRUE(told.contains(90));
  EXPECT_NE(told[90] & bit_of(PlanItem::Gyroscopic), 0u);
  ASSERT_TRUE(told.contains(110));
  const auto off = std::find_if(lines.begin(), lines.end(), [](const Line& line) {
    return line.frame == 110 && line.text.starts_with("plan: gyroscopic off: forced off");
  });
  ASSERT_NE(off, lines.end());
}

TEST(PlanChanges, NumbersThatChangeAreNone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  PhysicsWorld world;
  const auto changes = record(world, path, 40, [&](int step) {
    // One more body in weightless flight at every step: "k of k dynamic bodies have weight".
    add(world, body_at(at(0, 100 + 3 * step, 0)), with(sphere(0.5)));
  });
  const std::vector<Line> lines = plan_lines(path);
  std::size_t told = 0;
  for (const auto& [step, items] : changes) told += static_cast<std::size_t>(std::popcount(items));
  EXPECT_EQ(lines.size(), kPlanItemCount + told);
  EXPECT_LE(changes.size(), 2u);  // the first of them come in the first steps
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
