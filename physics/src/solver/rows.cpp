// Rows: from a manifold and two bodies to the numbers that the solver iterates on.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "collision/rolling.h"
#include "effects/effect_world.h"
#include "math/prefetch.h"
#include "motion/body_motion.h"
#include "solver/joints/joint_stages.h"
#include "solver/newton/newton_solver.h"
#include "solver/plain_bodies.h"
#include "solver/row_responses.h"
#include "solver/surface_drive.h"
#include "solver/turning_kernel.h"
#include "solver/worst_first.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

Softness make_softness(Real frequency, Real damping_ratio, Real masses, Real h) {
  constexpr Real kTwoPi = Real(6.283185307179586476925);
  const Real w = kTwoPi * frequency;
  const Real a1 = Real(2) * damping_ratio + h * w;
  const Real a2 = masses * h * w * a1;
  const Real a3 = Real(1) / (Real(1) + a2);
  return {w / a1, a2 * a3, a3};
}

void mark_loaded_points(ContactRow<Real>& row) {
  for (int i = 0; i < row.count; ++i)
    row.points[i].loaded = row.points[i].impulse > row.negligible ? Real(1) : Real(0);
}

namespace {

// [m] Radius of gyration about the axis that turns most easily.
Real smallest_gyration(const BodyMass& m) {
  const Real easiest =
      m.mass * std::max({m.inverse_moments.x, m.inverse_moments.y, m.inverse_moments.z});
  return easiest > Real(0) ? Real(1) / std::sqrt(easiest) : std::numeric_limits<Real>::max();
}

// What all rows of a body ask of it.
struct RowBody {
  Real gyration = std::numeric_limits<Real>::max();  // [m] the smallest radius
  Real pull = 0;                                     // [m/s^2] of gravity and forces
};

// What rows ask of the world, looked up once.
class RowContext {
 public:
  explicit RowContext(WorldState& w)
      : world(w),
        gravity(static_cast<Real>(w.settings.gravity.norm())),
        bodies_(w.bodies.awake_end, &w.memory) {}
  void note(std::uint32_t dense) {
    const BodyMass& mass = world.bodies.mass[dense];
    if (mass.mass > Real(0))
      bodies_[dense] = {smallest_gyration(mass), length(world.substep[dense].acceleration)};
  }
  [[nodiscard]] RowBody body(std::uint32_t dense) const {
    return dense < bodies_.size() ? bodies_[dense] : RowBody{};
  }

  const WorldState& world;
  const Real gravity;  // [m/s^2]

 private:
  StepList<RowBody> bodies_;  // per dense body that is awake
};

void make_points(ContactRow<Real>& row, const Contact& contact, Vec center, Real warm) {
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    const ManifoldPoint& from = contact.manifold.points[i];
    const Vec offset = from.position - center;
    point = {};
    point.a = dot(row.t1, offset);
    point.b = dot(row.t2, offset);
    point.separation = from.separation;
    point.impulse = warm * contact.normal_impulse[i];
    // Friction also stops swaying, and those impulses must not grow with the step: that would pump.
    const Real warm_friction = std::min(warm, Real(1));
    point.friction1 = warm_friction * dot(row.t1, contact.friction_impulse[i]);
    point.friction2 = warm_friction * dot(row.t2, contact.friction_impulse[i]);
  }
}

}  // namespace

// [Hz] of a contact, for it to sink no more than its share, however short the substep must be.
static Real wanted_frequency(const WorldState& world, const ContactRow<Real>& row) {
  const Real thickness = row.push_speed / tolerance::kPushRate;
  const Real pull = static_cast<Real>(world.settings.gravity.norm()) / thickness;
  const Real stiffer = std::sqrt(std::max(pull / tolerance::kReferencePull, Real(1)));
  return world.settings.contact_frequency * stiffer;
}

Real longest_substep(const WorldState& world, const ContactRow<Real>& row) {
  const Real masses = row.both_dynamic ? tolerance::kContactMasses : Real(1);
  return tolerance::kStiffestContact / (wanted_frequency(world, row) * std::sqrt(masses));
}

