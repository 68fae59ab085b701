// The worst overlap of a scene: a sweep over the bodies' boxes, then every feature against every
// feature (support/collision_oracle.h).
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "bench/anchors/judge/check.h"
#include "support/collision_oracle.h"

namespace plumb::anchors {
namespace {

struct Placed {
  oracle::Solid solid;
  Vector3d lower, upper;  // [m] bounds
};

Placed place(const Scene& scene, const Shape& shape, const Vector3d& p, const Quaterniond& q) {
  Placed out;
  oracle::Solid& s = out.solid;
  const auto corner = [&](const Vector3d& at) { s.vertices.push_back(p + q * at); };
  switch (shape.kind) {
    case ShapeKind::Sphere:
      s.vertices = {p};
      s.radius = shape.radius;
      break;
    case ShapeKind::Capsule:
      corner({0, -shape.half_length, 0});
      corner({0, shape.half_length, 0});
      s.edges = {{0, 1}};
      s.radius = shape.radius;
      break;
    case ShapeKind::Plane:  // as the box that stands for it
    case ShapeKind::Box:
      for (int i = 0; i < 8; ++i)
        corner(Vector3d((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)
                   .cwiseProduct(shape.half) -
               Vector3d(0, shape.kind == ShapeKind::Plane ? shape.half.y() : 0, 0));
      for (const auto& loop : {std::vector<int>{0, 4, 6, 2},
                               {1, 3, 7, 5},
                               {0, 1, 5, 4},
                               {2, 6, 7, 3},
                               {0, 2, 3, 1},
                               {4, 5, 7, 6}})
        oracle::add_face(s, loop);
      break;
    case ShapeKind::Hull:
      for (const Vector3d& at : scene.hulls[shape.hull].points) corner(at);
      for (const auto& t : scene.hulls[shape.hull].triangles)
        oracle::add_face(s,
                         {static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
      break;
    case ShapeKind::Mesh:
    case ShapeKind::None:
      break;
  }
  out.lower = Vector3d::Constant(std::numeric_limits<double>::infinity());
  out.upper = -out.lower;
  for (const Vector3d& v : s.vertices) {
    out.lower = out.lower.cwiseMin(v);
    out.upper = out.upper.cwiseMax(v);
  }
  out.lower.array() -= s.radius;
  out.upper.array() += s.radius;
  return out;
}

// [m] 0 where they are apart. Spares the distance of what is apart for certain.
double overlap(const oracle::Solid& a, const oracle::Solid& b) {
  if (!a.faces.empty() || !b.faces.empty()) {
    const double room = oracle::best_facet_room(a, b);
    if (room >= 0) return 0;
    if (a.radius + b.radius == 0) return -room;
  }
  return std::max(0.0, -oracle::signed_distance(a, b));
}

// The mesh's height field seen from above: which triangle is below a point.
struct Below {
  explicit Below(const Mesh& mesh) : mesh_(mesh) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t];
      const Vector3d middle = (mesh.vertices[c[0]] + mesh.vertices[c[1]] + mesh.vertices[c[2]]) / 3;
      lists_[key(middle.x(), middle.z())].push_back(t);
    }
  }
  // How far p lies below the plane of the triangle above or below it [m]; negative above it.
  [[nodiscard]] double depth(const Vector3d& p) const {
    const auto found = lists_.find(key(p.x(), p.z()));
    if (found == lists_.end()) return -1;
    for (const std::uint32_t t : found->second) {
      const auto& c = mesh_.triangles[t];
      const Vector3d &a = mesh_.vertices[c[0]], &b = mesh_.vertices[c[1]],
                     &d = mesh_.vertices[c[2]];
      const auto left = [&](const Vector3d& u, const Vector3d& v) {
        return (v.z() - u.z()) * (p.x() - u.x()) - (v.x() - u.x()) * (p.z() - u.z());
      };
      if (left(a, b) >= 0 && left(b, d) >= 0 && left(d, a) >= 0)
        return -(b - a).cross(d - a).normalized().dot(p - a);
    }
    return -1;
  }

 private:
  static std::int64_t key(double x, double z) {
    return static_cast<std::int64_t>(std::floor(x)) * 1000003 +
           static_cast<std::int64_t>(std::floor(z));
  }
  const Mesh& mesh_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> lists_;  // by cell of a metre
};

}  // namespace

double worst_penetration(const Scene& scene, const std::vector<BodyState>& bodies) {
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].position.allFinite()) continue;
    placed.push_back(
        place(scene, scene.bodies[i].shape, bodies[i].position, bodies[i].orientation));
  }
  double worst = 0;
  const auto look = [&](const Placed& a, const Placed& b) {
    if ((a.lower.array() > b.upper.array()).any() || (b.lower.array() > a.upper.array()).any())
      return;
    worst = std::max(worst, overlap(a.solid, b.solid));
  };
  for (const Body& body : scene.ground) {
    if (body.shape.kind == ShapeKind::Mesh) continue;
    const Placed ground = place(scene, body.shape, body.position, body.orientation);
    for (const Placed& other : placed) look(other, ground);
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.lower.x() < b.lower.x(); });
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t j = i + 1; j < placed.size() && placed[j].lower.x() <= placed[i].upper.x();
         ++j)
      look(placed[i], placed[j]);
  return worst;
}

double depth_under_mesh(const Scene& scene, const std::vector<BodyState>& bodies) {
  if (scene.mesh.triangles.empty()) return 0;
  const Below below(scene.mesh);
  double worst = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].position.allFinite()) continue;
    const Placed body =
        place(scene, scene.bodies[i].shape, bodies[i].position, bodies[i].orientation);
    for (const Vector3d& v : body.solid.vertices)
      worst = std::max(worst, below.depth(v) + body.solid.radius);
  }
  return worst;
}

}  // namespace plumb::anchors
