#include "solver/joints/joint_rows.h"

#include <cmath>

#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

FreeRow& RowBuilder::add_free(Coordinate coordinate) {
  FreeRow& row = block_.free[block_.rows - block_.held];
  row = {};
  block_.row[block_.rows].coordinate = coordinate;
  block_.row[block_.rows].needs_value = false;
  ++block_.rows;
  return row;
}

void RowBuilder::hold(Coordinate coordinate, Real target) {
  if (!is_soft()) {
    JointRow& row = block_.row[block_.rows];
    row.coordinate = coordinate;
    row.needs_value = true;
    row.target = target;
    ++block_.rows;
    ++block_.held;
    return;
  }
  FreeRow& row = add_free(coordinate);
  row.spring = true;
  row.rest = target;
  row.hold_frequency = softness_.frequency;
  row.hold_damping_ratio = softness_.damping_ratio;
  block_.row[block_.rows - 1].needs_value = true;
}

void RowBuilder::hold_attitude() {
  // Twice the vector part of the quaternion says less and less of a turn: its gradient is gone at
  // half of one, where bodies that others force apart may come. Far off the rotation vector serves.
  const FramePair& pair = block_.pair[0];
  const Rotation q = conjugate(pair.frame_a) * pair.frame_b;
  const bool far = std::abs(q.w) < joint_tolerance::kNearHalfCosine;
  const Coordinate first = far ? Coordinate::RotationX : Coordinate::TurnX;
  for (int i = 0; i < 3; ++i) hold(static_cast<Coordinate>(static_cast<int>(first) + i));
}

void set_limit(FreeRow& row, const JointLimit& limit) {
  row.limited = true;
  row.lower = limit.lower;
  row.upper = limit.upper;
  row.limit_frequency = limit.softness.frequency;
  row.limit_damping_ratio = limit.softness.damping_ratio;
  row.restitution = limit.restitution;
}

FreeRow& RowBuilder::leave(Coordinate coordinate, const JointAxis& axis) {
  FreeRow& row = add_free(coordinate);
  if (axis.spring.has_value()) {
    row.spring = true;
    row.rest = axis.spring->rest;
    row.stiffness = axis.spring->stiffness;
    row.damping = axis.spring->damping;
  }
  if (axis.motor.has_value()) {
    row.max_effort = axis.motor->max_effort;
    if (axis.motor->mode == JointMotor::Mode::Velocity) {
      row.motor = true;
      row.speed = axis.motor->target;
    } else {
      row.servo = true;
      row.servo_target = axis.motor->target;
      row.servo_frequency = axis.motor->softness.frequency;
      row.servo_damping_ratio = axis.motor->softness.damping_ratio;
    }
  }
  if (axis.friction > Real(0)) {
    row.friction = axis.friction;
  }
  if (axis.limit.has_value()) {
    set_limit(row, *axis.limit);
  }
  block_.row[block_.rows - 1].needs_value = row.spring || row.servo || row.limited;
  return row;
}

void RowBuilder::turn_friction(Real torque) {
  if (!(torque > Real(0))) return;
  block_.friction_group = block_.rows - block_.held;
  for (const Coordinate rate : {Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ})
    add_free(rate).friction = torque;
}

}  // namespace plumb::inline PLUMB_ABI::detail
