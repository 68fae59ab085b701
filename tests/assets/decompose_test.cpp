// Invariant: the convex parts of a solid are together the solid, up to the distance asked for and
// told: no hollow wider than twice of it is filled, nothing of the solid is lost, the same mesh
// gives the same bits, and what has no inside is refused.
#include "plumb/assets/decompose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <random>

#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets;

constexpr double kExact = 1e-9;  // relative: a handful of roundings, with room

// The surface of cubes of side 1, vertices shared.
TriangleMesh cubes_mesh(const std::vector<std::array<int, 3>>& cells) {
  TriangleMesh mesh;
  mesh.name = "cubes";
  std::map<std::array<int, 3>, std::uint32_t> number_of;
  const auto is_full = [&](const std::array<int, 3>& cell) {
    return std::find(cells.begin(), cells.end(), cell) != cells.end();
  };
  const auto corner = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] =
        number_of.try_emplace(p, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.emplace_back(p[0], p[1], p[2]);
    return found->second;
  };
  for (const std::array<int, 3>& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> next = cell;
        next[axis] += 2 * side - 1;
        if (is_full(next)) continue;
        std::array<std::uint32_t, 4> quad;
        for (std::size_t k = 0; k < 4; ++k) {  // counter-clockwise about the axis
          std::array<int, 3> p = cell;
          p[axis] += side;
          p[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
          p[(axis + 2) % 3] += k >= 2 ? 1 : 0;
          quad[k] = corner(p);
        }
        if (side == 0) std::swap(quad[1], quad[3]);
        mesh.triangles.push_back({quad[0], quad[1], quad[2]});
        mesh.triangles.push_back({quad[0], quad[2], quad[3]});
      }
    }
  }
  return mesh;
}

Decomposition parts_of(const TriangleMesh& mesh, const DecomposeOptions& options = {}) {
  const Result<Decomposition> result = decompose(mesh, options);
  EXPECT_TRUE(result.ok()) << result.error();
  return result.ok() ? *result : Decomposition{};
}

// The parts fill the solid and nothing else.
void expect_exact(const TriangleMesh& mesh, std::size_t most_parts) {
  const Decomposition made = parts_of(mesh);
  const DecompositionReport& report = made.report;
  EXPECT_LE(report.parts, most_parts) << report.text();
  EXPECT_EQ(report.parts, made.parts.size());
  const double volume = certify(mesh).signed_volume;
  EXPECT_NEAR(report.mesh_volume, volume, kExact * volume);
  EXPECT_NEAR(report.parts_volume, volume, 1e-6 * volume);
  EXPECT_LE(report.overlap_volume, 1e-6 * volume);
  double by_mass = 0;  // of each part by another way
  for (const HullMesh& part : made.parts) by_mass += certify(triangulated(part)).signed_volume;
  // Faces that are flat but for the rounding of floats are one face, cut in another way here.
  const double flat = mesh.coordinate_rounding > 0 ? 1e-7 : kExact;
  EXPECT_NEAR(by_mass, report.parts_volume, flat * volume);
  const double size = certify(mesh).bounds.diagonal();
  EXPECT_LE(report.parts_beyond_mesh, 1e-6 * size);
  EXPECT_LE(report.mesh_beyond_parts, 1e-6 * size);
  EXPECT_TRUE(report.within_distance);
  EXPECT_TRUE(to_physics(made).ok()) << to_physics(made).error();
}

TriangleMesh turned(TriangleMesh mesh, bool through_floats) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  for (Vector3d& v : mesh.vertices) {
    v = turn * v;
    if (through_floats) v = v.cast<float>().cast<double>();
  }
  if (through_floats) mesh.coordinate_rounding = 0x1p-24;
  return mesh;
}

TEST(Decompose, AnLIsTwoParts) {
  const TriangleMesh beam = l_beam_mesh(0.6, 0.12, 0.15, 0.8, 0.2);
  EXPECT_NEAR(certify(beam).signed_volume, (0.6 * 0.12 + 0.15 * 0.68) * 0.2, 1e-12);
  expect_exact(beam, 2);
  EXPECT_EQ(parts_of(beam).parts.size(), 2u);
  expect_exact(turned(beam, false), 2);
  expect_exact(turned(beam, true), 2);
}