// A contact sinks by g/w^2 under its load: for no size to sink more than its share, w^2 must follow
// g / thickness, as far as the substep allows [Catto 2024].
void soften_row(const WorldState& world, ContactRow<Real>& row, Real h) {
  const Real stiffest = tolerance::kStiffestContact / h;
  Real frequency = std::min(wanted_frequency(world, row), stiffest);
  if (!row.both_dynamic) frequency *= tolerance::kStaticStiffness;
  const Real damping = world.settings.contact_damping_ratio;
  const Softness in_turn = make_softness(frequency, damping, Real(1), h);
  Softness at_once = in_turn;
  if (row.both_dynamic) {
    const Real room = stiffest / frequency;  // a spring of s masses is sqrt(s) times as fast
    at_once =
        make_softness(frequency, damping, std::min(tolerance::kContactMasses, room * room), h);
  }
  row.bias_rate = at_once.bias_rate;
  row.mass_scale = at_once.mass_scale;
  row.impulse_scale = at_once.impulse_scale;
  row.mass_scale_in_turn = in_turn.mass_scale;
  row.impulse_scale_in_turn = in_turn.impulse_scale;
}

void fill_responses(ContactRow<Real>& row) { make_responses(row); }

namespace {

// `arm`: of the contact from the body's centre of mass; `outward`: from the collider.
Real rolling_surface(const WorldState& world, std::uint32_t slot, Real radius, Vec arm,
                     Vec outward) {
  const ColliderInfo& collider = world.colliders.info[slot];
  if (!is_curved(collider.shape.type)) return radius;
  const Rotation& q_body = world.bodies.pose[world.bodies.dense_of[collider.body]].q;
  const Vec place = inverse_rotate(q_body, arm), normal = inverse_rotate(q_body, outward);
  return rolling_radius(collider.shape, inverse_transform_point(collider.in_body, place),
                        inverse_rotate(collider.in_body.q, normal));
}

// [m] Radius of a surface that is round at a contact; 0 of one that is flat or sharp, or of parts.
Real roundness(const CollisionShape& shape, Real surface) {
  if (shape.type == ShapeType::Sphere || shape.type == ShapeType::Capsule) return surface;
  return is_curved(shape.type) && surface > shape.radius ? surface : Real(0);
}

// How two dynamic bodies share the path between them (place_arms). A contact goes with the centre
// of what is round: a ball keeps it below itself, however far the board it rolls on is pulled along
// meanwhile; anywhere else its own weight would drive it. Two round surfaces share the path as
// their radii. What is flat or sharp tells nothing of it: half each.
void share_path(const WorldState& world, const Pair& pair, ContactRow<Real>& row) {
  const auto round = [&](std::uint32_t collider, Real surface) {
    return surface > Real(0) ? roundness(world.colliders.info[collider].shape, surface) : Real(0);
  };
  const Real a = round(pair.collider_a(), row.surface_a);
  const Real b = round(pair.collider_b(), row.surface_b);
  if (a > Real(0) && b > Real(0)) {
    row.follow_a = a / (a + b);
  } else {
    row.follow_a = b > Real(0) ? Real(1) : (a > Real(0) ? Real(0) : Real(0.5));
  }
  row.follow_b = Real(1) - row.follow_a;
}

// Turns the contact's axes so that t1 lies along the grain. A grain that stands on the contact
// plane leaves friction round.
void align_with_grain(const WorldState& world, const Pair& pair, ContactRow<Real>& row) {
  constexpr Real kUpright = Real(1e-2);  // [-] sine of the angle to the normal
  const ColliderInfo* grained = &world.colliders.info[pair.collider_a()];
  const ColliderInfo* other = &world.colliders.info[pair.collider_b()];
  const auto share = [](const ColliderInfo& c) {
    const Material& m = c.component.material;
    return m.grain.squaredNorm() > Real(0) ? m.grain_friction : Real(1);
  };
  if (share(*other) < share(*grained)) grained = other;
  const Material& material = grained->component.material;
  const Rotation& q_body = world.bodies.pose[world.bodies.dense_of[grained->body]].q;
  const Vec grain = rotate(q_body, rotate(grained->in_body.q, to_inner(material.grain)));
  const Vec flat = grain - dot(grain, row.n) * row.n;
  const Real size = length(flat);
  if (!(size > kUpright * length(grain))) return;
  row.t1 = (Real(1) / size) * flat;
  row.t2 = cross(row.n, row.t1);
  row.along = material.grain_friction;
}

void build_row(const RowContext& context, ContactRow<Real>& row, std::uint32_t contact_index) {
  const WorldState& world = context.world;
  const BodyStore& bodies = world.bodies;
  const Contact& contact = world.contacts[contact_index];
  const Pair& pair = world.pairs[contact.pair];
  row = {};
  row.contact = contact_index;
  row.body_a = bodies.dense_of[pair.body_a];
  row.body_b = bodies.dense_of[pair.body_b];
  row.count = contact.manifold.count;
  row.n = contact.manifold.normal;
  tangent_frame(row.n, row.t1, row.t2);
  if (pair.grained) align_with_grain(world, pair, row);

  Vec center{0, 0, 0};
  for (int i = 0; i < row.count; ++i) center += contact.manifold.points[i].position;
  center = (Real(1) / static_cast<Real>(row.count)) * center;
  const Vec from_a_to_b = cast<Real>(bodies.pose[row.body_b].x - bodies.pose[row.body_a].x);
  row.between = from_a_to_b;
  row.advance = contact.advance;
  row.watched = length_squared(row.advance) > Real(0);
  row.arm_a = pair.relative_to_b ? center + (from_a_to_b + contact.advance) : center;
  row.arm_b = pair.relative_to_b ? center : center - (from_a_to_b + contact.advance);
  const bool a_moves = bodies.mass[row.body_a].mass > Real(0);
  const bool b_moves = bodies.mass[row.body_b].mass > Real(0);
  row.both_dynamic = a_moves && b_moves;
  const RowBody of_a = context.body(row.body_a), of_b = context.body(row.body_b);
  Real gap = 0;  // between the surfaces, when the manifold was made
  for (int i = 0; i < row.count; ++i)
    gap += contact.manifold.points[i].separation - contact.advanced_gap;
  const Vec half_gap = (Real(0.5) * gap / static_cast<Real>(row.count)) * row.n;
  row.surface_a = contact.radius_a;
  row.surface_b = contact.radius_b;
  if (pair.curved) {
    row.surface_a = rolling_surface(world, pair.collider_a(), contact.radius_a, row.arm_a, row.n);
    row.surface_b = rolling_surface(world, pair.collider_b(), contact.radius_b, row.arm_b, -row.n);
  }
  row.core_a = row.arm_a - half_gap - row.surface_a * row.n;
  row.core_b = row.arm_b + half_gap + row.surface_b * row.n;
  if (row.both_dynamic) {
    share_path(world, pair, row);
    const auto room = [](Real gyration, Real follow) {
      return follow > Real(0) ? gyration / follow : std::numeric_limits<Real>::max();
    };
    row.path_room = tolerance::kArmRoom *
                    std::min(room(of_a.gyration, row.follow_a), room(of_b.gyration, row.follow_b));
    // ... and lies on its surface, not half-way through what they overlap: it rolls by its radius.
    const Vec to_round = (row.follow_a - row.follow_b) * half_gap;
    row.arm_a += to_round;
    row.arm_b += to_round;
  } else {
    // Against what does not yield a body acts with its own surface, wherever the other one's is.
    row.arm_a -= half_gap;
    row.arm_b += half_gap;
  }

  if (a_moves) {
    row.inverse_mass_a = bodies.mass[row.body_a].inverse_mass;
    row.inverse_inertia_a = world.substep[row.body_a].I_inverse;
  }
  if (b_moves) {
    row.inverse_mass_b = bodies.mass[row.body_b].inverse_mass;
    row.inverse_inertia_b = world.substep[row.body_b].I_inverse;
  }
  // The remembered impulses belong to a substep of the last length; forces are what persists.
  const Real warm =
      world.settings.warm_starting && world.last_h > Real(0) ? world.h / world.last_h : Real(0);
  make_points(row, contact, center, warm);

  if (pair.driven) row.drive = drive_of(world, pair, row).velocity;
  row.friction = pair.friction;
  row.restitution = pair.restitution;
  const Real thickness = pair.slop / tolerance::kSlopFraction;
  row.push_speed = tolerance::kPushRate * thickness;
  soften_row(world, row, world.h);
  row.push_speed_now = row.push_speed;
  // What overlaps is no collision to come: it must approach faster than resting bodies to bounce.
  Real deepest = 0;
  for (int i = 0; i < row.count; ++i) deepest = std::max(deepest, -row.points[i].separation);
  row.at_rest = contact.at_rest || deepest > pair.slop;

  // As the step begins: how fast do the surfaces approach, and what does a substep add to that?
  // Asked by bounces and by what meets in this step.
  if (row.restitution > Real(0) || !pair.was_touching) {
    const BodyVelocity& va = bodies.velocity[row.body_a];
    const BodyVelocity& vb = bodies.velocity[row.body_b];
    for (int i = 0; i < row.count; ++i) {
      const Vec place = row.points[i].a * row.t1 + row.points[i].b * row.t2;
      const Vec v = vb.v + cross(vb.w, row.arm_b + place) - va.v - cross(va.w, row.arm_a + place);
      row.approach_speed = std::max(row.approach_speed, -dot(row.n, v));
    }
  }
  row.cut_unit = std::max(of_a.pull, of_b.pull) * world.h;
  const auto& collider_a = world.colliders.info[pair.collider_a()];
  const auto& collider_b = world.colliders.info[pair.collider_b()];
  if (row.restitution > Real(0) && collider_a.shape.type == ShapeType::Sphere &&
      collider_b.shape.type == ShapeType::Sphere &&
      length_squared(collider_a.in_body.p) == Real(0) &&
      length_squared(collider_b.in_body.p) == Real(0)) {
    row.exact_spheres = true;
    row.radius_a = collider_a.shape.radius;
    row.radius_b = collider_b.shape.radius;
  }
  // Bodies that do not move in this step are all the world itself, dense 0.
  if (row.body_a >= bodies.awake_end) row.body_a = 0;
  if (row.body_b >= bodies.awake_end) row.body_b = 0;
  row.negligible =
      tolerance::kLoadedFraction * world.h *
      std::max(bodies.mass[row.body_a].mass * of_a.pull, bodies.mass[row.body_b].mass * of_b.pull);
  mark_loaded_points(row);
}

// Gives the rows of pairs that resist turning or have a grain their own; one test a step where
// nothing does.
void build_turning_rows(WorldState& world) {
  world.turning_rows.clear();
  if (world.counts.turning == 0 && world.counts.grained == 0 &&
      !world.contact_data.materials.resists_turning())
    return;
  for (ContactRow<Real>& row : world.rows) {
    const Pair& pair = world.pairs[world.contacts[row.contact].pair];
    if (!(pair.rolling > Real(0)) && !(pair.torsional > Real(0)) && row.along == Real(1)) continue;
    row.turning = static_cast<std::uint32_t>(world.turning_rows.size());
    row.watched = true;
    world.turning_rows.push_back(make_turning_row(row, pair.rolling, pair.torsional));
  }
}

// How contacts hold a body.
constexpr std::uint8_t kFree = 0, kHeld = 1, kDriven = 2;

// To what several threads may add at once; most find that others were there before.
void add_bits(std::uint8_t& to, std::uint8_t bits) {
  const std::atomic_ref shared(to);
  if ((shared.load(std::memory_order_relaxed) & bits) != bits)
    shared.fetch_or(bits, std::memory_order_relaxed);
}

void begin_body(WorldState& world, std::uint32_t i, std::uint8_t hold, bool needs_inertia,
                RowContext& context) {
  BodyStore& bodies = world.bodies;
  world.delta[i] = {};
  SubstepBody& s = world.substep[i];
  s = {};
  const bool held = (hold & kHeld) != 0;
  s.driven = (hold & kDriven) != 0;
  const BodyMass& m = bodies.mass[i];
  s.acceleration = multiply_each(m.inverse_mass, bodies.force[i].force);
  if (m.mass > Real(0)) {
    const Vec g = m.gravity_scale * to_inner(world.settings.gravity);
    // A locked axis feels no gravity.
    s.acceleration +=
        Vec{m.inverse_mass.x > Real(0) ? g.x : Real(0), m.inverse_mass.y > Real(0) ? g.y : Real(0),
            m.inverse_mass.z > Real(0) ? g.z : Real(0)};
    s.constrained = held;
    if (held || needs_inertia) {
      s.I = world_inertia(m, bodies.pose[i].q);
      s.I_inverse = world_inverse_inertia(m, bodies.pose[i].q);
    }
  }
  choose_body_way(world, i);
  if (held) context.note(i);
}

}  // namespace

