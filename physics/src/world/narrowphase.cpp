// Narrowphase: a manifold for every awake pair, warm-start impulses carried over, sleepers woken.
#include <algorithm>
#include <atomic>
#include <limits>

#include "collision/collide_parts.h"
#include "world/body_sweep.h"
#include "world/clearance.h"
#include "world/contact_report.h"
#include "world/forced.h"
#include "world/inner_edges.h"
#include "world/one_way.h"
#include "world/recycling.h"
#include "world/seen_anyway.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Points that lost their feature name are matched to an old point within this share of the contact
// thickness [-]; farther off it is another place of the surface.
constexpr Real kMatchFraction = Real(0.02);

// The shape of a collider placed relative to a reference point near the contact.
Transform placed_from(const WorldState& world, const ColliderInfo& collider, PosVec reference) {
  const BodyPose& pose = world.bodies.pose[world.bodies.dense_of[collider.body]];
  const Vec offset = rotate(pose.q, collider.in_body.p);
  const Rotation q = pose.q * collider.in_body.q;
  const PosVec p = pose.x - reference + cast<PosReal>(offset);
  if (collider.shape.type != ShapeType::HalfSpace) return {cast<Real>(p), q};
  // A plane may be described from any of its points: the nearest to the reference loses no digits.
  const PosVec n = cast<PosReal>(rotate(q, collider.shape.normal));
  return {cast<Real>(dot(n, p) * n), q};
}

// A contact takes over the impulses of the same part's points in the last step: by feature, else
// by place.
void carry_impulses(Contact& contact, const Contact& old, Real thickness) {
  const Manifold& now = contact.manifold;
  const Manifold& before = old.manifold;
  bool taken[Manifold::kMaxPoints]{}, matched[Manifold::kMaxPoints]{};
  const auto take = [&](int i, int j) {
    contact.normal_impulse[i] = old.normal_impulse[j];
    contact.friction_impulse[i] = old.friction_impulse[j];
    taken[j] = matched[i] = true;
  };
  for (int i = 0; i < now.count; ++i)
    for (int j = 0; j < before.count && !matched[i]; ++j)
      if (!taken[j] && before.points[j].feature == now.points[i].feature) take(i, j);
  const Real reach = kMatchFraction * thickness;
  for (int i = 0; i < now.count; ++i) {
    if (matched[i]) continue;
    int nearest = -1;
    Real best = reach * reach;
    for (int j = 0; j < before.count; ++j) {
      const Real d = length_squared(before.points[j].position - now.points[i].position);
      if (!taken[j] && d < best) {
        best = d;
        nearest = j;
      }
    }
    if (nearest >= 0) take(i, nearest);
  }
}

bool is_tied(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Dynamic && !world.joints.at_body(body).empty();
}

// How far the surfaces of a slow pair may approach within one step [m]. What may come nearer than
// that is swept, or else stopped after the step (continuous.cpp): a contact made across a wide gap
// has long arms and a normal of the wrong moment, and throws bodies about. What a joint ties is
// seen coming from farther away: stopped after the step, it would be torn from what it is tied to.
Real reach_of(const WorldState& world, const Pair& pair) {
  const BodyStore& bodies = world.bodies;
  const BodyVelocity& va = bodies.velocity[bodies.dense_of[pair.body_a]];
  const BodyVelocity& vb = bodies.velocity[bodies.dense_of[pair.body_b]];
  const Real speed = length(vb.v - va.v) + length(va.w) * bodies.extent[pair.body_a].radius +
                     length(vb.w) * bodies.extent[pair.body_b].radius;
  const Real thickness = pair.slop / tolerance::kSlopFraction;
  // Surfaces are not followed after the step: they are seen coming from as far as it takes.
  const bool tied =
      !world.joints.empty() && (is_tied(world, pair.body_a) || is_tied(world, pair.body_b));
  const Real fraction = tied ? tolerance::kTiedReach : tolerance::kSweptFraction;
  const Real near = pair.on_surface ? kUnbounded : fraction * thickness;
  return std::min(world.dt * speed, near) + world.falls_in_a_step;
}

