// Joints as laws along their rows: what is held, and what acts along free coordinates, each with
// the bounds and the compliance that joint_laws.h gives it.
#include <algorithm>
#include <cmath>

#include "solver/joints/coordinates.h"
#include "solver/joints/joint_laws.h"
#include "solver/joints/joint_motion.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_tolerances.h"
#include "solver/newton/island_build.h"
#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"
#include "solver/newton/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

Vec3d wide(Vec a) { return cast<double>(a); }

void fill_rows(const WorldState& world, const Solver& solver, Island& island,
               const JointBlock& block, IslandJoint& joint) {
  joint.bodies = block.bodies;
  joint.rows = block.rows;
  const BlockVelocities u = read_velocities(world, block);
  for (int k = 0; k < block.bodies; ++k)
    joint.body[k] = block.moves[k] ? solver.place[block.body[k]].body : kFixed;
  for (int i = 0; i < block.rows; ++i) {
    const double size = static_cast<double>(block.size);
    joint.unit2[i] = is_linear(block.row[i].coordinate) ? 1 : size * size;
    for (int k = 0; k < block.bodies; ++k) {
      const BodyJacobian& J = block.J[i * block.bodies + k];
      joint.J[i][k] = {wide(J.linear), wide(J.angular)};
      if (joint.body[k] == kFixed) {
        joint.fixed[i] += dot(joint.J[i][k], Twist{wide(u.v[k]), wide(u.w[k])});
        continue;
      }
      const IslandBody& body = island.bodies[static_cast<std::size_t>(joint.body[k])];
      const Vec3d l = joint.J[i][k].v, a = joint.J[i][k].w;
      const double response =
          l.x * l.x * body.moves.x / body.mass.x + l.y * l.y * body.moves.y / body.mass.y +
          l.z * l.z * body.moves.z / body.mass.z + detail::dot(a, body.inverse_inertia * a);
      if (response > 0) island.mass = std::max(island.mass, 1 / (response * joint.unit2[i]));
    }
  }
}

double response_of(const Island& island, const IslandJoint& joint, int row) {
  double K = 0;
  for (int k = 0; k < joint.bodies; ++k) {
    if (joint.body[k] == kFixed) continue;
    const IslandBody& body = island.bodies[static_cast<std::size_t>(joint.body[k])];
    const Twist& J = joint.J[row][k];
    K += detail::dot(J.v, {J.v.x * body.moves.x / body.mass.x, J.v.y * body.moves.y / body.mass.y,
                           J.v.z * body.moves.z / body.mass.z}) +
         detail::dot(J.w, body.inverse_inertia * J.w);
  }
  return K;
}

bool in_ball(const JointBlock& block, int f, RowPart part, Real& size, Real h) {
  if (part == kFriction && block.friction_group >= 0 && f >= block.friction_group &&
      f < block.friction_group + 3) {
    size = h * block.free[block.friction_group].friction;
    return true;
  }
  if (part != kMotor || f / 3 >= block.motor_groups) return false;
  size = h * block.free[f - f % 3].max_effort;
  return std::isfinite(size);
}

// At rest and where it stands: what the law asks of the rate.
ScalarLaw make_law(const JointBlock& block, int f, const Law& law) {
  const FreeRow& free = block.free[f];
  const JointRow& row = block.row[block.held + f];
  ScalarLaw out;
  out.row = block.held + f;
  out.part = law.part;
  out.lower = static_cast<double>(law.lower);
  out.upper = static_cast<double>(law.upper);
  out.compliance = static_cast<double>(law.give);
  out.bias = static_cast<double>(law.lack) - out.compliance * static_cast<double>(law.impulse);
  out.warm = std::min(std::max(static_cast<double>(law.impulse), out.lower), out.upper);
  if (law.soft) return out;
  const bool limit = law.part == kLower || law.part == kUpper;
  const double sign = law.part == kUpper ? -1 : 1;
  const bool servo = law.part == kMotor && free.servo;
  if (servo || (limit && sign * out.bias < 0)) {  // back into place, in positions alone
    out.push = out.bias;
    out.bias = 0;
  }
  if (limit && row.may_bounce) {
    out.bounces = true;
    out.bounce = static_cast<double>(free.restitution * row.approach);
  }
  return out;
}

void fill_laws(const WorldState& world, Island& island, const JointBlock& block, bool loops,
               IslandJoint& joint) {
  joint.first_law = static_cast<std::uint32_t>(island.laws.size());
  for (int i = 0; i < block.held; ++i) {
    ScalarLaw law;
    law.row = i;
    law.lower = -std::numeric_limits<double>::infinity();
    law.upper = std::numeric_limits<double>::infinity();
    if (loops) law.compliance = joint_tolerance::kLoopCompliance * response_of(island, joint, i);
    law.warm = static_cast<double>(block.row[i].impulses.first[kHold]);
    island.laws.push_back(law);
  }
  Law laws[kMaxFree][kMaxLaws];
  int counts[kMaxFree] = {};
  Real size = 0;
  for (int f = 0; f < block.rows - block.held; ++f) {
    const Real value = block.row[block.held + f].value;
    counts[f] = laws_of(block, f, {JointPass::Solve, world.h, Real(0), value}, laws[f]);
    for (int k = 0; k < counts[f]; ++k)
      if (!in_ball(block, f, laws[f][k].part, size, world.h))
        island.laws.push_back(make_law(block, f, laws[f][k]));
  }
  for (int first = 0; first + 2 < block.rows - block.held; ++first) {
    for (const RowPart part : {kFriction, kMotor}) {
      const bool begins = part == kFriction ? first == block.friction_group
                                            : first % 3 == 0 && first / 3 < block.motor_groups;
      if (!begins || !in_ball(block, first, part, size, world.h)) continue;
      const std::size_t begin = island.laws.size();
      for (int f = first; f < first + 3; ++f)
        for (int k = 0; k < counts[f]; ++k)
          if (laws[f][k].part == part) island.laws.push_back(make_law(block, f, laws[f][k]));
      if (island.laws.size() != begin + 3) {  // no effort at all: nothing acts
        island.laws.resize(begin);
        continue;
      }
      joint.ball[joint.balls++] = {static_cast<int>(begin), static_cast<double>(size)};
    }
  }
  joint.laws = static_cast<std::uint32_t>(island.laws.size()) - joint.first_law;
}

}  // namespace

void fill_joints(const WorldState& world, const Solver& solver, Island& island) {
  island.laws.clear();
  island.joints.clear();
  if (island.blocks.empty()) return;
  const JointScratch& scratch = *world.joints.scratch;
  for (const std::uint32_t index : island.pieces) {
    const JointPiece& piece = scratch.system.pieces[index];
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
      island.joints.emplace_back();
      IslandJoint& joint = island.joints.back();
      joint.block = i;
      fill_rows(world, solver, island, scratch.blocks[i], joint);
      fill_laws(world, island, scratch.blocks[i], piece.loops, joint);
    }
  }
}

void store_joints(WorldState& world, const Island& island) {
  for (const IslandJoint& joint : island.joints) {
    JointBlock& block = world.joints.scratch->blocks[joint.block];
    for (int i = 0; i < block.rows; ++i) block.row[i].impulses = {};
    for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws; ++k) {
      const ScalarLaw& law = island.laws[k];
      const Real impulse = static_cast<Real>(law.center);
      if (law.part == kHold) {
        block.row[law.row].impulses.first[kHold] = impulse;
      } else {
        set_impulse(block, law.row - block.held, JointPass::Solve, law.part, impulse);
      }
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
