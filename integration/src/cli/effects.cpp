// plumb effects: what each effect costs a body and step on this machine.
//
// A thousand bodies that fly freely are stepped with one effect on each, and without: the
// difference, by bodies, is the price. The best of several runs counts; the rest is what else the
// machine was doing.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "cli/commands.h"
#include "cli/output_path.h"
#include "plumb/world.h"

namespace plumb::cli {
namespace {

constexpr int kBodies = 1000;
constexpr int kSteps = 20;
constexpr int kRuns = 7;
constexpr int kBar = 40;  // [characters] of the dearest

struct Price {
  const char* name;
  EffectKind kind;
  double nanoseconds = 0;  // a body and step
};

FieldForce no_force(const FieldSample&, void*) { return {}; }

std::vector<Price> all_effects() {
  PointGravity star;
  star.mu = Real(1);
  star.softening = Real(1);
  Attractor pull;
  pull.strength = Real(0.1);
  Drag linear, quadratic, turning;
  linear.linear = Real(0.1);
  quadratic.quadratic = Real(0.1);
  turning.angular_linear = Real(0.1);
  Magnus magnus;
  magnus.coefficient = Real(0.01);
  Wind wind;
  wind.velocity = Vec3(1, 0, 0);
  AeroSurface wing;
  wing.tensor = -Mat3::Identity();
  wing.point = Vec3(0, Real(0.5), 0);
  Buoyancy water;
  water.level = Real(1e4);
  Spring spring;
  spring.rest_length = Real(1e3);
  Thrust thrust;
  thrust.force = Vec3(0, 1, 0);
  Explosion blast;
  blast.updraft = Real(1);
  blast.updraft_duration = Real(1e6);
  blast.chimney_radius = blast.chimney_height = Real(1e6);
  return {{"point gravity", star},
          {"force field (empty)", ForceField{}},
          {"thrust", thrust},
          {"explosion (updraft)", blast},
          {"drag linear", linear},
          {"drag quadratic", quadratic},
          {"drag angular", turning},
          {"magnus", magnus},
          {"attractor", pull},
          {"wind on a box", wind},
          {"aero surface", wing},
          {"buoyancy of a box", water},
          {"spring to the world", spring}};
}

// Seconds a step; null: without effects.
double step_time(const EffectKind* kind) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    WorldSettings settings;
    settings.sleeping = false;
    PhysicsWorld world(settings);
    (void)world.set_force_field(0, no_force);
    for (int i = 0; i < kBodies; ++i) {
      RigidBody body;
      body.pose.position = Pos3(PosReal(5 * (i % 32)), PosReal(5 * (i / 32)), 0);
      body.linear_velocity = Vec3(1, Real(0.5), 0);
      body.angular_velocity = Vec3(1, 2, 3);
      const BodyId id = world.create_body(body).id;
      Collider collider;
      collider.shape = Box{Vec3(Real(0.5), Real(0.4), Real(0.3))};
      (void)world.create_collider(id, collider);
      if (kind != nullptr) (void)world.create_effect({id, *kind, 0});
    }
    for (int i = 0; i < 3; ++i) world.step(1.0 / 60);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kSteps; ++i) world.step(1.0 / 60);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count() / kSteps);
  }
  return best;
}

}  // namespace

int print_effect_prices(const std::string& csv) {
  if (const std::string wrong = csv.empty() ? "" : why_no_file(csv); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  std::vector<Price> prices = all_effects();
  const double bare = step_time(nullptr);
  double dearest = 0;
  for (Price& price : prices) {
    price.nanoseconds = std::max(0.0, step_time(&price.kind) - bare) / kBodies * 1e9;
    dearest = std::max(dearest, price.nanoseconds);
  }
  std::printf(
      "Nanoseconds a body and step of %d substeps, %s, one thread; a free body alone: %.0f\n",
      WorldSettings{}.substeps, kPrecisionName, bare / kBodies * 1e9);
  for (const Price& price : prices) {
    const int length = dearest > 0 ? static_cast<int>(kBar * price.nanoseconds / dearest + 0.5) : 0;
    std::printf("%-20s %8.0f  ", price.name, price.nanoseconds);
    for (int i = 0; i < length; ++i) std::fputc('#', stdout);
    std::fputc('\n', stdout);
  }
  if (csv.empty()) return kOk;
  std::ofstream file(csv);
  file << "effect,nanoseconds_per_body_and_step\nnone," << bare / kBodies * 1e9 << "\n";
  for (const Price& price : prices) file << price.name << "," << price.nanoseconds << "\n";
  file.flush();
  if (!file) {
    complain("cannot write " + csv + "; is the disk full?");
    return kFailed;
  }
  return kOk;
}

}  // namespace plumb::cli
