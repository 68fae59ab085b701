#pragma once

#include "math/choose.h"
#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

// Whether the determinant is above `least` times the product of the diagonal; elsewhere `out` means
// nothing.
template <class T>
MaskOf<T> invert(const Symmetric3<T>& m, T least, Symmetric3<T>& out) {
  const T cxx = m.yy * m.zz - m.yz * m.yz, cxy = m.xz * m.yz - m.xy * m.zz,
          cxz = m.xy * m.yz - m.xz * m.yy;
  const T determinant = m.xx * cxx + m.xy * cxy + m.xz * cxz;
  const T d = T(1) / determinant;
  out = {d * cxx, d * (m.xx * m.zz - m.xz * m.xz), d * (m.xx * m.yy - m.xy * m.xy), d * cxy,
         d * cxz, d * (m.xy * m.xz - m.xx * m.yz)};
  return determinant > least * m.xx * m.yy * m.zz;
}

}  // namespace plumb::inline PLUMB_ABI::detail
