// Slow, exact answers for the distance and the penetration depth of two convex shapes, in double
// precision, by trying every feature against every feature. Shares no code with the narrowphase.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "collision/collision_shape.h"

namespace plumb::inline PLUMB_ABI::oracle {

using V = Eigen::Vector3d;

// A convex core (point, segment or polyhedron) in place, grown by a radius.
struct Solid {
  std::vector<V> vertices;
  std::vector<std::vector<int>> faces;  // counter-clockwise from outside
  std::vector<V> normals;               // of the faces
  std::vector<std::pair<int, int>> edges;
  double radius = 0;
};

inline Eigen::Quaterniond rotation_of(const detail::Transform& x) {
  return Eigen::Quaterniond(static_cast<double>(x.q.w), static_cast<double>(x.q.x),
                            static_cast<double>(x.q.y), static_cast<double>(x.q.z))
      .normalized();
}
inline V vec(detail::Vec v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline detail::Vec as_vec(const V& v) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

inline void add_face(Solid& s, std::vector<int> loop) {
  V area = V::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const V& o = s.vertices[static_cast<std::size_t>(loop[0])];
    area += (s.vertices[static_cast<std::size_t>(loop[i])] - o)
                .cross(s.vertices[static_cast<std::size_t>(loop[i + 1])] - o);
  }
  s.normals.push_back(area.normalized());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int a = loop[i], b = loop[(i + 1) % loop.size()];
    if (a < b) s.edges.emplace_back(a, b);
  }
  s.faces.push_back(std::move(loop));
}

// Every finite shape of corners; not the half-space, cylinder and cone.
inline Solid solid_of(const detail::CollisionShape& shape, const detail::Transform& x) {
  Solid s;
  s.radius = static_cast<double>(shape.radius);
  const Eigen::Matrix3d R = rotation_of(x).toRotationMatrix();
  const V p = vec(x.p), h = vec(shape.half);
  switch (shape.type) {
    case detail::ShapeType::Sphere:
      s.vertices = {p};
      break;
    case detail::ShapeType::Capsule:
      s.vertices = {p - R * h, p + R * h};
      s.edges = {{0, 1}};
      break;
    case detail::ShapeType::Box:
      for (int i = 0; i < 8; ++i) {
        const V corner((i & 1) != 0 ? h.x() : -h.x(), (i & 2) != 0 ? h.y() : -h.y(),
                       (i & 4) != 0 ? h.z() : -h.z());
        s.vertices.push_back(p + R * corner);
      }
      for (const auto& loop : {std::vector<int>{0, 4, 6, 2},
                               {1, 3, 7, 5},
                               {0, 1, 5, 4},
                               {2, 6, 7, 3},
                               {0, 2, 3, 1},
                               {4, 5, 7, 6}}) {
        add_face(s, loop);
      }
      break;
    case detail::ShapeType::Hull:
      for (const Vec3& v : shape.hull->vertices()) s.vertices.push_back(p + R * v.cast<double>());
      for (std::size_t k = 0; k < shape.hull->face_count(); ++k) {
        const auto loop = shape.hull->face(k);
        add_face(s, std::vector<int>(loop.begin(), loop.end()));
      }
      break;
    case detail::ShapeType::HalfSpace:
    case detail::ShapeType::Cylinder:
    case detail::ShapeType::Cone:
    case detail::ShapeType::Mesh:
    case detail::ShapeType::Heightfield:
    case detail::ShapeType::Compound:
      break;
  }
  return s;
}

// min over B of n . x minus max over A of n . x, radii included: the room between them along n.
inline double room_along(const Solid& a, const Solid& b, const V& n) {
  double high = -std::numeric_limits<double>::infinity(), low = -high;
  for (const V& v : a.vertices) high = std::max(high, n.dot(v));
  for (const V& v : b.vertices) low = std::min(low, n.dot(v));
  return low - high - a.radius - b.radius;
}

inline double point_segment(const V& p, const V& a, const V& b) {
  const V d = b - a;
  const double t =
      d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}
