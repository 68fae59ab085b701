#include "math/eigen_bridge.h"
#include "solver/body_substep.h"
#include "world/ledger_charges.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

Sum wide(Vec v) { return cast<double>(v); }
void add(Eigen::Vector3d& entry, Sum v) { entry += Eigen::Vector3d(v.x, v.y, v.z); }

// Whether rows hold it in the substeps of the group that runs.
bool in_loop(const WorldState& world, std::uint32_t i) {
  const SubstepBody& s = world.substep[i];
  return s.constrained && !s.split && world.groups.group_of[i] == world.ledger.group;
}
bool dynamic(const WorldState& world, std::uint32_t i) {
  return world.bodies.mass[i].mass > Real(0);
}

template <class Task>
void for_dynamic(const WorldState& world, Task&& task) {
  for (std::uint32_t i = world.bodies.awake_begin; i < world.bodies.awake_end; ++i)
    if (dynamic(world, i)) task(i);
}

// [J] with the angular momentum as it will be once the rows' part is collected.
double kinetic_of(const WorldState& world, std::uint32_t i) {
  const BodyMass& m = world.bodies.mass[i];
  const BodyVelocity& velocity = world.bodies.velocity[i];
  const SubstepBody& s = world.substep[i];
  const bool held = s.constrained && world.ledger.in_substeps;
  const Rotation q = held ? orientation_now(world, i) : world.bodies.pose[i].q;
  Vec L = world.bodies.momentum[i].L;
  if (world.ledger.pending && in_loop(world, i)) L += s.I * (velocity.w - s.w_in);
  const Sum v = wide(velocity.v);
  return 0.5 * static_cast<double>(m.mass) * dot(v, v) +
         0.5 * dot(wide(angular_velocity_of(m, q, L)), wide(L));
}
Sum momentum_of(const WorldState& world, std::uint32_t i) {
  return static_cast<double>(world.bodies.mass[i].mass) * wide(world.bodies.velocity[i].v);
}

// [m/s^2] of gravity alone, with the body's own scale and locks.
Sum gravity_on(const WorldState& world, std::uint32_t i) {
  const BodyMass& m = world.bodies.mass[i];
  const Vec free = m.mass * m.inverse_mass;  // 1, or 0 along a locked axis
  return wide(m.gravity_scale * multiply_each(free, to_inner(world.settings.gravity)));
}
Sum force_on(const WorldState& world, std::uint32_t i) {  // [N] in the axes that are free
  const BodyMass& m = world.bodies.mass[i];
  return wide(m.mass * multiply_each(m.inverse_mass, world.bodies.force[i].force));
}

struct Totals {
  double kinetic = 0;
  Sum linear{0, 0, 0};
};
Totals totals(const WorldState& world) {
  Totals now;
  for_dynamic(world, [&](std::uint32_t i) {
    now.kinetic += kinetic_of(world, i);
    now.linear += momentum_of(world, i);
  });
  return now;
}

// What has changed since the last charge; from here on it counts as charged.
Totals take_change(WorldState& world) {
  LedgerBook& book = world.ledger;
  const Totals now = totals(world);
  const Totals change{now.kinetic - book.kinetic, now.linear - book.linear};
  book.kinetic = now.kinetic;
  book.linear = now.linear;
  for_dynamic(world, [&](std::uint32_t i) { book.place[i] = world.delta[i].dp; });
  return change;
}

// Gravity's and the forces' share of what the bodies of a flight have gained: work by their paths,
// momentum by the time.
template <class Flies>
void split_flight(WorldState& world, double time, Totals& change, Flies&& flies) {
  LedgerBook& book = world.ledger;
  for_dynamic(world, [&](std::uint32_t i) {
    if (!flies(i)) return;
    const double mass = static_cast<double>(world.bodies.mass[i].mass);
    const Sum path = wide(world.delta[i].dp - book.place[i]);
    const Sum weight = mass * gravity_on(world, i), force = force_on(world, i);
    const double by_gravity = dot(weight, path), by_force = dot(force, path);
    book.credited_gravity += by_gravity;
    book.energy.forces += by_force;
    change.kinetic -= by_gravity + by_force;
    add(book.momentum.gravity, time * weight);
    add(book.momentum.forces, time * force);
    change.linear -= time * weight + time * force;
  });
}

}  // namespace

