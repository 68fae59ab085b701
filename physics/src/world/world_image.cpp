#include "plumb/world_image.h"

#include "world/body_reading.h"
#include "world/digest.h"
#include "world/world_image.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

std::shared_ptr<const BodyFactsList> make_facts(const WorldState& world) {
  auto facts = std::make_shared<BodyFactsList>();
  facts->reserve(world.bodies.alive_count);
  const Eigen::Vector3d gravity = world.settings.gravity.cast<double>();
  for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot) {
    const BodyInfo& info = world.bodies.info[slot];
    if (!info.alive) continue;
    BodyFacts& fact = facts->emplace_back();
    fact.user_data = info.user_data;
    fact.mass = info.properties.mass;
    fact.gravity = static_cast<double>(world.bodies.mass[info.dense].gravity_scale) * gravity;
    fact.slot = slot;
    fact.generation = info.generation;
    fact.center_B = info.center_B;
    fact.R_BP = info.R_BP;
    fact.type = info.type;
    fact.disabled = info.disabled;
  }
  return facts;
}

// Contacts are large and lie in a row, and of each only the begin is read: the memory is told
// early.
constexpr std::size_t kPrefetched = 8;  // [-] contacts ahead
void prefetch(const std::vector<Contact>& contacts, std::size_t i) {
#if defined(__GNUC__) || defined(__clang__)
  if (i >= contacts.size()) return;
  const Contact& contact = contacts[i];
  __builtin_prefetch(&contact);
  __builtin_prefetch(&contact.manifold.points[1]);
  __builtin_prefetch(&contact.manifold.points[3]);
#else
  static_cast<void>(contacts), static_cast<void>(i);
#endif
}

void add(ImageContacts& out, std::uint32_t seen_from, const Contact& from) {
  out.contacts.push_back(
      {seen_from, static_cast<std::uint32_t>(from.manifold.count), from.manifold.normal});
  for (int i = 0; i < from.manifold.count; ++i)
    out.points.push_back({from.manifold.points[i].position, from.step_normal_impulse[i]});
}

void add_touching(ImageContacts& out, const Pair& pair, const std::vector<Contact>& store) {
  if (pair.contact_count == 0 || !pair.was_touching) return;
  const std::uint32_t seen_from = pair.relative_to_b ? pair.body_b : pair.body_a;
  for (const Contact& contact : contacts_of(pair, store)) add(out, seen_from, contact);
}

void copy_awake_contacts(const WorldState& world, ImageContacts& out) {
  out.contacts.clear();
  out.points.clear();
  if (world.pairs.changes() == world.contacts_fit) {  // no look at the pairs
    for (std::size_t i = 0; i < world.contacts.size(); ++i) {
      prefetch(world.contacts, i + kPrefetched);
      const Contact& contact = world.contacts[i];
      if (contact.seen_from != kNone) add(out, contact.seen_from, contact);
    }
  } else {
    for (const Pair& pair : world.pairs) add_touching(out, pair, world.contacts);
  }
}

std::shared_ptr<const ImageContacts> make_sleeping_contacts(const WorldState& world) {
  auto out = std::make_shared<ImageContacts>();
  for (const SleepingIsland& island : world.islands)
    for (const Pair& pair : island.pairs) add_touching(*out, pair, island.contacts);
  return out;
}

}  // namespace
}  // namespace detail

void PhysicsWorld::copy_image(WorldImage& image) const {
  if (!image.columns_) image.columns_ = std::make_unique<detail::ImageColumns>();
  detail::ImageColumns& out = *image.columns_;
  const detail::BodyStore& bodies = state_->bodies;
  out.facts = state_->facts.get([this] { return detail::make_facts(*state_); });
  out.velocity = bodies.velocity;
  out.pose = bodies.pose;
  out.momentum = bodies.momentum;
  out.awake_end = bodies.awake_end;
  out.dense_of.resize(bodies.info.size());
  for (std::uint32_t i = 1; i < bodies.dense_count(); ++i) out.dense_of[bodies.slot_of[i]] = i;
  detail::copy_awake_contacts(*state_, out.awake);
  out.asleep =
      state_->sleeping_contacts.get([this] { return detail::make_sleeping_contacts(*state_); });
}

WorldImage::WorldImage() = default;
WorldImage::~WorldImage() = default;
WorldImage::WorldImage(WorldImage&&) noexcept = default;
WorldImage& WorldImage::operator=(WorldImage&&) noexcept = default;

void WorldImage::copy_body_states(std::vector<BodyState>& out) const {
  out.clear();
  if (!columns_) return;
  const detail::ImageColumns& from = *columns_;
  for (const detail::BodyFacts& fact : *from.facts) {
    const std::uint32_t i = from.dense_of[fact.slot];
    out.push_back(
        detail::state_of(fact.slot, fact, i < from.awake_end, from.pose[i], from.velocity[i]));
  }
}

void WorldImage::copy_contact_points(std::vector<ContactPoint>& out) const {
  out.clear();
  if (!columns_) return;
  const auto append = [&](const detail::ImageContacts& from) {
    const detail::ImagePoint* point = from.points.data();
    for (const detail::ImageContact& contact : from.contacts) {
      const detail::PosVec origin = columns_->pose[columns_->dense_of[contact.reference]].x;
      for (std::uint32_t i = 0; i < contact.point_count; ++i, ++point)
        out.push_back(
            detail::contact_point(origin, point->position, contact.normal, point->normal_impulse));
    }
  };
  append(columns_->awake);
  append(*columns_->asleep);
}

EnergyReport WorldImage::energy() const {
  EnergyReport sum;
  if (!columns_) return sum;
  const detail::ImageColumns& from = *columns_;
  for (const detail::BodyFacts& fact : *from.facts) {
    if (fact.type != MotionType::Dynamic || fact.disabled) continue;
    const std::uint32_t i = from.dense_of[fact.slot];
    detail::add_energy(sum, fact.mass, fact.gravity, from.pose[i], from.velocity[i],
                       from.momentum[i].L);
  }
  return sum;
}

std::uint64_t WorldImage::motion_hash() const {
  detail::Digest digest;
  if (!columns_) return digest.value();
  const detail::ImageColumns& from = *columns_;
  for (const detail::BodyFacts& fact : *from.facts) {
    const std::uint32_t i = from.dense_of[fact.slot];
    detail::add_motion(digest, fact.slot, fact, i < from.awake_end, from.pose[i], from.velocity[i],
                       from.momentum[i].L);
  }
  return digest.value();
}

}  // namespace plumb::inline PLUMB_ABI
