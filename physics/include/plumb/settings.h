// What a user may choose for a world. Everything has a unit, a default and a reason; tolerances
// that nobody should have to choose live in src/world/tolerances.h.
#pragma once

#include <cstdint>

#include "plumb/math.h"
#include "plumb/plan_items.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

// How bodies turn between kicks. Exact is the one to use: it takes for each body the form that its
// inertia allows (ball, symmetric top, any other). The others are there to be compared with it.
enum class RotationMethod : std::uint8_t {
  Exact,         // torque-free flow, exact to round-off (src/motion/rotation_flow.h); the default
  ImplicitGyro,  // one Newton step of the implicit gyroscopic term: damps tumbling [Catto 2015]
  Book,          // first-order quaternion update, no gyroscopic term [Millington 2010]
  ExplicitGyro,  // gyroscopic term from the start of the step, order 1: tumbling gains energy
  Splitting,     // rotations about the principal axes in turn, order 2, keeps L [McLachlan 1993]
  Splitting4,    // five of these, order 4, keeps L [Suzuki 1990]
  RK4,           // classical Runge-Kutta on quaternion and body rates, order 4
  Jacobi,        // elliptic functions, attitude by quadrature; exact to round-off [van Zon 2007]
};
inline constexpr int kRotationMethodCount = 8;
const char* name_of(RotationMethod method);  // "Exact", "ImplicitGyro", ...

// What a scene is made of, as far as it decides which settings are good enough.
enum class SceneKind : std::uint8_t {
  Any,   // the worst of the others
  Free,  // flying, tumbling
  Bouncing,
  Sliding,  // sliding and rolling
  Jointed,  // pendulums, tops, chains
  Stacked,  // resting, columns
};
inline constexpr int kSceneKindCount = 6;
const char* name_of(SceneKind kind);

struct SettingsChoice;

// How contacts and joints that touch something are solved.
enum class ContactSolver : std::uint8_t {
  SoftStep,  // fast: one soft pass and one relaxing pass a substep (src/solver)
  // Accurate: each island to the exact laws in every substep, whatever its masses and its height,
  // in double (src/solver/newton). Costs more where many contacts open and close.
  Newton,
  // The default: soft steps, and Newton for the islands that call for it: where heavy bodies lie on
  // light ones or many on one another. Its cost is bounded; what is too large or takes too long
  // goes on in soft steps (world.plan() tells; physics/README.md has the map). The bits are those
  // of SoftStep where nothing calls.
  Auto,
  // Sequential, as the textbook has it [Millington 2010]: in every substep the worst penetration
  // by itself, then the next, then likewise the contact that closes fastest; nothing is remembered
  // (src/solver/worst_first.cpp). There to be compared with: its time grows with the square of the
  // number of contacts.
  WorstFirst,
};
inline constexpr int kContactSolverCount = 4;

// Up to where friction holds: all tangential impulses f of a point with normal impulse N that are
// within a circle of radius mu N, or within a polygon about that circle, with its first facet
// across the contact's first tangent: what engines limit axis by axis. A body on a polygon is held
// and slowed by more than mu N between the middles of its facets, and drawn to one side.
enum class FrictionCone : std::uint8_t {
  Exact,        // the circle; the default
  FourFacets,   // |f1|, |f2| <= mu N: up to 41% too much
  EightFacets,  // |f1|, |f2|, |f1 +- f2| / sqrt(2) <= mu N: up to 8% too much
};
inline constexpr int kFrictionConeCount = 3;

struct WorldSettings {
  Vec3 gravity = Vec3(0, Real(-9.81), 0);  // [m/s^2] finite

  // Solver steps within one step [-] 1..64. Contacts and joints stiffen and errors shrink with
  // their number; cost grows with it. 4: stacks of ten stand at 60 Hz.
  int substeps = 4;
  // Level of detail in time: by how much a step may err in any island [m] >= 0, finite. Islands
  // that keep to it with fewer solver steps get half of `substeps`, a quarter, ... (two at least),
  // by what their last steps told of their errors (src/solver/step_levels.h); what something new
  // strikes gets as many as the blow needs. What joints, effects, bounces or the accurate solver
  // take part in, or has over a thousand contacts, has all of them. 0: everything has.
  Real step_tolerance = Real(0);
  // How fast overlap is worked off: the natural frequency [Hz] > 0 and damping ratio [-] >= 0 of a
  // contact seen as a spring. Limited to a quarter of the substep rate. [Catto 2024]
  Real contact_frequency = Real(30);
  Real contact_damping_ratio = Real(10);

  RotationMethod rotation = RotationMethod::Exact;
  ContactSolver contact_solver = ContactSolver::Auto;
  // Passes of the soft steps over contacts, and joints of what touches something, in each substep
  // [-] 1..64; what other engines call iterations. There to be compared with more substeps.
  // WorstFirst: so many times eight resolutions a contact. Newton needs none.
  int velocity_iterations = 1;
  // Polygons are there to be compared with the circle. Bounces, rolling friction, Newton and
  // WorstFirst keep circles.
  FrictionCone friction_cone = FrictionCone::Exact;
  // Order in the substep of what jointed bodies that touch nothing do [-], 2 or 4. 4: five times
  // the cost of their joints; with four substeps in double the error of a pendulum's period falls
  // from 2e-5 to 4e-8, with one from 4e-4 to 1e-7. What has motors, friction, dampers or limits
  // within reach stays at 2. [Suzuki 1990]
  int joint_order = 2;

  bool warm_starting = true;  // begin from the last step's impulses; off only to show what it buys
  bool sleeping = true;       // islands at rest stop costing anything
  Real time_to_sleep = Real(0.5);  // [s] >= 0 that every body of an island must have been at rest
  bool profiling = false;          // fill StepReport::stage_seconds

  // Items of the plan that are forced on or off, whatever the scene calls for; what is forced off
  // is told by world.plan() with the bound on what is lost. AccurateContacts goes before
  // contact_solver, Sleeping before sleeping.
  PlanChoices forced{};

  // The cheapest settings and step known to keep the error below a tolerance, or the most accurate
  // ones within a budget, by measurements of this build's number types (`plumb accuracy --table`
  // makes them again, src/world/measured_settings.cpp holds them).
  //   tolerance  [-] > 0: error relative to the size of the motion after a few seconds; beyond a
  //              second or so chaotic scenes have no such error
  //   budget     [s] > 0 of computing for a body and a simulated second
  //   dt         [s] > 0: only settings for this step or a shorter one; 0: any step
  // OutOfRange where an argument is; Unreachable, with the best there is, where nothing measured
  // is as good or as cheap.
  static SettingsChoice from_tolerance(double tolerance, SceneKind kind = SceneKind::Any,
                                       double dt = 0);
  static SettingsChoice from_budget(double budget, SceneKind kind = SceneKind::Any, double dt = 0);
};

struct SettingsChoice {
  Status status;
  WorldSettings settings;  // the defaults, with substeps and joint order as measured
  double dt = 0;           // [s] to call step() with
  double error = 0;        // [-] measured with them: the worst case of the kind
  double cost = 0;         // [s] measured for a body and a simulated second, on the machine below
};
const char* measured_on();  // machine, compiler and commit of those measurements

// Whether every number is finite and in its range.
Status check(const WorldSettings& settings);

}  // namespace plumb::inline PLUMB_ABI
