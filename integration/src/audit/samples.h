// What the audit compares: the dynamic bodies of two steps.
#pragma once

#include <vector>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::audit {

struct BodySample {
  BodyState state;
  Eigen::Vector3d L, center;  // [kg m^2/s], [m]
  double size = 1;            // [m] radius of gyration of the whole body
  double weight_turn = 0;     // [kg m^2/s] what its weight may do in a step
  double rest_speed = 0;      // [m/s]
  bool held = false;
};
using Sample = std::vector<BodySample>;

Sample sample_of(const PhysicsWorld& world, double dt);
// Between the i-th bodies of two samples of one scene, in the unit of tolerance_of(item) (audit.h).
double change_between(PlanItem item, const Sample& a, const Sample& b, std::size_t i, double dt);
double largest_change(PlanItem item, const Sample& a, const Sample& b, double dt);

}  // namespace plumb::inline PLUMB_ABI::audit
