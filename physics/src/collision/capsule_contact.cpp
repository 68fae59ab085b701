#include "collision/capsule_contact.h"

#include "collision/placed_polyhedron.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct ClippedEnd {
  Num at;            // parameter on the axis
  FeatureName name;  // of the face: itself, or the edge that cuts
};

// The part of the axis between the sides of the face, seen along the normal.
bool clip_axis(const FacePolygon& face, const Segment& axis, NumVec normal, Num band,
               ClippedEnd (&ends)[2]) {
  ends[0] = {Num(0), face.name};
  ends[1] = {Num(1), face.name};
  for (int i = 0; i < face.count; ++i) {
    const NumVec edge = face.points[i + 1 < face.count ? i + 1 : 0] - face.points[i];
    const NumVec outward = normalized_or(cross(edge, normal), {0, 0, 0});
    const Num start = dot(outward, axis.start - face.points[i]) - band;
    const Num end = dot(outward, axis.end - face.points[i]) - band;
    if (start > Num(0) && end > Num(0)) return false;
    if (start <= Num(0) && end <= Num(0)) continue;
    const Num t = start / (start - end);
    if (start > Num(0)) {
      if (t > ends[0].at) ends[0] = {t, face.edge_names[i]};
    } else {
      if (t < ends[1].at) ends[1] = {t, face.edge_names[i]};
    }
  }
  return ends[0].at < ends[1].at;
}

// How far the surface lies from a point of the axis along the normal. A tilted cylinder is thicker
// than its radius; near the lower end, `along` [m] away, its place is taken by the cap.
Num depth_below_axis(Num radius, Num sine, Num along) {
  const Num cosine = std::sqrt(Num(1) - sine * sine);
  if (along * cosine >= radius * sine) return radius / cosine;
  const Num aside = along * cosine;
  return along * sine + std::sqrt(radius * radius - aside * aside);
}

}  // namespace

void add_capsule_contacts(const FacePolygon& face, const Segment& axis, Num radius,
                          const AxisProximity& proximity, Num thickness, Num margin,
                          Contacts& out) {
  const NumVec n = proximity.normal;
  const NumVec along = axis.end - axis.start;
  const Num steepness = dot(face.normal, n), tilt = dot(along, n);
  const Num length_sq = length_squared(along);
  out.normal = n;
  NumVec on_axis = proximity.on_axis;
  ClippedEnd ends[2];
  if (steepness >= kSteepFace && tilt * tilt <= kParallelTilt * kParallelTilt * length_sq &&
      clip_axis(face, axis, n, kAttained * thickness, ends)) {
    Num core[2];
    for (int i = 0; i < 2; ++i) {
      const Num height = (dot(face.normal, point_at(axis, ends[i].at)) - face.offset) / steepness;
      core[i] = std::max(height, proximity.distance);  // rounding may see it closer
    }
    const Num slack = (proximity.distance > Num(0) ? kAttained : kFacePreference) * thickness;
    const Num span = ends[1].at - ends[0].at;
    const bool wide =
        span * span * length_sq > kParallelCapsules * radius * kParallelCapsules * radius;
    if (wide && std::min(core[0], core[1]) <= proximity.distance + slack) {
      const Num size = std::sqrt(length_sq), sine = std::abs(tilt) / size;
      const Num lower = tilt > Num(0) ? Num(0) : Num(1);
      for (int i = 0; i < 2; ++i) {
        // At an end of the capsule its name is that end's, else that of the side between them.
        const bool at_end = ends[i].at == Num(i);
        const FeatureName own = at_end ? vertex_name(i) : edge_name(0);
        const Num down = depth_below_axis(radius, sine, std::abs(ends[i].at - lower) * size);
        const Num separation = std::max(core[i] - down, proximity.distance - radius);
        if (!(separation <= margin)) continue;
        out.add(point_at(axis, ends[i].at) - (down + Num(0.5) * separation) * n, separation,
                pair_name(ends[i].name, own));
      }
      return;
    }
    // Too narrow for two points, but a point of the axis within it is a point above the face.
    if (std::min(core[0], core[1]) <= proximity.distance + slack)
      on_axis = point_at(axis, ends[core[0] <= core[1] ? 0 : 1].at);
  }
  const Num separation = proximity.distance - radius;
  if (!(separation <= margin)) return;
  out.add(on_axis - (radius + Num(0.5) * separation) * n, separation,
          pair_name(face.name, face_name(0)));
}

AxisProximity deepest_of_axis(const PlacedPolyhedron& p, const Segment& axis, Num thickness) {
  AxisProximity deepest{{0, 1, 0}, -std::numeric_limits<Num>::infinity(), axis.start};
  for (int k = 0; k < p.face_count(); ++k) {
    const Num start = dot(p.normal(k), axis.start), end = dot(p.normal(k), axis.end);
    const Num s = std::min(start, end) - p.offset(k);
    if (s > deepest.distance) deepest = {p.normal(k), s, start <= end ? axis.start : axis.end};
  }
  const NumVec along = axis.end - axis.start;
  const Num floor = deepest.distance + kFacePreference * thickness;
  for (int i = 0; i < p.edge_count(); ++i) {
    const PlacedPolyhedron::Edge e = p.edge(i);
    // Only edges whose two faces look to different sides along the axis support the sum of both.
    if (!(dot(p.normal(e.face_a), along) * dot(p.normal(e.face_b), along) < Num(0))) continue;
    const Segment edge = p.segment(i);
    const NumVec d = edge.end - edge.start, across = cross(d, along);
    const Num squared = length_squared(across);
    if (!(squared > kParallelSine * kParallelSine * length_squared(d) * length_squared(along)))
      continue;
    const Num sign =
        dot(across, p.normal(e.face_a) + p.normal(e.face_b)) < Num(0) ? Num(-1) : Num(1);
    const Num s = sign * dot(across, axis.start - edge.start) / std::sqrt(squared);
    if (s > std::max(floor, deepest.distance)) {
      deepest = {(sign / std::sqrt(squared)) * across, s,
                 point_at(axis, closest_parameters(axis, edge).a)};
    }
  }
  deepest.normal = normalized_or(deepest.normal, {0, 1, 0});
  return deepest;
}

}  // namespace plumb::inline PLUMB_ABI::detail
