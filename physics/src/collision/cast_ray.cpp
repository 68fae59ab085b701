// Rays against single shapes, in the shape's frame and in double precision. The boundary belongs to
// the shape: a ray that starts on it starts inside.
#include "collision/collide.h"
#include "collision/collide_parts.h"
#include "collision/contact_points.h"
#include "collision/core_distance.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct Ray {
  NumVec origin, direction;  // [m]
};
enum class Outcome { Miss, Inside, Hit };
struct Hit {
  Outcome outcome;
  Num fraction = 0;
  NumVec normal{0, 1, 0};
};
constexpr Hit kMiss{Outcome::Miss};
constexpr Hit kInside{Outcome::Inside};

// The part of a ray on the inner side of all planes seen so far.
struct Interval {
  Num enter = -std::numeric_limits<Num>::infinity();
  Num leave = std::numeric_limits<Num>::infinity();
  NumVec normal{0, 1, 0};
  bool inside = true;  // the origin lies within all planes

  // height: of the origin above the plane; rise: of the whole ray. False when nothing is left.
  bool cut(Num height, Num rise, NumVec n) {
    if (height > Num(0)) inside = false;
    if (rise == Num(0)) return height <= Num(0);
    const Num t = -height / rise;
    if (rise < Num(0)) {
      if (t > enter) enter = t, normal = n;
    } else if (t < leave) {
      leave = t;
    }
    return enter <= leave;
  }
  [[nodiscard]] Hit result() const {
    if (inside) return kInside;
    if (!(enter >= Num(0))) return kMiss;
    return {Outcome::Hit, enter, normal};
  }
};

// First root of |o + t d|^2 = r^2, o and d taken as given (perpendicular parts for a cylinder). The
// point nearest to the centre comes first, so that a far origin costs no digits.
Hit cast_round(NumVec o, NumVec d, Num radius) {
  const Num squared = length_squared(d);
  if (length_squared(o) <= radius * radius) return kInside;
  if (!(squared > Num(0))) return kMiss;
  const Num nearest = -dot(o, d) / squared;
  const NumVec at_nearest = o + nearest * d;
  const Num room = radius * radius - length_squared(at_nearest);
  if (!(room >= Num(0))) return kMiss;
  const Num back = std::sqrt(room / squared);
  if (!(nearest >= back)) return kMiss;
  return {Outcome::Hit, nearest - back, normalized_or(at_nearest - back * d, {0, 1, 0})};
}

Hit cast_capsule(const Ray& ray, Num half_length, Num radius) {
  const NumVec foot{0, std::clamp(ray.origin.y, -half_length, half_length), 0};
  if (length_squared(ray.origin - foot) <= radius * radius) return kInside;
  Hit first = kMiss;
  const auto consider = [&first](const Hit& hit) {
    if (hit.outcome == Outcome::Hit &&
        (first.outcome == Outcome::Miss || hit.fraction < first.fraction)) {
      first = hit;
    }
  };
  const NumVec o{ray.origin.x, 0, ray.origin.z}, d{ray.direction.x, 0, ray.direction.z};
  const Hit side = cast_round(o, d, radius);
  if (side.outcome == Outcome::Hit &&
      std::abs(ray.origin.y + side.fraction * ray.direction.y) <= half_length) {
    consider(side);
  }
  consider(cast_round(ray.origin - NumVec{0, half_length, 0}, ray.direction, radius));
  consider(cast_round(ray.origin + NumVec{0, half_length, 0}, ray.direction, radius));
  return first;
}

Hit cast_box(const Ray& ray, NumVec half) {
  Interval interval;
  for (int i = 0; i < 3; ++i) {
    const Num o = component(ray.origin, i), d = component(ray.direction, i), h = component(half, i);
    NumVec n{0, 0, 0};
    set_component(n, i, Num(1));
    if (!interval.cut(o - h, d, n) || !interval.cut(-o - h, -d, -n)) return kMiss;
  }
  return interval.result();
}

