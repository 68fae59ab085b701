// Sequential contact resolution, the worst contact first [Millington 2010, ch. 14], to be compared
// with the other solvers.
//
//   for each substep of length h, when forces have acted and bodies have moved
//     repeat   the deepest contact: both bodies move and turn until it does not penetrate, each by
//              the share of its inverse inertia
//     repeat   the contact that closes fastest: an impulse after which it parts with restitution
//              times its speed, or rests, and slides no more if friction allows that
//
// A contact is one point of a manifold that penetrates. Each resolution may undo an earlier one,
// which then is the worst some time later; they end where nothing is wrong by more than a
// tolerance, or after so many. Impulses are not accumulated: none is ever taken back, and nothing
// is remembered. Known of the book and left out: rolling friction, friction with a grain.
#include "solver/worst_first.h"

#include <algorithm>
#include <cmath>

#include "math/symmetric_inverse.h"
#include "solver/contact_kernel.h"
#include "solver/row_velocities.h"
#include "solver/turned_rows.h"
#include "world/forced.h"
#include "world/ledger_charges.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Resolutions of each kind, for each contact and velocity iteration [-]; the programs of the book
// allow eight for each contact that there is room for.
constexpr std::size_t kResolutionsPerContact = 8;
// The book stops at 0.01 m/s and takes restitution away below 0.25 m/s, in frames of 1/60 s in
// which gravity adds 0.16 m/s. As shares of what gravity adds [-] both hold for any size and step.
constexpr Real kVelocityTolerance = Real(1) / Real(16), kLeastBounce = Real(1.5);
// A position is corrected by turning a body no farther than this [rad], as in the book.
constexpr Real kMostTurn = Real(0.2);
// Smallest determinant, relative to the product of the diagonal, at which the three directions of
// a contact can be solved together [-]. Below it (motion locks) friction is left out.
constexpr Real kSolvable = Real(1e-5);

struct PointContact {
  std::uint32_t row = 0;
  int point = 0;
  Vec arm_a{0, 0, 0}, arm_b{0, 0, 0};  // [m] from the centres of mass
  Real penetration = 0;                // [m]
  Real wanted = 0;                     // [m/s] change of the speed along the normal
};

class Resolver {
 public:
  explicit Resolver(WorldState& world) : world_(world), contacts_(&world.memory) {
    for (std::uint32_t k = 0; k < world.rows.size(); ++k) {
      ContactRow<Real>& row = world.rows[k];
      const RowVelocities<Real> u = read_velocities(world, row);
      for (int i = 0; i < row.count; ++i) {
        auto& point = row.points[i];
        point.impulse = point.friction1 = point.friction2 = Real(0);
        PointContact contact;
        contact.row = k;
        contact.point = i;
        contact.penetration = penetration_of(contact);
        if (!(contact.penetration > Real(0))) continue;
        const Vec place = point.a * row.t1 + point.b * row.t2;
        contact.arm_a = u.arm_a + place;
        contact.arm_b = u.arm_b + place;
        contacts_.push_back(contact);
      }
    }
    most_ = kResolutionsPerContact * contacts_.size() *
            static_cast<std::size_t>(world.settings.velocity_iterations);
  }

  void adjust_positions() {
    for (std::size_t i = 0; i < most_; ++i) {
      PointContact* const worst = largest(
          &PointContact::penetration, [&](const PointContact& c) { return position_tolerance(c); });
      if (worst == nullptr) return;
      move_apart(*worst);
      for (PointContact& c : contacts_)
        if (shares_body(c, *worst)) c.penetration = penetration_of(c);
    }
  }

  void adjust_velocities() {
    for (PointContact& c : contacts_) c.wanted = wanted_of(c);
    for (std::size_t i = 0; i < most_; ++i) {
      PointContact* const worst = largest(&PointContact::wanted, [&](const PointContact& c) {
        return kVelocityTolerance * row_of(c).cut_unit;
      });
      if (worst == nullptr) break;
      apply(*worst, impulse_of(*worst));
      for (PointContact& c : contacts_)
        if (shares_body(c, *worst)) c.wanted = wanted_of(c);
    }
    note_impulses();
  }

