// Two faces laid over one another along a contact normal.
#pragma once

#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

// A convex polygon, counter-clockwise seen from outside. No initial values: only `count` are read.
struct FacePolygon {
  int count;
  FeatureName name;
  NumVec normal;  // unit, outward
  Num offset;     // [m] normal . x <= offset holds for the whole shape
  NumVec points[kMaxFaceVertices];
  FeatureName vertex_names[kMaxFaceVertices];
  FeatureName edge_names[kMaxFaceVertices];  // edge i runs from point i to point i + 1
};

// Clips face b by the sides of face a, both projected along the normal (Sutherland and Hodgman),
// and appends for each corner of the common area the point midway between the planes of the faces.
// Points farther apart than `margin` are left out. Returns the smallest separation of all corners,
// infinity when the faces do not overlap.
//
// For a.normal = normal this is the usual face contact; for the normal of two crossing edges or two
// near corners it adds to that point the others which the two faces have within the margin.
// Needs dot(a.normal, normal) >= kSteepFace and dot(b.normal, normal) < 0. `least` [m]: the
// separation of the shapes along the normal. `band` [m]: corners of b this close to a side of a lie
// on it; those outside could seem closer than `least`.
Num overlay_faces(const FacePolygon& a, const FacePolygon& b, NumVec normal, Num least, Num band,
                  Num margin, ContactCandidates& out);

}  // namespace plumb::inline PLUMB_ABI::detail
