// Queries: rays, moving shapes, overlaps, nearest points.
//
// Every query walks both trees, nearest boxes first, and shortens its reach with what it finds. The
// exact test of a shape never depends on that reach, so that the answer is the same whatever the
// trees look like; only boxes are left out by it. All is computed in double precision relative to
// where the query begins and rounded once.
#include <algorithm>
#include <limits>

#include "collision/collide.h"
#include "collision/shape_gap.h"
#include "world/body_sweep.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

constexpr std::uint32_t kQueryGrain = 64;  // questions per chunk of a batch [-]
// A cast shape stops this part of the thinner shape's thickness before what it meets [-].
constexpr Num kCastGap = 5e-4;
// Boxes are compared with coordinates of this many roundings' slack [-].
constexpr PosReal kBoxRounding = 8 * std::numeric_limits<PosReal>::epsilon();

bool is_sound(const Shape& shape, const Pose& pose) {
  return check_shape(shape).ok() && check_pose(pose).ok() &&
         !std::holds_alternative<HalfSpace>(shape);
}

PosReal rounding_at(const WorldAabb& box) {
  const PosVec m = max_each(absolute(box.lower), absolute(box.upper));
  return kBoxRounding * std::max(m.x, std::max(m.y, m.z));
}
WorldAabb grown(const WorldAabb& box, PosReal by) {
  return {box.lower - PosVec{by, by, by}, box.upper + PosVec{by, by, by}};
}

// A query's view of the world: relative to where it begins, and only what its filter lets through.
class View {
 public:
  View(const PhysicsWorld& world, const WorldState& state, const QueryFilter& filter,
       PosVec reference)
      : world_(world), state_(state), filter_(filter), reference_(reference) {}

  [[nodiscard]] const ColliderInfo& info(std::uint32_t slot) const {
    return state_.colliders.info[slot];
  }
  [[nodiscard]] bool sees(std::uint32_t slot) const {
    const ColliderInfo& collider = info(slot);
    if ((collider.component.filter.layers & filter_.layers) == 0) return false;
    if (collider.component.is_sensor && !filter_.sensors) return false;
    return filter_.ignore.is_null() || body(slot) != filter_.ignore;
  }
  // Asked last, when a collider would be part of the answer.
  [[nodiscard]] bool accepts(std::uint32_t slot) const {
    return filter_.accept == nullptr || filter_.accept(world_, id(slot), filter_.context);
  }
  [[nodiscard]] ColliderId id(std::uint32_t slot) const { return state_.colliders.id(slot); }
  [[nodiscard]] BodyId body(std::uint32_t slot) const {
    const std::uint32_t owner = info(slot).body;
    return {owner, state_.bodies.info[owner].generation};
  }
  [[nodiscard]] Placed placed(std::uint32_t slot) const {
    const ColliderInfo& collider = info(slot);
    const BodyPose& pose = state_.bodies.pose[state_.bodies.info[collider.body].dense];
    const NumRotation q = to_num(pose.q);  // unit to rounding; the product is normalised
    return {collider.shape, cast<Num>(pose.x - reference_) + rotate(q, to_num(collider.in_body.p)),
            normalized(q * to_num(collider.in_body.q))};
  }
  [[nodiscard]] Pos3 in_world(NumVec p) const {
    return to_public_position(reference_ + cast<PosReal>(p));
  }
  [[nodiscard]] PosVec reference() const { return reference_; }
  template <class Walk>
  void for_all_trees(Walk&& walk) const {
    walk(state_.trees.of_static);
    walk(state_.trees.of_moving);
    walk(state_.trees.of_sleeping);
  }

 private:
  const PhysicsWorld& world_;
  const WorldState& state_;
  const QueryFilter& filter_;
  PosVec reference_;
};

// Of equals the smaller id is nearer; slots order like ids, of which only one lives in a slot.
template <class Found>
bool is_nearer(Num value, std::uint32_t slot, const Found& than) {
  return value < than.value || (value == than.value && slot < than.slot);
}

// ---- rays ---------------------------------------------------------------------------------------

struct FoundHit {
  Num value = std::numeric_limits<Num>::infinity();  // fraction
  std::uint32_t slot = kNone;
  NumVec normal{0, 1, 0}, point{0, 0, 0};
  Num separation = 0;
};

bool is_sound(const Ray& ray) { return ray.origin.allFinite() && ray.translation.allFinite(); }

