// One island as Newton's method sees it: bodies with their mass matrices, contacts in manifold
// space (contact_kernel.h), joints as laws along their rows. All in double, whatever the build.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/joints/joint_memory.h"
#include "solver/newton/body_matrix.h"
#include "solver/newton/contact_law.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

inline constexpr int kFixed = -1;  // index of what does not move

// Velocity or momentum of a body: linear, angular.
struct Twist {
  Vec3d v{0, 0, 0}, w{0, 0, 0};
};
inline Twist operator+(const Twist& a, const Twist& b) { return {a.v + b.v, a.w + b.w}; }
inline Twist operator-(const Twist& a, const Twist& b) { return {a.v - b.v, a.w - b.w}; }
inline Twist operator*(double s, const Twist& a) { return {s * a.v, s * a.w}; }
inline double dot(const Twist& a, const Twist& b) {
  return detail::dot(a.v, b.v) + detail::dot(a.w, b.w);
}

struct IslandBody {
  std::uint32_t dense = 0;
  Vec3d mass{1, 1, 1};  // [kg] by world axis; where it cannot move: 1, and it takes no momentum
  Sym3d inertia{}, inverse_inertia{};  // [kg m^2], [1/(kg m^2)] likewise
  bool restricted = false;
  Vec3d moves{1, 1, 1};           // 0: locked
  Sym3d turns = kWhole;           // projects on the axes about which it turns
  Twist start;                    // velocity before the forces of the substep
  Twist p;                        // M v before the impulses
  double m = 0, size = 0;         // [kg], [m] scales of its linear and angular momentum
  double weight = 0;              // [N s] mass times what forces add to its velocity in the substep
  double carried = 0, floor = 0;  // [N s] sum of impulses at it; what rounding may leave of them
};

// A scalar law; see contact_law.h. Soft ones have a compliance e: u + bias + e l is what vanishes.
struct ScalarLaw {
  int row = 0;  // of its joint
  RowPart part = kHold;
  double lower = 0, upper = 0, compliance = 0;
  double bias = 0, push = 0;  // the latter only while positions are solved for
  bool bounces = false;       // once it acts it has this bias:
  double bounce = 0;
  double warm = 0, center = 0, g = 0, D = 0, factored_D = 0;
};

struct IslandPoint {
  double a = 0, b = 0;  // [m] in the contact plane
  double gap = 0;       // [m/s] bias of the normal: closing speed that just meets
  double push = 0;      // [m/s] <= 0, further bias while positions are solved for
  double drive1 = 0, drive2 = 0;
  Vec3d warm{0, 0, 0}, center{0, 0, 0}, g{0, 0, 0};  // [N s] of last time, of this, found
  Sym3d D{};
  double shift = 0;   // [m/s] |u_t| of the last outer iteration
  double radius = 0;  // [N s] of the disc
  bool slid = false, disc = false;
  Sym3d factored_D{};  // of the matrix that is factored
};

struct IslandContact {
  std::uint32_t row = 0;  // of the world
  int a = kFixed, b = kFixed;
  Vec3d n, t1, t2, arm_a, arm_b;
  double mu = 0;
  double response = 0;           // [1/kg]
  double load = 0, sliding = 0;  // [N s] of the substep, and the part of it that slides
  bool rests = false;            // it touches when the substep begins: what changes is no jump
  int count = 0;
  IslandPoint points[4];
  // Velocity of what is not part of the island, and at a time those of what is: (n, t1, t2).
  Twist fixed, now, change;
  bool resists_turning = false;
  double rolling = 0, torsional = 0;        // [m]
  double spin_drive = 0;                    // [rad/s]
  double lever2 = 0;                        // [m^2] scale of torques' step lengths
  double roll_radius = 0, spin_radius = 0;  // [N m s] bounds of the last outer iteration
  Vec3d turn_warm{0, 0, 0}, turn_center{0, 0, 0}, turn_g{0, 0, 0};  // about n, t1, t2
  Sym3d turn_D{}, factored_turn_D{};
};

// Three laws whose impulses are bounded as a vector.
struct BallBound {
  int first = 0;  // law
  double radius = 0;
};

struct IslandJoint {
  std::uint32_t block = 0;
  int bodies = 0, rows = 0;
  int body[kMaxJointBodies] = {};
  Twist J[kMaxJointRows][kMaxJointBodies];
  double unit2[kMaxJointRows] = {};  // [m^2] of turning rows, 1 of the others
  double fixed[kMaxJointRows] = {};  // [m/s], [rad/s] from what is not part of the island
  double now[kMaxJointRows] = {}, change[kMaxJointRows] = {};
  std::uint32_t first_law = 0, laws = 0;
  int balls = 0;
  BallBound ball[3];
  double ball_D[3][3] = {};  // beside the diagonal: (0,1), (0,2), (1,2)
  double factored_ball_D[3][3] = {};
};

struct Island {
  std::vector<IslandBody> bodies;  // ascending by dense index
  std::vector<IslandContact> contacts;
  std::vector<IslandJoint> joints;
  std::vector<ScalarLaw> laws;
  std::vector<std::uint32_t> rows, blocks, pieces;  // of the world: contact rows, joints
  std::vector<BodyMatrix::Edge> edges;

  double mass = 0;         // [kg] the largest that an impulse meets
  double step_length = 0;  // [-] rho over it
  double speed = 0;        // [m/s] below which differences are none
  double slides = 0;       // [m/s] above which a point slides
  bool solves_positions = false;

  double lack = 0;  // [m/s] by which the laws are missed
  int factorizations = 0;
  bool fell_back = false;
  // Of factorizations in this step; beyond it a solve has one interior point, and what overlaps
  // stays so.
  std::uint32_t budget = 0;
  // Over the step: sums, and the largest lack.
  std::uint32_t total_factorizations = 0, fallbacks = 0;
  double worst_lack = 0;

  std::vector<Twist> v;  // the unknowns
  std::vector<Twist> gradient, step;
  std::vector<Twist> v_start;  // where the solve began, or what an interior point has found
  std::vector<Twist> v_rest;   // the velocities with which the substep ends
  BodyMatrix matrix;
  bool has_factor = false;  // of the laws as they were when it was made
};

}  // namespace plumb::inline PLUMB_ABI::detail::newton