 private:
  [[nodiscard]] ContactRow<Real>& row_of(const PointContact& c) const { return world_.rows[c.row]; }
  [[nodiscard]] Real position_tolerance(const PointContact& c) const {
    return world_.pairs[world_.contacts[row_of(c).contact].pair].slop;
  }
  [[nodiscard]] bool moves(std::uint32_t body) const { return world_.substep[body].constrained; }
  [[nodiscard]] bool shares_body(const PointContact& c, const PointContact& d) const {
    const ContactRow<Real>&p = row_of(c), &q = row_of(d);
    const auto in_q = [&](std::uint32_t body) {
      return moves(body) && (body == q.body_a || body == q.body_b);
    };
    return in_q(p.body_a) || in_q(p.body_b);
  }

  // The contact with the largest number above its tolerance, the first of several; null if none.
  template <class Tolerance>
  PointContact* largest(Real PointContact::*number, Tolerance&& tolerance) {
    PointContact* found = nullptr;
    for (PointContact& c : contacts_)
      if (c.*number > tolerance(c) && (found == nullptr || c.*number > found->*number)) found = &c;
    return found;
  }

  [[nodiscard]] Real penetration_of(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const auto& point = row.points[c.point];
    const auto change = separation_change(row, delta_of_a(world_, row), delta_of_b(world_, row));
    return -(point.separation + change.D0 + point.a * change.E1 + point.b * change.E2);
  }

  // --- positions ---
  // How one body yields to a push along the normal at the contact.
  struct Yield {
    Vec turn{0, 0, 0};             // [1/(kg m)] of its angle
    Real linear = 0, angular = 0;  // [1/kg] of the contact's way, by shifting and by turning
  };
  static Yield yield_of(Vec n, Vec arm, Vec inverse_mass, const Symmetric3<Real>& inverse_inertia) {
    const Vec turn = inverse_inertia * cross(arm, n);
    return {turn, dot(n, multiply_each(inverse_mass, n)), dot(n, cross(turn, arm))};
  }
  void move_apart(const PointContact& c) {
    const ContactRow<Real>& row = row_of(c);
    const Yield a = yield_of(row.n, c.arm_a, row.inverse_mass_a, row.inverse_inertia_a);
    const Yield b = yield_of(row.n, c.arm_b, row.inverse_mass_b, row.inverse_inertia_b);
    const Real total = a.linear + a.angular + b.linear + b.angular;
    if (!(total > Real(0))) return;
    const Real push = c.penetration / total;  // [kg m]
    move(row.body_a, a, -push, row.n, c.arm_a);
    move(row.body_b, b, push, row.n, c.arm_b);
  }
  // What a turn is too short for the shift does.
  void move(std::uint32_t body, const Yield& yield, Real push, Vec n, Vec arm) {
    if (!moves(body)) return;
    const Real most = kMostTurn * length(arm - dot(arm, n) * n);
    const Real turned = std::clamp(push * yield.angular, -most, most);
    BodyDelta& delta = world_.delta[body];
    delta.dp += (push * (yield.linear + yield.angular) - turned) * n;
    if (yield.angular > Real(0))
      delta.dq = normalized(from_rotation_vector((turned / yield.angular) * yield.turn) * delta.dq);
  }

