// The pair routines behind collide(), one for each pair of kinds. The first shape is the "greater"
// one: half-space, then polyhedra (the larger first), then capsule, then sphere. Each leaves
// out.count = 0 where nothing lies within the margin. The radii of spheres and capsules are the
// routines' business, the rounding of the others is not: collide() adds it (see added_radii).
#pragma once

#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

using PairRoutine = void (*)(const Placed& a, const Placed& b, Num margin, Contacts& out);

void collide_spheres(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_capsule_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_capsules(const Placed& a, const Placed& b, Num margin, Contacts& out);

void collide_box_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_box_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_boxes(const Placed& a, const Placed& b, Num margin, Contacts& out);

void collide_hull_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_hull_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out);
// Hull against hull, hull against box, box against hull.
void collide_polyhedra(const Placed& a, const Placed& b, Num margin, Contacts& out);

void collide_half_space_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_half_space_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_half_space_box(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_half_space_hull(const Placed& a, const Placed& b, Num margin, Contacts& out);

// Cylinders and cones: the sharp cores of both shapes, also of spheres and capsules.
void collide_curved(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_curved_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out);
void collide_half_space_curved(const Placed& a, const Placed& b, Num margin, Contacts& out);

}  // namespace plumb::inline PLUMB_ABI::detail
