// Saving and restoring a world as named columns.
//
// One visitor per table lists its columns once; saving, restoring and their order all follow from
// it.
#include "plumb/snapshot.h"

#include <algorithm>
#include <cmath>

#include "collision/collide.h"
#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "world/inputs.h"
#include "world/joint_world.h"
#include "world/shape_numbers.h"
#include "world/snapshot_contact_data.h"
#include "world/snapshot_geometry.h"
#include "world/snapshot_table.h"
#include "world/validate.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

template <class Table>
void visit_world(Table& t, WorldState& world) {
  WorldSettings& s = world.settings;
  t("gravity", s.gravity.x(), s.gravity.y(), s.gravity.z());
  t("substeps", s.substeps);
  t("step_tolerance", s.step_tolerance);
  t("contact_spring", s.contact_frequency, s.contact_damping_ratio);
  t("rotation", s.rotation);
  t("contact_solver", s.contact_solver);
  t("velocity_iterations", s.velocity_iterations);
  t("friction_cone", s.friction_cone);
  t("joint_order", s.joint_order);
  std::uint64_t items_off = s.forced.items_off(), items_on = s.forced.items_on();
  t("forced", items_off, items_on);
  s.forced = PlanChoices(items_off, items_on);
  t("switches", s.warm_starting, s.sleeping, s.profiling);
  t("time_to_sleep", s.time_to_sleep);
  t("time", world.time);
  t("dt", world.dt, world.proxy_dt, world.last_h);
  t("steps", world.step_count);
  t("newton_calls", world.newton_calls.mass, world.newton_calls.load, world.newton_calls.overlap);
}

