#include "world/contact_report.h"

#include <algorithm>
#include <atomic>

#include "world/forced.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Dense index of a body that contacts push; 0, the world itself, for any other one.
std::uint32_t dense_if_pushed(const BodyStore& bodies, std::uint32_t body) {
  const std::uint32_t dense = bodies.dense_of[body];
  return dense < bodies.awake_end && bodies.mass[dense].mass > Real(0) ? dense : 0;
}

void note_depth(WorldState& world, const Contact& contact) {
  if (!world.deep_overlap) world.overlaps_deeply.assign(world.bodies.awake_end, 0);
  world.deep_overlap = true;
  const Pair& pair = world.pairs[contact.pair];
  for (const std::uint32_t body : {pair.body_a, pair.body_b}) {
    const std::uint32_t dense = dense_if_pushed(world.bodies, body);
    if (dense != 0) world.overlaps_deeply[dense] = 1;
  }
}

// What a chunk of the contacts adds to the report.
struct ContactCounts {
  std::uint32_t points = 0, looked_ahead = 0;
  Real depth = 0;     // [m] the largest overlap
  bool deep = false;  // one of them is deep for its pair
};

Real depth_of(const Contact& contact) {
  Real depth = 0;
  for (int k = 0; k < contact.manifold.count; ++k)
    depth = std::max(depth, -contact.manifold.points[k].separation);
  return depth;
}

}  // namespace

void report_contacts(WorldState& world) {
  StepReport& report = world.report;
  report.candidate_pairs = static_cast<std::uint32_t>(world.pairs.size());
  for (const Pair& pair : world.pairs) report.touching_pairs += pair.contact_count > 0 ? 1 : 0;
  const Real deep_slops =
      threshold(world.settings, PlanItem::DeepOverlap, tolerance::kDeepSlops, Real(-1));
  const auto is_deep = [&](const Contact& contact) {
    return depth_of(contact) > deep_slops * world.pairs[contact.pair].slop;
  };
  const auto count = static_cast<std::uint32_t>(world.contacts.size());
  StepList<ContactCounts> chunks(count / tolerance::kPairGrain + 1, ContactCounts{}, &world.memory);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    ContactCounts& sum = chunks[begin / tolerance::kPairGrain];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Contact& contact = world.contacts[i];
      sum.points += static_cast<std::uint32_t>(contact.manifold.count);
      if (length_squared(contact.advance) > Real(0)) ++sum.looked_ahead;
      sum.depth = std::max(sum.depth, depth_of(contact));
      sum.deep |= is_deep(contact);
    }
  });
  world.deep_overlap = false;
  for (std::uint32_t c = 0; c < chunks.size(); ++c) {
    report.contact_points += chunks[c].points;
    report.looked_ahead += chunks[c].looked_ahead;
    report.largest_penetration =
        std::max(report.largest_penetration, static_cast<double>(chunks[c].depth));
    if (!chunks[c].deep) continue;
    const std::uint32_t begin = c * tolerance::kPairGrain;
    for (std::uint32_t i = begin; i < std::min(begin + tolerance::kPairGrain, count); ++i)
      if (is_deep(world.contacts[i])) note_depth(world, world.contacts[i]);
  }
}

void spread_depth(WorldState& world) {
  if (!world.deep_overlap) return;
  const BodyStore& bodies = world.bodies;
  std::vector<std::uint8_t>& deep = world.overlaps_deeply;
  for (int layer = 0; layer < tolerance::kDeepLayers; ++layer) {
    const StepList<std::uint8_t> before(deep.begin(), deep.end(), &world.memory);
    const auto was_deep = [&](std::uint32_t body) {
      const std::uint32_t dense = bodies.dense_of[body];
      return dense < before.size() && before[dense] != 0;
    };
    const auto push = [&](std::uint32_t body) {
      const std::uint32_t dense = dense_if_pushed(bodies, body);
      if (dense != 0) std::atomic_ref(deep[dense]).store(1, std::memory_order_relaxed);
    };
    const auto count = static_cast<std::uint32_t>(world.pairs.size());
    parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        const Pair& pair = world.pairs[i];
        if (!(was_deep(pair.body_a) || was_deep(pair.body_b)) || pair.contact_count == 0) continue;
        push(pair.body_a);
        push(pair.body_b);
      }
    });
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
