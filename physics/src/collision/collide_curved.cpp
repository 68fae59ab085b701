// Cylinders and cones against every convex shape. All routines here deal with the sharp cores: for
// pairs with a curved core collide() adds the radii of both shapes afterwards, also those of
// spheres and capsules.
#include <optional>

#include "collision/collide_pairs.h"
#include "collision/core_distance.h"
#include "collision/feature_overlay.h"
#include "collision/penetration.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

class CurvedContact {
 public:
  CurvedContact(const ConvexCore& a, const ConvexCore& b, Num thickness, Num margin, Contacts& out)
      : a_(a), b_(b), thickness_(thickness), margin_(margin), out_(out) {}

  void find() {
    RoomAxes axes;
    if (!most_room(a_, b_, thickness_, margin_, axes)) return;
    const bool apart = axes.best.room > Num(0);
    const Num limit = axes.best.room + (apart ? kDeepestTie : kFacePreference) * thickness_;
    if (overlay(axes.preferred, limit)) return;
    const bool same = axes.preferred.room == axes.best.room;
    if (!axes.best.facing) refine_room(a_, b_, thickness_, axes.best);
    if (!same && overlay(axes.best, limit)) return;
    const RoomAxis& axis = axes.best;
    if (!(axis.room <= margin_)) return;
    out_.normal = axis.normal;
    out_.add(Num(0.5) * (axis.on_a + axis.on_b), axis.room,
             pair_name(feature_a_.name, feature_b_.name));
  }

 private:
  // A layer counts only if it holds a point as deep as the cores are along the normal: features
  // beside which they meet do not.
  bool overlay(const RoomAxis& axis, Num limit) {
    a_.feature_facing(axis.normal, polygon_, feature_a_);
    b_.feature_facing(-axis.normal, feature_a_.polygon == nullptr ? polygon_ : other_, feature_b_);
    candidates_.count = 0;
    const Overlay layer{axis.normal, axis.room, kClipBand * thickness_, kDeepestTie * thickness_,
                        margin_};
    if (!(overlay_features(feature_a_, feature_b_, layer, candidates_) <= limit)) return false;
    if (candidates_.count > 0)
      choose_points(candidates_, axis.normal, kDeepestTie * thickness_, out_);
    return true;
  }

  const ConvexCore& a_;
  const ConvexCore& b_;
  Num thickness_, margin_;
  Contacts& out_;
  SupportFeature feature_a_, feature_b_;
  FacePolygon polygon_, other_;
  ContactCandidates candidates_;
};

bool is_polyhedron(const CollisionShape& shape) {
  return shape.type == ShapeType::Box || shape.type == ShapeType::Hull;
}

}  // namespace

void collide_curved(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  std::optional<PlacedPolyhedron> polyhedron;
  for (const Placed* p : {&a, &b}) {
    if (is_polyhedron(p->shape)) polyhedron.emplace(p->shape, to_matrix(p->q), p->p);
  }
  const PlacedPolyhedron* placed = polyhedron ? &*polyhedron : nullptr;
  const ConvexCore core_a(a, is_polyhedron(a.shape) ? placed : nullptr);
  const ConvexCore core_b(b, is_polyhedron(b.shape) ? placed : nullptr);
  const Num thickness = std::min(core_a.half_thickness(), core_b.half_thickness());
  CurvedContact(core_a, core_b, thickness, margin, out).find();
}

void collide_curved_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const CoreDistance d = distance_to_core(a.shape, rotate(conjugate(a.q), b.p));
  if (out.parted(d.distance, margin)) return;
  out.normal = rotate(a.q, d.outward);
  out.add(b.p - Num(0.5) * d.distance * out.normal, d.distance,
          pair_name(face_name(0), face_name(0)));
}

void collide_half_space_curved(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumVec n = rotate(a.q, normalized_or(to_num(a.shape.normal), NumVec{0, 1, 0}));
  const ConvexCore core(b, nullptr);
  SupportFeature plane, feature;
  plane.kind = SupportFeature::Kind::Plane;
  plane.name = face_name(0);
  plane.out = plane.normal = n;
  plane.offset = static_cast<Num>(a.shape.offset);
  const Num room = dot(n, core.support(-n)) - plane.offset;
  if (out.parted(room, margin)) return;
  FacePolygon unused;
  core.feature_facing(-n, unused, feature);
  ContactCandidates candidates;
  candidates.count = 0;
  const Num tie = kDeepestTie * core.half_thickness();
  overlay_features(plane, feature, {n, room, Num(0), tie, margin}, candidates);
  if (candidates.count > 0) {
    choose_points(candidates, n, tie, out);
    return;
  }
  // A sharp rim or apex whose two sides both rise steeply.
  out.normal = n;
  out.add(core.support(-n) - (Num(0.5) * room) * n, room, pair_name(plane.name, feature.name));
}

}  // namespace plumb::inline PLUMB_ABI::detail
