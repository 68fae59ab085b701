// Surfaces as lists of triangles in double, and random ones, for tests that try every triangle.
#pragma once

#include "collision/collide_parts.h"
#include "support/collision_oracle.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI::surface_oracle {

using namespace detail;
using oracle::Random;
using oracle::V;
using surfaces::Soup;

struct Triangle {
  V corner[3], normal;
};

// The triangles of a surface in place, in double.
struct Ground {
  CollisionShape shape;
  Transform placed;
  std::vector<Triangle> triangles;
  double size = 1;
};

inline Triangle triangle_of(const V& a, const V& b, const V& c, const Transform& x) {
  const Eigen::Matrix3d R = oracle::rotation_of(x).toRotationMatrix();
  const V p = oracle::vec(x.p);
  Triangle t{{R * a + p, R * b + p, R * c + p}, V::Zero()};
  t.normal = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]).normalized();
  return t;
}

inline Ground ground_of(const Shape& shape, const Transform& placed, double size) {
  Ground g{make_collision_shape(shape), placed, {}, size};
  if (const auto* mesh = std::get_if<SurfaceMesh>(&shape)) {
    for (std::size_t t = 0; t < mesh->geometry->triangle_count(); ++t) {
      const auto c = mesh->geometry->triangle(t);
      const auto at = [&](std::size_t i) -> V {
        return c[i].cast<double>().cwiseProduct(mesh->scale.cast<double>());
      };
      g.triangles.push_back(triangle_of(at(0), at(1), at(2), placed));
    }
  } else {
    const HeightfieldGeometry& f = *std::get<Heightfield>(shape).geometry;
    const auto at = [&](std::uint32_t i, std::uint32_t k) -> V {
      return {i * static_cast<double>(f.spacing_x()), static_cast<double>(f.height(i, k)),
              k * static_cast<double>(f.spacing_z())};
    };
    for (std::uint32_t k = 0; k + 1 < f.samples_z(); ++k) {
      for (std::uint32_t i = 0; i + 1 < f.samples_x(); ++i) {
        if (f.is_hole(i, k)) continue;
        g.triangles.push_back(triangle_of(at(i, k), at(i, k + 1), at(i + 1, k + 1), placed));
        g.triangles.push_back(triangle_of(at(i, k), at(i + 1, k + 1), at(i + 1, k), placed));
      }
    }
  }
  return g;
}

inline oracle::Solid solid_of_triangle(const Triangle& t) {
  oracle::Solid s;
  s.vertices = {t.corner[0], t.corner[1], t.corner[2]};
  s.faces = {{0, 1, 2}};
  s.normals = {t.normal};
  s.edges = {{0, 1}, {1, 2}, {0, 2}};
  return s;
}

inline double point_triangle(const V& p, const Triangle& t) {
  const oracle::Solid s = solid_of_triangle(t);
  double best = oracle::point_face(p, s, 0);
  for (int k = 0; k < 3; ++k)
    best = std::min(best, oracle::point_segment(p, t.corner[k], t.corner[(k + 1) % 3]));
  return best;
}

inline double bump(double x, double z) { return 0.35 * std::sin(1.3 * x) * std::cos(0.9 * z); }

// Bumps, a tiled plane, slivers, a ball and a box, each at a size and a place.
inline Ground random_ground(Random& random, double size) {
  const int kind = random.below(6);
  const Transform placed{{static_cast<Real>(size * random.uniform(-1, 1)), 0, 0},
                         random.below(3) == 0 ? Rotation{0, 0, 0, 1} : random.rotation()};
  const auto sized = [&](Soup soup) {
    for (Vec3& v : soup.vertices) v *= static_cast<Real>(size);
    return Shape{SurfaceMesh{surfaces::made(soup)}};
  };
  switch (kind) {
    case 0:
      return ground_of(sized(surfaces::grid(-3, 3, -3, 3, 8, 8, bump, true)), placed, size);
    case 1:
      return ground_of(sized(surfaces::grid(-3, 3, -3, 3, 5, 9, surfaces::level)), placed, size);
    case 2:
      return ground_of(sized(surfaces::grid(-3, 3, -3, 3, 60, 1, bump)), placed, size);
    case 3:
      return ground_of(sized(surfaces::ball_soup(2, 7)), placed, size);
    case 4: {
      SurfaceMesh mesh{surfaces::made(surfaces::box_soup(2, 1, 1.5)),
                       Vec3(1, Real(1.5), 1) * static_cast<Real>(size)};
      return ground_of(mesh, placed, size);
    }
    default:
      return ground_of(Heightfield{surfaces::field(8, 9, 0.8 * size,
                                                   [&](int i, int k) {
                                                     if (i == 3 && k == 4) return std::nan("");
                                                     return size * bump(i, k);
                                                   })},
                       placed, size);
  }
}

// Above a random place of the surface by this much [m], in front of it; turned in any way, or as
// the ground is.
inline Transform above(Random& random, const Ground& ground, double least, double most) {
  const Triangle& under = ground.triangles[static_cast<std::size_t>(
      random.below(static_cast<int>(ground.triangles.size())))];
  const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
  const V at = under.corner[0] + u * (under.corner[1] - under.corner[0]) +
               v * (under.corner[2] - under.corner[0]) + random.uniform(least, most) * under.normal;
  return {oracle::as_vec(at), random.below(3) == 0 ? ground.placed.q : random.rotation()};
}

// Whether a normal is one along which a point of the manifold can be touched: all triangles there
// go downhill along it, or it is that of one of them. The other points may lie beside. `half` [m]:
// half of the thickness of what touches.
inline bool is_real(const Ground& ground, const Manifold& m, double half) {
  const V n = oracle::vec(m.normal);
  bool some = false;
  for (int i = 0; i < m.count && !some; ++i) {
    const ManifoldPoint& point = m.points[i];
    const V p = oracle::vec(point.position) - 0.5 * static_cast<double>(point.separation) * n;
    bool holds = true, is_facet = false;
    for (const Triangle& t : ground.triangles) {
      if (point_triangle(p, t) > 2e-3 * half) continue;
      is_facet = is_facet || (n - t.normal).norm() <= 1e-3;
      for (const V& corner : t.corner)
        holds = holds && n.dot(corner - p) <= 1e-3 * (corner - p).norm() + 4e-3 * half;
    }
    some = holds || is_facet;
  }
  return some;
}

// The least separation of all points [m].
inline double deepest_of(const Manifold& m) {
  double deepest = 1e300;
  for (int i = 0; i < m.count; ++i)
    deepest = std::min(deepest, static_cast<double>(m.points[i].separation));
  return deepest;
}
inline double deepest_of(const PartManifolds& all) {
  double deepest = 1e300;
  for (const PartManifold& part : all.parts) deepest = std::min(deepest, deepest_of(part.manifold));
  return deepest;
}

}  // namespace plumb::inline PLUMB_ABI::surface_oracle
