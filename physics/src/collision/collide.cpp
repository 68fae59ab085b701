// Puts a pair into its one order, calls the routine of its kinds, and hands the result back in the
// caller's order. Swapping the arguments therefore gives the same bits with the normal negated.
#include "collision/collide.h"

#include "collision/collide_pairs.h"
#include "collision/collide_parts.h"
#include "collision/core_distance.h"
#include "collision/separating_face.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// By first, then second shape, in the order of ShapeType: sphere, capsule, box, hull, half-space,
// cylinder, cone.
constexpr PairRoutine kRoutines[kShapeTypeCount][kShapeTypeCount] = {
    {collide_spheres, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
    {collide_capsule_sphere, collide_capsules, nullptr, nullptr, nullptr, nullptr, nullptr},
    {collide_box_sphere, collide_box_capsule, collide_boxes, collide_polyhedra, nullptr,
     collide_curved, collide_curved},
    {collide_hull_sphere, collide_hull_capsule, collide_polyhedra, collide_polyhedra, nullptr,
     collide_curved, collide_curved},
    {collide_half_space_sphere, collide_half_space_capsule, collide_half_space_box,
     collide_half_space_hull, nullptr, collide_half_space_curved, collide_half_space_curved},
    {collide_curved_sphere, collide_curved, collide_curved, collide_curved, nullptr, collide_curved,
     collide_curved},
    {collide_curved_sphere, collide_curved, collide_curved, collide_curved, nullptr, collide_curved,
     collide_curved},
};

int rank(ShapeType type) {
  switch (type) {
    case ShapeType::Sphere:
      return 0;
    case ShapeType::Capsule:
      return 1;
    case ShapeType::Box:
    case ShapeType::Hull:
    case ShapeType::Cylinder:
    case ShapeType::Cone:
      return 2;
    case ShapeType::HalfSpace:
      return 3;
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      break;  // never asked: collide_parts() takes them apart first
  }
  return 0;
}

// Squared [m^2]; only compared within a rank.
Real size_squared(const CollisionShape& shape) {
  if (shape.type == ShapeType::Hull) return shape.hull->outer_radius() * shape.hull->outer_radius();
  return length_squared(shape.half) + shape.radius * shape.radius;
}

// Between shapes of one size the order comes from the placement: along a direction that no scene is
// likely to be built across, so that the order of two resting bodies holds.
bool placed_after(const Transform& xa, const Transform& xb) {
  constexpr NumVec kGeneric{0.3597, 0.8003, 0.4797};
  const Num along = dot(to_num(xb.p) - to_num(xa.p), kGeneric);
  if (along != Num(0)) return along < Num(0);
  const Real ka[7] = {xa.p.x, xa.p.y, xa.p.z, xa.q.x, xa.q.y, xa.q.z, xa.q.w};
  const Real kb[7] = {xb.p.x, xb.p.y, xb.p.z, xb.q.x, xb.q.y, xb.q.z, xb.q.w};
  return std::lexicographical_compare(kb, kb + 7, ka, ka + 7);
}

bool goes_second(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                 const Transform& xb) {
  const int rank_a = rank(a.type), rank_b = rank(b.type);
  if (rank_a != rank_b) return rank_a < rank_b;
  const Real size_a = size_squared(a), size_b = size_squared(b);
  if (size_a != size_b) return size_a < size_b;
  if (a.type != b.type) return a.type < b.type;
  return placed_after(xa, xb);
}

// [m] The radii that a pair's routine leaves out: of a core with flat faces always, of spheres and
// capsules where they meet a curved core.
struct AddedRadii {
  Num first, second;
};
AddedRadii added_radii(const CollisionShape& first, const CollisionShape& second) {
  const bool curved = is_curved(first.type) || is_curved(second.type);
  const auto of = [curved](const CollisionShape& s) {
    const bool own = s.type == ShapeType::Sphere || s.type == ShapeType::Capsule;
    return own && !curved ? Num(0) : static_cast<Num>(s.radius);
  };
  return {of(first), of(second)};
}

// By how much less than its radius the grown surface lies from a point of the core, along n [m].
Num missed(const Placed& x, Num radius, NumVec on_core, NumVec n) {
  if (!(radius > Num(0))) return Num(0);
  const NumVec local = rotate(conjugate(x.q), on_core + radius * n - x.p);
  return radius - distance_to_core(x.shape, local).distance;
}

// Grows both shapes. A core's point, moved out by the radius along the normal, lies on the grown
// surface where the core rests on it; where the core only has a face that looks elsewhere it lies
// inside, and goes. The deepest point stays.
void grow(const Placed& a, const Placed& b, const AddedRadii& radii, Contacts& contacts) {
  const NumVec n = contacts.normal;
  int deepest = 0, kept = 0;
  for (int i = 1; i < contacts.count; ++i) {
    if (contacts.points[i].separation < contacts.points[deepest].separation) deepest = i;
  }
  for (int i = 0; i < contacts.count; ++i) {
    ContactPoint point = contacts.points[i];
    const NumVec half_way = (Num(0.5) * point.separation) * n;
    if (i != deepest &&
        (missed(a, radii.first, point.position - half_way, n) > kGrownMiss * radii.first ||
         missed(b, radii.second, point.position + half_way, -n) > kGrownMiss * radii.second)) {
      continue;
    }
    point.separation -= radii.first + radii.second;
    point.position += (Num(0.5) * (radii.first - radii.second)) * n;
    contacts.points[kept++] = point;
  }
  contacts.count = kept;
}

NumRotation unit_rotation(Rotation q) { return normalized(NumRotation{q.x, q.y, q.z, q.w}); }

// One sum finds any number that is not finite; finite single coordinates cannot overflow it.
bool is_placed(NumVec p, NumRotation a, NumRotation b) {
  return std::isfinite(p.x + p.y + p.z + a.x + a.y + a.z + a.w + b.x + b.y + b.z + b.w);
}

}  // namespace

