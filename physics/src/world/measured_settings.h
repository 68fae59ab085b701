// What settings were measured to give, and to cost: a row a number type, kind of scene, step,
// number of substeps and, for joints, order. The table is generated (measured_table.h).
#pragma once

#include "plumb/settings.h"

namespace plumb::inline PLUMB_ABI::detail {

struct MeasuredSetting {
  const char* precision;  // kPrecisionName of the build that was measured
  SceneKind kind;         // never Any
  int rate;               // [Hz] 1/dt
  int substeps;           // [-]
  int joint_order;  // [-] WorldSettings::joint_order; 4 only in Jointed, others do not feel it
  double error;     // [-] the worst case of the kind, relative to the size of its motion
  double cost;      // [s] for a body and a simulated second, the dearest case of the kind
};

}  // namespace plumb::inline PLUMB_ABI::detail