// Calls found(FoundHit) -> how much of the ray is still of interest, for everything it enters.
template <class Found>
void walk_ray(const View& view, const Ray& ray, Found&& found) {
  const NumVec path = to_num(to_inner(ray.translation));
  PosReal reach = 1;
  const auto visit = [&](std::uint32_t slot, PosReal) -> PosReal {
    if (!view.sees(slot)) return reach;
    const Placed placed = view.placed(slot);
    NumRayHit hit;
    if (cast_ray(placed.shape, placed.q, -placed.p, path, Num(1), hit))
      reach =
          std::min(reach, found(FoundHit{hit.fraction, slot, hit.normal, hit.fraction * path, 0}));
    return reach;
  };
  view.for_all_trees([&](const AabbTree& tree) {
    if (reach > PosReal(0)) tree.cast_ray(view.reference(), cast<PosReal>(path), reach, visit);
  });
}

// What is left of a cast when its best hit is known: never 0, which would end it before equals.
PosReal reach_after(Num fraction) {
  return std::max(static_cast<PosReal>(fraction), std::numeric_limits<PosReal>::min());
}

RayHitResult ray_result(const View& view, const FoundHit& hit) {
  RayHitResult result;
  result.collider = view.id(hit.slot);
  result.body = view.body(hit.slot);
  result.point = view.in_world(hit.point);
  result.normal = to_public(cast<Real>(hit.normal));
  result.fraction = static_cast<Real>(hit.value);
  return result;
}

RayHitResult nearest_hit(const PhysicsWorld& world, const WorldState& state, const Ray& ray,
                         const QueryFilter& filter) {
  if (!is_sound(ray)) return {};
  const View view(world, state, filter, to_inner_position(ray.origin));
  FoundHit best;
  walk_ray(view, ray, [&](const FoundHit& hit) {
    if (is_nearer(hit.value, hit.slot, best) && view.accepts(hit.slot)) best = hit;
    return best.slot == kNone ? PosReal(1) : reach_after(best.value);
  });
  return best.slot == kNone ? RayHitResult{} : ray_result(view, best);
}

// ---- moving shapes ------------------------------------------------------------------------------

// A shape of the user's in place.
struct OwnShape {
  CollisionShape shape;
  NumRotation q;
  OwnShape(const Shape& given, const Pose& pose)
      : shape(make_collision_shape(given)), q(normalized(to_num(to_inner(pose.orientation)))) {}
  [[nodiscard]] Placed placed() const { return {shape, {0, 0, 0}, q}; }
  [[nodiscard]] WorldAabb bounds(PosVec at) const {
    const Aabb box = bounds_of(shape, {{0, 0, 0}, to_real(q)});
    const WorldAabb tight{at + cast<PosReal>(box.lower), at + cast<PosReal>(box.upper)};
    return grown(tight, rounding_at(tight));
  }
};

bool is_sound(const ShapeCast& cast) {
  return is_sound(cast.shape, cast.start) && cast.translation.allFinite() &&
         cast.rotation.allFinite();
}

template <class Found>
void walk_cast(const View& view, const ShapeCast& given, Found&& found) {
  const OwnShape own(given.shape, given.start);
  Sweep sweep = resting_at({0, 0, 0}, own.q);
  sweep.travel = to_num(to_inner(given.translation));
  sweep.turn = to_num(to_inner(given.rotation));
  const SweptShape swept{own.shape, {0, 0, 0}, {0, 0, 0, 1}, sweep};
  WorldAabb box = own.bounds(view.reference());
  if (length_squared(sweep.turn) > Num(0)) {
    const auto r = static_cast<PosReal>(bounding_radius(own.shape));
    box = grown({view.reference(), view.reference()}, r + rounding_at(box));
  }
  const Num thickness = static_cast<Num>(smallest_thickness(own.shape));
  PosReal reach = 1;
  const auto visit = [&](std::uint32_t slot, PosReal) -> PosReal {
    if (!view.sees(slot)) return reach;
    const Placed placed = view.placed(slot);
    const Sweep still = resting_at(placed.p, placed.q);
    const Num gap = kCastGap * std::min(thickness, static_cast<Num>(view.info(slot).thickness));
    ImpactSearch search;
    search.separation = gap;
    search.tolerance = gap;
    search.touching = Num(2) * gap;
    search.allowance = gap;
    const Impact impact =
        time_of_impact({placed.shape, {0, 0, 0}, {0, 0, 0, 1}, still}, swept, search);
    if (impact.status == ImpactStatus::Apart && !(impact.first_distance < Num(0))) return reach;
    FoundHit hit{impact.time, slot, impact.normal, impact.point, impact.distance};
    if (impact.first_distance < Num(0)) {
      hit = {0, slot, impact.first_normal, impact.first_point, impact.first_distance};
    }
    return reach = std::min(reach, found(hit));
  };
  view.for_all_trees(
      [&](const AabbTree& tree) { tree.cast_box(box, cast<PosReal>(sweep.travel), reach, visit); });
}

