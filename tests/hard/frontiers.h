// What is known to fail, by how much: the worst ratio of a figure to its bound (hard_cell.h), 1e6
// where the scene does not end as it should at all. Nothing is taken out of the suite for failing;
// a line goes when its cell passes. The runs print them.
#pragma once

#include <string_view>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {
namespace hard {

struct Frontier {
  std::string_view cell;
  int bits;      // of Real
  double worst;  // [-] of the bound
};

inline constexpr Frontier kFrontiers[] = {
    {"", 0, 0},
};

// 0: it passes.
inline double known_frontier(std::string_view cell, bool in_double) {
  for (const Frontier& f : kFrontiers)
    if (f.cell == cell && f.bits == (in_double ? 64 : 32)) return f.worst;
  return 0;
}

}  // namespace hard
}  // namespace plumb::inline PLUMB_ABI
