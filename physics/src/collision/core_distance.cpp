#include "collision/core_distance.h"

#include "collision/gjk.h"
#include "collision/round_core.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// In the half-plane through the axis and the point: r >= 0 away from the axis, y along it.
struct Flat {
  Num r, y;
};
struct FlatDistance {
  Num distance;
  Flat outward;
};

FlatDistance away_from(Flat corner, Flat point, Flat fallback) {
  const Flat d{point.r - corner.r, point.y - corner.y};
  const Num size = std::sqrt(d.r * d.r + d.y * d.y);
  if (!(size > Num(0))) return {Num(0), fallback};
  return {size, {d.r / size, d.y / size}};
}

FlatDistance to_cylinder(Flat p, Num radius, Num half) {
  const Num side = p.r - radius, end = std::abs(p.y) - half, up = p.y < Num(0) ? Num(-1) : Num(1);
  if (side > Num(0) && end > Num(0)) return away_from({radius, up * half}, p, {Num(1), Num(0)});
  if (end >= side) return {end, {Num(0), up}};
  return {side, {Num(1), Num(0)}};
}

FlatDistance to_cone(Flat p, Num radius, Num half) {
  const Num height = Num(2) * half, slant = std::sqrt(radius * radius + height * height);
  const Flat normal{height / slant, radius / slant};  // of the slanted side
  const Num base = -half - p.y;
  const Num side = normal.r * p.r + normal.y * (p.y - half);
  // Along the side, from the rim (0) to the apex (slant).
  const Num along = (height * (p.y + half) - radius * (p.r - radius)) / slant;
  if (base >= side && p.r <= radius) return {base, {Num(0), Num(-1)}};
  if (side <= Num(0) && base <= Num(0)) {
    return base > side ? FlatDistance{base, {Num(0), Num(-1)}} : FlatDistance{side, normal};
  }
  if (along <= Num(0)) {
    if (p.r <= radius) return {base, {Num(0), Num(-1)}};
    return away_from({radius, -half}, p, normal);
  }
  if (along >= slant) return away_from({Num(0), half}, p, {Num(0), Num(1)});
  return {side, normal};
}

CoreDistance distance_to_round(const CollisionShape& shape, NumVec point) {
  const NumVec half = to_num(shape.half);
  const NumVec aside{point.x, Num(0), point.z};
  const Flat p{length(aside), point.y};
  const FlatDistance flat = shape.type == ShapeType::Cylinder ? to_cylinder(p, half.x, half.y)
                                                              : to_cone(p, half.x, half.y);
  const NumVec radial = normalized_or(aside, NumVec{1, 0, 0});
  return {flat.distance, flat.outward.r * radial + NumVec{0, flat.outward.y, 0}};
}

// Of spheres, capsules and boxes: from the nearest point of the box of half extents.
CoreDistance distance_to_box(NumVec x, NumVec half) {
  const NumVec d = x - max_each(-half, min_each(half, x));
  return {length(d), normalized_or(d, NumVec{0, 0, 0})};
}

CoreDistance distance_to_hull(NumVec x, const HullGeometry& hull) {
  const std::vector<Vec3>& vertices = hull.vertices();
  const auto farthest = [&vertices](NumVec d) {
    NumVec best = to_num(vertices[0]);
    for (const Vec3& v : vertices) {
      const NumVec vertex = to_num(v);
      if (dot(vertex, d) > dot(best, d)) best = vertex;
    }
    return best;
  };
  const GjkResult closest = gjk_distance(
      farthest, [x](NumVec) { return x; }, x - to_num(hull.interior_point()),
      static_cast<Num>(hull.outer_radius()));
  if (closest.overlap) return {Num(0), {0, 0, 0}};
  return {closest.distance, closest.normal};
}

}  // namespace

CoreDistance distance_to_core(const CollisionShape& shape, NumVec point) {
  switch (shape.type) {
    case ShapeType::Cylinder:
    case ShapeType::Cone:
      return distance_to_round(shape, point);
    case ShapeType::Hull:
      return distance_to_hull(point, *shape.hull);
    case ShapeType::Sphere:
    case ShapeType::Capsule:
    case ShapeType::Box:
      return distance_to_box(point, to_num(shape.half));
    case ShapeType::HalfSpace:
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      break;
  }
  const NumVec n = normalized_or(to_num(shape.normal), NumVec{0, 1, 0});
  return {dot(n, point) - static_cast<Num>(shape.offset), n};
}

}  // namespace plumb::inline PLUMB_ABI::detail