template <class Table>
void visit_body(Table& t, BodyInfo& i, BodyVelocity& v, BodyPose& x, BodyMomentum& m, BodyForce& f,
                Vec& acceleration, Real& gravity_scale, bool& awake) {
  t("generation", i.generation);
  t("flags", i.alive, i.disabled, i.has_own_mass, i.can_sleep, i.continuous, awake);
  t("type", i.type);
  t("locks", i.locks.linear_x, i.locks.linear_y, i.locks.linear_z, i.locks.angular_x,
    i.locks.angular_y, i.locks.angular_z);
  t("island", i.island);
  t("rest_time", i.rest_time);
  t("step_level", i.level.halvings, i.level.calm_steps);
  t("newton_calls", i.newton_calls);
  t("newton_steps", i.newton_steps);
  t("newton_pause", i.newton_pause);
  t("newton_overruns", i.newton_overruns);
  t("position", x.x.x, x.x.y, x.x.z);
  t("orientation", x.q.x, x.q.y, x.q.z, x.q.w);
  t("velocity", v.v.x, v.v.y, v.v.z);
  t("angular_velocity", v.w.x, v.w.y, v.w.z);
  t("angular_momentum", m.L.x, m.L.y, m.L.z);
  t("force", f.force.x, f.force.y, f.force.z);
  t("torque", f.torque.x, f.torque.y, f.torque.z);
  t("damping", f.linear_damping, f.angular_damping);
  t("gravity_scale", gravity_scale);
  t.unbounded("acceleration", acceleration.x, acceleration.y, acceleration.z);
  t("center", i.center_B.x, i.center_B.y, i.center_B.z);
  t("principal_axes", i.R_BP.x, i.R_BP.y, i.R_BP.z, i.R_BP.w);
  Eigen::Matrix3d& I = i.properties.I_Bcm_B;
  t("mass", i.properties.mass);
  t("mass_center", i.properties.center.x(), i.properties.center.y(), i.properties.center.z());
  t("inertia", I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  t("user_data", i.user_data);
}

template <class Table>
void visit_collider(Table& t, ColliderInfo& c, ShapeNumbers& shape, WorldAabb& box) {
  t("generation", c.generation);
  t("flags", c.alive, c.is_static, c.query_pairs, c.component.is_sensor);
  t("body", c.body);
  t("shape", shape.type, shape.hull);
  t("shape_numbers", shape.n[0], shape.n[1], shape.n[2], shape.n[3]);
  LocalPose& p = c.component.pose;
  t("position", p.position.x(), p.position.y(), p.position.z());
  t("orientation", p.orientation.x(), p.orientation.y(), p.orientation.z(), p.orientation.w());
  Material& m = c.component.material;
  t("surface", m.friction, m.restitution, m.rolling_friction, m.torsional_friction);
  t("surface_grain", m.grain.x(), m.grain.y(), m.grain.z(), m.grain_friction, m.adhesion);
  t("surface_rules", m.friction_rule, m.restitution_rule);
  t("surface_kind", m.kind);
  SurfaceVelocity& s = c.component.surface_velocity;
  t("surface_velocity", s.linear.x(), s.linear.y(), s.linear.z());
  t("surface_spin", s.angular.x(), s.angular.y(), s.angular.z());
  Vec3& one_way = c.component.one_way;
  t("one_way", one_way.x(), one_way.y(), one_way.z());
  Filter& filter = c.component.filter;
  t("filter", filter.layers, filter.collides_with, filter.group);
  t("density", c.component.density);
  t("user_data", c.component.user_data);
  t.unbounded("bounds", box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y,
              box.upper.z);
}

// The rest of a pair follows from its colliders.
template <class Table>
void visit_pair(Table& t, Pair& p, std::uint32_t& island) {
  t("key", p.key);
  t("island", island);
  t("flags", p.touching, p.was_touching);
  t("passage", p.passage);
  t("began", p.began);
  t("contacts", p.contact_count);
}

template <class Table>
void visit_kept(Table& t, KeptManifold& k) {
  t("kept_margin", k.margin);
  t("kept_normal", k.normal.x, k.normal.y, k.normal.z);
  t("kept_a", k.a.x.x, k.a.x.y, k.a.x.z, k.a.q.x, k.a.q.y, k.a.q.z, k.a.q.w);
  t("kept_b", k.b.x.x, k.b.x.y, k.b.x.z, k.b.q.x, k.b.q.y, k.b.q.z, k.b.q.w);
  static constexpr const char* kNames[4] = {"kept0", "kept1", "kept2", "kept3"};
  for (std::size_t i = 0; i < Manifold::kMaxPoints; ++i)
    t(kNames[i], k.position[i].x, k.position[i].y, k.position[i].z, k.separation[i]);
}

template <class Table>
void visit_contact(Table& t, Contact& c) {
  Manifold& m = c.manifold;
  t("part", c.part);
  t("flags", c.at_rest);
  t("normal", m.normal.x, m.normal.y, m.normal.z);
  t("radii", c.radius_a, c.radius_b);
  t("advance", c.advance.x, c.advance.y, c.advance.z, c.advanced_gap);
  t("points", m.count);
  static constexpr const char* kNames[4][5] = {
      {"place0", "feature0", "impulse0", "friction0", "step0"},
      {"place1", "feature1", "impulse1", "friction1", "step1"},
      {"place2", "feature2", "impulse2", "friction2", "step2"},
      {"place3", "feature3", "impulse3", "friction3", "step3"}};
  for (std::size_t k = 0; k < Manifold::kMaxPoints; ++k) {
    ManifoldPoint& point = m.points[k];
    Vec &f = c.friction_impulse[k], &s = c.step_friction_impulse[k];
    t(kNames[k][0], point.position.x, point.position.y, point.position.z, point.separation);
    t(kNames[k][1], point.feature);
    t.unbounded(kNames[k][2], c.normal_impulse[k], c.step_normal_impulse[k]);
    t.unbounded(kNames[k][3], f.x, f.y, f.z);
    t.unbounded(kNames[k][4], s.x, s.y, s.z);
  }
  visit_kept(t, c.kept);
}

void add_list(ColumnWriter& out, const char* table, const char* name,
              const std::vector<std::uint32_t>& values) {
  out.add(table, name, 1, false).integers.assign(values.begin(), values.end());
}
bool read_list(const Snapshot& in, const char* name, std::vector<std::uint32_t>& values,
               std::size_t limit) {
  const SnapshotColumn* column = in.find(name);
  if (column == nullptr || column->type != SnapshotColumn::Type::Uint64) return false;
  values.clear();
  for (const std::uint64_t v : column->integers) {
    if (v >= limit) return false;
    values.push_back(static_cast<std::uint32_t>(v));
  }
  return true;
}

// Hulls are stored once, whatever the number of colliders that share them.
void save_hulls(ColumnWriter& out, const std::vector<std::shared_ptr<const HullGeometry>>& hulls) {
  std::vector<Shape> shapes;
  for (const auto& hull : hulls) shapes.emplace_back(ConvexHull{hull});
  save_shapes(out, "hull", shapes);
}

bool restore_hulls(const Snapshot& in, std::vector<std::shared_ptr<const HullGeometry>>& hulls) {
  std::vector<Shape> shapes;
  if (!restore_shapes(in, "hull", shapes)) return false;
  for (const Shape& shape : shapes) {
    const auto* hull = std::get_if<ConvexHull>(&shape);
    if (hull == nullptr) return false;
    hulls.push_back(hull->geometry);
  }
  return true;
}

bool is_unit(const Rotation& q) { return check_orientation(to_public(q)).ok(); }

// Builds bodies from their table. Dense places are given anew; nothing depends on them.
bool restore_bodies(const Snapshot& in, WorldState& world) {
  TableReader table(in, "body");
  BodyStore& bodies = world.bodies;
  const std::size_t count = table.rows();
  std::vector<BodyInfo> infos(count);
  for (std::size_t slot = 0; slot < count; ++slot) {
    BodyInfo info;
    BodyVelocity velocity;
    BodyPose pose;
    BodyMomentum momentum;
    BodyForce force;
    Vec acceleration{0, 0, 0};
    Real gravity_scale = 1;
    bool awake = false;
    table.next_row();
    visit_body(table, info, velocity, pose, momentum, force, acceleration, gravity_scale, awake);
    if (!table.ok() ||
        (info.alive && !(info.properties.mass >= 0 && is_unit(pose.q) && is_unit(info.R_BP))))
      return false;
    const std::uint32_t made = bodies.create();  // slots come in ascending order: none is free yet
    if (made != slot) return false;
    Eigen::Matrix3d& I = info.properties.I_Bcm_B;
    I(1, 0) = I(0, 1), I(2, 0) = I(0, 2), I(2, 1) = I(1, 2);
    info.dense = bodies.info[made].dense;
    bodies.info[made] = info;
    bodies.pose[info.dense] = pose;
    bodies.mass[info.dense].gravity_scale = gravity_scale;
    bodies.force[info.dense] = force;
    bodies.acceleration[made] = acceleration;
    if (info.alive) {
      bodies.info[made].has_own_mass =
          true;                  // its colliders are not there yet: the saved mass holds
      update_mass(world, made);  // the principal moments; the frame was saved and is put back below
      bodies.info[made].has_own_mass = info.has_own_mass;
      const std::uint32_t dense = bodies.info[made].dense;
      if (info.disabled) bodies.mass[dense] = BodyMass{};
      bodies.info[made].R_BP = info.R_BP;
      bodies.info[made].center_B = info.center_B;
      bodies.info[made].properties = info.properties;
      bodies.pose[dense] = pose;
      bodies.velocity[dense] = velocity;
      bodies.momentum[dense] = momentum;
      if (awake) bodies.wake(made);
      if (info.type == MotionType::Kinematic) ++world.counts.kinematic;
    }
  }
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    if (bodies.info[slot].alive) continue;
    const std::uint32_t generation = bodies.info[slot].generation;
    bodies.destroy(slot);
    bodies.info[slot].generation = generation;
  }
  return read_list(in, "body_free.slot", bodies.free_slots, count + 1);
}

