#include "collision/axes_kernel.h"

namespace plumb::inline PLUMB_ABI::detail {

AxesKernel choose_axes_kernel(int bits) {
#if defined(__x86_64__) || defined(__i386__)
  // As for the contact kernel (contact_blocks.cpp): the first processors with vectors of 512 bits
  // lower their clock for them; those that came after know VBMI2 as well.
  const bool has_512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512dq");
  if (has_512 && (bits >= 512 || (bits == 0 && __builtin_cpu_supports("avx512vbmi2"))))
    return axes_kernel_512();
  if ((bits == 0 || bits >= 256) && __builtin_cpu_supports("avx2")) return axes_kernel_256();
#endif
  return axes_kernel_128();
}

}  // namespace plumb::inline PLUMB_ABI::detail
