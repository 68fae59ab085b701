// The distance to the solid grows by no more than the way one goes, so that the distance at the
// middle of a cube plus the cube's radius bounds all of the cube. Cubes whose bound decides nothing
// are halved along each axis.
#include "decompose/hollow.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

struct Cube {
  Vector3d middle;
  double half;
  std::uint32_t face;  // of the solid, near it
  bool outside;        // all of it is outside of the solid
};

struct Question {
  double smallest;  // radius of cubes that are not halved any more
  double ignored;   // distances up to here do not matter,
  double slack;     // nor do those that exceed the farthest found by no more than this
  double enough;    // the search ends where a point may be farther than this
};

bool misses(const Cube& cube, const PartHull& part) {
  return std::any_of(part.planes.begin(), part.planes.end(), [&](const CutPlane& plane) {
    return plane.height(cube.middle) > cube.half * plane.normal.lpNorm<1>();
  });
}

double farthest(const PartHull& part, const SolidField& solid, const Question& question) {
  double sure = 0;
  std::vector<Cube> stack{{part.box.center(), 0.5 * part.box.sizes().maxCoeff(), 0, false}};
  while (!stack.empty()) {
    Cube cube = stack.back();
    stack.pop_back();
    if (misses(cube, part)) continue;
    const double radius = std::numbers::sqrt3 * cube.half;
    const auto [distance, face] = solid.nearest(cube.middle, cube.face);
    if (distance + radius <= std::max(question.ignored, sure + question.slack)) continue;
    const bool is_sample = distance > sure && part.height(cube.middle) <= 0;
    const bool is_apart = distance > radius && !cube.outside;
    if ((is_sample || is_apart) && (cube.outside || !solid.is_inside(cube.middle, face))) {
      cube.outside = cube.outside || is_apart;
      if (is_sample) sure = distance;
    } else if (is_apart) {
      continue;  // all of it is inside the solid
    }
    if (sure > question.enough) return sure;
    if (radius <= question.smallest) {
      if (distance + radius > question.enough) return distance + radius;
      continue;
    }
    for (int k = 8; k-- > 0;) {
      const Vector3d side((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5,
                          (k & 4) != 0 ? 0.5 : -0.5);
      stack.push_back({cube.middle + cube.half * side, 0.5 * cube.half, face, cube.outside});
    }
  }
  return sure;
}

}  // namespace

bool stays_within(const PartHull& part, const SolidField& solid, double limit) {
  return farthest(part, solid, {limit / 32, limit, 0, limit}) <= limit;
}

double reach_beyond(const PartHull& part, const SolidField& solid, double resolution) {
  return farthest(part, solid,
                  {0.5 * resolution, 0, resolution, std::numeric_limits<double>::infinity()});
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