bool restore_colliders(const Snapshot& in, WorldState& world) {
  std::vector<std::shared_ptr<const HullGeometry>> hulls;
  GeometryTable geometries;
  if (!restore_hulls(in, hulls) || !geometries.restore(in)) return false;
  TableReader table(in, "collider");
  for (std::size_t slot = 0; slot < table.rows(); ++slot) {
    ColliderInfo info;
    ShapeNumbers shape;
    WorldAabb box{};
    table.next_row();
    visit_collider(table, info, shape, box);
    if (!table.ok()) return false;
    if (info.alive) {
      if (info.body >= world.bodies.info.size() || !world.bodies.info[info.body].alive)
        return false;
      if (!shape_from(shape, hulls, geometries, info.component.shape) ||
          !check_shape(info.component.shape).ok() || !check_local_pose(info.component.pose).ok())
        return false;
      info.shape = make_collision_shape(info.component.shape);
      const BodyInfo& owner = world.bodies.info[info.body];
      info.asleep =
          owner.type == MotionType::Dynamic && !owner.disabled && !world.bodies.is_awake(info.body);
      info.proxy = world.trees.of(info).insert(box, static_cast<std::uint32_t>(slot));
      count_collider(world.counts, info.component, 1);
    }
    world.colliders.info.push_back(std::move(info));
  }
  std::vector<std::uint32_t> order;  // of creation, per body
  if (!read_list(in, "collider_order.slot", order, world.colliders.info.size())) return false;
  std::vector<bool> listed(world.colliders.info.size(), false);
  for (const std::uint32_t slot : order) {
    if (!world.colliders.info[slot].alive || listed[slot]) return false;
    listed[slot] = true;
    BodyInfo& owner = world.bodies.info[world.colliders.info[slot].body];
    owner.colliders.push_back(slot);
    owner.collider_ids.push_back(world.colliders.id(slot));
  }
  for (std::size_t slot = 0; slot < listed.size(); ++slot)
    if (world.colliders.info[slot].alive && !listed[slot]) return false;
  world.colliders.has_neighbours.assign(world.colliders.info.size(), 0);
  for (std::uint32_t body = 0; body < world.bodies.info.size(); ++body)
    if (world.bodies.info[body].alive) update_collider_frames(world, body);
  return read_list(in, "collider_free.slot", world.colliders.free_slots,
                   world.colliders.info.size());
}

