// Which vector length to run, of those that kernels are compiled for.
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

// 128, 256 or 512: the longest that this processor has, of at most `most` bits where that is > 0.
// The first processors with vectors of 512 bits lower their clock for them: they get them only when
// asked. Those that came after know VBMI2 as well.
inline int vector_bits(int most) {
#if defined(__x86_64__) || defined(__i386__)
  const bool has_512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512dq");
  if (has_512 && (most >= 512 || (most == 0 && __builtin_cpu_supports("avx512vbmi2")))) return 512;
  if ((most == 0 || most >= 256) && __builtin_cpu_supports("avx2")) return 256;
#endif
  static_cast<void>(most);
  return 128;
}

}  // namespace plumb::inline PLUMB_ABI::detail