TEST(Decompose, NotchesTakeAFewParts) {
  std::vector<std::array<int, 3>> cube;
  for (int k = 0; k < 27; ++k) cube.push_back({k % 3, k / 3 % 3, k / 9});
  const auto without = [&](std::vector<std::array<int, 3>> gone) {
    std::vector<std::array<int, 3>> left;
    for (const auto& cell : cube)
      if (std::find(gone.begin(), gone.end(), cell) == gone.end()) left.push_back(cell);
    return cubes_mesh(left);
  };
  expect_exact(without({{2, 2, 2}}), 3);                        // a corner
  expect_exact(without({{1, 2, 0}, {1, 2, 1}, {1, 2, 2}}), 3);  // a slot
  expect_exact(without({{1, 2, 1}}), 5);                        // a pocket
  expect_exact(without({{1, 0, 1}, {1, 1, 1}, {1, 2, 1}}), 4);  // a bore
  expect_exact(without({{1, 1, 1}}), 6);                        // a cavity
  expect_exact(turned(without({{2, 2, 2}}), true), 3);
  // Two bodies in one mesh.
  TriangleMesh two = box_mesh({1, 1, 1});
  join(two, box_mesh({0.5, 1, 1}, {4, 0, 0}));
  expect_exact(two, 2);
}

TEST(Decompose, AConvexMeshIsItsHull) {
  for (const TriangleMesh& mesh :
       {box_mesh({1, 2, 0.5}, {10, 0, -5}), sphere_mesh(0.4, 8), cone_mesh(1, 2, 8)}) {
    const Decomposition made = parts_of(mesh, {.max_part_vertices = kMostPartVertices});
    const Result<HullMesh> hull = convex_hull(mesh.vertices);
    ASSERT_TRUE(hull.ok()) << hull.error();
    ASSERT_EQ(made.parts.size(), 1u) << made.report.text();
    ASSERT_EQ(made.parts[0].vertices.size(), hull->vertices.size());
    for (const Vector3d& v : made.parts[0].vertices) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& w : hull->vertices) nearest = std::min(nearest, (v - w).norm());
      EXPECT_LE(nearest, 1e-14);  // moved to the middle and back
    }
    EXPECT_EQ(made.report.overlap_volume, 0);
    EXPECT_LE(made.report.parts_beyond_mesh, 1e-12);
  }
}

// Measured against the round torus itself, of which the mesh is inscribed.
TEST(Decompose, ATorusKeepsItsHole) {
  constexpr double kRing = 0.3, kTube = 0.1;
  const TriangleMesh mesh = torus_mesh(kRing, kTube, 16);
  std::size_t coarser = 0;
  for (const double distance : {0.04, 0.015}) {
    const Decomposition made = parts_of(mesh, {.max_distance = distance});
    const DecompositionReport& report = made.report;
    SCOPED_TRACE(report.text());
    EXPECT_TRUE(report.within_distance);
    EXPECT_EQ(report.max_distance, distance);
    EXPECT_LE(report.parts_beyond_mesh, distance);
    EXPECT_GT(report.parts_beyond_mesh, 0.1 * distance);  // a bent part fills something
    EXPECT_LE(report.mesh_beyond_parts, 1e-9);            // no part was simplified
    EXPECT_LE(report.most_vertices, kColliderHullVertices);
    EXPECT_LE(report.parts, kDefaultMostParts);
    EXPECT_GT(report.parts, coarser);
    coarser = report.parts;
    const double missed = report.parts_volume - report.overlap_volume - report.mesh_volume;
    EXPECT_GT(missed, -1e-9 * report.mesh_volume);

    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    double farthest = 0;
    for (const HullMesh& part : made.parts) {
      for (int trial = 0; trial < 2000; ++trial) {
        Vector3d point = Vector3d::Zero();
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
          const double weight = any(random);
          const auto v =
              static_cast<std::size_t>(any(random) * static_cast<double>(part.vertices.size()));
          point += weight * part.vertices[v];
          sum += weight;
        }
        point /= sum;
        const double across = std::hypot(std::hypot(point.x(), point.z()) - kRing, point.y());
        farthest = std::max(farthest, across - kTube);
      }
    }
    EXPECT_LE(farthest, distance);
    EXPECT_GE(farthest, 0.1 * distance);
  }
}

