// Written by `plumb accuracy --table physics/src/world/measured_table.h`; see measured_settings.h.
// clang-format off
#pragma once

#include "world/measured_settings.h"

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr const char* kMeasuredOn = "nothing measured yet";
inline constexpr MeasuredSetting kMeasured[] = {
    {"f32", SceneKind::Free, 60, 4, 1e-3, 1e-6},
};

}  // namespace plumb::inline PLUMB_ABI::detail