void save_pairs(ColumnWriter& out, WorldState& world) {
  std::size_t pairs = 0, contacts = 0;
  const auto each_pair = [&](auto&& visit) {
    for (std::size_t i = 0; i < world.pairs.size(); ++i)
      visit(world.pairs[i], world.contacts, kNone);
    for (std::uint32_t i = 0; i < world.islands.size(); ++i)
      for (Pair& pair : world.islands[i].pairs) visit(pair, world.islands[i].contacts, i);
  };
  each_pair([&](const Pair& pair, const std::vector<Contact>&, std::uint32_t) {
    ++pairs;
    contacts += pair.contact_count;
  });
  {
    TableWriter table(out, "pair", pairs);
    each_pair([&](Pair& pair, std::vector<Contact>&, std::uint32_t island) {
      table.next_row();
      visit_pair(table, pair, island);
    });
  }
  TableWriter table(out, "contact", contacts);
  each_pair([&](const Pair& pair, std::vector<Contact>& store, std::uint32_t) {
    for (Contact& contact : contacts_of(pair, store)) {
      table.next_row();
      visit_contact(table, contact);
    }
  });
}

bool restore_pairs(const Snapshot& in, WorldState& world) {
  std::vector<Pair> awake;
  TableReader table(in, "pair"), contacts(in, "contact");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    Pair seen;
    std::uint32_t island = kNone;
    table.next_row();
    visit_pair(table, seen, island);
    const auto& colliders = world.colliders.info;
    if (!table.ok() || seen.collider_a() >= colliders.size() ||
        seen.collider_b() >= colliders.size())
      return false;
    if (!colliders[seen.collider_a()].alive || !colliders[seen.collider_b()].alive) return false;
    if (seen.passage > Passage::Passing) return false;
    Pair pair = remake_pair(world, seen);
    const bool asleep = island != kNone;
    if (asleep && (island >= world.islands.size() || !world.islands[island].used)) return false;
    if (!asleep && !awake.empty() && awake.back().key >= pair.key) return false;
    std::vector<Contact>& store = asleep ? world.islands[island].contacts : world.contacts;
    pair.first_contact = static_cast<std::uint32_t>(store.size());
    pair.contact_count = seen.contact_count;
    for (std::uint32_t k = 0; k < seen.contact_count; ++k) {
      Contact contact;
      contacts.next_row();
      visit_contact(contacts, contact);
      if (!contacts.ok() || contact.manifold.count < 0 ||
          contact.manifold.count > Manifold::kMaxPoints)
        return false;
      store.push_back(contact);
    }
    (asleep ? world.islands[island].pairs : awake).push_back(pair);
    if (pair.sensor && pair.was_touching) world.overlaps.push_back(overlap_of(world, pair));
  }
  std::sort(world.overlaps.begin(), world.overlaps.end());
  world.pairs.insert_sorted(awake);
  return true;
}

bool restore_islands(const Snapshot& in, WorldState& world) {
  for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot) {
    const BodyInfo& info = world.bodies.info[slot];
    if (!info.alive || info.island == kNone) continue;
    if (info.island >= world.bodies.info.size() + 1) return false;
    if (info.island >= world.islands.size()) world.islands.resize(info.island + 1);
    world.islands[info.island].used = true;
    world.islands[info.island].bodies.push_back(slot);
  }
  if (!read_list(in, "island_free.index", world.free_islands, world.bodies.info.size() + 1))
    return false;
  const std::size_t needed = world.free_islands.empty()
                                 ? 0
                                 : static_cast<std::size_t>(*std::max_element(
                                       world.free_islands.begin(), world.free_islands.end())) +
                                       1;
  if (needed > world.islands.size()) world.islands.resize(needed);
  return true;
}