inline double segment_segment(const V& a0, const V& a1, const V& b0, const V& b1) {
  double best = std::min({point_segment(a0, b0, b1), point_segment(a1, b0, b1),
                          point_segment(b0, a0, a1), point_segment(b1, a0, a1)});
  // Both interior: only if the lines' common perpendicular falls within both.
  const V da = a1 - a0, db = b1 - b0, c = da.cross(db), r = b0 - a0;
  if (c.squaredNorm() > 0) {
    const double s = r.cross(db).dot(c) / c.squaredNorm(), t = r.cross(da).dot(c) / c.squaredNorm();
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      best = std::min(best, (a0 + s * da - b0 - t * db).norm());
  }
  return best;
}
// Distance to a face for points whose foot lies within it; infinity else (its edges then decide).
inline double point_face(const V& p, const Solid& s, std::size_t k) {
  const std::vector<int>& loop = s.faces[k];
  const V& n = s.normals[k];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const V& a = s.vertices[static_cast<std::size_t>(loop[i])];
    const V& b = s.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
    if ((b - a).cross(p - a).dot(n) < 0) return std::numeric_limits<double>::infinity();
  }
  return std::abs(n.dot(p - s.vertices[static_cast<std::size_t>(loop[0])]));
}

// Largest room over every direction that can be a face of the Minkowski difference. Exact depth of
// overlapping cores (negative); positive only when they are apart. -infinity if there is none.
inline double best_facet_room(const Solid& a, const Solid& b) {
  double best = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const V& n) {
    best = std::max({best, room_along(a, b, n), room_along(a, b, -n)});
  };
  for (const V& n : a.normals) consider(n);
  for (const V& n : b.normals) consider(n);
  for (const auto& [a0, a1] : a.edges) {
    for (const auto& [b0, b1] : b.edges) {
      const V da =
          a.vertices[static_cast<std::size_t>(a1)] - a.vertices[static_cast<std::size_t>(a0)];
      const V db =
          b.vertices[static_cast<std::size_t>(b1)] - b.vertices[static_cast<std::size_t>(b0)];
      const V c = da.cross(db);
      if (c.norm() > 1e-9 * da.norm() * db.norm()) consider(c.normalized());
    }
  }
  return best;
}

// Distance of the cores, by all pairs of features; right only if they do not overlap.
inline double feature_distance(const Solid& a, const Solid& b) {
  double best = std::numeric_limits<double>::infinity();
  for (const V& p : a.vertices) {
    for (const V& q : b.vertices) best = std::min(best, (p - q).norm());
    for (std::size_t k = 0; k < b.faces.size(); ++k) best = std::min(best, point_face(p, b, k));
  }
  for (const V& p : b.vertices) {
    for (std::size_t k = 0; k < a.faces.size(); ++k) best = std::min(best, point_face(p, a, k));
  }
  const auto at = [](const Solid& s, int i) -> const V& {
    return s.vertices[static_cast<std::size_t>(i)];
  };
  for (const auto& [a0, a1] : a.edges) {
    for (const V& q : b.vertices) best = std::min(best, point_segment(q, at(a, a0), at(a, a1)));
    for (const auto& [b0, b1] : b.edges) {
      best = std::min(best, segment_segment(at(a, a0), at(a, a1), at(b, b0), at(b, b1)));
    }
  }
  for (const auto& [b0, b1] : b.edges) {
    for (const V& p : a.vertices) best = std::min(best, point_segment(p, at(b, b0), at(b, b1)));
  }
  return best;
}

// Distance of the surfaces, or minus the depth of overlap: the least translation that parts the
// shapes.
inline double signed_distance(const Solid& a, const Solid& b) {
  const double radii = a.radius + b.radius;
  if (a.faces.empty() && b.faces.empty()) return feature_distance(a, b) - radii;
  const double facets = best_facet_room(a, b) + radii;  // of the cores
  return (facets > 0 ? feature_distance(a, b) : facets) - radii;
}