TEST(Decompose, GivesTheSameBitsAgainAndAtAnyScale) {
  const TriangleMesh mesh = torus_mesh(0.3, 0.12, 8);
  const Decomposition first = parts_of(mesh), second = parts_of(mesh);
  const Decomposition large = parts_of(scaled(mesh, 1024));
  ASSERT_EQ(first.parts.size(), second.parts.size());
  ASSERT_EQ(first.parts.size(), large.parts.size());
  EXPECT_EQ(first.report.text(), second.report.text());
  for (std::size_t k = 0; k < first.parts.size(); ++k) {
    EXPECT_EQ(first.parts[k].faces, second.parts[k].faces);
    ASSERT_EQ(first.parts[k].vertices.size(), second.parts[k].vertices.size());
    ASSERT_EQ(first.parts[k].vertices.size(), large.parts[k].vertices.size());
    for (std::size_t v = 0; v < first.parts[k].vertices.size(); ++v) {
      EXPECT_EQ(first.parts[k].vertices[v], second.parts[k].vertices[v]);
      EXPECT_EQ(Vector3d(1024 * first.parts[k].vertices[v]), large.parts[k].vertices[v]);
    }
  }
}

TEST(Decompose, HoldsTheMostPartsAndSaysWhatThatCosts) {
  const TriangleMesh mesh = torus_mesh(0.3, 0.1, 8);
  const Decomposition made = parts_of(mesh, {.max_parts = 3, .max_part_vertices = 12});
  EXPECT_LE(made.parts.size(), 3u);
  EXPECT_LE(made.report.most_vertices, 12u);
  EXPECT_FALSE(made.report.within_distance);
  EXPECT_GT(made.report.parts_beyond_mesh, made.report.max_distance);
  EXPECT_GT(made.report.mesh_beyond_parts, 0);
  EXPECT_NE(made.report.text().find("NOT within"), std::string::npos) << made.report.text();
}

TEST(Decompose, RefusesWhatHasNoInside) {
  TriangleMesh open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  const std::string told = decompose(open).error();
  EXPECT_NE(told.find("not the boundary of a solid"), std::string::npos) << told;
  EXPECT_NE(told.find("as its hull"), std::string::npos) << told;
  EXPECT_FALSE(decompose(flipped(box_mesh({1, 1, 1}))).ok());
  EXPECT_FALSE(decompose(TriangleMesh{}).ok());
}

TEST(Decompose, RefusesBadOptions) {
  const TriangleMesh box = box_mesh({1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double distance : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(decompose(box, {.max_distance = distance}).error().find("max_distance"),
              std::string::npos);
  }
  for (const std::size_t parts : {std::size_t{0}, kMostParts + 1}) {
    EXPECT_NE(decompose(box, {.max_parts = parts}).error().find("max_parts"), std::string::npos);
  }
  for (const std::size_t vertices : {std::size_t{3}, kMostPartVertices + 1}) {
    EXPECT_NE(decompose(box, {.max_part_vertices = vertices}).error().find("max_part_vertices"),
              std::string::npos);
  }
}

// Every model of assets/models, in float coordinates as they come from their files.
TEST(Decompose, TakesTheModels) {
  const auto folder = std::filesystem::path(PLUMB_SOURCE_DIR) / "assets" / "models";
  const DecomposeOptions options{.max_distance = 0.03, .max_parts = 12};
  for (const char* file :
       {"l_beam.obj", "torus.stl", "ball.ply", "hollow_cube.off", "hammer.glb", "gear.dae",
        "blob.ply", "star.obj", "bowl.gltf", "pawn.stl", "knot.glb", "jack.off"}) {
    SCOPED_TRACE(file);
    const Result<Imported> imported = import_mesh((folder / file).string());
    ASSERT_TRUE(imported.ok()) << imported.error();
    const Decomposition made = parts_of(imported->mesh, options);
    const DecompositionReport& report = made.report;
    SCOPED_TRACE(report.text());
    EXPECT_LE(made.parts.size(), options.max_parts);
    // Nothing of the mesh is lost but by simplification, which is told.
    EXPECT_LE(report.mesh_beyond_parts, 0.03);
    if (report.mesh_beyond_parts < 1e-6) {
      EXPECT_GT(report.parts_volume, (1 - 1e-5) * report.mesh_volume);
    }
    EXPECT_EQ(report.within_distance, report.parts_beyond_mesh <= options.max_distance);
    EXPECT_TRUE(to_physics(made).ok()) << to_physics(made).error();
  }
}

}  // namespace
}  // namespace plumb::test