// Work lists that follow from the rest. Whether a body was acted on is not saved: all awake ones
// are looked at, which changes nothing for the others.
void restore_lists(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  for (std::uint32_t slot = 0; slot < world.colliders.info.size(); ++slot) {
    const ColliderInfo& collider = world.colliders.info[slot];
    if (!collider.alive) continue;
    update_reach(world, slot);
    note_new_box(world, slot);
    if (collider.query_pairs) world.query_list.push_back(slot);
  }
  for (const Pair& pair : world.pairs)
    world.box_notes[pair.collider_a()].paired = world.box_notes[pair.collider_b()].paired = true;
  world.touched.assign(bodies.slot_of.begin() + bodies.awake_begin,
                       bodies.slot_of.begin() + bodies.awake_end);
}

}  // namespace
}  // namespace detail

Snapshot PhysicsWorld::save() const {
  Snapshot snapshot;
  save(snapshot);
  return snapshot;
}

void PhysicsWorld::save(Snapshot& snapshot) const {
  using namespace detail;
  WorldState& world = *state_;  // the visitors serve both directions; saving writes nothing
  snapshot.schema_version = Snapshot::kSchemaVersion;
  snapshot.precision = kPrecisionName;
  ColumnWriter out(snapshot);
  {
    TableWriter table(out, "world", 1);
    table.next_row();
    visit_world(table, world);
  }
  {
    TableWriter table(out, "body", world.bodies.info.size());
    for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot) {
      BodyInfo& info = world.bodies.info[slot];
      const std::uint32_t dense = info.alive ? info.dense : 0;
      bool awake = info.alive && world.bodies.is_awake(slot);
      table.next_row();
      visit_body(table, info, world.bodies.velocity[dense], world.bodies.pose[dense],
                 world.bodies.momentum[dense], world.bodies.force[dense],
                 world.bodies.acceleration[slot], world.bodies.mass[dense].gravity_scale, awake);
    }
  }
  add_list(out, "body_free", "slot", world.bodies.free_slots);
  std::vector<std::shared_ptr<const HullGeometry>> hulls;
  GeometryTable geometries;
  {
    TableWriter table(out, "collider", world.colliders.info.size());
    for (ColliderInfo& info : world.colliders.info) {
      ShapeNumbers shape = numbers_of(info.component.shape, hulls, geometries);
      WorldAabb box = info.alive ? world.trees.of(info).box(info.proxy) : WorldAabb{};
      table.next_row();
      visit_collider(table, info, shape, box);
    }
  }
  save_hulls(out, hulls);
  geometries.save(out);
  std::vector<std::uint32_t> order;
  for (const BodyInfo& info : world.bodies.info)
    order.insert(order.end(), info.colliders.begin(), info.colliders.end());
  add_list(out, "collider_order", "slot", order);
  add_list(out, "collider_free", "slot", world.colliders.free_slots);
  add_list(out, "island_free", "index", world.free_islands);
  save_contact_data(out, world);
  save_pairs(out, world);
  save_joints(out, world);
  save_effects(out, world);
}

Status PhysicsWorld::restore(const Snapshot& snapshot) {
  using namespace detail;
  if (state_->stepping)
    return {StatusCode::InsideStep, "restore() was called while the world steps"};
  if (snapshot.schema_version != Snapshot::kSchemaVersion)
    return {StatusCode::BadSnapshot,
            "the snapshot has another schema version than this build reads"};
  if (snapshot.precision != kPrecisionName)
    return {StatusCode::BadSnapshot,
            "the snapshot was taken by a build of another precision (f32, f32d, f64)"};
  auto made = std::make_unique<WorldState>();
  const Status damaged{StatusCode::BadSnapshot,
                       "the snapshot is damaged: its columns do not fit together"};
  TableReader table(snapshot, "world");
  table.next_row();
  visit_world(table, *made);
  if (!table.ok() || !check(made->settings).ok()) return damaged;
  if (!restore_bodies(snapshot, *made) || !restore_colliders(snapshot, *made) ||
      !restore_islands(snapshot, *made) || !restore_contact_data(snapshot, *made) ||
      !restore_pairs(snapshot, *made) || !restore_joints(snapshot, *made) ||
      !restore_effects(snapshot, *made))
    return damaged;
  restore_lists(*made);
  made->jobs = state_->jobs;
  made->observers = state_->observers;
  if (state_->effects != nullptr && !state_->effects->hooks.empty()) {
    if (made->effects == nullptr) made->effects = std::make_shared<EffectStore>();
    made->effects->hooks = state_->effects->hooks;
  }
  state_ = std::move(made);
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