Hit cast_hull(const Ray& ray, const HullGeometry& hull) {
  Interval interval;
  for (std::size_t k = 0; k < hull.face_count(); ++k) {
    const NumVec n = to_num(hull.face_normals()[k]);
    const Num height = dot(n, ray.origin) - static_cast<Num>(hull.face_offsets()[k]);
    if (!interval.cut(height, dot(n, ray.direction), n)) return kMiss;
  }
  return interval.result();
}

Hit cast_half_space(const Ray& ray, NumVec normal, Num offset) {
  const Num height = dot(normal, ray.origin) - offset, rise = dot(normal, ray.direction);
  if (height <= Num(0)) return kInside;
  if (!(rise < Num(0))) return kMiss;
  return {Outcome::Hit, -height / rise, normal};
}

// A core grown by a radius: the distance from a convex core is a convex function along the ray, so
// that Newton's steps, taken from outside, never pass its first root and meet it quadratically (a
// ray that only grazes: halving the rest each time).
Hit cast_grown(const Ray& ray, const CollisionShape& shape) {
  const Num radius = shape.radius, size = static_cast<Num>(bounding_radius(shape));
  CoreDistance at = distance_to_core(shape, ray.origin);
  if (at.distance - radius <= Num(0)) return kInside;
  Num t = Num(0);
  for (int i = 0; i < kMaxRaySteps; ++i) {
    const Num slope = dot(at.outward, ray.direction);
    if (!(slope < Num(0))) return kMiss;
    const Num step = (at.distance - radius) / -slope;
    const NumVec outward = at.outward;
    t += step;
    const NumVec x = ray.origin + t * ray.direction;
    at = distance_to_core(shape, x);
    const Num left = at.distance - radius;
    const Num rounding = Num(8) * kNumEpsilon * (size + length(x));
    if (left <= rounding) {
      return {Outcome::Hit, t, length_squared(at.outward) > Num(0) ? at.outward : outward};
    }
  }
  return kMiss;
}

Hit cast_shape(const CollisionShape& shape, const Ray& ray) {
  const Num radius = shape.radius;
  switch (shape.type) {
    case ShapeType::Sphere:
      return cast_round(ray.origin, ray.direction, shape.radius);
    case ShapeType::Capsule:
      return cast_capsule(ray, shape.half.y, shape.radius);
    case ShapeType::Box:
      if (!(radius > Num(0))) return cast_box(ray, to_num(shape.half));
      return cast_grown(ray, shape);
    case ShapeType::Hull:
      if (!(radius > Num(0))) return cast_hull(ray, *shape.hull);
      return cast_grown(ray, shape);
    case ShapeType::Cylinder:
    case ShapeType::Cone:
      return cast_grown(ray, shape);
    case ShapeType::HalfSpace:
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      break;
  }
  return cast_half_space(ray, normalized_or(to_num(shape.normal), NumVec{0, 1, 0}),
                         static_cast<Num>(shape.offset));
}

}  // namespace

bool cast_ray(const CollisionShape& shape, NumRotation q, NumVec origin, NumVec direction,
              Num max_fraction, NumRayHit& hit) {
  if (has_parts(shape.type)) return cast_ray_parts(shape, q, origin, direction, max_fraction, hit);
  const NumRotation to_shape = conjugate(q);
  const Hit found = cast_shape(shape, {rotate(to_shape, origin), rotate(to_shape, direction)});
  if (found.outcome == Outcome::Miss) return false;
  if (found.outcome == Outcome::Inside) {
    hit = {0, normalized_or(-direction, NumVec{0, 1, 0})};
    return true;
  }
  if (!(found.fraction <= max_fraction)) return false;
  hit = {found.fraction, normalized_or(rotate(q, found.normal), NumVec{0, 1, 0})};
  return true;
}

bool cast_ray(const CollisionShape& shape, const Transform& placement, Vec origin, Vec direction,
              Real max_fraction, RayHit& hit) {
  const NumRotation q =
      normalized(NumRotation{placement.q.x, placement.q.y, placement.q.z, placement.q.w});
  NumRayHit found;
  if (!cast_ray(shape, q, to_num(origin) - to_num(placement.p), to_num(direction),
                static_cast<Num>(max_fraction), found))
    return false;
  hit = {static_cast<Real>(found.fraction), cast<Real>(found.normal)};
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
