// Joints as numbers (joint_inputs.cpp documents the layout).
#pragma once

#include <optional>
#include <vector>

#include "plumb/joint.h"
#include "world/inputs.h"

namespace plumb::inline PLUMB_ABI::detail {

void append(std::vector<double>& out, const std::optional<JointMotor>& motor);
void append(std::vector<double>& out, const std::optional<JointLimit>& limit);
void append(std::vector<double>& out, const Joint& joint);

// ok becomes false where a number is no valid choice.
std::optional<JointMotor> read_motor(NumberReader& in, bool& ok);
std::optional<JointLimit> read_limit(NumberReader& in, bool& ok);
Joint read_joint(NumberReader& in, bool& ok);

}  // namespace plumb::inline PLUMB_ABI::detail
