// The ten anchor scenes, the elastic grid of balls [Kang 2018] and ten thousand sleepers.
//
// Friction 0.6, restitution 0, density 1000 kg/m^3 and 60 Hz unless said. Random numbers are drawn
// in the order written; each scene starts with its own number as the seed.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/anchors/random.h"
#include "bench/anchors/solids.h"

namespace plumb::anchors {

inline const Vector3d kCube = Vector3d::Constant(0.5);  // [m] half extents of the unit box

// A static box with its top at y = 0.
inline Body floor_of(double half) { return fixed_box({half, 1, half}, {0, -1, 0}); }

// S1: rows of 40, 39, ... 1 boxes.
inline Scene pyramid(int rows = 40) {
  Scene s{.name = "S1", .title = "pyramid", .steps = 300};
  s.ground = {floor_of(100)};
  for (int i = 0; i < rows; ++i)
    for (int n = rows - i, j = 0; j < n; ++j)
      s.bodies.push_back(box(kCube, {(j - (n - 1) / 2.0) * 1.05, 0.5 + i, 0}));
  s.top = static_cast<int>(s.bodies.size()) - 1;
  return s;
}

// S2: boxes, balls and capsules fall into a pit.
inline Scene pile(int side = 16) {
  Scene s{.name = "S2", .title = "pile", .steps = 600, .warm_up = 60};
  s.ground = {floor_of(100)};
  for (const double sign : {-1.0, 1.0}) {
    s.ground.push_back(fixed_box({1, 20, 14}, {13 * sign, 20, 0}));
    s.ground.push_back(fixed_box({14, 20, 1}, {0, 20, 13 * sign}));
  }
  s.lower = {-12.5, -1, -12.5};
  s.upper = {12.5, 60, 12.5};
  Random random(2);
  int c = 0;
  const double middle = (side - 1) / 2.0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < side; ++k, ++c) {
        const double x = (i - middle) * 1.5 + random.range(-.05, .05);
        const double z = (k - middle) * 1.5 + random.range(-.05, .05);
        const Vector3d p(x, 1 + 1.5 * j + random.range(-.05, .05), z);
        const double a = random.range(0, 1), b = random.range(0, 1), d = random.range(0, 1);
        Body body = c % 3 == 0   ? box({.35 + .15 * a, .35 + .15 * b, .35 + .15 * d}, p)
                    : c % 3 == 1 ? sphere(.4 + .15 * a, p)
                                 : capsule(.25 + .1 * a, .25 + .1 * b, p);
        body.orientation = random.turn(0.3);
        s.bodies.push_back(body);
      }
  return s;
}

// S3: a heap of hulls of 16 points.
inline Scene hulls(int side = 10) {
  Scene s{.name = "S3", .title = "hulls", .steps = 300};
  s.ground = {floor_of(100)};
  Random random(3);
  std::vector<Body> kinds;
  for (int h = 0; h < 32; ++h) {
    const double sx = random.range(.8, 1.1), sy = random.range(.6, .9), sz = random.range(.7, 1);
    std::vector<Vector3d> points;
    for (int i = 0; i < 16; ++i) {
      const double angle = 2.399963229728653 * i + random.range(-.25, .25);
      const double y = 1 - 2 * (i + .5) / 16 + random.range(-.03, .03);
      const double r = std::sqrt(1 - y * y);
      points.push_back(0.6 * Vector3d(sx * r * std::cos(angle), sy * y, sz * r * std::sin(angle)));
    }
    s.hulls.push_back(hull_of(points));
    kinds.push_back(centre(s.hulls.back()));
    kinds.back().shape.hull = static_cast<std::size_t>(h);
  }
  const double middle = (side - 1) / 2.0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < side; ++k) {
        Body body = kinds[s.bodies.size() % kinds.size()];
        const double x = (i - middle) * 1.5 + random.range(-.1, .1);
        const double z = (k - middle) * 1.5 + random.range(-.1, .1);
        body.position = {x, 1 + 1.5 * j, z};
        body.orientation = random.turn(std::numbers::pi);
        s.bodies.push_back(body);
      }
  return s;
}

// S4: bodies that tumble past each other.
inline Scene free_bodies(int count = 100000) {
  Scene s{.name = "S4", .title = "free", .gravity = Vector3d::Zero(), .steps = 100, .warm_up = 10};
  s.collide = false;
  s.lower = {-200, -200, -200};
  Random random(4);
  for (int c = 0; c < count; ++c) {
    Body body =
        box({.2, .4, .6}, {3.0 * (c % 45 - 22), 3.0 * (c / 2025), 3.0 * (c / 45 % 45 - 22)});
    for (int k = 0; k < 3; ++k) body.spin[k] = random.range(-5, 5);
    for (int k = 0; k < 3; ++k) body.velocity[k] = random.range(-.1, .1);
    body.orientation = random.turn(std::numbers::pi);
    s.bodies.push_back(body);
  }
  return s;
}

// S5: boxes that lie on the ground, each by itself.
inline Scene spread(int count = 20000) {
  Scene s{.name = "S5", .title = "spread", .steps = 300};
  s.ground = {floor_of(200)};
  for (int c = 0; c < count; ++c)
    s.bodies.push_back(box(kCube, {(c % 142 - 70.5) * 2, 0.5, (c / 142 - 70.5) * 2}));
  return s;
}

