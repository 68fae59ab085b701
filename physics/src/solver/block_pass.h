// What the wide kernel is given: memory and numbers only, so that its translation units, which are
// compiled for other processors, share no inline function with the rest of the engine (see
// contact_wide.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

// W rows that share no dynamic body, all with the same number of points.
struct BlockHead {
  static constexpr int kMostLanes = 16;
  std::uint32_t body_a[kMostLanes]{}, body_b[kMostLanes]{};  // dense; 0 in unused lanes
  std::uint32_t row[kMostLanes]{};                           // index into the world's rows
  std::uint64_t numbers = 0;                                 // where its RowNumbers begin [Real]
  std::uint32_t points = 0;                                  // of each row
  std::uint32_t lanes = 0;                                   // bit i: lane i holds a row
  std::uint32_t writes_a = 0, writes_b = 0;                  // ... whose body is dynamic
};

struct BlockPass {
  const BlockHead* heads = nullptr;
  Real* numbers = nullptr;
  Real* velocity = nullptr;                  // BodyVelocity: (v, load), (w, sliding load)
  const Real* delta = nullptr;               // BodyDelta: (dp, -), dq
  std::uint8_t* contacts_changed = nullptr;  // per dense body
  Real inverse_h = 0;                        // [1/s]
  bool ends_substep = false;                 // the last relaxing pass
};

// Records of the bodies, by dense index: where they begin, and what the kernel reads of them.
struct BodyPass {
  Real* velocity = nullptr;     // BodyVelocity
  Real* delta = nullptr;        // BodyDelta
  Real* momentum = nullptr;     // BodyMomentum
  Real* orientation = nullptr;  // of BodyPose
  std::size_t pose_stride = 0;  // [Real]
  const Real* mass = nullptr;   // BodyMass
  const Real* force = nullptr;  // BodyForce
  Real* substep = nullptr;      // SubstepBody
  Real h = 0, dt = 0;           // [s] substep, step
};

// One kernel. Over contact rows: a sweep over blocks [begin, end), of one colour where they act
// (prepare makes their responses, once). Over bodies: those
// of the `lanes` bodies from `first` on whose bit is set in `which`; returns those that it left as
// they were because they turn too fast for one series.
struct BlockKernel {
  int lanes = 1;
  void (*prepare)(const BlockPass& pass, std::uint32_t begin, std::uint32_t end) = nullptr;
  void (*warm)(const BlockPass& pass, std::uint32_t begin, std::uint32_t end) = nullptr;
  void (*solve)(const BlockPass& pass, std::uint32_t begin, std::uint32_t end) = nullptr;
  void (*relax)(const BlockPass& pass, std::uint32_t begin, std::uint32_t end) = nullptr;
  void (*kick)(const BodyPass& pass, std::uint32_t first, std::uint32_t which) = nullptr;
  std::uint32_t (*drift)(const BodyPass& pass, std::uint32_t first, std::uint32_t which) = nullptr;
  // `weight` [s] of the trapezoid, per lane.
  void (*finish)(const BodyPass& pass, std::uint32_t first, std::uint32_t which,
                 const Real* weight) = nullptr;
  std::uint32_t (*fly)(const BodyPass& pass, std::uint32_t first, std::uint32_t which) = nullptr;
};
// Compiled for vectors of 128, 256 and 512 bits.
BlockKernel block_kernel_128();
BlockKernel block_kernel_256();
BlockKernel block_kernel_512();

}  // namespace plumb::inline PLUMB_ABI::detail
