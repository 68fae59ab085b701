// Invariant: a hull is closed, convex, outward and holds every point it was made from to the
// distance it reports; points that make no body are refused with a reason.
#include "plumb/assets/hull.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "plumb/assets/certificate.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/to_physics.h"
#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets;

std::vector<Vector3d> random_points(std::size_t count, unsigned seed, bool on_sphere) {
  std::mt19937 random(seed);
  std::normal_distribution<double> any;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d p(any(random), any(random), any(random));
    points.push_back(on_sphere ? Vector3d(p.normalized()) : p);
  }
  return points;
}

void expect_hull(const HullMesh& hull, const std::vector<Vector3d>& points, double tolerance) {
  const MeshCertificate certificate = certify(triangulated(hull));
  EXPECT_TRUE(certificate.solid) << certificate.fault_text();
  EXPECT_EQ(certificate.genus, 0);
  double outside = 0;
  for (const auto& face : hull.faces) {
    ASSERT_GE(face.size(), 3u);
    Vector3d area = Vector3d::Zero(), middle = Vector3d::Zero();
    for (std::size_t i = 0; i < face.size(); ++i) {
      area += 0.5 * hull.vertices[face[i]].cross(hull.vertices[face[(i + 1) % face.size()]]);
      middle += hull.vertices[face[i]] / static_cast<double>(face.size());
    }
    for (const Vector3d& p : points) outside = std::max(outside, area.normalized().dot(p - middle));
  }
  EXPECT_LE(outside, tolerance);
}

TEST(ConvexHull, BoxHasSixSquares) {
  std::vector<Vector3d> points = box_mesh({1, 2, 3}, {10, 0, -5}).vertices;
  points.push_back({10, 0, -5});      // inside
  points.push_back({11, 0.3, -4.1});  // on a face
  points.push_back({11, 2, -4});      // on an edge
  points.push_back(points.front());   // twice
  const Result<HullMesh> hull = convex_hull(points);
  ASSERT_TRUE(hull.ok()) << hull.error();
  EXPECT_EQ(hull->vertices.size(), 8u);
  ASSERT_EQ(hull->faces.size(), 6u);
  for (const auto& face : hull->faces) EXPECT_EQ(face.size(), 4u);
  expect_hull(*hull, points, 1e-13);
}

// Coordinates that went through floats are flat only to 1e-7; the faces still come out whole.
TEST(ConvexHull, FacesOfFloatCoordinatesAreMerged) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    std::vector<Vector3d> points;
    for (const Vector3d& v : cylinder_mesh(1, 0.5, 8).vertices)
      points.push_back((turn * v).cast<float>().cast<double>());
    const Result<HullMesh> hull = convex_hull(points);
    ASSERT_TRUE(hull.ok()) << hull.error();
    EXPECT_EQ(hull->vertices.size(), 32u);
    EXPECT_EQ(hull->faces.size(), 18u);
    expect_hull(*hull, points,
                5e-6);  // the merge width for a body of size 2, with its second round
    EXPECT_LE(hull->max_outside, 5e-6);
  }
}

TEST(ConvexHull, HoldsAllPoints) {
  for (const bool on_sphere : {false, true}) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
      std::vector<Vector3d> points = random_points(500, 9, on_sphere);
      for (Vector3d& p : points) p = scale * (p + Vector3d(100, 0, 0));
      const Result<HullMesh> hull = convex_hull(points);
      ASSERT_TRUE(hull.ok()) << hull.error();
      EXPECT_EQ(hull->vertices.size() == 500, on_sphere);
      expect_hull(*hull, points, 1e-5 * scale);
    }
  }
}

