// Rays against meshes, heightfields and compounds.
#include <cmath>

#include "collision/collide_parts.h"
#include "collision/surface/composite_shape.h"
#include "collision/surface/heightfield_surface.h"
#include "collision/surface/mesh_surface.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A ray against triangles such that none slips through between two of them: corners are sheared
// into the plane across the ray, where both triangles of an edge compute the same product for it,
// with the opposite sign [Woop 2013].
class TriangleCast {
 public:
  TriangleCast(NumVec origin, NumVec direction) : origin_(origin), direction_(direction) {
    const NumVec m = absolute(direction);
    z_ = m.x >= m.y ? (m.x >= m.z ? 0 : 2) : (m.y >= m.z ? 1 : 2);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    const Num along = component(direction, z_);
    shear_x_ = component(direction, x_) / along;
    shear_y_ = component(direction, y_) / along;
    inverse_ = Num(1) / along;
  }

  // Whether the front of the triangle is hit, and where.
  [[nodiscard]] bool hits(const SurfaceTriangle& t, Num& fraction) const {
    if (!(dot(t.normal, direction_) < Num(0))) return false;
    Num x[3], y[3], z[3];
    for (int k = 0; k < 3; ++k) {
      const NumVec v = t.corner[k] - origin_;
      z[k] = component(v, z_);
      x[k] = component(v, x_) - shear_x_ * z[k];
      y[k] = component(v, y_) - shear_y_ * z[k];
    }
    const Num u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2],
              w = x[1] * y[0] - y[1] * x[0];
    if ((u < Num(0) || v < Num(0) || w < Num(0)) && (u > Num(0) || v > Num(0) || w > Num(0)))
      return false;
    const Num sum = u + v + w;
    if (sum == Num(0)) return false;  // seen edge-on
    fraction = inverse_ * (u * z[0] + v * z[1] + w * z[2]) / sum;
    return fraction >= Num(0);
  }

 private:
  NumVec origin_, direction_;
  int x_, y_, z_;
  Num shear_x_, shear_y_, inverse_;
};

template <class Surface>
bool cast_surface(const Surface& surface, NumVec origin, NumVec direction, Num max_fraction,
                  Num& fraction, NumVec& normal) {
  const TriangleCast ray(origin, direction);
  bool found = false;
  surface.cast_segment(origin, direction, max_fraction, [&](const SurfaceTriangle& t, Num largest) {
    Num at;
    if (!ray.hits(t, at) || !(found ? at < largest : at <= largest)) return largest;
    found = true;
    fraction = at;
    normal = t.normal;
    return at;
  });
  return found;
}

}  // namespace

bool cast_ray_parts(const CollisionShape& shape, NumRotation q, NumVec origin, NumVec direction,
                    Num max_fraction, NumRayHit& hit) {
  const NumRotation back = conjugate(q);
  const NumVec o = rotate(back, origin), d = rotate(back, direction);
  if (!is_finite(o) || !is_finite(d)) return false;
  if (shape.type == ShapeType::Compound) {
    const CompoundData& compound = *shape.compound;
    bool found = false;
    compound.tree.cast(SegmentQuery(o, d), max_fraction, [&](std::uint32_t place, Num largest) {
      const CompoundData::Child& child = compound.children[compound.order[place]];
      const Placement placed = to_placement(child.placed);
      NumRayHit here;
      if (!cast_ray(child.shape, q * placed.q, origin - rotate(q, placed.p), direction, largest,
                    here))
        return largest;
      if (found && !(here.fraction < hit.fraction)) return largest;
      found = true;
      hit = here;
      return here.fraction;
    });
    return found;
  }
  if (!(length_squared(d) > Num(0))) return false;
  Num fraction = 0;
  NumVec normal{0, 1, 0};
  const bool found = shape.type == ShapeType::Mesh
                         ? cast_surface(MeshSurface(*shape.mesh, cast<Num>(shape.scale)), o, d,
                                        max_fraction, fraction, normal)
                         : cast_surface(HeightfieldSurface(*shape.heightfield), o, d, max_fraction,
                                        fraction, normal);
  if (!found) return false;
  hit = {fraction, normalized_or(rotate(q, normal), NumVec{0, 1, 0})};
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