ShapeHitResult shape_result(const View& view, const FoundHit& hit) {
  ShapeHitResult result;
  result.collider = view.id(hit.slot);
  result.body = view.body(hit.slot);
  result.fraction = static_cast<Real>(hit.value);
  result.point = view.in_world(hit.point);
  result.normal = to_public(cast<Real>(hit.normal));
  result.separation = static_cast<Real>(hit.separation);
  return result;
}

ShapeHitResult nearest_hit(const PhysicsWorld& world, const WorldState& state,
                           const ShapeCast& given, const QueryFilter& filter) {
  if (!is_sound(given)) return {};
  const View view(world, state, filter, to_inner_position(given.start.position));
  FoundHit best;
  walk_cast(view, given, [&](const FoundHit& hit) {
    if (is_nearer(hit.value, hit.slot, best) && view.accepts(hit.slot)) best = hit;
    return best.slot == kNone ? PosReal(1) : reach_after(best.value);
  });
  return best.slot == kNone ? ShapeHitResult{} : shape_result(view, best);
}

// ---- nearest points -----------------------------------------------------------------------------

struct FoundGap {
  Num value = std::numeric_limits<Num>::infinity();  // distance
  std::uint32_t slot = kNone;
  Gap gap{};
};

// Calls found(FoundGap) -> the distance still of interest, for everything up to `reach`.
template <class Found>
void walk_gaps(const View& view, const Placed& own, const WorldAabb& box, Real max_distance,
               Found&& found) {
  if (!(max_distance >= Real(0))) return;
  const Num farthest = static_cast<Num>(max_distance);
  const PosReal slack = rounding_at(box);
  PosReal reach = static_cast<PosReal>(max_distance);
  const auto visit = [&](std::uint32_t slot, PosReal) -> PosReal {
    if (!view.sees(slot)) return reach + slack;
    const Placed placed = view.placed(slot);
    const Gap gap = gap_between(placed, own, own.p - placed.p);
    if (gap.distance <= farthest) reach = std::min(reach, found(FoundGap{gap.distance, slot, gap}));
    return reach + slack;
  };
  view.for_all_trees([&](const AabbTree& tree) { tree.nearest(box, reach + slack, visit); });
}

ClosestPointResult gap_result(const View& view, const FoundGap& found) {
  ClosestPointResult result;
  result.collider = view.id(found.slot);
  result.body = view.body(found.slot);
  result.distance = static_cast<Real>(found.gap.distance);
  result.on_collider = view.in_world(found.gap.on_a);
  result.on_query = view.in_world(found.gap.on_b);
  result.normal = to_public(cast<Real>(found.gap.normal));
  return result;
}

ClosestPointResult nearest_gap(const View& view, const Placed& own, const WorldAabb& box,
                               Real max_distance) {
  FoundGap best;
  walk_gaps(view, own, box, max_distance, [&](const FoundGap& found) {
    if (is_nearer(found.value, found.slot, best) && view.accepts(found.slot)) best = found;
    return best.slot == kNone ? static_cast<PosReal>(max_distance)
                              : static_cast<PosReal>(std::max(best.value, Num(0)));
  });
  return best.slot == kNone ? ClosestPointResult{} : gap_result(view, best);
}

void all_gaps(const View& view, const Placed& own, const WorldAabb& box, Real max_distance,
              std::vector<ClosestPointResult>& out) {
  walk_gaps(view, own, box, max_distance, [&](const FoundGap& found) {
    if (view.accepts(found.slot)) out.push_back(gap_result(view, found));
    return static_cast<PosReal>(max_distance);
  });
  std::sort(out.begin(), out.end(), [](const ClosestPointResult& a, const ClosestPointResult& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.collider < b.collider;
  });
}

// A point is a sphere without a radius.
const CollisionShape kPoint{};