// How far along the relative path of the step [0, 1] two shapes meet, without rotation; negative if
// they do not, or touch already. With parts: conservative advancement [Mirtich 1996].
Num first_touch_of_parts(const Pair& pair, const ColliderInfo& a, const Transform& xa,
                         const ColliderInfo& b, const Transform& xb, Vec path) {
  Transform moved = xb;
  Real t = 0;
  for (int i = 0; i < tolerance::kSweepSteps; ++i) {
    const Proximity near = closest_points(a.shape, xa, b.shape, moved);
    const Real closing = -dot(near.normal, path);  // [m] per whole step
    if (!(closing > Real(0))) return -1;
    // Overlapping from the start: the ordinary manifold knows more.
    if (near.distance <= tolerance::kSweepTolerance * pair.slop)
      return i > 0 ? static_cast<Num>(t) : Num(-1);
    t += near.distance / closing;
    if (t > Real(1)) return -1;
    moved.p = xb.p + t * path;
  }
  return -1;
}

Num first_touch(const Pair& pair, const ColliderInfo& a, const Transform& xa, const ColliderInfo& b,
                const Transform& xb, Vec path) {
  if (has_parts(a.shape.type) || has_parts(b.shape.type))
    return first_touch_of_parts(pair, a, xa, b, xb, path);
  const Sweep still = resting_at(to_num(xa.p), {0, 0, 0, 1});
  Sweep moving = resting_at(to_num(xb.p), {0, 0, 0, 1});
  moving.travel = to_num(path);
  const SweptShape in_a{a.shape, {0, 0, 0}, normalized(to_num(xa.q)), still};
  const SweptShape in_b{b.shape, {0, 0, 0}, normalized(to_num(xb.q)), moving};
  // What only brushes past (the next of two flush tiles, under a body that slides) does not count.
  const Num slop = static_cast<Num>(pair.slop);
  ImpactSearch search;
  search.separation = -static_cast<Num>(tolerance::kContinuousOverlapSlops) * slop;
  search.tolerance = slop;
  Impact meeting = time_of_impact(in_a, in_b, search);
  if (meeting.status == ImpactStatus::Apart || !(meeting.time > Num(0))) return -1;
  search.separation = 0;
  search.tolerance = static_cast<Num>(tolerance::kSweepTolerance) * slop;
  search.end = meeting.time;
  const Impact touch = time_of_impact(in_a, in_b, search);
  if (touch.status != ImpactStatus::Apart) meeting = touch;
  return dot(meeting.normal, moving.travel) < Num(0) ? meeting.time : Num(-1);
}

// Fast pairs: their manifold is that of the first touch along the relative path of the step, so
// that they meet, and bounce, within the step. Returns false when the pair is slow, touches
// already, or does not meet; the ordinary manifold serves then. `advance` [m]: how far B is then
// along, seen from A.
bool find_first_touch(const WorldState& world, const Pair& pair, const ColliderInfo& a,
                      const Transform& xa, const ColliderInfo& b, const Transform& xb,
                      Transform& moved, Vec& advance) {
  const BodyInfo& info_a = world.bodies.info[pair.body_a];
  const BodyInfo& info_b = world.bodies.info[pair.body_b];
  const Vec v = world.bodies.velocity[info_b.dense].v - world.bodies.velocity[info_a.dense].v;
  const Real thickness = pair.slop / tolerance::kSlopFraction;
  const Vec path = world.dt * v;
  const Real far =
      threshold(world.settings, PlanItem::LookAhead, tolerance::kSweptFraction * thickness);
  if (length(path) <= far) return false;
  const Num t = first_touch(pair, a, xa, b, xb, path);
  if (!(t > Num(0))) return false;
  advance = static_cast<Real>(t) * path;
  moved = xb;
  moved.p = xb.p + advance;
  return true;
}

// The manifold of the moment of first touch, told as of the step's start.
void set_back(const Pair& pair, Vec advance, Contact& contact) {
  contact.advance = advance;
  contact.advanced_gap = -dot(contact.manifold.normal, advance);
  for (int i = 0; i < contact.manifold.count; ++i) {
    ManifoldPoint& point = contact.manifold.points[i];
    point.separation += contact.advanced_gap;
    if (pair.relative_to_b) point.position -= advance;
  }
}

