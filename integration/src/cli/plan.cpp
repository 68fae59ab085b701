// plumb plan SCENE
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "cli/commands.h"
#include "cli/forcing.h"
#include "cli/status_line.h"
#include "plumb/assets/scene.h"
#include "plumb/world.h"

namespace plumb::cli {

namespace {

void print(const StepPlan& plan) {
  std::size_t width = std::strlen("Item");
  for (const PlanDecision& decision : plan.decisions) {
    width = std::max(width, std::strlen(name_of(decision.item)));
  }
  const int column = static_cast<int>(width);
  std::printf("%-*s  Runs  Reason\n", column, "Item");
  for (const PlanDecision& decision : plan.decisions) {
    std::printf("%-*s  %-4s  %s\n", column, name_of(decision.item), decision.active ? "yes" : "no",
                decision.reason.c_str());
    if (!decision.loss.empty()) {
      std::printf("%-*s        lost: %s\n", column, "", decision.loss.c_str());
    }
  }
}

}  // namespace

int print_plan(const std::string& path, const ForcedNames& forced) {
  auto scene = assets::load_scene(path);
  if (!scene.ok()) {
    complain(scene.error());
    return kBadInput;
  }
  if (const std::string wrong = force(forced, scene.value().settings); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  PhysicsWorld world;
  const auto instance = [&] {
    StatusLine status(true);
    const auto show = [&](const std::string& work) { status.show(work); };
    return assets::instantiate(*scene, world, {.guarded = true, .on_work = show});
  }();
  if (!instance.ok()) {
    complain(instance.error());
    return kBadInput;
  }
  print(world.plan());
  return kOk;
}

}  // namespace plumb::cli
