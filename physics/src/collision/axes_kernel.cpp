#include "collision/axes_kernel.h"

#include "math/vector_bits.h"

namespace plumb::inline PLUMB_ABI::detail {

AxesKernel choose_axes_kernel(int bits) {
  const int chosen = vector_bits(bits);
  return chosen == 512 ? axes_kernel_512() : chosen == 256 ? axes_kernel_256() : axes_kernel_128();
}

}  // namespace plumb::inline PLUMB_ABI::detail
