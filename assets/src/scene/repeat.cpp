#include "scene/repeat.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// Uniform over all rotations: a point uniform in the four-dimensional ball, brought to its surface.
// Points too near the centre are passed over, where the division would magnify the grain of the
// generator.
Eigen::Quaterniond random_rotation(Lcg& random) {
  constexpr double kInnermost = 1e-4;  // of the squared radius
  for (;;) {
    const double x = random.next(), y = random.next(), z = random.next(), w = random.next();
    const double squared = x * x + y * y + z * z + w * w;
    if (squared > 1 || squared < kInnermost) continue;
    const double length = std::sqrt(squared);
    return {w / length, x / length, y / length, z / length};
  }
}

}  // namespace

std::vector<RepeatPlace> places_of(const SceneRepeat& repeat) {
  Lcg random(repeat.seed);
  std::vector<RepeatPlace> places;
  places.reserve(repeat.total());
  for (int k = 0; k < repeat.count[2]; ++k) {
    for (int j = 0; j < repeat.count[1]; ++j) {
      for (int i = 0; i < repeat.count[0]; ++i) {
        RepeatPlace& place = places.emplace_back();
        const double cell[3] = {static_cast<double>(i), static_cast<double>(j),
                                static_cast<double>(k)};
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          place.offset[axis] =
              cell[axis] * repeat.spacing[axis] + repeat.jitter[axis] * random.next();
        }
        if (repeat.random_orientation) place.turn = random_rotation(random);
      }
    }
  }
  return places;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