// Whether a contact that looking ahead has found is seen from here as well. What turns fast is told
// anew within the step where it was (solver/turned_rows.h), and there it would be another contact.
bool is_seen_anyway(const WorldState& world, const Pair& pair, const Contact& contact,
                    const Manifold& here) {
  const BodyInfo &a = world.bodies.info[pair.body_a], &b = world.bodies.info[pair.body_b];
  const BodyStore& bodies = world.bodies;
  const auto turns_fast = [&](const BodyInfo& body) {
    const Real turning = visible_turning(bodies.mass[body.dense], bodies.pose[body.dense].q,
                                         bodies.velocity[body.dense].w);
    return world.dt * turning > tolerance::kFastTurn;
  };
  if (!(pair.restitution > Real(0)) && (turns_fast(a) || turns_fast(b))) return false;
  const bool other_moves = (pair.relative_to_b ? a : b).type == MotionType::Dynamic;
  const Vec carried = other_moves ? contact.advance : Vec{0, 0, 0};
  return is_seen_anyway(
      contact.manifold, here, carried,
      std::min(bodies.extent[pair.body_a].radius, bodies.extent[pair.body_b].radius));
}

// Appends the contacts of a pair of shapes one of which has parts; each takes over from the same
// part.
void collide_pair_of_parts(const WorldState& world, std::uint32_t index, const Pair& pair,
                           const ColliderInfo& a, const Transform& xa, const ColliderInfo& b,
                           const Transform& xb, Real margin, std::vector<Contact>& out) {
  static thread_local PartManifolds found, here;  // kept for their storage only
  Transform moved = xb;
  Vec advance{0, 0, 0};
  const bool held = pair.contact_count > 0;
  const bool swept = find_first_touch(world, pair, a, xa, b, xb, moved, advance) &&
                     collide_parts(a.shape, xa, b.shape, moved, margin, found, held);
  if (!swept) collide_parts(a.shape, xa, b.shape, xb, margin, found, held);
  const bool seen = swept && collide_parts(a.shape, xa, b.shape, xb, margin, here, held);
  const std::span<const Contact> before = contacts_of(pair, world.contacts);
  auto old = before.begin();
  for (const PartManifold& part : found.parts) {
    Contact& contact = out.emplace_back();
    contact.pair = index;
    contact.part = part.part;
    contact.manifold = part.manifold;
    contact.radius_a = part.radius_a;
    contact.radius_b = part.radius_b;
    if (swept) set_back(pair, advance, contact);
    const auto same = [&](const PartManifold& other) {
      return other.part == contact.part && is_seen_anyway(world, pair, contact, other.manifold);
    };
    contact.seen_anyway = seen && std::any_of(here.parts.begin(), here.parts.end(), same);
    while (old != before.end() && old->part < contact.part) ++old;
    if (old == before.end() || old->part != contact.part) continue;
    carry_impulses(contact, *old, pair.slop / tolerance::kSlopFraction);
    contact.at_rest = old->at_rest;
  }
}

// Only a new box can have parted from another.
bool boxes_have_parted(const WorldState& world, std::uint32_t slot_a, std::uint32_t slot_b) {
  if (!world.box_notes[slot_a].is_new && !world.box_notes[slot_b].is_new) return false;
  const ColliderInfo& a = world.colliders.info[slot_a];
  const ColliderInfo& b = world.colliders.info[slot_b];
  return !overlaps(world.trees.of(a).box(a.proxy), world.trees.of(b).box(b.proxy));
}