ClosestPointResult nearest_gap(const PhysicsWorld& world, const WorldState& state,
                               const Pos3& point, Real max_distance, const QueryFilter& filter) {
  if (!point.allFinite()) return {};
  const PosVec p = to_inner_position(point);
  const View view(world, state, filter, p);
  return nearest_gap(view, {kPoint, {0, 0, 0}, {0, 0, 0, 1}}, {p, p}, max_distance);
}

// ---- lists and batches --------------------------------------------------------------------------

template <class Hit>
void sort_hits(std::vector<Hit>& out) {
  std::sort(out.begin(), out.end(), [](const Hit& a, const Hit& b) {
    return a.fraction != b.fraction ? a.fraction < b.fraction : a.collider < b.collider;
  });
}

template <class Question, class Answer, class Solve>
Status solve_all(std::span<const Question> questions, std::span<Answer> answers, JobSystem* jobs,
                 Solve&& solve) {
  if (questions.size() != answers.size())
    return {StatusCode::OutOfRange, "the spans of questions and answers must have one length"};
  if (questions.size() > std::numeric_limits<std::uint32_t>::max())
    return {StatusCode::CapacityExceeded, "a batch holds at most 4294967295 questions"};
  const auto count = static_cast<std::uint32_t>(questions.size());
  const auto task = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) answers[i] = solve(questions[i]);
  };
  if (jobs != nullptr && count > kQueryGrain) {
    jobs->parallel_for(count, kQueryGrain, task);
  } else {
    task(0, count);
  }
  return {};
}

template <class Result>
std::optional<Result> found_or_nothing(const Result& result) {
  if (result.collider.is_null()) return std::nullopt;
  return result;
}

}  // namespace
}  // namespace detail

using namespace detail;

std::optional<RayHitResult> PhysicsWorld::cast_ray(const Pos3& origin, const Vec3& translation,
                                                   const QueryFilter& filter) const {
  return found_or_nothing(nearest_hit(*this, *state_, Ray{origin, translation}, filter));
}
std::optional<RayHitResult> PhysicsWorld::cast_ray(const Pos3& origin, const Vec3& translation,
                                                   std::uint32_t layers) const {
  QueryFilter filter;
  filter.layers = layers;
  return cast_ray(origin, translation, filter);
}

bool PhysicsWorld::ray_is_blocked(const Pos3& origin, const Vec3& translation,
                                  const QueryFilter& filter) const {
  const Ray ray{origin, translation};
  if (!is_sound(ray)) return false;
  const View view(*this, *state_, filter, to_inner_position(origin));
  bool blocked = false;
  walk_ray(view, ray, [&](const FoundHit& hit) {
    blocked = blocked || view.accepts(hit.slot);
    return blocked ? PosReal(0) : PosReal(1);
  });
  return blocked;
}

void PhysicsWorld::cast_ray_all(const Pos3& origin, const Vec3& translation,
                                std::vector<RayHitResult>& out, const QueryFilter& filter) const {
  out.clear();
  const Ray ray{origin, translation};
  if (!is_sound(ray)) return;
  const View view(*this, *state_, filter, to_inner_position(origin));
  walk_ray(view, ray, [&](const FoundHit& hit) {
    if (view.accepts(hit.slot)) out.push_back(ray_result(view, hit));
    return PosReal(1);
  });
  sort_hits(out);
}

std::optional<ShapeHitResult> PhysicsWorld::cast_shape(const ShapeCast& cast,
                                                       const QueryFilter& filter) const {
  return found_or_nothing(nearest_hit(*this, *state_, cast, filter));
}

void PhysicsWorld::cast_shape_all(const ShapeCast& cast, std::vector<ShapeHitResult>& out,
                                  const QueryFilter& filter) const {
  out.clear();
  if (!is_sound(cast)) return;
  const View view(*this, *state_, filter, to_inner_position(cast.start.position));
  walk_cast(view, cast, [&](const FoundHit& hit) {
    if (view.accepts(hit.slot)) out.push_back(shape_result(view, hit));
    return PosReal(1);
  });
  sort_hits(out);
}

void PhysicsWorld::overlap_shape(const Shape& shape, const Pose& pose, std::vector<ColliderId>& out,
                                 const QueryFilter& filter) const {
  out.clear();
  if (!is_sound(shape, pose)) return;
  const View view(*this, *state_, filter, to_inner_position(pose.position));
  const OwnShape own(shape, pose);
  const auto visit = [&](std::uint32_t slot) {
    if (view.sees(slot) && shapes_overlap(view.placed(slot), own.placed()) && view.accepts(slot))
      out.push_back(view.id(slot));
  };
  const WorldAabb box = own.bounds(view.reference());
  view.for_all_trees([&](const AabbTree& tree) { tree.query(box, visit); });
  std::sort(out.begin(), out.end());
}