bool collide(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
             const Transform& xb, Real margin, Manifold& out, PairMemory* memory) {
  out.count = 0;
  if (has_parts(a.type) || has_parts(b.type))
    return collide_deepest_part(a, xa, b, xb, margin, out);
  const bool swap = goes_second(a, xa, b, xb);
  const CollisionShape& first = swap ? b : a;
  const CollisionShape& second = swap ? a : b;
  const Transform& x_first = swap ? xb : xa;
  const Transform& x_second = swap ? xa : xb;
  const PairRoutine routine =
      kRoutines[static_cast<int>(first.type)][static_cast<int>(second.type)];
  if (routine == nullptr) return false;

  const NumVec origin = to_num(x_first.p), offset = to_num(x_second.p) - origin;
  const NumRotation q_first = unit_rotation(x_first.q), q_second = unit_rotation(x_second.q);
  if (!is_placed(offset, q_first, q_second)) return false;
  const AddedRadii radii = added_radii(first, second);
  const Num added = radii.first + radii.second;
  const Placed placed_first{first, {0, 0, 0}, q_first}, placed_second{second, offset, q_second};
  const Num reach = static_cast<Num>(margin) + added;
  Contacts contacts;
  const auto remember = [&](Num gap_of_cores) {
    if (memory == nullptr) return;
    memory->axis = swap ? contacts.axis.swapped() : contacts.axis;
    const auto gap = static_cast<Real>(gap_of_cores - added);
    memory->gap = gap > Real(0) ? gap : Real(0);
  };
  if (memory != nullptr) {
    contacts.axis = swap ? memory->axis.swapped() : memory->axis;
    const Num gap = gap_along(contacts.axis, placed_first, placed_second);
    if (gap > reach) {
      remember(gap);
      return false;
    }
  }
  routine(placed_first, placed_second, reach, contacts);
  remember(contacts.count == 0 ? contacts.gap : added);
  if (contacts.count == 0) return false;
  if (added > Num(0)) grow(placed_first, placed_second, radii, contacts);

  // Turning a normal into world axes leaves it a few roundings away from unit length.
  const NumVec normal = (Num(1) / length(contacts.normal)) * contacts.normal;
  out.normal = cast<Real>(swap ? -normal : normal);
  out.count = contacts.count;
  for (int i = 0; i < contacts.count; ++i) {
    const ContactPoint& point = contacts.points[i];
    out.points[i] = {cast<Real>(origin + point.position), static_cast<Real>(point.separation),
                     swap ? swapped_name(point.feature) : point.feature};
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
