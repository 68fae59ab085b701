#include "audit/samples.h"

#include <algorithm>
#include <cmath>

namespace plumb::inline PLUMB_ABI::audit {
namespace {

// In body sizes a step: of places and attitudes, and of what the velocities make of them.
double motion_between(const BodySample& a, const BodySample& b, double dt) {
  const Eigen::Quaterniond turn =
      a.state.pose.orientation.cast<double>().conjugate() * b.state.pose.orientation.cast<double>();
  const double turned = 2 * turn.vec().norm();
  const double moved = (b.center - a.center).norm() / a.size;
  const double v =
      (b.state.linear_velocity - a.state.linear_velocity).cast<double>().norm() * dt / a.size;
  const double w = (b.state.angular_velocity - a.state.angular_velocity).cast<double>().norm() * dt;
  return std::max({turned, moved, v, w});
}

// Of the angular momentum; what a contact or a joint holds has that of its weight for company.
double momentum_between(const BodySample& a, const BodySample& b) {
  const double whole = a.L.norm() + (a.held ? a.weight_turn : 0);
  return whole > 0 ? (b.L - a.L).norm() / whole : 0;
}

}  // namespace

Sample sample_of(const PhysicsWorld& world, double dt) {
  std::vector<BodyState> states;
  world.copy_body_states(states);
  std::vector<ContactState> contacts;
  world.copy_contacts(contacts);
  Sample out;
  for (const BodyState& state : states) {
    if (state.type != MotionType::Dynamic) continue;
    BodySample& body = out.emplace_back();
    body.state = state;
    body.L = world.angular_momentum(state.id).cast<double>();
    body.center = world.center_of_mass(state.id).cast<double>();
    const MassProperties mass = world.mass_properties(state.id);
    const double gyration = std::sqrt(mass.I_Bcm_B.trace() / (2 * mass.mass));
    if (gyration > 0) body.size = gyration;
    const double g = world.settings().gravity.cast<double>().norm();
    body.weight_turn = mass.mass * g * body.size * dt;
    body.held = std::any_of(contacts.begin(), contacts.end(), [&](const ContactState& contact) {
      return contact.body_a == state.id || contact.body_b == state.id;
    });
    body.held = body.held || !world.joints_of(state.id).empty();
    // Below this a body counts as resting (physics/src/world/tolerances.h).
    body.rest_speed = std::max(0.014 * std::sqrt(g * body.size), 1e-3 * body.size);
  }
  return out;
}

double change_between(PlanItem item, const Sample& a, const Sample& b, std::size_t i, double dt) {
  if (item == PlanItem::Sleeping && a[i].state.awake) return 0;
  const double change =
      item == PlanItem::Gyroscopic ? momentum_between(a[i], b[i]) : motion_between(a[i], b[i], dt);
  return item == PlanItem::Sleeping ? change * a[i].size / (dt * a[i].rest_speed) : change;
}

double largest_change(PlanItem item, const Sample& a, const Sample& b, double dt) {
  double most = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    most = std::max(most, change_between(item, a, b, i, dt));
  return most;
}

}  // namespace plumb::inline PLUMB_ABI::audit
