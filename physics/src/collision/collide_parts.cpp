#include "collision/collide_parts.h"

#include <algorithm>

#include "collision/surface/composite_shape.h"
#include "collision/surface/finish_parts.h"
#include "collision/surface/heightfield_surface.h"
#include "collision/surface/mesh_surface.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// What one side of a pair is made of: the shape itself, or the children of a compound.
struct Piece {
  const CollisionShape& shape;
  Transform placed;
};

// A convex shape in a frame, and its bounds there, with room for the rounding of bounds_of().
NumBox bounds_in(const CollisionShape& shape, const Placement& at, Num margin) {
  const Transform turned{{0, 0, 0},
                         {static_cast<Real>(at.q.x), static_cast<Real>(at.q.y),
                          static_cast<Real>(at.q.z), static_cast<Real>(at.q.w)}};
  const Aabb box = bounds_of(shape, turned);
  const Num room = margin + 16 * static_cast<Num>(std::numeric_limits<Real>::epsilon()) *
                                static_cast<Num>(bounding_radius(shape));
  const NumVec grow{room, room, room};
  return {at.p + cast<Num>(box.lower) - grow, at.p + cast<Num>(box.upper) + grow};
}

template <class Surface>
void touch_triangles(const Surface& surface, const ConvexOnSurface& on, const NumBox& box,
                     PartManifolds& out) {
  TriangleContact contact;
  const auto each = [&](auto&& touch) {
    surface.query(box, [&](SurfaceTriangle& t) {
      if (touch(t)) gather(out, on, t, contact);
    });
  };
  const auto grown = [&](const ConvexCore& core) {
    if (on.rounding > Num(0)) grow_contact(on, core, contact);
    return true;
  };
  switch (on.shape.type) {
    case ShapeType::Sphere:
      each([&](SurfaceTriangle& t) { return touch_sphere(on, t, contact); });
      return;
    case ShapeType::Capsule:
      each([&](SurfaceTriangle& t) { return touch_capsule(on, t, contact); });
      return;
    case ShapeType::Box:
    case ShapeType::Hull: {
      const PlacedPolyhedron polyhedron(on.shape, on.R, on.p);
      const ConvexCore core({on.shape, on.p, on.q}, &polyhedron);
      each([&](SurfaceTriangle& t) {
        return touch_polyhedron(on, polyhedron, t, contact) && grown(core);
      });
      return;
    }
    case ShapeType::Cylinder:
    case ShapeType::Cone: {
      const ConvexCore core({on.shape, on.p, on.q}, nullptr);
      each([&](SurfaceTriangle& t) { return touch_round(on, core, t, contact) && grown(core); });
      return;
    }
    case ShapeType::HalfSpace:
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      return;
  }
}

// Points in the order of the names that the convex shape has for them, as on a face: what rolls
// keeps that order, while it turns against the axes that gather() goes by.
void order_by_core(Manifold& m, bool core_first) {
  const auto name = [core_first](const ManifoldPoint& p) {
    return core_first ? p.feature : swapped_name(p.feature);
  };
  std::sort(m.points, m.points + m.count,
            [&](const ManifoldPoint& a, const ManifoldPoint& b) { return name(a) < name(b); });
}

void collide_surface(const Piece& surface, const Piece& convex, bool swapped, Real margin,
                     bool held, PartManifolds& out) {
  const Placement s = to_placement(surface.placed), c = to_placement(convex.placed);
  const NumRotation to_surface = conjugate(s.q);
  const Placement at{rotate(to_surface, c.p - s.p), to_surface * c.q};
  if (!is_finite(at.p) || !is_finite(at.q)) return;
  const NumMatrix R = to_matrix(at.q);
  const CollisionShape& shape = convex.shape;
  const NumVec middle =
      shape.type == ShapeType::Hull ? R * to_num(shape.hull->interior_point()) + at.p : at.p;
  const Num thickness = Num(0.5) * static_cast<Num>(smallest_thickness(shape));
  const NumBox box = bounds_in(shape, at, static_cast<Num>(margin));
  // All cores but points and segments meet the triangles at the distance of their rounding.
  const bool round = shape.type == ShapeType::Sphere || shape.type == ShapeType::Capsule;
  const Num rounding = round ? Num(0) : static_cast<Num>(shape.radius);
  out.group_count = 0;
  const auto run = [&](const auto& triangles) {
    const ConvexOnSurface on{shape,
                             at.p,
                             at.q,
                             R,
                             static_cast<Num>(margin) + rounding,
                             rounding,
                             thickness,
                             middle,
                             (held ? kBehindWhenHeld : kBehind) * thickness,
                             triangles};
    touch_triangles(triangles, on, box, out);
  };
  if (surface.shape.type == ShapeType::Mesh) {
    run(MeshSurface(*surface.shape.mesh, cast<Num>(surface.shape.scale)));
  } else {
    run(HeightfieldSurface(*surface.shape.heightfield));
  }
  const std::size_t begin = out.parts.size();
  finish_parts(out, {s.p, s.q}, thickness, swapped, out.parts);
  if (!is_curved(shape.type)) return;
  for (std::size_t i = begin; i < out.parts.size(); ++i)
    order_by_core(out.parts[i].manifold, swapped);
}

