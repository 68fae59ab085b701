// Events of contacts and sensors, gathered in the order of pairs.
#include <limits>

#include "math/eigen_bridge.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

void note_sensor(WorldState& world, const Pair& pair, SensorEvent::Kind kind) {
  const SensorOverlap overlap = overlap_of(world, pair);
  world.gathering.sensors.push_back({kind, overlap.sensor, overlap.other});
}

void note_contact(WorldState& world, const Pair& pair, ContactEvent::Kind kind) {
  world.gathering.contacts.push_back({kind,
                                      world.colliders.id(pair.collider_a()),
                                      world.colliders.id(pair.collider_b()),
                                      {pair.body_a, world.bodies.info[pair.body_a].generation},
                                      {pair.body_b, world.bodies.info[pair.body_b].generation}});
}

// Whether a pair touches after the step: surfaces are within a slop or push; no more when no point
// is left within the margin. Its contacts get to know.
bool touches_now(Pair& pair, std::vector<Contact>& store) {
  if (pair.sensor || !pair.touching) return pair.touching;
  const std::span<Contact> contacts = contacts_of(pair, store);
  Real nearest = std::numeric_limits<Real>::max(), impulse = 0;
  for (const Contact& contact : contacts) {
    for (int k = 0; k < contact.manifold.count; ++k) {
      nearest = std::min(nearest, contact.manifold.points[k].separation);
      impulse = std::max(impulse, contact.step_normal_impulse[k]);
    }
  }
  const bool now = impulse > Real(0) || nearest <= pair.slop ||
                   (pair.was_touching && nearest <= tolerance::kMarginSlops * pair.slop);
  const std::uint32_t seen_from = pair.relative_to_b ? pair.body_b : pair.body_a;
  for (Contact& contact : contacts) contact.seen_from = now ? seen_from : kNone;
  return now;
}

}  // namespace

SensorOverlap overlap_of(const WorldState& world, const Pair& pair) {
  const ColliderId a = world.colliders.id(pair.collider_a()),
                   b = world.colliders.id(pair.collider_b());
  const bool a_senses = world.colliders.info[a.index].component.is_sensor;
  return {a_senses ? a : b, a_senses ? b : a};
}

void note_pair_end(WorldState& world, const Pair& pair) {
  if (!pair.was_touching) return;
  if (pair.sensor) {
    note_sensor(world, pair, SensorEvent::Kind::Exit);
  } else {
    note_contact(world, pair, ContactEvent::Kind::End);
  }
}

// Who has begun or ended is found by all threads and told in the order of the pairs.
void note_contact_events(WorldState& world) {
  const auto count = static_cast<std::uint32_t>(world.pairs.size());
  StepList<std::uint8_t> changed(count, 0, &world.memory);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      Pair& pair = world.pairs[i];
      changed[i] = touches_now(pair, world.contacts) != pair.was_touching ? 1 : 0;
    }
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    if (changed[i] == 0) continue;
    Pair& pair = world.pairs[i];
    const bool now = !pair.was_touching;
    pair.was_touching = now;
    if (now) pair.began = static_cast<std::uint32_t>(world.step_count);
    if (pair.sensor) {
      note_sensor(world, pair, now ? SensorEvent::Kind::Enter : SensorEvent::Kind::Exit);
    } else {
      note_contact(world, pair, now ? ContactEvent::Kind::Begin : ContactEvent::Kind::End);
    }
  }
}

// Contacts that began with an approach above the bounce threshold and were stopped without a
// bounce.
void note_hits(WorldState& world) {
  for (const ContactRow<Real>& row : world.rows) {
    if (row.bounced || row.approach_speed <= tolerance::kBounceCutResting * row.cut_unit) continue;
    const Contact& contact = world.contacts[row.contact];
    const Pair& pair = world.pairs[contact.pair];
    if (pair.was_touching) continue;
    HitEvent hit;
    // The manifold lies midway in the gap; they met on the side that did not move to the other.
    const bool b_yields = world.bodies.info[pair.body_b].type == MotionType::Dynamic;
    const Real side = pair.relative_to_b ? Real(-0.5) : (b_yields ? Real(0) : Real(0.5));
    Vec place{0, 0, 0};
    Real impulse = 0;
    for (int i = 0; i < row.count; ++i) {
      const ManifoldPoint& point = contact.manifold.points[i];
      const Real gap = point.separation - contact.advanced_gap;
      impulse += row.points[i].impulse_sum;
      place += row.points[i].impulse_sum * (point.position + (side * gap) * row.n);
    }
    if (!(impulse > Real(0))) continue;
    place = (Real(1) / impulse) * place;
    if (pair.relative_to_b) place += contact.advance;  // B has gone so far until it met A
    const std::uint32_t reference =
        world.bodies.info[pair.relative_to_b ? pair.body_b : pair.body_a].dense;
    hit.a = world.colliders.id(pair.collider_a());
    hit.b = world.colliders.id(pair.collider_b());
    hit.body_a = {pair.body_a, world.bodies.info[pair.body_a].generation};
    hit.body_b = {pair.body_b, world.bodies.info[pair.body_b].generation};
    hit.point = to_public_position(world.bodies.pose[reference].x + cast<PosReal>(place));
    hit.normal = to_public(row.n);
    hit.approach_speed = row.approach_speed;
    hit.impulse = impulse;
    world.gathering.hits.push_back(hit);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
