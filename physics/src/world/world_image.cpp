#include "plumb/world_image.h"

#include "world/body_reading.h"
#include "world/digest.h"
#include "world/world_image.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

std::shared_ptr<const FactsCache::Facts> make_facts(const WorldState& world) {
  auto facts = std::make_shared<FactsCache::Facts>();
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

// Writes contacts into lists that are long enough for all, and cuts these in the end.
class ContactWriter {
 public:
  ContactWriter(const WorldState& world, ImageColumns& out) : out_(out) {
    std::size_t count = world.contacts.size();
    for (const SleepingIsland& island : world.islands) count += island.contacts.size();
    out.contacts.resize(count);
    out.points.resize(count * Manifold::kMaxPoints);
    contact_ = out.contacts.data();
    point_ = out.points.data();
  }
  void add(std::uint32_t seen_from, const Contact& from) {
    contact_->reference = seen_from;
    contact_->point_count = static_cast<std::uint32_t>(from.manifold.count);
    contact_->normal = from.manifold.normal;
    ++contact_;
    for (int i = 0; i < from.manifold.count; ++i, ++point_) {
      point_->position = from.manifold.points[i].position;
      point_->normal_impulse = from.step_normal_impulse[i];
    }
  }
  void add_all(const Pair& pair, const std::vector<Contact>& store) {
    if (pair.contact_count == 0 || !pair.was_touching) return;
    const std::uint32_t seen_from = pair.relative_to_b ? pair.body_b : pair.body_a;
    for (const Contact& contact : contacts_of(pair, store)) add(seen_from, contact);
  }
  void close() {
    out_.contacts.resize(static_cast<std::size_t>(contact_ - out_.contacts.data()));
    out_.points.resize(static_cast<std::size_t>(point_ - out_.points.data()));
  }

 private:
  ImageColumns& out_;
  ImageContact* contact_;
  ImagePoint* point_;
};

void copy_contacts(const WorldState& world, ImageColumns& out) {
  ContactWriter writer(world, out);
  if (world.pairs.changes() == world.contacts_fit) {  // no look at the pairs
    for (const Contact& contact : world.contacts)
      if (contact.seen_from != kNone) writer.add(contact.seen_from, contact);
  } else {
    for (const Pair& pair : world.pairs) writer.add_all(pair, world.contacts);
  }
  for (const SleepingIsland& island : world.islands)
    for (const Pair& pair : island.pairs) writer.add_all(pair, island.contacts);
  writer.close();
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
  detail::copy_contacts(*state_, out);
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
  const detail::ImagePoint* point = columns_->points.data();
  for (const detail::ImageContact& contact : columns_->contacts) {
    const detail::PosVec origin = columns_->pose[columns_->dense_of[contact.reference]].x;
    for (std::uint32_t i = 0; i < contact.point_count; ++i, ++point)
      out.push_back(
          detail::contact_point(origin, point->position, contact.normal, point->normal_impulse));
  }
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
