// A world's moving state, copied as it lies in memory: the cheapest way to take it to another
// thread. What a recorder or a renderer shows is worked out from the image there, and comes out as
// the world itself would have told it, bit for bit.
//
//   WorldImage image;                          // kept between frames for its storage
//   world.copy_image(image);                   // on the stepping thread: a few block copies
//   image.copy_body_states(states);            // anywhere else, while the world goes on
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "plumb/events.h"
#include "plumb/report.h"
#include "plumb/rigid_body.h"

namespace plumb::inline PLUMB_ABI {

namespace detail {
struct ImageColumns;
}

class WorldImage {
 public:
  WorldImage();  // of no world: lists are empty, sums are zero
  ~WorldImage();
  WorldImage(WorldImage&&) noexcept;
  WorldImage& operator=(WorldImage&&) noexcept;

  // Each equals what PhysicsWorld's function of that name gave when the image was taken.
  void copy_body_states(std::vector<BodyState>& out) const;
  void copy_contact_points(std::vector<ContactPoint>& out) const;
  [[nodiscard]] EnergyReport energy() const;
  [[nodiscard]] std::uint64_t motion_hash() const;

 private:
  friend class PhysicsWorld;
  std::unique_ptr<detail::ImageColumns> columns_;
};

}  // namespace plumb::inline PLUMB_ABI