TEST(ConvexHull, SimplificationReportsItsError) {
  const std::vector<Vector3d> points = random_points(800, 10, true);
  const Result<HullMesh> full = convex_hull(points);
  ASSERT_TRUE(full.ok());
  double last = std::numeric_limits<double>::infinity();
  for (const std::size_t budget : {4u, 16u, 64u, 200u}) {
    const Result<HullMesh> hull = convex_hull(points, {.max_vertices = budget});
    ASSERT_TRUE(hull.ok()) << hull.error();
    EXPECT_LE(hull->vertices.size(), budget);
    EXPECT_EQ(hull->full_vertex_count, 800u);
    EXPECT_LT(hull->simplification_distance, last);  // more vertices, less error
    last = hull->simplification_distance;
    // Every point lies within the reported distance of some face plane, and the volumes agree.
    expect_hull(*hull, points, hull->simplification_distance + 1e-12);
    const double volume = certify(triangulated(*hull)).signed_volume;
    const double full_volume = certify(triangulated(*full)).signed_volume;
    EXPECT_NEAR(hull->simplification_volume_loss, 1 - volume / full_volume, 1e-9);
  }
  // 64 points on a sphere: caps of half-angle about 2 / sqrt(64), so a sagitta near 1/32 to 1/12.
  EXPECT_LT(convex_hull(points, {.max_vertices = kColliderHullVertices})->simplification_distance,
            0.1);
}

TEST(ConvexHull, PointsWithoutABodyAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto error_of = [](const std::vector<Vector3d>& points) {
    return convex_hull(points).error();
  };
  EXPECT_NE(error_of({}).find("0 points"), std::string::npos);
  EXPECT_NE(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("3 points"), std::string::npos);
  EXPECT_NE(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}}).find("point 3"),
            std::string::npos);
  EXPECT_NE(error_of(std::vector<Vector3d>(5, {1, 2, 3})).find("one place"), std::string::npos);
  EXPECT_NE(error_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}).find("one line"),
            std::string::npos);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  std::vector<Vector3d> flat;
  for (const Vector3d& p : random_points(50, 11, false))
    flat.push_back(turn * Vector3d(p.x(), p.y(), 0));
  EXPECT_NE(error_of(flat).find("one plane"), std::string::npos);
  EXPECT_FALSE(convex_hull(random_points(10, 12, true), {.max_vertices = 3}).ok());
  EXPECT_FALSE(convex_hull(random_points(10, 12, true), {.coplanar_tolerance = nan}).ok());
}

TEST(ConvexHull, ThinPlateStaysABody) {
  const Result<HullMesh> hull = convex_hull(box_mesh({1, 1e-5, 1}).vertices);
  ASSERT_TRUE(hull.ok()) << hull.error();
  EXPECT_EQ(hull->vertices.size(), 8u);
  EXPECT_EQ(hull->faces.size(), 6u);
}

TEST(ToPhysics, HullsAndMassesAreAccepted) {
  for (const TriangleMesh& mesh :
       {box_mesh({0.5, 0.2, 0.1}), sphere_mesh(0.4, 12), l_beam_mesh(0.6, 0.12, 0.15, 0.8, 0.2)}) {
    const Result<MeshMass> mass = mass_of_mesh(mesh, {.density = 700});
    ASSERT_TRUE(mass.ok()) << mass.error();
    const Result<MassProperties> properties = to_physics(*mass);
    ASSERT_TRUE(properties.ok()) << properties.error();
    EXPECT_EQ(properties->mass, mass->mass);
    EXPECT_EQ(properties->I_Bcm_B, mass->I_Bcm_B);

    const Result<HullMesh> hull =
        convex_hull(mesh.vertices, {.max_vertices = kColliderHullVertices});
    ASSERT_TRUE(hull.ok()) << hull.error();
    const auto geometry = to_physics(*hull, mass->center);
    ASSERT_TRUE(geometry.ok()) << geometry.error();
    EXPECT_EQ((*geometry)->vertices().size(), hull->vertices.size());
    EXPECT_EQ((*geometry)->face_count(), hull->faces.size());
  }
}

}  // namespace
}  // namespace plumb::test
