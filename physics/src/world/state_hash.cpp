// The digest of a world's state: what two runs are compared by.
#include <bit>

#include "world/joint_world.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

class Digest {
 public:
  void add(std::uint64_t word) {  // multiply-rotate mixing of 64-bit words [Steele 2014]
    state_ = std::rotl(state_ ^ (word * 0x9e3779b97f4a7c15u), 29) * 0xbf58476d1ce4e5b9u;
  }
  void add(float v) { add(std::uint64_t{std::bit_cast<std::uint32_t>(v)}); }
  void add(double v) { add(std::bit_cast<std::uint64_t>(v)); }
  template <class T>
  void add(Vector3<T> v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_ = 0x2545f4914f6cdd1du;
};

}  // namespace
}  // namespace detail

std::uint64_t PhysicsWorld::state_hash() const {
  using namespace detail;
  const WorldState& world = *state_;
  Digest digest;
  for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot) {
    const BodyInfo& info = world.bodies.info[slot];
    if (!info.alive) continue;
    const BodyPose& pose = world.bodies.pose[info.dense];
    digest.add(std::uint64_t{info.generation} << 32 | slot);
    digest.add(pose.x);
    digest.add(Vec{pose.q.x, pose.q.y, pose.q.z});
    digest.add(pose.q.w);
    digest.add(world.bodies.velocity[info.dense].v);
    digest.add(world.bodies.velocity[info.dense].w);
    digest.add(world.bodies.momentum[info.dense].L);
    digest.add(info.rest_time);
    digest.add(std::uint64_t{world.bodies.is_awake(slot)} << 1 | std::uint64_t{info.disabled});
  }
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const Pair& pair = world.pairs[i];
    if (pair.manifold.count == 0) continue;  // follows from the poses and boxes
    digest.add(pair.key);
    digest.add(static_cast<std::uint64_t>(pair.manifold.count));
    for (int k = 0; k < pair.manifold.count; ++k) {
      digest.add(pair.normal_impulse[k]);
      digest.add(pair.friction_impulse[k]);
    }
  }
  if (!world.joints.empty()) digest.add(digest_of_joints(world));
  return digest.value();
}

}  // namespace plumb::inline PLUMB_ABI
