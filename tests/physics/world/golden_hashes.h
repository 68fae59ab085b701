// State hashes after ten seconds of the scenes of golden_test, in their order.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

struct GoldenHash {
  std::uint64_t f32, f32d, f64;
  [[nodiscard]] std::uint64_t of_this_build() const {
    if constexpr (sizeof(Real) == 8) return f64;
    return sizeof(PosReal) == 8 ? f32d : f32;
  }
};
inline constexpr GoldenHash kGoldenHashes[] = {
    {0x60833bb369f8de9a, 0x8807dc9b89bde38e, 0xbbac923318561296},  // stack
    {0x3737bea91d640919, 0x92a121380dcacb50, 0xdbca8403e8d04df0},  // pyramid
    {0x1d0b6eeffa74b333, 0xd6cbbe37173658e3, 0x6188fcab1fbef8be},  // pile
    {0x8f8ac0508cb2d150, 0xf1883ca5fcc0de4, 0xa648dd5562ad2f83},   // cluster
    {0x8dfdf6d8b5706ee8, 0x2c5a2db840264a47, 0x8241986aad681c6a},  // bouncing
    {0x4352d96a2e91dbcc, 0xf471cd5d290ba38d, 0x9b0a791994f93acc},  // bridge
    {0xc4aa68e0fd281ace, 0xb53692fa70a59a41, 0x93209a701aad2c3e},  // hills
    {0x27bb8b95c4fe25bd, 0x57e1223490b56f80, 0x46f59f0703b362c4},  // heavy above light
};

}  // namespace plumb::inline PLUMB_ABI