// Appends the contacts of one pair to `out`.
void collide_pair(WorldState& world, std::size_t index, std::vector<Contact>& out) {
  Pair& pair = world.pairs[index];
  PairFindings& found = world.findings[index];
  const BodyStore& bodies = world.bodies;
  const std::uint32_t slot_a = pair.collider_a(), slot_b = pair.collider_b();
  const bool some_awake = bodies.is_awake(pair.body_a) || bodies.is_awake(pair.body_b);
  const bool clear = stays_clear(world, pair) && !pair.touching && !pair.one_way;
  found = {.first = static_cast<std::uint32_t>(out.size()), .memory = pair.memory};
  const auto keep_apart = [&](bool parted) {
    // A sensor that came to rest goes on seeing what sleeps in it.
    found.overlaps = pair.sensor && pair.touching && !some_awake;
    found.gone = parted || (!some_awake && !found.overlaps);
  };
  if (clear || !some_awake) return keep_apart(boxes_have_parted(world, slot_a, slot_b));
  const auto margin_for = [&](Real reach) { return tolerance::kMarginSlops * pair.slop + reach; };
  if (!pair.sensor && pair.contact_count > 0) {
    const Real reach = reach_of(world, pair);
    if (recycle(world, pair, margin_for(reach), reach)) {
      found.count = pair.contact_count;
      found.kept = true;
      return;
    }
  }
  found.asked = true;
  const WorldAabb reach_a = reach_now(world, slot_a), reach_b = reach_now(world, slot_b);
  if (!overlaps(reach_a, reach_b)) {
    found.memory.gap = gap_of(reach_a, reach_b);
    return keep_apart(boxes_have_parted(world, slot_a, slot_b));
  }
  const Real margin = margin_for(reach_of(world, pair));
  const ColliderInfo& a = world.colliders.info[slot_a];
  const ColliderInfo& b = world.colliders.info[slot_b];
  const PosVec reference =
      bodies.pose[bodies.dense_of[pair.relative_to_b ? pair.body_b : pair.body_a]].x;
  const Transform xa = placed_from(world, a, reference), xb = placed_from(world, b, reference);
  if (pair.sensor) {
    Manifold manifold;
    found.overlaps = collide(a.shape, xa, b.shape, xb, Real(0), manifold);
    return;
  }
  if (has_parts(a.shape.type) || has_parts(b.shape.type)) {
    collide_pair_of_parts(world, static_cast<std::uint32_t>(index), pair, a, xa, b, xb, margin,
                          out);
    found.count = static_cast<std::uint32_t>(out.size()) - found.first;
    keep(world, pair, margin, std::span(out).subspan(found.first));
    return;
  }
  Contact& contact = out.emplace_back();
  contact.pair = static_cast<std::uint32_t>(index);
  contact.radius_a = a.shape.radius;
  contact.radius_b = b.shape.radius;
  Transform moved = xb;
  Vec advance{0, 0, 0};
  if (find_first_touch(world, pair, a, xa, b, xb, moved, advance) &&
      collide(a.shape, xa, b.shape, moved, margin, contact.manifold)) {
    set_back(pair, advance, contact);
    Manifold here;
    contact.seen_anyway = collide(a.shape, xa, b.shape, xb, margin, here) &&
                          is_seen_anyway(world, pair, contact, here);
  } else {
    collide(a.shape, xa, b.shape, xb, margin, contact.manifold, &found.memory);
  }
  if (contact.manifold.count == 0) {
    out.pop_back();
    return;
  }
  found.count = 1;
  keep(world, pair, margin, std::span(out).last(1));
  for (const Contact& old : contacts_of(pair, world.contacts)) {
    if (old.part != contact.part) continue;
    carry_impulses(contact, old, pair.slop / tolerance::kSlopFraction);
    contact.at_rest = old.at_rest;
  }
}

// Finds the contacts of one pair. Reads the world, writes only to `out` and to the pair's findings,
// so that all pairs can be worked on at once.
void find_contacts(WorldState& world, std::size_t index, std::vector<Contact>& out) {
  collide_pair(world, index, out);
  const Pair& pair = world.pairs[index];
  if (!pair.one_way) return;
  PairFindings& found = world.findings[index];
  found.passage = passage_of(world, pair, std::span(out).subspan(found.first, found.count));
  if (found.passage != Passage::Passing) return;
  out.resize(found.first);
  found.count = 0;
}

void collide_all(WorldState& world) {
  const std::uint32_t count = static_cast<std::uint32_t>(world.pairs.size());
  const std::uint32_t chunks = (count + tolerance::kPairGrain - 1) / tolerance::kPairGrain;
  world.findings.resize(count);
  if (world.contacts_by_chunk.size() < chunks) world.contacts_by_chunk.resize(chunks);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    std::vector<Contact>& out = world.contacts_by_chunk[begin / tolerance::kPairGrain];
    out.clear();
    for (std::uint32_t i = begin; i < end; ++i) find_contacts(world, i, out);
  });
}

// Sleeping dynamic bodies that something awake has reached.
bool wake_what_is_touched(WorldState& world) {
  world.bodies_to_wake.clear();
  if (world.islands.size() == world.free_islands.size()) return false;  // nothing sleeps
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const Pair& pair = world.pairs[i];
    if (world.findings[i].count == 0) continue;
    for (const std::uint32_t body : {pair.body_a, pair.body_b})
      if (!world.bodies.is_awake(body) && world.bodies.info[body].island != kNone)
        world.bodies_to_wake.push_back(body);
  }
  for (const std::uint32_t body : world.bodies_to_wake) wake_body(world, body);
  return !world.bodies_to_wake.empty();
}

