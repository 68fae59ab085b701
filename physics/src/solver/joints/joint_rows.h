// From the kind of a joint to its rows. Each kind has a file of its own that says what it holds and
// what it leaves free.
#pragma once

#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

// Collects the rows of one joint, the held ones first.
class RowBuilder {
 public:
  RowBuilder(JointBlock& block, const JointSoftness& softness)
      : block_(block), softness_(softness) {}

  // Holds a coordinate at `target`: rigidly, or by the joint's own spring when it is soft. All
  // calls come before the first leave().
  void hold(Coordinate coordinate, Real target = Real(0));
  // Holds B's attitude to that of A.
  void hold_attitude();
  // Leaves a coordinate free but for what acts along it.
  FreeRow& leave(Coordinate coordinate, const JointAxis& axis);
  // Bounded friction against turning, the same in every direction.
  void turn_friction(Real torque);
  // Gives a limit the joint's own softness.
  void soften_limit(FreeRow& row) const {
    row.limit_frequency = softness_.frequency;
    row.limit_damping_ratio = softness_.damping_ratio;
  }
  // The motors of rows 0-2 and of 3-5 are bounded as vectors.
  void bound_motors() { block_.motor_groups = 2; }
  [[nodiscard]] bool is_soft() const { return softness_.frequency > Real(0); }

 private:
  FreeRow& add_free(Coordinate coordinate);
  JointBlock& block_;
  JointSoftness softness_;
};

void set_limit(FreeRow& row, const JointLimit& limit);

void make_rows(const BallJoint& joint, RowBuilder& rows);
void make_rows(const HingeJoint& joint, RowBuilder& rows);
void make_rows(const SliderJoint& joint, RowBuilder& rows);
void make_rows(const FixedJoint& joint, RowBuilder& rows);
void make_rows(const DistanceJoint& joint, RowBuilder& rows);
void make_rows(const RopeJoint& joint, RowBuilder& rows);
void make_rows(const SpringJoint& joint, RowBuilder& rows);
void make_rows(const ConeTwistJoint& joint, RowBuilder& rows);
void make_rows(const SixDofJoint& joint, RowBuilder& rows);
void make_rows(const GearJoint& joint, RowBuilder& rows);
void make_rows(const RackPinionJoint& joint, RowBuilder& rows);
void make_rows(const PulleyJoint& joint, RowBuilder& rows);
void make_rows(const MotorJoint& joint, RowBuilder& rows);

}  // namespace plumb::inline PLUMB_ABI::detail
