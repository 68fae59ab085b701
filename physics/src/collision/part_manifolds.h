// The contacts of a pair in which a shape has parts: one manifold a part.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/contact_points.h"
#include "collision/manifold.h"

namespace plumb::inline PLUMB_ABI::detail {

struct PartManifold {
  std::uint32_t part;  // names the place of the contact; stays while the contact does
  Manifold manifold;
  Real radius_a = 0, radius_b = 0;  // [m] of the rounded shapes, or children, that touch
};

// In ascending order of part, each part once. Keep one for many pairs: it keeps its storage.
struct PartManifolds {
  std::vector<PartManifold> parts;

  // Contacts of triangles that share a plane, while they are being gathered.
  struct Group {
    NumVec normal;  // unit, from the surface
    NumVec origin;  // [m] a point of the surface
    bool behind;    // the middle of the shape lies behind all of its triangles
    bool of_face;   // some triangle is touched by its face
    std::uint32_t feature;
    std::vector<ContactPoint> points;
  };
  std::vector<Group> groups;  // only the first group_count are in use
  std::size_t group_count = 0;
};

}  // namespace plumb::inline PLUMB_ABI::detail