std::optional<ClosestPointResult> PhysicsWorld::closest_point(const Pos3& point, Real max_distance,
                                                              const QueryFilter& filter) const {
  return found_or_nothing(nearest_gap(*this, *state_, point, max_distance, filter));
}

std::optional<ClosestPointResult> PhysicsWorld::closest_point(const Shape& shape, const Pose& pose,
                                                              Real max_distance,
                                                              const QueryFilter& filter) const {
  if (!is_sound(shape, pose)) return std::nullopt;
  const View view(*this, *state_, filter, to_inner_position(pose.position));
  const OwnShape own(shape, pose);
  return found_or_nothing(
      nearest_gap(view, own.placed(), own.bounds(view.reference()), max_distance));
}

void PhysicsWorld::closest_points(const Pos3& point, Real max_distance,
                                  std::vector<ClosestPointResult>& out,
                                  const QueryFilter& filter) const {
  out.clear();
  if (!point.allFinite()) return;
  const PosVec p = to_inner_position(point);
  const View view(*this, *state_, filter, p);
  all_gaps(view, {kPoint, {0, 0, 0}, {0, 0, 0, 1}}, {p, p}, max_distance, out);
}

void PhysicsWorld::closest_points(const Shape& shape, const Pose& pose, Real max_distance,
                                  std::vector<ClosestPointResult>& out,
                                  const QueryFilter& filter) const {
  out.clear();
  if (!is_sound(shape, pose)) return;
  const View view(*this, *state_, filter, to_inner_position(pose.position));
  const OwnShape own(shape, pose);
  all_gaps(view, own.placed(), own.bounds(view.reference()), max_distance, out);
}

void PhysicsWorld::overlap_bounds(const Bounds& box, std::vector<ColliderId>& out,
                                  const QueryFilter& filter) const {
  out.clear();
  if (!box.lower.allFinite() || !box.upper.allFinite()) return;
  const WorldAabb sought{to_inner_position(box.lower), to_inner_position(box.upper)};
  const View view(*this, *state_, filter, sought.lower);
  const auto visit = [&](std::uint32_t slot) {
    if (!view.sees(slot)) return;
    const ColliderInfo& collider = view.info(slot);
    const BodyPose& pose = state_->bodies.pose[state_->bodies.info[collider.body].dense];
    const Transform placed{rotate(pose.q, collider.in_body.p), pose.q * collider.in_body.q};
    const Aabb tight = bounds_of(collider.shape, placed);
    const WorldAabb bounds{pose.x + detail::cast<PosReal>(tight.lower),
                           pose.x + detail::cast<PosReal>(tight.upper)};
    if (overlaps(sought, bounds) && view.accepts(slot)) out.push_back(view.id(slot));
  };
  view.for_all_trees([&](const AabbTree& tree) { tree.query(sought, visit); });
  std::sort(out.begin(), out.end());
}
void PhysicsWorld::overlap_bounds(const Bounds& box, std::vector<ColliderId>& out,
                                  std::uint32_t layers) const {
  QueryFilter filter;
  filter.layers = layers;
  filter.sensors = true;
  overlap_bounds(box, out, filter);
}

Status PhysicsWorld::cast_rays(std::span<const Ray> rays, std::span<RayHitResult> hits,
                               const QueryFilter& filter, JobSystem* jobs) const {
  return solve_all(rays, hits, jobs,
                   [&](const Ray& ray) { return nearest_hit(*this, *state_, ray, filter); });
}
Status PhysicsWorld::cast_shapes(std::span<const ShapeCast> casts, std::span<ShapeHitResult> hits,
                                 const QueryFilter& filter, JobSystem* jobs) const {
  return solve_all(casts, hits, jobs, [&](const ShapeCast& cast) {
    return nearest_hit(*this, *state_, cast, filter);
  });
}
Status PhysicsWorld::closest_points(std::span<const Pos3> points, Real max_distance,
                                    std::span<ClosestPointResult> nearest,
                                    const QueryFilter& filter, JobSystem* jobs) const {
  return solve_all(points, nearest, jobs, [&](const Pos3& point) {
    return nearest_gap(*this, *state_, point, max_distance, filter);
  });
}

}  // namespace plumb::inline PLUMB_ABI