  // --- velocities ---
  // Of B seen from A, along n, t1, t2 [m/s].
  [[nodiscard]] Vec velocity_at(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const BodyVelocity& a = world_.bodies.velocity[row.body_a];
    const BodyVelocity& b = world_.bodies.velocity[row.body_b];
    const Vec v = b.v + cross(b.w, c.arm_b) - a.v - cross(a.w, c.arm_a);
    return {dot(row.n, v), dot(row.t1, v), dot(row.t2, v)};
  }
  // What the forces of the substep have added to it, and will add in the next one.
  [[nodiscard]] Vec velocity_by_forces(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const auto pull = [&](std::uint32_t body) {
      return moves(body) ? world_.substep[body].acceleration : Vec{0, 0, 0};
    };
    const Vec v = world_.h * (pull(row.body_b) - pull(row.body_a));
    return {dot(row.n, v), dot(row.t1, v), dot(row.t2, v)};
  }
  [[nodiscard]] Real wanted_of(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const Real speed = velocity_at(c).x;
    const bool bounces = std::abs(speed) >= kLeastBounce * row.cut_unit;
    const Real restitution = bounces ? row.restitution : Real(0);
    return -speed - restitution * (speed - velocity_by_forces(c).x);
  }
  // Change of the velocity by a unit impulse on B and its opposite on A, in n, t1, t2 [1/kg].
  [[nodiscard]] Symmetric3<Real> response_of(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const Vec axes[3] = {row.n, row.t1, row.t2};
    const auto response = [&](int i, int j) {
      const Vec x = axes[i], y = axes[j];
      return dot(x, multiply_each(row.inverse_mass_a, y)) +
             dot(x, multiply_each(row.inverse_mass_b, y)) +
             dot(cross(c.arm_a, x), row.inverse_inertia_a * cross(c.arm_a, y)) +
             dot(cross(c.arm_b, x), row.inverse_inertia_b * cross(c.arm_b, y));
    };
    return {response(0, 0), response(1, 1), response(2, 2),
            response(0, 1), response(0, 2), response(1, 2)};
  }
  // Along n, t1, t2 [N s].
  [[nodiscard]] Vec impulse_of(const PointContact& c) const {
    const ContactRow<Real>& row = row_of(c);
    const auto& point = row.points[c.point];
    const Symmetric3<Real> K = response_of(c);
    if (!(K.xx > Real(0))) return {0, 0, 0};
    Symmetric3<Real> mass;
    if (!(row.friction > Real(0)) || !invert(K, kSolvable, mass))
      return {c.wanted / K.xx, Real(0), Real(0)};
    Vec slip = velocity_at(c) + velocity_by_forces(c);
    slip.y += row.drive.x - point.b * row.drive.z;
    slip.z += row.drive.y + point.a * row.drive.z;
    const Vec stick = mass * Vec{c.wanted, -slip.y, -slip.z};
    const Real planar = std::sqrt(stick.y * stick.y + stick.z * stick.z);
    if (planar <= row.friction * stick.x) return stick;
    // It slides: as much friction as there can be, in that direction.
    const Real f1 = row.friction * stick.y / planar, f2 = row.friction * stick.z / planar;
    const Real sliding = K.xx + f1 * K.xy + f2 * K.xz;
    const Real normal = c.wanted / (sliding > Real(0) ? sliding : K.xx);
    return {normal, f1 * normal, f2 * normal};
  }
  void apply(const PointContact& c, Vec impulse) {
    ContactRow<Real>& row = row_of(c);
    auto& point = row.points[c.point];
    point.impulse += impulse.x;
    point.friction1 += impulse.y;
    point.friction2 += impulse.z;
    const Vec P = impulse.x * row.n + impulse.y * row.t1 + impulse.z * row.t2;
    if (moves(row.body_a)) {
      BodyVelocity& a = world_.bodies.velocity[row.body_a];
      a.v -= multiply_each(row.inverse_mass_a, P);
      a.w -= row.inverse_inertia_a * cross(c.arm_a, P);
    }
    if (moves(row.body_b)) {
      BodyVelocity& b = world_.bodies.velocity[row.body_b];
      b.v += multiply_each(row.inverse_mass_b, P);
      b.w += row.inverse_inertia_b * cross(c.arm_b, P);
    }
  }

  // For events and reports. What touches moves as in the book, without the trapezoid.
  void note_impulses() {
    for (ContactRow<Real>& row : world_.rows) {
      end_substep(row);
      Real load = 0;
      for (int i = 0; i < row.count; ++i) load += row.points[i].impulse;
      row.at_rest = load > Real(0);
    }
    for (const PointContact& c : contacts_)
      for (const std::uint32_t body : {row_of(c).body_a, row_of(c).body_b})
        if (moves(body)) world_.contacts_changed[body] = 1;
  }

  WorldState& world_;
  StepList<PointContact> contacts_;
  std::size_t most_ = 0;  // resolutions of each kind
};

}  // namespace

bool resolves_worst_first(const WorldState& world) {
  return solver_of(world.settings) == ContactSolver::WorstFirst;
}

void resolve_worst_first(WorldState& world) {
  Resolver resolver(world);
  resolver.adjust_positions();
  if (world.diagnostics.ledger) charge_shifts(world);
  resolver.adjust_velocities();
  if (world.diagnostics.ledger) charge(world, &EnergyLedger::normal);
}

}  // namespace plumb::inline PLUMB_ABI::detail
