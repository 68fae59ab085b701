// Body effects: what acts on bodies beyond uniform gravity, damping, contacts and joints. Each is a
// component in a pool of its kind; a kind that a scene does not have costs one test a step, and a
// body that no effect acts on costs nothing.
//
//   world.create_effect({.body = ball, .kind = Drag{.quadratic = Real(0.02)}});
//   world.create_effect({.kind = Buoyancy{.density = 1000}});   // a lake: every body
//   world.effect_ledger();                                      // energy and work by kind
//
// How they act: every substep of length h they see each body in the middle of it, where it gets by
// itself (x + h v / 2), and give one mean force and torque for the whole of it. With the straight
// motion before and after this is the position Verlet scheme: second order, and what has a
// potential keeps its energy without drift [Hairer 2006]. What grows with speed or with
// displacement (drag, springs, water) is solved implicitly for the end of the substep: stable for
// any coefficient and any step. Vectors are in world axes unless said.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "plumb/ids.h"
#include "plumb/math.h"
#include "plumb/shapes.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

using EffectId = Id<struct EffectTag>;

// No stiffness, strength or coefficient may be larger [SI]: beyond it single precision overflows.
inline constexpr double kLargestCoefficient = 1e12;

// The pull of a point mass: a = -mu r / (r^2 + softening^2)^(3/2), r from `center`.
struct PointGravity {
  Pos3 center = Pos3::Zero();  // [m]
  Real mu = Real(0);           // [m^3/s^2] G times the mass; finite
  Real softening = Real(0);    // [m] >= 0
};

// A field of the user's own: the function registered under `field` (set_force_field()).
struct ForceField {
  std::uint32_t field = 0;
  std::array<Real, 4> parameters{};  // handed to the function as they are; finite
  bool keeps_awake = false;          // for fields that vary in time: what they act on never sleeps
};

// F = -(linear + quadratic |u|) u, u = v - medium; torque = -(angular_linear + angular_quadratic
// |w|) w. Exact for linear drag with constant forces; the terminal speed is exact for both.
struct Drag {
  Real linear = Real(0);             // [N s/m] >= 0
  Real quadratic = Real(0);          // [N s^2/m^2] >= 0: half density x area x coefficient
  Real angular_linear = Real(0);     // [N m s] >= 0
  Real angular_quadratic = Real(0);  // [N m s^2] >= 0
  Vec3 medium = Vec3::Zero();        // [m/s] velocity of what resists
};

// The side force on what spins in a flow: F = coefficient w x (v - medium). Does no work on the
// motion through the medium. A smooth sphere: coefficient = 4/3 pi density radius^3 at most.
struct Magnus {
  Real coefficient = Real(0);  // [kg] finite
  Vec3 medium = Vec3::Zero();  // [m/s]
};

// Moving air on the surfaces of the body's colliders, panel by panel: with u the velocity of the
// panel through the air and n its outward normal,
//   F = -1/2 density area |u| (pressure (u . n) n  where u . n > 0,  + friction (u - (u . n) n)).
// A plate held at an angle gets lift and drag and the torque of both. Spheres are in closed form;
// other round shapes have 24 sides.
struct Wind {
  Vec3 velocity = Vec3::Zero();  // [m/s] of the air
  Real density = Real(1.2);      // [kg/m^3] > 0
  Real pressure = Real(1.5);     // [-] >= 0
  Real friction = Real(0.02);    // [-] >= 0
};

// A wing, keel, fin or sail as a tensor: F_S = tensor u_S, where u_S is the velocity of the point
// through the air in the surface's axes S [Millington 2010]. With `minimum` and `maximum` it is a
// control surface: `control` -1 .. 0 .. 1 leads from minimum over tensor to maximum.
struct AeroSurface {
  Mat3 tensor = Mat3::Zero();   // [N s/m] finite; drag is negative
  Mat3 minimum = Mat3::Zero();  // [N s/m] where is_controlled
  Mat3 maximum = Mat3::Zero();  // [N s/m] where is_controlled
  bool is_controlled = false;
  Real control = Real(0);               // [-] -1..1
  Vec3 point = Vec3::Zero();            // [m] body frame
  Quat orientation = Quat::Identity();  // R_BS, unit: an angled surface
  Vec3 wind = Vec3::Zero();             // [m/s] velocity of the air
};

// A fluid below the plane n . x = level (n: `normal` made unit): weight of the displaced fluid
// upwards (against the world's gravity) at the centre of the displaced volume, and drag there. The
// volume is that of the real shapes, cut exactly (src/effects/displacement.h).
struct Buoyancy {
  Real density = Real(1000);    // [kg/m^3] > 0
  Vec3 normal = Vec3::UnitY();  // up, any length > 0
  Real level = Real(0);         // [m]
  Vec3 current = Vec3::Zero();  // [m/s] velocity of the fluid
  // Drag at the centre of the displaced volume V with displaced mass M = density V:
  Real linear_drag = Real(0.5);     // [1/s] >= 0: F = -linear_drag M u
  Real quadratic_drag = Real(0.5);  // [-] >= 0: F = -1/2 quadratic_drag density V^(2/3) |u| u
  Real angular_drag = Real(0.5);    // [1/s] >= 0: torque = -angular_drag M V^(2/3) w
  // What displaces, in the body frame: a closed mesh (a hollow boat). Empty: the body's colliders.
  std::optional<SurfaceMesh> hull{};
};

