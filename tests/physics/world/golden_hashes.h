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
    {0x60833bb369f8de9a, 0x2bd36ed0a48b4769, 0xa52f343422bdb3bc},  // stack
    {0x3737bea91d640919, 0x54f70c2653e842bc, 0x397827038f40ef64},  // pyramid
    {0x1d0b6eeffa74b333, 0xeb693c31b35f5482, 0xa0290bbce52e801c},  // pile
    {0x8f8ac0508cb2d150, 0xdd161c8933d55e53, 0xe7f975ef7c74567a},  // cluster
    {0x8dfdf6d8b5706ee8, 0x9b4ded355a69da4, 0x2b06a648695912e8},   // bouncing
    {0xa8f498a58e114c39, 0x3a38c150ceb23d19, 0x8f4d2a918bf52a8e},  // bridge
    {0xc4aa68e0fd281ace, 0xb53692fa70a59a41, 0x93209a701aad2c3e},  // hills
    {0x27bb8b95c4fe25bd, 0x57e1223490b56f80, 0x2cdb39e9da1542b1},  // heavy above light
};

}  // namespace plumb::inline PLUMB_ABI