void open_ledger(WorldState& world) {
  LedgerBook& book = world.ledger;
  book = {};
  book.in_substeps = true;
  book.place.assign(world.bodies.dense_count(), Vec{0, 0, 0});
  book.drifted.assign(world.bodies.dense_count(), Vec{0, 0, 0});
  const Totals now = totals(world);
  book.start = book.kinetic = now.kinetic;
  book.linear_start = book.linear = now.linear;
}

void charge(WorldState& world, double EnergyLedger::*entry) {
  const Totals change = take_change(world);
  world.ledger.energy.*entry += change.kinetic;
  add(entry == &EnergyLedger::joints ? world.ledger.momentum.joints
                                     : world.ledger.momentum.contacts,
      change.linear);
}

// A bounce at time t of the substep changes v as if it had been so from the start, and shifts the
// path back to make up for it: what gravity does on the shift belongs to the bounce.
void charge_bounces(WorldState& world) {
  LedgerBook& book = world.ledger;
  double by_gravity = 0;
  for_dynamic(world, [&](std::uint32_t i) {
    by_gravity += static_cast<double>(world.bodies.mass[i].mass) *
                  dot(gravity_on(world, i), wide(world.delta[i].dp - book.place[i]));
  });
  book.credited_gravity += by_gravity;
  book.energy.restitution -= by_gravity;
  charge(world, &EnergyLedger::restitution);
}

void charge_flight(WorldState& world) {
  LedgerBook& book = world.ledger;
  bool damped = false;
  for_dynamic(world, [&](std::uint32_t i) {
    const BodyForce& force = world.bodies.force[i];
    damped = damped || force.linear_damping > Real(0) || force.angular_damping > Real(0);
  });
  bool turned = false;
  for_dynamic(world, [&](std::uint32_t i) {
    turned = turned || length_squared(world.bodies.force[i].torque) > Real(0);
  });
  const Totals now = totals(world);
  Totals change{now.kinetic - book.kinetic, now.linear - book.linear};
  split_flight(world, static_cast<double>(world.dt), change, [&](std::uint32_t i) {
    const Vec path = world.delta[i].dp - book.place[i];  // others fly with effects
    return !world.substep[i].constrained && length_squared(path) > Real(0);
  });
  (damped   ? book.energy.damping
   : turned ? book.energy.forces
            : book.energy.integrator) += change.kinetic;
  add(book.momentum.damping, change.linear);
  take_change(world);
}

// Effects fly the bodies that only they hold, a substep at a time; what they do to others comes
// with the kick. All of it counts as forces.
void charge_effects(WorldState& world) {
  LedgerBook& book = world.ledger;
  const Totals now = totals(world);
  Totals change{now.kinetic - book.kinetic, now.linear - book.linear};
  split_flight(world, static_cast<double>(world.h), change, [&](std::uint32_t i) {
    const Vec path = world.delta[i].dp - book.place[i];
    return !world.substep[i].constrained && length_squared(path) > Real(0);
  });
  book.energy.forces += change.kinetic;
  add(book.momentum.forces, change.linear);
  take_change(world);
}

void charge_joint_flight(WorldState& world) {
  LedgerBook& book = world.ledger;
  const Totals now = totals(world);
  Totals change{now.kinetic - book.kinetic, now.linear - book.linear};
  split_flight(world, static_cast<double>(world.h), change,
               [&](std::uint32_t i) { return world.substep[i].split; });
  book.energy.joints += change.kinetic;
  add(book.momentum.joints, change.linear);
  take_change(world);
}

void charge_kick(WorldState& world) {
  LedgerBook& book = world.ledger;
  const double h = book.h;
  book.pending = true;
  Totals change = take_change(world);
  bool damped = false;
  for_dynamic(world, [&](std::uint32_t i) {
    const SubstepBody& s = world.substep[i];
    if (!in_loop(world, i)) return;
    const BodyForce& f = world.bodies.force[i];
    damped = damped || f.linear_damping > Real(0) || f.angular_damping > Real(0);
    const Sum mean = 0.5 * (wide(s.v_start) + wide(world.bodies.velocity[i].v));
    const double mass = static_cast<double>(world.bodies.mass[i].mass);
    const Sum weight = mass * gravity_on(world, i), force = force_on(world, i);
    const double by_gravity = h * dot(weight, mean), by_force = h * dot(force, mean);
    book.credited_gravity += by_gravity;
    book.energy.forces += by_force;
    change.kinetic -= by_gravity + by_force;
    add(book.momentum.gravity, h * weight);
    add(book.momentum.forces, h * force);
    change.linear -= h * weight + h * force;
  });
  (damped ? book.energy.damping : book.energy.forces) += change.kinetic;
  add(damped ? book.momentum.damping : book.momentum.forces, change.linear);
}