// Of two shapes without children. Appends to out.parts.
void collide_pieces(const Piece& a, const Piece& b, Real margin, bool held, PartManifolds& out) {
  const bool surface_a = is_surface(a.shape.type), surface_b = is_surface(b.shape.type);
  if (surface_a || surface_b) {
    const ShapeType other = surface_a ? b.shape.type : a.shape.type;
    if ((surface_a && surface_b) || other == ShapeType::HalfSpace) return;
    collide_surface(surface_a ? a : b, surface_a ? b : a, surface_b, margin, held, out);
    return;
  }
  Manifold manifold;
  if (collide(a.shape, a.placed, b.shape, b.placed, margin, manifold))
    out.parts.push_back({0, manifold, 0, 0});
}

// Numbers of two levels in one: children of both compounds, and the part below them.
std::uint32_t joint_part(std::uint32_t a, std::uint32_t b, std::uint32_t below) {
  if (below == 0) return a << 16 | b;
  // Below a child lie planes and features of a surface: spread them so that children do not share.
  constexpr std::uint32_t kOdd = 0x9e3779b1U;  // golden ratio times 2^32, made odd
  return below ^ (a << 16 | b) * kOdd;
}

// visit(child number, piece) for the children of `of` whose boxes come near `other`; the shape
// itself if it has none.
template <class Visit>
void each_piece(const CollisionShape& of, const Transform& x, const CollisionShape& other,
                const Transform& x_other, Real margin, std::vector<std::uint32_t>& near,
                Visit&& visit) {
  if (of.type != ShapeType::Compound) {
    visit(0U, Piece{of, x});
    return;
  }
  const CompoundData& compound = *of.compound;
  near.clear();
  if (other.type == ShapeType::HalfSpace || is_surface(other.type)) {
    for (std::uint32_t i = 0; i < compound.children.size(); ++i) near.push_back(i);
  } else {
    const Placement at = to_placement(x), o = to_placement(x_other);
    const NumRotation back = conjugate(at.q);
    const NumBox box =
        bounds_in(other, {rotate(back, o.p - at.p), back * o.q}, static_cast<Num>(margin));
    compound.tree.query(box, [&](std::uint32_t place) { near.push_back(compound.order[place]); });
    std::sort(near.begin(), near.end());
  }
  for (const std::uint32_t i : near)
    visit(i, Piece{compound.children[i].shape, x * compound.children[i].placed});
}

}  // namespace

bool collide_parts(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                   const Transform& xb, Real margin, PartManifolds& out, bool held) {
  out.parts.clear();
  std::vector<std::uint32_t> near_a, near_b;  // stay empty, without storage, but for compounds
  each_piece(a, xa, b, xb, margin, near_a, [&](std::uint32_t i, const Piece& piece_a) {
    each_piece(b, xb, piece_a.shape, piece_a.placed, margin, near_b,
               [&](std::uint32_t k, const Piece& piece_b) {
                 const std::size_t begin = out.parts.size();
                 collide_pieces(piece_a, piece_b, margin, held, out);
                 for (std::size_t n = begin; n < out.parts.size(); ++n) {
                   out.parts[n].part = joint_part(i, k, out.parts[n].part);
                   out.parts[n].radius_a = piece_a.shape.radius;
                   out.parts[n].radius_b = piece_b.shape.radius;
                 }
               });
  });
  // Distinct numbers, however the children's were spread.
  const auto before = [](const PartManifold& x, const PartManifold& y) { return x.part < y.part; };
  std::stable_sort(out.parts.begin(), out.parts.end(), before);
  for (std::size_t n = 1; n < out.parts.size(); ++n)
    out.parts[n].part = std::max(out.parts[n].part, out.parts[n - 1].part + 1);
  return !out.parts.empty();
}

bool collide_deepest_part(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                          const Transform& xb, Real margin, Manifold& out) {
  PartManifolds all;
  collide_parts(a, xa, b, xb, margin, all);
  Real deepest = std::numeric_limits<Real>::infinity();
  for (const PartManifold& part : all.parts) {
    for (int i = 0; i < part.manifold.count; ++i) {
      if (!(part.manifold.points[i].separation < deepest)) continue;
      deepest = part.manifold.points[i].separation;
      out = part.manifold;
    }
  }
  return !all.parts.empty();
}

}  // namespace plumb::inline PLUMB_ABI::detail