// Drops the pairs whose bounds have parted. `source`: which of the findings are those of a pair.
void drop_parted(WorldState& world, StepList<std::uint32_t>& source) {
  std::uint32_t index = 0;
  source.reserve(world.pairs.size());
  world.pairs.remove_if([&](const Pair& pair) {
    const bool gone = world.findings[index].gone;
    if (gone) {
      note_pair_end(world, pair);
    } else {
      source.push_back(index);
    }
    ++index;
    return gone;
  });
}

// What a chunk of the pairs has: all that must be known of it to place its contacts.
struct PairChunk {
  std::uint32_t contacts = 0;  // found now
  std::uint32_t kept = 0;      // pairs
  std::uint32_t first = 0;     // in the sum: where its contacts begin
  // Where the last step's began, if there are as many of each pair as then, one behind the other.
  std::uint32_t first_before = 0;
  bool as_before = true;

  void add(const Pair& pair, const PairFindings& found) {
    if (found.kept) ++kept;
    if (contacts == 0) first_before = pair.first_contact;
    as_before = as_before && found.count == pair.contact_count &&
                (found.count == 0 || pair.first_contact == first_before + contacts);
    contacts += found.count;
  }
};

// A pair takes what was found of it, its contacts to where they begin from now on.
void take(WorldState& world, std::uint32_t index, std::uint32_t source, std::uint32_t first,
          std::vector<Contact>& to) {
  Pair& pair = world.pairs[index];
  const PairFindings& found = world.findings[source];
  const Contact* const from =
      found.kept ? world.contacts.data() + pair.first_contact
                 : world.contacts_by_chunk[source / tolerance::kPairGrain].data() + found.first;
  if (found.count > 0 && from != &to[first]) std::copy_n(from, found.count, &to[first]);
  for (std::uint32_t k = 0; k < found.count; ++k) to[first + k].pair = index;
  pair.first_contact = first;
  pair.contact_count = found.count;
  pair.touching = found.count > 0 || found.overlaps;
  pair.passage = found.passage;
  pair.memory = found.memory;
  if (!found.asked) return;
  for (const std::uint32_t body : {pair.body_a, pair.body_b})  // pairs share bodies
    std::atomic_ref(world.bodies.travel[body].asked).store(true, std::memory_order_relaxed);
}

// Replaces the last step's contacts by those found now, and drops pairs whose bounds have parted.
void take_findings(WorldState& world) {
  StepList<std::uint32_t> source(&world.memory);
  drop_parted(world, source);
  const auto count = static_cast<std::uint32_t>(source.size());
  StepList<PairChunk> chunks(count / tolerance::kPairGrain + 1, PairChunk{}, &world.memory);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    PairChunk& chunk = chunks[begin / tolerance::kPairGrain];
    for (std::uint32_t i = begin; i < end; ++i)
      chunk.add(world.pairs[i], world.findings[source[i]]);
  });
  std::uint32_t contacts = 0;
  bool in_place = true;
  for (PairChunk& chunk : chunks) {
    chunk.first = contacts;
    in_place =
        in_place && chunk.as_before && (chunk.contacts == 0 || chunk.first_before == chunk.first);
    contacts += chunk.contacts;
    world.report.kept_pairs += chunk.kept;
  }
  in_place = in_place && contacts == world.contacts.size();
  std::vector<Contact>& to = in_place ? world.contacts : world.new_contacts;
  to.resize(contacts);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    std::uint32_t first = chunks[begin / tolerance::kPairGrain].first;
    for (std::uint32_t i = begin; i < end; ++i) {
      take(world, i, source[i], first, to);
      first += world.pairs[i].contact_count;
    }
  });
  if (!in_place) world.contacts.swap(world.new_contacts);
  world.contacts_fit = world.pairs.changes();
}

}  // namespace

void collide_pairs(WorldState& world) {
  collide_all(world);
  // A woken island brings its own contacts; they are computed once more together with all others,
  // which happens only in steps in which something wakes.
  while (world.flags.sleeping && wake_what_is_touched(world)) {
    find_pairs(world);
    collide_all(world);
  }
  take_findings(world);
  note_paired(world);
  drop_hidden_contacts(world);
  end_travels(world);
  report_contacts(world);
  spread_depth(world);
}

}  // namespace plumb::inline PLUMB_ABI::detail