// S6: a slanting chain with a thousand times heavier end, let go. The links' +y ends look up.
inline Scene chain(int links = 100) {
  Scene s{.name = "S6", .title = "chain", .steps = 600, .warm_up = 60};
  s.collide = false;
  s.watches_energy = true;
  s.lower = {-200, -200, -200};
  const double half = 0.25, radius = 1.684;
  const Vector3d start(0, 60, 0), along = Vector3d(1, -1, 0).normalized();
  const Quaterniond turned(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitZ()));
  for (int i = 0; i < links; ++i) {
    s.bodies.push_back(box({.1, half, .1}, start + (2 * i + 1) * half * along));
    s.joints.push_back(
        {.a = i - 1, .b = i, .at_a = i == 0 ? start : Vector3d(0, -half, 0), .at_b = {0, half, 0}});
  }
  s.bodies.push_back(sphere(radius, start + (2 * links * half + radius) * along));
  s.joints.push_back({.a = links - 1, .b = links, .at_a = {0, -half, 0}, .at_b = {0, radius, 0}});
  for (Body& body : s.bodies) body.orientation = turned;
  return s;
}

// S7: each box four times heavier than the one below.
inline Scene mass_ratio() {
  Scene s{.name = "S7", .title = "mass ratio", .steps = 600, .warm_up = 60};
  s.ground = {floor_of(100)};
  for (int i = 0; i < 10; ++i)
    s.bodies.push_back(box(kCube, {0, 0.5 + i, 0}, 1000 * std::pow(4.0, i)));
  s.top = 9;
  return s;
}

// S8: a column of equal boxes.
inline Scene tall_stack(int count = 50) {
  Scene s{.name = "S8", .title = "tall stack", .steps = 600, .warm_up = 60};
  s.ground = {floor_of(100)};
  for (int i = 0; i < count; ++i) s.bodies.push_back(box(kCube, {0, 0.5 + i, 0}));
  s.top = count - 1;
  return s;
}

// S9: a body spun about its middle axis turns over again and again, 12 times in a minute.
inline Scene dzhanibekov() {
  Scene s{.name = "S9",
          .title = "Dzhanibekov",
          .gravity = Vector3d::Zero(),
          .steps = 3600,
          .warm_up = 60};
  s.collide = false;
  s.counts_flips = s.watches_energy = true;
  Body body;
  body.mass = 1;
  body.inertia = {1, 2, 3};
  body.spin = {.01, 5, .01};
  s.bodies = {body};
  return s;
}

// S10: boxes fall onto hills of triangles.
inline Scene on_mesh(int count = 1000) {
  Scene s{.name = "S10", .title = "mesh", .steps = 300};
  s.lower = {-100, -4, -100};
  s.upper = {100, 100, 100};
  constexpr int kSide = 201;
  for (int k = 0; k < kSide; ++k)
    for (int i = 0; i < kSide; ++i) {
      const double x = i - 100, z = k - 100;
      const double h = 1.5 * std::sin(.25 * x) * std::cos(.2 * z) + .3 * std::sin(1.1 * x + .7 * z);
      s.mesh.vertices.emplace_back(x, h, z);
    }
  for (std::uint32_t k = 0; k + 1 < kSide; ++k)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = k * kSide + i, b = a + 1, c = a + kSide, d = c + 1;
      s.mesh.triangles.push_back({a, c, b});
      s.mesh.triangles.push_back({b, c, d});
    }
  Body ground;
  ground.shape.kind = ShapeKind::Mesh;
  s.ground = {ground};
  Random random(10);
  for (int c = 0; c < count; ++c) {
    s.bodies.push_back(box(kCube, {(c % 32 - 15.5) * 3, 4, (c / 32 - 15.5) * 3}));
    s.bodies.back().orientation = random.turn(std::numbers::pi);
  }
  return s;
}

// 216 balls that bounce for ten seconds and lose nothing.
inline Scene elastic_grid() {
  Scene s{.name = "E666", .title = "elastic balls", .steps = 600, .warm_up = 60};
  s.friction = 0;
  s.restitution = 1;
  s.watches_energy = true;
  s.ground = {floor_of(100)};
  Random random(666);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k) {
        const double x = 0.21 * i + random.range(0, 1e-3), z = 0.21 * k + random.range(0, 1e-3);
        const double y = 1.101 + 0.21 * j + random.range(0, 1e-3);
        const double unit = sphere(0.1, {}, 1).mass;
        s.bodies.push_back(sphere(0.1, {x, y, z}, 10 / unit));
      }
  return s;
}

// 10,000 boxes that have gone to sleep when the timing begins.
inline Scene sleepers(int count = 10000) {
  Scene s = spread(count);
  s.name = "Z7";
  s.title = "sleepers";
  s.sleeping = true;
  s.warm_up = 200;
  return s;
}

struct SceneEntry {
  const char* name;
  std::function<Scene()> make;
};
inline const std::vector<SceneEntry>& catalogue() {
  static const std::vector<SceneEntry> all = {
      {"S1", [] { return pyramid(); }},
      {"S2", [] { return pile(); }},
      {"S3", [] { return hulls(); }},
      {"S4", [] { return free_bodies(); }},
      {"S5", [] { return spread(); }},
      {"S6", [] { return chain(); }},
      {"S7", mass_ratio},
      {"S8", [] { return tall_stack(); }},
      {"S9", dzhanibekov},
      {"S10", [] { return on_mesh(); }},
      {"E666", elastic_grid},
      {"Z7", [] { return sleepers(); }},
  };
  return all;
}

}  // namespace plumb::anchors
