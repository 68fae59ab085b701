// A 64-bit digest of numbers in their order: what two runs are compared by.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// Four chains of multiply-rotate mixing [Steele 2014], taken in turn, so that one word need not
// wait for the last; two single-precision numbers share a word.
class Digest {
 public:
  void add(std::uint64_t word) {
    std::uint64_t& chain = chains_[count_++ % kChains];
    chain = std::rotl(chain ^ (word * 0x9e3779b97f4a7c15u), 29) * 0xbf58476d1ce4e5b9u;
  }
  void add(double v) { add(std::bit_cast<std::uint64_t>(v)); }
  void add(float a, float b) {
    add(std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b));
  }
  template <class T, std::size_t N>
  void add(const T (&values)[N]) {
    if constexpr (sizeof(T) == sizeof(float)) {
      for (std::size_t i = 0; i + 1 < N; i += 2) add(values[i], values[i + 1]);
      if constexpr (N % 2 == 1) add(values[N - 1], 0.0f);
    } else {
      for (const T v : values) add(v);
    }
  }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t all = count_;
    for (const std::uint64_t chain : chains_) {
      std::uint64_t z = all ^ chain;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      all = z ^ (z >> 31);
    }
    return all;
  }

 private:
  static constexpr std::size_t kChains = 4;
  std::uint64_t chains_[kChains] = {0x2545f4914f6cdd1du, 0x9e6c63d0676a9a99u, 0xd1342543de82ef95u,
                                    0xf1357aea2e62a9c5u};
  std::uint64_t count_ = 0;
};

// How one body stands and moves. `About`: BodyInfo, or what an image keeps of it.
template <class About>
void add_motion(Digest& digest, std::uint32_t slot, const About& about, bool awake,
                const BodyPose& pose, const BodyVelocity& u, Vec L) {
  digest.add(std::uint64_t{about.generation} << 32 | slot);
  digest.add({pose.x.x, pose.x.y, pose.x.z});
  digest.add({pose.q.x, pose.q.y, pose.q.z, pose.q.w, u.v.x, u.v.y, u.v.z, u.w.x, u.w.y, u.w.z, L.x,
              L.y, L.z});
  digest.add(std::uint64_t{awake} << 1 | std::uint64_t{about.disabled});
}

}  // namespace plumb::inline PLUMB_ABI::detail
