// Invariant: trees and grid walks find what trying everything finds: boxes, rays, closest points;
// and geometry that cannot work is refused with a reason, while what can be mended is mended and
// counted.
#include <gtest/gtest.h>

#include "collision/collide_parts.h"
#include "collision/surface/static_bvh.h"
#include "support/collision_oracle.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;
using surfaces::Soup;

constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

NumVec num(const V& v) { return {v.x(), v.y(), v.z()}; }

TEST(StaticTree, FindsEveryBoxThatBruteForceFinds) {
  Random random(5);
  for (const int count : {1, 2, 5, 37, 1000}) {
    for (const double flat : {1.0, 0.0}) {  // boxes in a volume; points in a plane
      std::vector<NumBox> boxes;
      for (int i = 0; i < count; ++i) {
        V low = 1e3 * random.direction();
        low.y() *= flat;
        const V high = low + V(random.uniform(0, 50), random.uniform(0, 50) * flat, 0);
        boxes.push_back({num(low), num(high)});
      }
      StaticBvh tree;
      const std::vector<std::uint32_t> order = tree.build(boxes);
      ASSERT_EQ(order.size(), boxes.size());
      for (int q = 0; q < 100; ++q) {
        const V low = 1.2e3 * random.direction();
        const NumBox box{num(low), num(low + random.scale(0.1, 1e3) * V::Ones())};
        std::vector<bool> seen(boxes.size(), false);
        std::uint32_t last = 0;
        tree.query(box, [&](std::uint32_t place) {
          EXPECT_TRUE(place >= last);
          last = place;
          seen[order[place]] = true;
        });
        for (std::size_t i = 0; i < boxes.size(); ++i)
          EXPECT_TRUE(seen[i] || !overlaps(boxes[i], box));
      }
    }
  }
}

