// Uses one thing of every installed component, so that each must be found and link.
#include <plumb/world.h>

#include <cstdio>
#include <vector>

#ifdef CONSUMER_HAS_ASSETS
#include <plumb/assets/hull.h>
#endif
#ifdef CONSUMER_HAS_REPLAY
#include <plumb/replay/recorder.h>
#endif
#ifdef CONSUMER_HAS_INTEGRATION
#include <plumb/integration/fixed_step_loop.h>
#endif

namespace {

int failures = 0;

void expect(bool condition, const char* what) {
  std::printf("%s: %s\n", what, condition ? "ok" : "FAILED");
  if (!condition) ++failures;
}

}  // namespace

int main() {
  plumb::PhysicsWorld world;

#ifdef CONSUMER_HAS_ASSETS
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto hull = plumb::assets::convex_hull(corners);
  expect(hull.ok() && hull->faces.size() == 4, "assets: the hull of four points has four faces");
#endif

#ifdef CONSUMER_HAS_REPLAY
  plumb::replay::Recorder recorder;
  expect(recorder.open({.path = "consumer.rrd"}).ok(), "replay: a recording opens");
  world.attach(&recorder);
#endif

#ifdef CONSUMER_HAS_INTEGRATION
  plumb::integration::FixedStepLoop loop(world, {.dt = 0.25});
  expect(loop.tick(0.5).steps == 2, "integration: half a second is two steps of a quarter");
#else
  world.step(0.25);
  world.step(0.25);
#endif
  expect(world.step_count() == 2, "physics: the world did two steps");

#ifdef CONSUMER_HAS_REPLAY
  world.detach(&recorder);
  expect(recorder.close().ok(), "replay: the recording closes");
#endif
  return failures == 0 ? 0 : 1;
}