// A spring between a point of the body and a point of `other`, or of the world where that is null.
// Keeps its energy at any stiffness and step (implicit midpoint); damping is fitted to decay
// exactly. Frequencies are right to (w h)^2 / 12. What contacts hold against a spring feels it
// weakened by 1 + k h^2 / (4 m): use a SpringJoint where that matters.
struct Spring {
  enum class Acts : std::uint8_t { Always, WhenStretched, WhenCompressed };
  BodyId other{};
  Vec3 point = Vec3::Zero();        // [m] body frame
  Pos3 other_point = Pos3::Zero();  // [m] frame of `other`, or world
  Real rest_length = Real(1);       // [m] > 0
  Real stiffness = Real(100);       // [N/m] > 0, <= 1e12
  Real damping = Real(0);           // [N s/m] >= 0, <= 1e12, along the spring
  Acts acts = Acts::Always;         // WhenStretched: a bungee
};

struct Thrust {
  Vec3 force = Vec3::Zero();  // [N] finite, body axes unless in_world_axes
  Vec3 point = Vec3::Zero();  // [m] body frame
  bool in_world_axes = false;
};

// A shock wave that runs outwards, then a chimney of hot air. The front passes a body at distance
// r within thickness / speed and leaves it the impulse
//   J = impulse (reference / max(r, reference))^falloff area,  away from the centre,
// whatever the time step; `area` is what the body shows to the blast. Starts when it is made.
struct Explosion {
  Pos3 center = Pos3::Zero();       // [m]
  Real impulse = Real(1000);        // [N s/m^2] >= 0, at `reference`
  Real reference = Real(1);         // [m] > 0
  Real falloff = Real(2);           // [-] 0..6
  Real speed = Real(340);           // [m/s] > 0, of the front
  Real thickness = Real(5);         // [m] > 0, of the front
  Real range = Real(50);            // [m] > 0: beyond it nothing is felt
  Real area = Real(0);              // [m^2] >= 0 of every body; 0: what its colliders show
  Real updraft = Real(0);           // [m/s^2] >= 0 on the chimney's axis at the ground
  Real chimney_radius = Real(5);    // [m] > 0; the updraft falls to 0 there,
  Real chimney_height = Real(20);   // [m] > 0; and here
  Real updraft_duration = Real(2);  // [s] >= 0, from the start on
};

// Pulls towards a point (strength > 0) or pushes away (< 0), regardless of mass.
struct Attractor {
  enum class Law : std::uint8_t {
    Constant,       // F = strength [N]
    Linear,         // F = strength r [N/m]
    InverseSquare,  // F = strength / (r^2 + softening^2) [N m^2]
  };
  Pos3 center = Pos3::Zero();  // [m]
  Real strength = Real(0);     // finite, |strength| <= 1e12
  Law law = Law::Constant;
  Real range = Real(0);         // [m] >= 0: beyond it nothing; 0: endless
  Real softening = Real(0.01);  // [m] > 0: within it the force falls to 0 at the centre
};

// Recordings and snapshots name a kind by its place in this list: new ones go to the end.
using EffectKind = std::variant<PointGravity, ForceField, Thrust, Explosion, Drag, Magnus,
                                Attractor, Wind, AeroSurface, Buoyancy, Spring>;
inline constexpr std::size_t kEffectKindCount = std::variant_size_v<EffectKind>;
const char* name_of_effect(std::size_t kind);  // "point gravity", ...

struct Effect {
  BodyId body{};  // null: every dynamic body (not for Thrust, AeroSurface and Spring)
  EffectKind kind = Drag{};
  std::uint64_t user_data = 0;  // never looked at
};

// What one effect did.
struct EffectReport {
  double potential = 0;                              // [J] now; 0 for what has none
  double step_work = 0;                              // [J] done on bodies in the last step
  double work = 0;                                   // [J] ... since it was made
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N] mean over the last step, summed over
                                                     // bodies; of a spring on its first body
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // [N m] the same, about the bodies' centres
};

// The energy books by kind. Where all of a kind's forces have a potential, work is what it lost.
struct EffectLedger {
  struct Row {
    std::size_t kind = 0;     // index in EffectKind
    std::uint32_t count = 0;  // effects
    std::uint32_t acted = 0;  // (effect, body) pairs whose motion it showed in
    double potential = 0;     // [J]
    double step_work = 0;     // [J]
    double work = 0;          // [J] of those that exist
  };
  std::vector<Row> rows;  // kinds that the world has, in the order of EffectKind

  [[nodiscard]] double potential() const {
    double sum = 0;
    for (const Row& row : rows) sum += row.potential;
    return sum;
  }
};

// What a field of the user's own is told of a body, and what it answers.
struct FieldSample {
  BodyId body;
  double time = 0;                                             // [s] of the world
  double mass = 0;                                             // [kg]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();          // [m] centre of mass
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          // [m/s]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // [rad/s]
  std::array<Real, 4> parameters{};
};
struct FieldForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // [N m]
  double potential = 0;                              // [J] for the ledger; 0 if there is none
};
// Must give the same answer to the same question (replay asks again), and allow being called from
// several threads. An answer that is not finite counts as none.
using ForceFieldFunction = FieldForce (*)(const FieldSample& at, void* context);

}  // namespace plumb::inline PLUMB_ABI