// Distance of a point from the surface of a solid; negative inside.
inline double signed_distance(const V& point, const Solid& s) {
  Solid p;
  p.vertices = {point};
  return signed_distance(p, s);
}

// ---- random input -------------------------------------------------------------------------------

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967295.0);
  }
  // Between low and high with every factor of ten equally likely.
  double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  V direction() {
    for (;;) {
      const V v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.squaredNorm() > 1e-4 && v.squaredNorm() < 1) return v.normalized();
    }
  }
  detail::Rotation rotation() {
    for (;;) {
      const Eigen::Vector4d v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.squaredNorm() < 1e-4 || v.squaredNorm() > 1) continue;
      const Eigen::Vector4d u = v.normalized();
      return {static_cast<Real>(u.x()), static_cast<Real>(u.y()), static_cast<Real>(u.z()),
              static_cast<Real>(u.w())};
    }
  }

 private:
  std::mt19937 engine_;  // its sequence is fixed by the standard, that of distributions is not
};

// The hull of points in general position, triangle by triangle.
inline std::shared_ptr<const HullGeometry> hull_of_points(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> sizes, loops;
  const auto at = [&points](std::size_t i) -> V { return points[i].cast<double>(); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (i == j || j == k || i == k || i > j || i > k) continue;
        const V n = (at(j) - at(i)).cross(at(k) - at(i));
        bool outside = true;
        for (std::size_t m = 0; m < points.size() && outside; ++m) {
          if (m != i && m != j && m != k && n.dot(at(m) - at(i)) >= 0) outside = false;
        }
        if (!outside) continue;
        sizes.push_back(3);
        for (const std::size_t v : {i, j, k}) loops.push_back(static_cast<std::uint32_t>(v));
      }
    }
  }
  return HullGeometry::create(points, sizes, loops).hull;
}

// Points on an ellipsoid with half axes between size / 3 and size: all of them are corners.
inline std::shared_ptr<const HullGeometry> random_hull(Random& random, int count, double size) {
  for (;;) {
    const V axes(random.uniform(0.33, 1), random.uniform(0.33, 1), random.uniform(0.33, 1));
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      points.push_back((size * axes.cwiseProduct(random.direction())).cast<Real>());
    }
    auto hull = hull_of_points(points);
    if (hull != nullptr && hull->inner_radius() > Real(0.1 * size)) return hull;
  }
}

// A sphere, capsule, box or hull of so many corners, by its kind 0 to 3; sides between `least` of
// the size [m] and the size.
inline Shape random_shape(Random& random, int kind, double size, double least,
                          int hull_corners = 8) {
  const auto side = [&] { return static_cast<Real>(size * random.uniform(least, 1)); };
  switch (kind) {
    case 0:
      return Sphere{side()};
    case 1:
      return Capsule{side(), side()};
    case 2:
      return Box{Vec3(side(), side(), side())};
    default:
      return ConvexHull{random_hull(random, hull_corners, size)};
  }
}

// A prism over a regular polygon: faces of many corners, many of them parallel.
inline std::shared_ptr<const HullGeometry> prism(int sides, double radius, double half_height) {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> sizes, loops;
  const double pi = std::acos(-1.0);
  const auto n = static_cast<std::uint32_t>(sides);
  for (int level = 0; level < 2; ++level) {
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * pi * i / sides;
      points.push_back(
          V(radius * std::cos(a), level == 0 ? -half_height : half_height, radius * std::sin(a))
              .cast<Real>());
    }
  }
  sizes.push_back(n);
  for (std::uint32_t i = 0; i < n; ++i) loops.push_back(i);
  sizes.push_back(n);
  for (std::uint32_t i = 0; i < n; ++i) loops.push_back(2 * n - 1 - i);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    sizes.push_back(4);
    for (const std::uint32_t v : {j, i, n + i, n + j}) loops.push_back(v);
  }
  return HullGeometry::create(points, sizes, loops).hull;
}

}  // namespace plumb::inline PLUMB_ABI::oracle