struct Scene {
  Shape shape;
  std::vector<std::array<V, 3>> triangles;  // in the shape's frame
};
Scene mesh_scene(const Soup& soup, const Vec3& scale) {
  Scene s{SurfaceMesh{surfaces::made(soup), scale}, {}};
  for (std::size_t i = 0; i < soup.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) -> V {
      return soup.vertices[soup.indices[i + k]].cwiseProduct(scale).cast<double>();
    };
    s.triangles.push_back({at(0), at(1), at(2)});
  }
  return s;
}
Scene field_scene(Random& random) {
  const auto field = surfaces::field(20, 14, 0.7, [&](int i, int k) {
    return i == 4 && k == 5 ? std::nan("") : random.uniform(-1, 1);
  });
  Scene s{Heightfield{field}, {}};
  const auto at = [&](std::uint32_t i, std::uint32_t k) -> V {
    return {i * static_cast<double>(field->spacing_x()), static_cast<double>(field->height(i, k)),
            k * static_cast<double>(field->spacing_z())};
  };
  for (std::uint32_t k = 0; k + 1 < 14; ++k) {
    for (std::uint32_t i = 0; i + 1 < 20; ++i) {
      if (field->is_hole(i, k)) continue;
      s.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      s.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return s;
}
std::vector<Scene> scenes() {
  Random random(3);
  std::vector<Scene> all;
  all.push_back(mesh_scene(surfaces::ball_soup(2, 9), Vec3(1, Real(0.5), 2)));
  all.push_back(mesh_scene(
      surfaces::grid(-3, 3, -3, 3, 20, 20,
                     [](double x, double z) { return std::sin(2 * x) * std::cos(3 * z); }),
      Vec3::Ones()));
  all.push_back(field_scene(random));
  return all;
}

// Fraction of the first front hit, by solving for the point in each triangle's own axes.
double first_hit(const Scene& s, const V& o, const V& d, double& border) {
  double best = 1e300;
  border = 1;
  for (const auto& t : s.triangles) {
    const V n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (!(n.dot(d) < 0)) continue;
    Eigen::Matrix3d m;
    m << t[1] - t[0], t[2] - t[0], -d;
    const V x = m.fullPivLu().solve(o - t[0]);
    const double inside = std::min({x.x(), x.y(), 1 - x.x() - x.y()});
    if (x.z() >= 0 && std::abs(inside) < border) border = std::abs(inside);
    if (inside >= 0 && x.z() >= 0 && x.z() < best) best = x.z();
  }
  return best;
}

TEST(SurfaceRays, HitWhatBruteForceHits) {
  Random random(11);
  for (const Scene& scene : scenes()) {
    const CollisionShape shape = make_collision_shape(scene.shape);
    int hits = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const Transform placed{{Real(3), Real(-2), Real(5)}, random.rotation()};
      const Eigen::Matrix3d R = oracle::rotation_of(placed).toRotationMatrix();
      const V target(random.uniform(-3, 14), random.uniform(-1, 1), random.uniform(-3, 9));
      const V from = target + 12 * random.direction();
      const V o = R * from + oracle::vec(placed.p), d = R * (2 * (target - from));
      const auto real = [](const V& v) {
        return Vec{static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
      };
      const Vec origin = real(o), direction = real(d);
      double border = 1;
      const double truth =
          first_hit(scene, R.transpose() * (oracle::vec(origin) - oracle::vec(placed.p)),
                    R.transpose() * oracle::vec(direction), border);
      // Rays within rounding of an edge may fall to either side.
      if (border < 1e3 * kEpsilon) continue;
      RayHit hit{};
      const bool found = cast_ray(shape, placed, origin, direction, Real(1), hit);
      ASSERT_EQ(found, truth <= 1) << "trial " << trial << " " << truth;
      if (!found) continue;
      ++hits;
      // A ray that meets a facet at a small angle shifts its hit by more than its rounding.
      EXPECT_NEAR(static_cast<double>(hit.fraction), truth, 2e3 * kEpsilon);
      EXPECT_LT(dot(hit.normal, direction), Real(0));
    }
    EXPECT_GT(hits, 300);
  }
}

// Through vertices and along edges of a grid nothing slips.
TEST(SurfaceRays, PassNoSeam) {
  const CollisionShape mesh = make_collision_shape(
      SurfaceMesh{surfaces::made(surfaces::grid(-2, 2, -2, 2, 8, 8, surfaces::level, true))});
  const CollisionShape field =
      make_collision_shape(Heightfield{surfaces::field(9, 9, 0.5, [](int, int) { return 0.0; })});
  const Rotation upright{0, 0, 0, 1};
  for (int i = 0; i <= 64; ++i) {
    for (int k = 0; k <= 64; ++k) {
      const Real x = Real(-2) + static_cast<Real>(i) / 16, z = Real(-2) + static_cast<Real>(k) / 16;
      for (const Vec slant : {Vec{0, -4, 0}, Vec{1, -4, Real(0.5)}, Vec{-2, -4, 2}}) {
        const Vec origin{x - Real(0.5) * slant.x, 2, z - Real(0.5) * slant.z};
        RayHit hit{};
        EXPECT_TRUE(cast_ray(mesh, {{0, 0, 0}, upright}, origin, slant, 1, hit));
        EXPECT_TRUE(cast_ray(field, {{-2, 0, -2}, upright}, origin, slant, 1, hit));
        EXPECT_NEAR(static_cast<double>(hit.fraction), 0.5, 8 * kEpsilon);
      }
    }
  }
}

// Whether an edge of the solid passes through a triangle, or one of a triangle's through the solid.
bool meets_any(const oracle::Solid& s, const std::vector<std::array<V, 3>>& triangles) {
  for (const auto& t : triangles) {
    const V n = (t[1] - t[0]).cross(t[2] - t[0]);
    for (const auto& [a, b] : s.edges) {
      const V &p = s.vertices[static_cast<std::size_t>(a)],
              &q = s.vertices[static_cast<std::size_t>(b)];
      const double hp = n.dot(p - t[0]), hq = n.dot(q - t[0]);
      if (hp * hq >= 0) continue;
      const V x = p + hp / (hp - hq) * (q - p);
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k)
        inside = inside && (t[(k + 1) % 3] - t[k]).cross(x - t[k]).dot(n) >= 0;
      if (inside) return true;
    }
    if (s.faces.empty()) continue;
    for (const double f : {0.0, 0.25, 0.5, 0.75, 1.0})
      for (std::size_t k = 0; k < 3; ++k)
        if (oracle::signed_distance(V(t[k] + f * (t[(k + 1) % 3] - t[k])), s) <= 0) return true;
  }
  return false;
}

TEST(SurfaceDistance, IsThatOfTheNearestTriangle) {
  Random random(13);
  for (const Scene& scene : scenes()) {
    const CollisionShape shape = make_collision_shape(scene.shape);
    for (int trial = 0; trial < 300; ++trial) {
      const CollisionShape convex =
          trial % 3 == 0   ? make_collision_shape(Sphere{Real(0.3)})
          : trial % 3 == 1 ? make_collision_shape(Capsule{Real(0.4), Real(0.2)})
                           : make_collision_shape(Box{Vec3(Real(0.3), Real(0.5), Real(0.2))});
      const V at = V(random.uniform(-4, 14), random.uniform(-4, 4), random.uniform(-4, 10));
      const Transform placed{
          {static_cast<Real>(at.x()), static_cast<Real>(at.y()), static_cast<Real>(at.z())},
          random.rotation()};
      const oracle::Solid solid = oracle::solid_of(convex, placed);
      double truth = 1e300;
      for (const auto& t : scene.triangles) {
        oracle::Solid s;
        s.vertices = {t[0], t[1], t[2]};
        s.faces = {{0, 1, 2}};
        s.normals = {(t[1] - t[0]).cross(t[2] - t[0]).normalized()};
        s.edges = {{0, 1}, {1, 2}, {0, 2}};
        truth = std::min(truth, oracle::feature_distance(solid, s));
      }
      truth -= solid.radius;
      const Transform home{{0, 0, 0}, {0, 0, 0, 1}};
      const Proximity near = closest_points(shape, home, convex, placed);
      if (truth < 0.05) continue;
      // What passes through a triangle has all its features away from it: then a corner lies
      // behind.
      if (near.distance == Real(0) && meets_any(solid, scene.triangles)) continue;
      const double scale = std::max(1.0, at.norm());
      EXPECT_NEAR(static_cast<double>(near.distance), truth, 64 * kEpsilon * scale);
      EXPECT_NEAR((oracle::vec(near.on_b) - oracle::vec(near.on_a)).norm(), truth,
                  256 * kEpsilon * scale);
      const Proximity back = closest_points(convex, placed, shape, home);
      EXPECT_NEAR(static_cast<double>(back.distance), truth, 64 * kEpsilon * scale);
      EXPECT_NEAR(static_cast<double>(dot(back.normal, near.normal)), -1, 1e-3);
    }
  }
}

TEST(SurfaceGeometry, RefusesWhatCannotWorkAndSaysWhy) {
  Soup soup = surfaces::grid(0, 1, 0, 1, 1, 1, surfaces::level);
  const auto code = [](const Soup& s) { return s.create().status.code; };
  EXPECT_EQ(code(soup), StatusCode::Ok);
  EXPECT_EQ(code(Soup{}), StatusCode::BadShape);
  Soup bad = soup;
  bad.indices[0] = 99;
  EXPECT_EQ(code(bad), StatusCode::BadShape);
  bad = soup;
  bad.indices.pop_back();
  EXPECT_EQ(code(bad), StatusCode::BadShape);
  bad = soup;
  bad.vertices[0].x() = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_EQ(code(bad), StatusCode::NotFinite);
  bad = soup;
  bad.vertices[0].x() = Real(3e6);
  EXPECT_EQ(code(bad), StatusCode::OutOfRange);
  bad = soup;
  bad.indices = {0, 1, 1, 2, 2, 2};
  EXPECT_EQ(code(bad), StatusCode::BadShape);

  const std::vector<Real> heights(6, Real(0));
  const auto field = [&](std::uint32_t x, std::uint32_t z, Real d, std::span<const Real> h) {
    return HeightfieldGeometry::create(x, z, d, d, h).status.code;
  };
  EXPECT_EQ(field(2, 3, 1, heights), StatusCode::Ok);
  EXPECT_EQ(field(1, 6, 1, heights), StatusCode::BadShape);
  EXPECT_EQ(field(2, 2, 1, heights), StatusCode::BadShape);
  EXPECT_EQ(field(2, 3, 0, heights), StatusCode::OutOfRange);
  EXPECT_EQ(field(2, 3, std::numeric_limits<Real>::infinity(), heights), StatusCode::NotFinite);
  std::vector<Real> infinite = heights;
  infinite[1] = std::numeric_limits<Real>::infinity();
  EXPECT_EQ(field(2, 3, 1, infinite), StatusCode::NotFinite);
  const std::vector<Real> holes(6, std::numeric_limits<Real>::quiet_NaN());
  EXPECT_EQ(field(2, 3, 1, holes), StatusCode::BadShape);

  EXPECT_EQ(CompoundGeometry::create({}).status.code, StatusCode::BadShape);
  const auto compound = [](const Shape& shape, const LocalPose& pose) {
    const CompoundGeometry::Child child{shape, pose};
    return CompoundGeometry::create(std::span(&child, 1)).status.code;
  };
  EXPECT_EQ(compound(Sphere{}, {}), StatusCode::Ok);
  EXPECT_EQ(compound(HalfSpace{}, {}), StatusCode::BadShape);
  EXPECT_EQ(compound(SurfaceMesh{surfaces::made(soup)}, {}), StatusCode::BadShape);
  EXPECT_EQ(compound(surfaces::compound({surfaces::child(Sphere{}, V::Zero())}), {}),
            StatusCode::BadShape);
  EXPECT_EQ(compound(Sphere{Real(-1)}, {}), StatusCode::BadShape);
  LocalPose bent;
  bent.orientation.coeffs() *= Real(2);
  EXPECT_EQ(compound(Sphere{}, bent), StatusCode::OutOfRange);

  EXPECT_EQ(check_shape(SurfaceMesh{}).code, StatusCode::BadShape);
  EXPECT_EQ(check_shape(Heightfield{}).code, StatusCode::BadShape);
  EXPECT_EQ(check_shape(Compound{}).code, StatusCode::BadShape);
  const SurfaceMesh turned{surfaces::made(soup), Vec3(1, -1, 1)};
  EXPECT_EQ(check_shape(turned).code, StatusCode::OutOfRange);
}

TEST(SurfaceGeometry, WeldsDropsAndCounts) {
  // Two squares that share places but no vertices, one triangle without area, one turned against.
  Soup soup;
  soup.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0});
  soup.quad({1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0});
  soup.indices.insert(soup.indices.end(), {0, 1, 1});
  const auto mesh = surfaces::made(soup);
  EXPECT_EQ(mesh->triangle_count(), 4U);
  EXPECT_EQ(mesh->dropped_triangles(), 1U);
  EXPECT_EQ(mesh->open_edges(), 6U);
  EXPECT_EQ(mesh->odd_edges(), 0U);
  int flat = 0;
  for (std::size_t t = 0; t < 4; ++t)
    for (int k = 0; k < 3; ++k) flat += mesh->edge_kind(t, k) == EdgeKind::Flat ? 1 : 0;
  EXPECT_EQ(flat, 6);  // three inner edges, from both sides

  soup.quad({1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0});  // a third wing on the middle edge
  EXPECT_EQ(surfaces::made(soup)->odd_edges(), 1U);

  const auto box = surfaces::made(surfaces::box_soup(1, 2, 3));
  EXPECT_EQ(box->open_edges(), 0U);
  int convex = 0;
  for (std::size_t t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) convex += box->edge_kind(t, k) == EdgeKind::Convex ? 1 : 0;
  EXPECT_EQ(convex, 24);  // twelve edges from both sides; diagonals are flat

  // Making a mesh again from what it gives back makes the same mesh.
  const auto ball = surfaces::made(surfaces::ball_soup(1, 6));
  std::vector<Vec3> vertices, again_vertices;
  std::vector<std::uint32_t> indices, again_indices;
  ball->copy_input(vertices, indices);
  const auto again = TriangleMeshGeometry::create(vertices, indices).mesh;
  again->copy_input(again_vertices, again_indices);
  EXPECT_EQ(vertices, again_vertices);
  EXPECT_EQ(indices, again_indices);
  for (std::size_t t = 0; t < ball->triangle_count(); ++t)
    EXPECT_EQ(ball->triangle(t), again->triangle(t));
}

TEST(SurfaceGeometry, TakesFewBytesATriangle) {
  const auto mesh = surfaces::made(surfaces::grid(0, 100, 0, 100, 100, 100, surfaces::level));
  const double each = static_cast<double>(mesh->bytes()) / 2e4;
  // Corners 12, neighbours 12, number 4, half a vertex, tree 16 a node with 2 to 4 triangles a
  // leaf.
  EXPECT_LT(each, 28 + 1.7 * sizeof(Real) + 16);
  const auto field = surfaces::field(101, 101, 1, [](int, int) { return 0.0; });
  EXPECT_EQ(field->bytes(), 101 * 101 * sizeof(Real));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
