#include "bench/peers/run.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/anchors/solids.h"

namespace plumb::peers {
namespace {

using accuracy::BodyReadings;
using accuracy::Setup;
using accuracy::SetupBody;
using anchors::Engine;
using anchors::EngineKind;
using anchors::Scene;
using Eigen::Vector3d;

// The density at which the shape has the case's mass: some engines take only that.
anchors::Body body_of(const SetupBody& from) {
  anchors::Body body;
  if (from.shape == SetupBody::Shape::Box) body = anchors::box(from.half, Vector3d::Zero(), 1);
  if (from.shape == SetupBody::Shape::Sphere)
    body = anchors::sphere(from.radius, Vector3d::Zero(), 1);
  if (from.shape != SetupBody::Shape::None) body.density = from.mass / body.mass;
  body.mass = from.mass;
  body.inertia = from.moments;
  body.position = from.position;
  body.orientation = from.orientation;
  body.velocity = from.velocity;
  body.spin = from.spin;
  body.force = from.force;
  return body;
}

BodyReadings readings_of(const Engine& engine, std::size_t count) {
  std::vector<anchors::BodyState> states(count);
  engine.read(states);
  BodyReadings out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back({states[i].position, states[i].orientation, states[i].velocity, states[i].spin});
  return out;
}

double processor_time() {  // [s]
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double cost_of_run(const EngineKind& kind, const Scene& scene, double seconds, double dt,
                   double window) {
  const std::unique_ptr<Engine> engine = kind.make(scene, {});
  const long steps = std::lround(seconds / dt);
  const double begin = processor_time();
  long done = 0;
  double spent = 0;
  while (done < steps && spent < window) {
    const long end = std::min(steps, done + std::max(1L, steps / 64));
    for (; done < end; ++done) engine->step(dt);
    spent = processor_time() - begin;
  }
  return spent / (static_cast<double>(done) * dt * static_cast<double>(scene.bodies.size()));
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

Scene scene_of(const Setup& setup) {
  Scene scene{.name = setup.name};
  scene.gravity = setup.gravity;
  scene.friction = setup.friction;
  scene.friction_among = setup.friction_among;
  scene.restitution = setup.restitution;
  if (setup.floor) scene.ground = {anchors::fixed_plane(setup.normal)};
  for (const SetupBody& body : setup.bodies) scene.bodies.push_back(body_of(body));
  const auto local = [&](int i, const Vector3d& at) -> Vector3d {
    if (i < 0) return at;
    const SetupBody& body = setup.bodies[static_cast<std::size_t>(i)];
    return body.orientation.conjugate() * (at - body.position);
  };
  for (const accuracy::SetupJoint& joint : setup.joints)
    scene.joints.push_back({.a = joint.a,
                            .b = joint.b,
                            .at_a = local(joint.a, joint.at),
                            .at_b = local(joint.b, joint.at)});
  return scene;
}

Outcome run(const EngineKind& kind, const Setup& setup, double dt) {
  Outcome out;
  const std::unique_ptr<Engine> engine = kind.make(scene_of(setup), {});
  if (engine == nullptr) return out;
  out.built = true;
  const std::size_t count = setup.bodies.size();
  const accuracy::MeterPtr meter = setup.meter();
  meter->begin(readings_of(*engine, count));
  const long steps = std::lround(setup.seconds / dt);
  for (long i = 0; i < steps; ++i) {
    engine->step(dt);
    meter->after_step(static_cast<double>(i + 1) * dt, readings_of(*engine, count));
  }
  out.readings = meter->readings(readings_of(*engine, count));
  out.finite = std::all_of(out.readings.begin(), out.readings.end(),
                           [](double v) { return std::isfinite(v); });
  return out;
}

double cost(const EngineKind& kind, const Setup& setup, double dt, double window) {
  constexpr int kRuns = 3;
  const Scene scene = scene_of(accuracy::repeated(setup, setup.copies));
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRuns; ++i)
    least = std::min(least, cost_of_run(kind, scene, setup.seconds, dt, window));
  return least;
}

std::string header_row() {
  return "case,engine,settings,dt_s,us_per_body_second,finite,readings\n";
}

std::string row_of(const std::string& name, const EngineKind& kind, double dt,
                   const Outcome& outcome, double seconds) {
  std::string out = name + ',' + kind.name + ",\"" + kind.settings + "\"," + number(dt) + ',' +
                    number(1e6 * seconds) + ',' + (outcome.finite ? "1," : "0,");
  for (std::size_t i = 0; i < outcome.readings.size(); ++i)
    out += (i == 0 ? "" : " ") + number(outcome.readings[i]);
  return out + '\n';
}

}  // namespace plumb::peers
