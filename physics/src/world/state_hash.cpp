// The digest of a world's state: what two runs are compared by.
#include "effects/effect_world.h"
#include "world/digest.h"
#include "world/joint_world.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

// rest: also how long the bodies have been at rest, which decides when they sleep.
void add_bodies(Digest& digest, const WorldState& world, bool rest) {
  const BodyStore& bodies = world.bodies;
  for (std::uint32_t slot = 0; slot < bodies.info.size(); ++slot) {
    const BodyInfo& info = bodies.info[slot];
    if (!info.alive) continue;
    add_motion(digest, slot, info, bodies.is_awake(slot), bodies.pose[info.dense],
               bodies.velocity[info.dense], bodies.momentum[info.dense].L);
    if (rest) digest.add(static_cast<double>(info.rest_time));
    if (rest && info.newton_steps > 0) digest.add(std::uint64_t{info.newton_steps});
  }
}

void add_contacts(Digest& digest, const WorldState& world) {
  // Pairs without contacts follow from the poses and boxes, but for those that let through.
  for (const Pair& pair : world.pairs) {
    if (pair.passage == Passage::Passing) digest.add(~pair.key);
    for (const Contact& contact : contacts_of(pair, world.contacts)) {
      const int count = contact.manifold.count;
      digest.add(pair.key);
      digest.add(std::uint64_t{contact.part} << 32 | static_cast<std::uint64_t>(count));
      for (int k = 0; k < count; ++k) {
        const Vec f = contact.friction_impulse[k];
        digest.add({contact.normal_impulse[k], f.x, f.y, f.z});
      }
    }
  }
}

}  // namespace
}  // namespace detail

std::uint64_t PhysicsWorld::state_hash() const {
  detail::Digest digest;
  detail::add_bodies(digest, *state_, true);
  detail::add_contacts(digest, *state_);
  if (!state_->joints.empty()) digest.add(detail::digest_of_joints(*state_));
  if (state_->effects != nullptr)
    if (const std::uint64_t effects = detail::digest_of_effects(*state_)) digest.add(effects);
  return digest.value();
}

std::uint64_t PhysicsWorld::motion_hash() const {
  detail::Digest digest;
  detail::add_bodies(digest, *state_, false);
  return digest.value();
}

}  // namespace plumb::inline PLUMB_ABI
