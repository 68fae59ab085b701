// From the axis of greatest separation of two polyhedra to their contact points.
#pragma once

#include "collision/face_overlay.h"
#include "collision/gjk.h"
#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {

// A direction in which two polyhedra were compared. The faces are those to lay over one another:
// the reference face and the one that faces it, or those beside two crossing edges.
struct ContactAxis {
  enum class Kind { FaceOfA, FaceOfB, Edges };
  Kind kind;
  NumVec normal;   // unit, from A to B
  Num separation;  // [m] of the shapes along it
  int face_a, face_b;
  Segment edge_a, edge_b;      // only for Edges
  FeatureName name_a, name_b;  // only for Edges
};

// Where two lines that are not parallel come closest: parameters along the segments, unclamped.
SegmentParameters line_parameters(const Segment& a, const Segment& b);
// Halfway between the supporting lines of two edges.
ContactPoint edge_contact(const ContactAxis& axis);
// Whether the closest points of the two lines lie within both edges (to round-off).
bool edges_cross(const ContactAxis& axis);

// A and B give, in one frame: face(index, FacePolygon&), face_facing(d), faces_facing(d, int[2]),
// support_index(d), vertex(i).
template <class A, class B>
struct PolyhedronContact {
  const A& a;
  const B& b;
  Num margin;      // [m]
  Num thickness;   // [m] half thickness of the thinner one: the scale of the tolerances
  Num size;        // [m] of the larger one
  NumVec towards;  // from about the middle of A to that of B
  Contacts& out;

  // From the separations [m] along the best face of A, the best face of B, and the best of all
  // axes, which is one of these or that of two edges. `axis_of(kind)` tells the axis. A face is
  // preferred that is not much worse than the best axis, and counts only if its deepest point is as
  // deep as the best axis says: a face beside which the shapes meet has points that lie farther
  // apart.
  template <class AxisOf>
  void along(Num face_a, Num face_b, Num separation, const AxisOf& axis_of) {
    using Kind = ContactAxis::Kind;
    const bool apart = separation > Num(0);
    const Num enough = separation - kFacePreference * thickness;
    const Num limit = separation + (apart ? kAttained : kFacePreference) * thickness;
    const Kind best_kind = separation > std::max(face_a, face_b) ? Kind::Edges
                           : face_a >= face_b                    ? Kind::FaceOfA
                                                                 : Kind::FaceOfB;
    const Kind preferred = face_a >= enough   ? Kind::FaceOfA
                           : face_b >= enough ? Kind::FaceOfB
                                              : best_kind;
    if (preferred != Kind::Edges && overlay(axis_of(preferred), limit)) return;
    const ContactAxis best = axis_of(best_kind);
    if (best_kind == Kind::Edges && (!apart || edges_cross(best))) {
      overlay_ridges(best.normal, limit, edge_contact(best));
      return;
    }
    if (best_kind != Kind::Edges && best_kind != preferred && overlay(best, limit)) return;
    if (!apart) {
      add_vertex_contact(best);
    } else {
      closest_points_contact(best);
    }
  }

 private:
  bool overlay(const ContactAxis& axis, Num limit) {
    const NumVec normal = axis.normal;
    FacePolygon polygon_a, polygon_b;
    a.face(axis.face_a, polygon_a);
    b.face(axis.face_b, polygon_b);
    if (dot(polygon_a.normal, normal) < kSteepFace || dot(polygon_b.normal, normal) > -kSteepFace) {
      return false;
    }
    ContactCandidates candidates;
    candidates.count = 0;
    const Num smallest = overlay_faces(polygon_a, polygon_b, normal, axis.separation,
                                       kClipBand * thickness, margin, candidates);
    if (!(smallest <= limit)) return false;
    if (candidates.count > 0) choose_points(candidates, normal, kDeepestTie * thickness, out);
    return true;
  }

  // Edges or corners that meet in `deepest`: each side of one over each side of the other. Along
  // edges that are nearly parallel the surfaces stay near to one another on all of what they share,
  // and which of the four pairs of sides holds it changes with the least turn.
  void overlay_ridges(NumVec normal, Num limit, const ContactPoint& deepest) {
    int sides_a[2], sides_b[2];
    a.faces_facing(normal, sides_a);
    b.faces_facing(-normal, sides_b);
    ContactCandidates candidates;
    candidates.count = 0;
    Num smallest = std::numeric_limits<Num>::infinity();
    FacePolygon polygon_a, polygon_b;
    for (const int side_a : sides_a) {
      a.face(side_a, polygon_a);
      if (dot(polygon_a.normal, normal) < kSteepFace) continue;
      for (const int side_b : sides_b) {
        b.face(side_b, polygon_b);
        if (dot(polygon_b.normal, normal) > -kSteepFace) continue;
        smallest =
            std::min(smallest, overlay_faces(polygon_a, polygon_b, normal, deepest.separation,
                                             kClipBand * thickness, margin, candidates));
      }
    }
    if (!(smallest <= limit)) {
      if (candidates.count == ContactCandidates::kCapacity) --candidates.count;
      candidates.points[candidates.count++] = deepest;
    }
    if (candidates.count > 0)
      choose_ridge_points(candidates, normal, kDeepestTie * thickness, margin, out);
  }

  void add_vertex_contact(const ContactAxis& axis) {
    out.normal = axis.normal;
    const Num half_way = Num(0.5) * axis.separation;
    if (axis.kind == ContactAxis::Kind::FaceOfA) {
      const int i = b.support_index(-axis.normal);
      out.add(b.vertex(i) - half_way * axis.normal, axis.separation,
              pair_name(face_name(axis.face_a), vertex_name(i)));
    } else {
      const int i = a.support_index(axis.normal);
      out.add(a.vertex(i) + half_way * axis.normal, axis.separation,
              pair_name(vertex_name(i), face_name(axis.face_b)));
    }
  }

  // Corners or edges met outside of every face: the direction is that of the closest points.
  void closest_points_contact(const ContactAxis& best) {
    const GjkResult closest =
        gjk_distance([this](NumVec d) { return a.vertex(a.support_index(d)); },
                     [this](NumVec d) { return b.vertex(b.support_index(d)); }, towards, size);
    if (closest.overlap) {  // touching to round-off
      add_vertex_contact(best);
      return;
    }
    if (!(closest.distance <= margin)) return;
    const NumVec n = closest.normal;
    const Num limit = closest.distance + kAttained * thickness;
    overlay_ridges(n, limit,
                   {Num(0.5) * (closest.on_a + closest.on_b), closest.distance,
                    pair_name(vertex_name(a.support_index(n)), vertex_name(b.support_index(-n)))});
  }
};

}  // namespace plumb::inline PLUMB_ABI::detail
