#include "solver/joints/joint_laws.h"

#include <cmath>

#include "solver/joints/coordinates.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

bool is_second(const JointBlock& block, JointPass pass) {
  return block.split && pass == JointPass::Relax;
}
Real* parts_of(JointBlock& block, int f, JointPass pass) {
  RowImpulses& impulses = block.row[block.held + f].impulses;
  return is_second(block, pass) ? impulses.second : impulses.first;
}

// Collects the laws of one row.
struct Laws {
  const JointBlock& block;
  const JointRow& row;
  const FreeRow& free;
  const RowMoment& moment;
  Law* out;
  int count = 0;

  [[nodiscard]] bool solving() const { return moment.pass == JointPass::Solve; }
  [[nodiscard]] Real time() const { return block.split ? Real(0.5) * moment.h : moment.h; }
  [[nodiscard]] Real now(RowPart part) const {
    return is_second(block, moment.pass) ? row.impulses.second[part] : row.impulses.first[part];
  }

  // [m] or [rad] of its displacement by which a spring pulls at most: one that substeps can follow
  // by all, one that acts like a rigid hold by what Newton's method can take back in one.
  [[nodiscard]] Real reach(Real share) const {
    const Real size = is_linear(row.coordinate) ? block.size : Real(1);
    return share > Real(0.5) ? joint_tolerance::kReach * size / (Real(2) * share - Real(1))
                             : kUnlimited;
  }
  // share: of its impulse that comes before the drift where impulses are split.
  void soft(RowPart part, Real share, Real rest, Real k, Real c, Real impulse, Real lower,
            Real upper) {
    const Real part_gone = block.split ? share : Real(1);
    const Real T = part_gone * moment.h, G = T * (k * T + c);
    if (!solving() || !(G > Real(0))) return;
    const Real most = reach(share);
    const Real x =
        std::min(std::max(row.value - rest, -most), most) + part_gone * (moment.end - row.value);
    const Real lack = (impulse + T * (k * x + c * moment.rate)) / G;
    out[count++] = {part, true, share > Real(0.5), lack, Real(1) / G, impulse, lower, upper};
  }
  void rigid(RowPart part, Real lack, Real impulse, Real lower, Real upper) {
    out[count++] = {part, false, false, lack, Real(0), impulse, lower, upper};
  }

  // Sign +1 keeps the coordinate above, -1 below `bound`.
  void limit(RowPart part, Real sign, Real bound) {
    if (!std::isfinite(bound)) return;
    const Real impulse = sign * now(part);
    const auto one_sided = [&](Real least, auto&& add) {
      if (sign > Real(0)) {
        add(least, kUnlimited);
      } else {
        add(-kUnlimited, -least);
      }
    };
    if (free.limit_frequency > Real(0)) {
      one_sided(Real(0), [&](Real lower, Real upper) {
        soft(part, free.limit_share, bound, free.limit_stiffness, free.limit_damping, impulse,
             lower, upper);
      });
      return;
    }
    const Real gap = sign * (row.value - bound), h = moment.h;
    Real lack, least = 0;
    if (solving()) {
      // What is beyond the limit already comes back in positions alone (joint_close.cpp).
      lack = (sign * (moment.end - row.value) + std::max(gap, Real(0))) / h;
    } else {
      const Real before = row.impulses.first[part];
      if (block.split) least = -before;  // what was pushed too much before is taken back
      lack = sign * moment.rate + std::max(gap, Real(0)) / h;
      const Real approach = sign * row.approach;
      if (row.may_bounce && approach < Real(0)) {
        if (!(before > Real(0)))
          return;  // not there yet: to slow it down now would spoil the bounce
        lack = sign * moment.rate + free.restitution * approach;
      }
    }
    one_sided(least,
              [&](Real lower, Real upper) { rigid(part, sign * lack, impulse, lower, upper); });
  }
};

}  // namespace

int laws_of(const JointBlock& block, int f, const RowMoment& moment, Law laws[kMaxLaws]) {
  const FreeRow& free = block.free[f];
  const JointRow& row = block.row[block.held + f];
  Laws all{block, row, free, moment, laws};
  const Real effort = all.time() * free.max_effort;
  if (free.spring)
    all.soft(kSpring, free.spring_share, free.rest, free.stiffness, free.damping, all.now(kSpring),
             -kUnlimited, free.pulls_only ? Real(0) : kUnlimited);
  if (free.servo && free.servo_frequency > Real(0)) {
    const Real most = block.split ? Real(2) * free.servo_share * effort : effort;
    all.soft(kMotor, free.servo_share, free.servo_target, free.servo_stiffness, free.servo_damping,
             all.now(kMotor), -most, most);
  }
  const bool soft_limits = free.limited && free.limit_frequency > Real(0);
  const auto limits = [&] {
    all.limit(kLower, Real(1), free.lower);
    all.limit(kUpper, Real(-1), free.upper);
  };
  if (soft_limits) limits();
  if (free.motor) {
    all.rigid(kMotor, moment.rate - free.speed, all.now(kMotor), -effort, effort);
  } else if (free.servo && !(free.servo_frequency > Real(0))) {
    const Real lack = all.solving() ? (moment.end - free.servo_target) / moment.h : moment.rate;
    all.rigid(kMotor, lack, all.now(kMotor), -effort, effort);
  }
  if (free.friction > Real(0)) {
    const Real most = all.time() * free.friction;
    all.rigid(kFriction, moment.rate, all.now(kFriction), -most, most);
  }
  if (free.limited && !soft_limits) limits();
  return all.count;
}

void set_impulse(JointBlock& block, int f, JointPass pass, RowPart part, Real impulse) {
  parts_of(block, f, pass)[part] = part == kUpper ? -impulse : impulse;
}

void settle_unlimited_motor(JointBlock& block, int f, JointPass pass) {
  const FreeRow& free = block.free[f];
  if (!free.limited || !(free.motor || free.servo) || std::isfinite(free.max_effort)) return;
  Real* part = parts_of(block, f, pass);
  for (const RowPart limit : {kLower, kUpper}) {
    const Real sign = limit == kLower ? Real(1) : Real(-1);
    const Real both = std::min(part[limit], -sign * part[kMotor]);
    if (!(both > Real(0))) continue;
    part[limit] -= both;
    part[kMotor] += sign * both;
  }
}

Real total_impulse(const RowImpulses& impulses, bool second) {
  const Real* part = second ? impulses.second : impulses.first;
  return part[kHold] + part[kSpring] + part[kMotor] + part[kFriction] + part[kLower] - part[kUpper];
}

}  // namespace plumb::inline PLUMB_ABI::detail
