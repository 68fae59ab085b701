// One moment of the world as the parts of the recorder see it.
#pragma once

#include <cstdint>
#include <span>

#include "plumb/rigid_body.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

struct Frame {
  const PhysicsWorld& world;
  std::uint64_t number;               // of the last step
  double time;                        // [s] after it
  std::span<const BodyState> bodies;  // all, in order of their index
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