void charge_drift(WorldState& world) {
  for_dynamic(world,
              [&](std::uint32_t i) { world.ledger.drifted[i] = world.bodies.velocity[i].v; });
  charge(world, &EnergyLedger::integrator);
}

// No velocity pays for the way. Turning a body changes the energy of its angular momentum.
void charge_shifts(WorldState& world) {
  LedgerBook& book = world.ledger;
  for_dynamic(world, [&](std::uint32_t i) {
    book.energy.recovery -= static_cast<double>(world.bodies.mass[i].mass) *
                            dot(gravity_on(world, i), wide(world.delta[i].dp - book.place[i]));
  });
  charge(world, &EnergyLedger::integrator);
}

void charge_finish(WorldState& world) {
  LedgerBook& book = world.ledger;
  book.pending = false;
  charge(world, &EnergyLedger::integrator);
  // The velocities that push out of overlap act for the drift and are gone after the relaxation.
  const double h = book.h;
  for_dynamic(world, [&](std::uint32_t i) {
    const SubstepBody& s = world.substep[i];
    if (!in_loop(world, i) || s.jointed || !(world.bodies.velocity[i].load > Real(0))) return;
    const Sum pushed = h * wide(book.drifted[i] - world.bodies.velocity[i].v);
    book.energy.recovery -=
        static_cast<double>(world.bodies.mass[i].mass) * dot(gravity_on(world, i), pushed);
  });
}

void close_ledger(WorldState& world) {
  LedgerBook& book = world.ledger;
  book.in_substeps = false;
  charge(world, &EnergyLedger::integrator);
  // What fell asleep has left the awake range, and with it the sums.
  book.energy.kinetic_change = book.kinetic - book.start;
  add(book.momentum.change, book.linear - book.linear_start);
  book.energy.integrator += book.credited_gravity - book.energy.gravity - book.energy.recovery;
  world.report.energy = book.energy;
  world.report.momentum = book.momentum;
}

void weigh_paths(WorldState& world) {
  for_dynamic(world, [&](std::uint32_t i) {
    world.ledger.energy.gravity += static_cast<double>(world.bodies.mass[i].mass) *
                                   dot(gravity_on(world, i), wide(world.delta[i].dp));
  });
}

double row_energy(const WorldState& world, const ContactRow<Real>& row) {
  double sum = 0;
  for (const std::uint32_t body : {row.body_a, row.body_b})
    if (world.substep[body].constrained) sum += kinetic_of(world, body);
  return sum;
}

double charge_row(WorldState& world, const ContactRow<Real>& row, double before,
                  double EnergyLedger::*entry) {
  const double now = row_energy(world, row);
  world.ledger.energy.*entry += now - before;
  world.ledger.kinetic += now - before;
  return now;
}

void charge_warm_start(WorldState& world, const ContactRow<Real>& row, double before,
                       const RowVelocities<Real>& u0, const RowVelocities<Real>& u1) {
  Real f1 = 0, f2 = 0, f3 = 0;
  for (int i = 0; i < row.count; ++i) {
    const auto& point = row.points[i];
    f1 += point.friction1;
    f2 += point.friction2;
    f3 += point.a * point.friction2 - point.b * point.friction1;
  }
  const Sum slip = 0.5 * (wide(relative_velocity(u0)) + wide(relative_velocity(u1)));
  const Sum spin = 0.5 * (wide(u0.wb - u0.wa) + wide(u1.wb - u1.wa));
  const double by_friction =
      dot(wide(f1 * row.t1 + f2 * row.t2), slip) + dot(wide(f3 * row.n), spin);
  charge_row(world, row, before, &EnergyLedger::normal);
  world.ledger.energy.normal -= by_friction;
  world.ledger.energy.friction += by_friction;
}

}  // namespace plumb::inline PLUMB_ABI::detail
