// The number types of this build and the inline namespace that carries them.
//
// One source, three builds. Each puts every symbol into its own inline namespace, so that linking a
// program against the wrong build fails at link time, and one program may hold several builds side
// by side (each in its own translation units) and compare them.
//
//   build  Real    PosReal   for
//   f32    float   float     games; worlds of a few kilometres
//   f32d   float   double    games with large worlds: positions in double, solver in float
//   f64    double  double    tools, references, tests against closed forms
#pragma once

#if defined(PLUMB_PRECISION_F64)
#define PLUMB_ABI f64
#elif defined(PLUMB_PRECISION_F32D)
#define PLUMB_ABI f32d
#else
#define PLUMB_ABI f32
#endif

namespace plumb::inline PLUMB_ABI {

#if defined(PLUMB_PRECISION_F64)
using Real = double;
using PosReal = double;
inline constexpr const char* kPrecisionName = "f64";
#elif defined(PLUMB_PRECISION_F32D)
using Real = float;
using PosReal = double;
inline constexpr const char* kPrecisionName = "f32d";
#else
using Real = float;
using PosReal = float;
inline constexpr const char* kPrecisionName = "f32";
#endif

}  // namespace plumb::inline PLUMB_ABI
