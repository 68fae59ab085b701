// Rows side by side: those of one colour and one number of points, W at a time, with every number
// of the kernel as W lanes. A row has the same bits in a block as alone, so which rows go into
// blocks is only a question of speed; those that need more than the plain kernel (bounces, rolling
// friction, running surfaces, effects, the ledger) stay rows.
#pragma once

#include <vector>

#include "collision/manifold.h"
#include "solver/block_pass.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

struct IndexRange {
  std::uint32_t begin = 0, end = 0;
};

// What a row needs to be sorted.
struct RowKind {
  std::uint8_t points = 0;  // of a row that goes into a block; 0: it stays alone
  bool deep = false;        // a body of it overlaps deeply
};

struct ContactBlocks {
  struct alignas(64) Line {
    std::uint8_t bytes[64];
  };
  // What one colour has: first the rows of bodies that overlap deeply, which are relaxed more often
  // (up to the `deep` marks), then the others.
  struct Color {
    IndexRange heads, loose;
    std::uint32_t deep_heads = 0, deep_loose = 0;  // ends
  };
  BlockKernel kernel;
  std::vector<BlockHead> heads;      // by colour, depth, number of points
  std::vector<std::uint32_t> loose;  // rows that stay alone, by colour, depth
  std::vector<Color> colors;
  std::vector<Line> numbers;
  std::vector<RowKind> kinds;                                  // scratch: of the group's rows
  std::vector<std::uint32_t> by_points[Manifold::kMaxPoints];  // scratch: rows of one colour

  [[nodiscard]] Real* data() { return reinterpret_cast<Real*>(numbers.data()); }
};

// The kernel for vectors of that many bits, or the longest below that this processor has; one row
// at a time for 0 < bits < 128. 0: as long as pays.
BlockKernel choose_block_kernel(int bits);

// The kernel of this step's passes.
BlockKernel block_kernel_of(const WorldState& world);

struct StepGroup;

// Sorts the rows of a group into blocks and loose ones, and fills the blocks.
void fill_blocks(WorldState& world, StepGroup& group);
// Writes what the blocks' rows have become back to the rows.
void empty_blocks(WorldState& world, StepGroup& group);

}  // namespace plumb::inline PLUMB_ABI::detail
