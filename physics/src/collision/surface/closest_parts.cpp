// Closest points where a shape has parts: the nearest part, found by trees.
#include <cmath>
#include <limits>

#include "collision/collide_parts.h"
#include "collision/gjk.h"
#include "collision/surface/composite_shape.h"
#include "collision/surface/heightfield_surface.h"
#include "collision/surface/mesh_surface.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Num kInfinity = std::numeric_limits<Num>::infinity();

Proximity turned_around(const Proximity& p) { return {p.distance, p.on_b, p.on_a, -p.normal}; }

// A triangle as a core for distances: a hull has no place for it, so that it is given by its
// support.
NumVec farthest(const SurfaceTriangle& t, NumVec d) {
  const Num a = dot(t.corner[0], d), b = dot(t.corner[1], d), c = dot(t.corner[2], d);
  return t.corner[a >= b ? (a >= c ? 0 : 2) : (b >= c ? 1 : 2)];
}

struct Nearest {
  Num distance = kInfinity;  // [m] of the cores, 0 where they overlap
  NumVec on_surface{0, 0, 0}, on_core{0, 0, 0}, normal{0, 1, 0};
};

template <class Surface, class Support>
Nearest nearest_triangle(const Surface& surface, const Support& support, NumVec middle, Num size,
                         const NumBox& core) {
  Nearest best;
  surface.nearest(core, kInfinity, [&](const SurfaceTriangle& t, Num largest) {
    const GjkResult cores = gjk_distance([&](NumVec d) { return farthest(t, d); }, support,
                                         middle - t.corner[0], size + length(t.along(0)));
    const Num distance = cores.overlap ? Num(0) : cores.distance;
    if (!(distance < best.distance)) return largest;
    best = {distance, cores.on_a, cores.on_b, cores.overlap ? t.normal : cores.normal};
    return distance * distance;
  });
  return best;
}

// The surface is the first shape.
Proximity from_surface(const CollisionShape& surface, const Transform& xs,
                       const CollisionShape& convex, const Transform& xc) {
  const Placement s = to_placement(xs), c = to_placement(xc);
  const NumRotation back = conjugate(s.q);
  const NumVec p = rotate(back, c.p - s.p);
  const NumMatrix R = to_matrix(back * c.q);
  const Num radius = convex.radius, size = static_cast<Num>(bounding_radius(convex));
  const auto support_of = [&](NumVec d) {
    return R * cast<Num>(support(
                   convex, cast<Real>(normalized_or(transpose_times(R, d), NumVec{0, 1, 0})))) +
           p;
  };
  const NumVec low{support_of({-1, 0, 0}).x, support_of({0, -1, 0}).y, support_of({0, 0, -1}).z};
  const NumVec high{support_of({1, 0, 0}).x, support_of({0, 1, 0}).y, support_of({0, 0, 1}).z};
  const NumBox core{low, high};
  const NumVec middle = Num(0.5) * (low + high);
  const Nearest found = surface.type == ShapeType::Mesh
                            ? nearest_triangle(MeshSurface(*surface.mesh, cast<Num>(surface.scale)),
                                               support_of, middle, size, core)
                            : nearest_triangle(HeightfieldSurface(*surface.heightfield), support_of,
                                               middle, size, core);
  const Num distance = std::max(found.distance - radius, Num(0));
  NumVec on_core = found.on_core - std::min(radius, found.distance) * found.normal;
  NumVec on_surface = found.on_surface;
  if (!(distance > Num(0))) on_core = on_surface;
  const auto out = [&](NumVec v) { return cast<Real>(s.p + rotate(s.q, v)); };
  return {static_cast<Real>(distance), out(on_surface), out(on_core),
          cast<Real>(normalized_or(rotate(s.q, found.normal), NumVec{0, 1, 0}))};
}

Proximity of_pieces(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                    const Transform& xb) {
  if (is_surface(a.type) && !is_surface(b.type) && b.type != ShapeType::HalfSpace)
    return from_surface(a, xa, b, xb);
  if (is_surface(b.type) && !is_surface(a.type) && a.type != ShapeType::HalfSpace)
    return turned_around(from_surface(b, xb, a, xa));
  if (is_surface(a.type) || is_surface(b.type))  // never asked for a contact: reported as touching
    return {0, xa.p, xa.p, {0, 1, 0}};
  return closest_points(a, xa, b, xb);
}

}  // namespace

Proximity closest_parts(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                        const Transform& xb) {
  const auto pieces = [](const CollisionShape& s) {
    return s.type == ShapeType::Compound ? s.compound->children.size() : std::size_t{1};
  };
  Proximity best{std::numeric_limits<Real>::infinity(), xa.p, xb.p, {0, 1, 0}};
  for (std::size_t i = 0; i < pieces(a); ++i) {
    const bool of_a = a.type == ShapeType::Compound;
    const CollisionShape& shape_a = of_a ? a.compound->children[i].shape : a;
    const Transform x_a = of_a ? xa * a.compound->children[i].placed : xa;
    for (std::size_t k = 0; k < pieces(b); ++k) {
      const bool of_b = b.type == ShapeType::Compound;
      const CollisionShape& shape_b = of_b ? b.compound->children[k].shape : b;
      const Transform x_b = of_b ? xb * b.compound->children[k].placed : xb;
      const Proximity here = of_pieces(shape_a, x_a, shape_b, x_b);
      if (here.distance < best.distance) best = here;
    }
  }
  return best;
}

}  // namespace plumb::inline PLUMB_ABI::detail