void build_rows(WorldState& world) {
  const std::uint32_t count = static_cast<std::uint32_t>(world.row_order.size());
  RowContext context(world);
  BodyStore& bodies = world.bodies;
  world.delta.resize(bodies.dense_count());
  world.substep.resize(bodies.dense_count());
  world.delta[0] = {};
  world.substep[0] = {};
  world.contacts_changed.assign(bodies.awake_end, 0);
  world.body_ways.resize(bodies.awake_end);
  // Bodies first: what a row reads of them, and which of them are held by a row. What nothing holds
  // flies, and needs no inertia in world axes.
  StepList<std::uint8_t> held(bodies.dense_count(), kFree, &world.memory);
  std::atomic<bool> some_bounce = false;
  const auto pair_count = static_cast<std::uint32_t>(world.pairs.size());
  parallel_for(
      world, pair_count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i) {
          const Pair& pair = world.pairs[i];
          if (pair.contact_count == 0) continue;
          const auto hold = static_cast<std::uint8_t>(pair.driven ? kHeld | kDriven : kHeld);
          add_bits(held[bodies.dense_of[pair.body_a]], hold);
          add_bits(held[bodies.dense_of[pair.body_b]], hold);
          if (pair.restitution > Real(0)) some_bounce.store(true, std::memory_order_relaxed);
        }
      });
  const bool all_inertias = !world.joints.empty() || world.diagnostics.ledger || world.has_effects;
  parallel_for(world, bodies.awake_end - bodies.awake_begin, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = bodies.awake_begin + begin; i < bodies.awake_begin + end;
                      ++i)
                   begin_body(world, i, held[i], all_inertias, context);
               });
  if (!world.joints.empty()) build_joints(world);
  world.rows.resize(count);
  parallel_for(world, count, tolerance::kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      // Rows of one colour lie far apart among the contacts.
      if (i + 2 * kRowsAhead < end) prefetch(world.contacts[world.row_order[i + 2 * kRowsAhead]]);
      if (i + kRowsAhead < end)
        prefetch(world.pairs[world.contacts[world.row_order[i + kRowsAhead]].pair]);
      build_row(context, world.rows[i], world.row_order[i]);
    }
  });
  build_turning_rows(world);
  find_spinning_rows(world);
  find_adhesive_rows(world);
  world.bouncing_rows.clear();
  const bool bounces_in_time = some_bounce && !resolves_worst_first(world);
  for (std::uint32_t i = 0; i < count && bounces_in_time; ++i)
    if (world.rows[i].restitution > Real(0)) world.bouncing_rows.push_back(i);
  find_turned_rows(world);
  if (world.newton != nullptr && world.newton->count > 0) gather_newton_islands(world);
}

}  // namespace plumb::inline PLUMB_ABI::detail
