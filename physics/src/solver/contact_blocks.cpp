#include "solver/contact_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "math/vector_bits.h"
#include "math/wide.h"
#include "solver/row_responses.h"
#include "solver/step_groups.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Numbers = RowNumbers<Real, ContactRow<Real>::kMaxPoints>;

// [Real] what stands before the points, and what one point takes.
constexpr std::size_t kPointReals = sizeof(Numbers::Point) / sizeof(Real);
constexpr std::size_t kHeadReals = sizeof(Numbers) / sizeof(Real) - Numbers::kRoom * kPointReals;
constexpr std::size_t reals_of(int points) {
  return kHeadReals + static_cast<std::size_t>(points) * kPointReals;
}
// Below this many rows a block is not worth its empty lanes.
constexpr std::size_t kFewestRows = 2;

bool fits_block(const WorldState& world, const ContactRow<Real>& row) {
  // Bounces look at all rows of the bodies that may bounce, and change them.
  const std::vector<std::uint8_t>& bounces = world.groups.bounces;
  if (!bounces.empty() && (bounces[row.body_a] | bounces[row.body_b]) != 0) return false;
  return is_plain(world, row) && !row.spun;
}

const Real* numbers_of(const ContactRow<Real>& row) {
  return reinterpret_cast<const Real*>(static_cast<const Numbers*>(&row));
}
Real* numbers_of(ContactRow<Real>& row) {
  return reinterpret_cast<Real*>(static_cast<Numbers*>(&row));
}

// Rows and lanes are the two readings of one table. It is turned in tiles of 4 x 4 numbers that fit
// into registers: for four rows, numbers [begin, end) of each.
constexpr std::size_t kTile = 4;
constexpr std::uint32_t kAllOfTile = (1u << kTile) - 1u;  // bits of its lanes
using TileRow = Lanes<Real, kTile>::Reals;

template <class Read, class Write>
void turn_tiles(std::size_t begin, std::size_t end, Read&& read, Write&& write) {
  for (std::size_t k = begin; k < end; k += kTile) {
    TileRow tile[kTile];
    for (std::size_t i = 0; i < kTile; ++i) std::memcpy(&tile[i], read(k, i), sizeof(TileRow));
    quads::transpose<Real, kTile>(tile);
    for (std::size_t i = 0; i < kTile; ++i) std::memcpy(write(k, i), &tile[i], sizeof(TileRow));
  }
}

// Calls tiles(first, rows) for every four lanes that are all taken, else one(lane, row).
template <class Row, class Tiles, class One>
void for_lanes(std::vector<Row>& rows, const BlockHead& head, std::size_t lanes, Tiles&& tiles,
               One&& one) {
  for (std::size_t first = 0; first < lanes; first += kTile) {
    if ((head.lanes >> first & kAllOfTile) == kAllOfTile) {
      Row* const four[kTile] = {&rows[head.row[first]], &rows[head.row[first + 1]],
                                &rows[head.row[first + 2]], &rows[head.row[first + 3]]};
      tiles(first, four);
      continue;
    }
    for (std::size_t i = first; i < std::min(first + kTile, lanes); ++i)
      if ((head.lanes >> i & 1u) != 0) one(i, rows[head.row[i]]);
  }
}

class Sorter {
 public:
  Sorter(WorldState& world, StepGroup& group) : world_(world), group_(group) {}

  void sort() {
    blocks_.heads.clear();
    blocks_.loose.clear();
    blocks_.colors.clear();
    reals_ = 0;
    const std::vector<std::uint32_t>& rows = group_.rows;
    look_at_rows();
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
      // The colours are ranges of the rows one behind the other.
      const auto color = std::upper_bound(
          world_.colors.begin(), world_.colors.end(), rows[begin],
          [](std::uint32_t row, const ColorRange& range) { return row < range.end; });
      if (color == world_.colors.end()) break;  // what the passes leave to others has none
      while (end < rows.size() && rows[end] < color->end) ++end;
      sort_color(&rows[begin], &rows[begin] + (end - begin));
    }
    blocks_.numbers.resize((reals_ * sizeof(Real) + sizeof(ContactBlocks::Line) - 1) /
                           sizeof(ContactBlocks::Line));
  }

 private:
  void sort_color(const std::uint32_t* begin, const std::uint32_t* end) {
    ContactBlocks::Color& sorted = blocks_.colors.emplace_back();
    sorted.heads.begin = heads();
    sorted.loose.begin = loose();
    if (world_.deep_overlap) sort_rows(begin, end, true);
    sorted.deep_heads = heads();
    sorted.deep_loose = loose();
    sort_rows(begin, end, false);
    sorted.heads.end = heads();
    sorted.loose.end = loose();
  }
  [[nodiscard]] std::uint32_t heads() const {
    return static_cast<std::uint32_t>(blocks_.heads.size());
  }
  [[nodiscard]] std::uint32_t loose() const {
    return static_cast<std::uint32_t>(blocks_.loose.size());
  }
  [[nodiscard]] bool is_deep(const ContactRow<Real>& row) const {
    return world_.deep_overlap &&
           (world_.overlaps_deeply[row.body_a] | world_.overlaps_deeply[row.body_b]) != 0;
  }

  // Rows are long: all threads read them, once, and what is sorted is a byte of each.
  void look_at_rows() {
    const std::vector<std::uint32_t>& rows = group_.rows;
    blocks_.kinds.resize(rows.size());
    parallel_for(group_.jobs, static_cast<std::uint32_t>(rows.size()), tolerance::kRowGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t k = begin; k < end; ++k)
                     blocks_.kinds[k] = kind_of(world_.rows[rows[k]]);
                 });
  }
  [[nodiscard]] RowKind kind_of(const ContactRow<Real>& row) const {
    const bool fits = blocks_.kernel.lanes > 1 && fits_block(world_, row);
    return {static_cast<std::uint8_t>(fits ? row.count : 0), is_deep(row)};
  }

  void sort_rows(const std::uint32_t* begin, const std::uint32_t* end, bool deep) {
    const RowKind* kind = blocks_.kinds.data() + (begin - group_.rows.data());
    for (const std::uint32_t* k = begin; k != end; ++k, ++kind) {
      if (kind->deep != deep) continue;
      if (kind->points > 0) {
        blocks_.by_points[kind->points - 1].push_back(*k);
      } else {
        blocks_.loose.push_back(*k);
      }
    }
    for (int points = 1; points <= ContactRow<Real>::kMaxPoints; ++points) {
      std::vector<std::uint32_t>& rows = blocks_.by_points[points - 1];
      const std::size_t lanes = static_cast<std::size_t>(blocks_.kernel.lanes);
      std::size_t taken = 0;
      for (; rows.size() - taken >= kFewestRows; taken = std::min(taken + lanes, rows.size()))
        add_block(points, &rows[taken], std::min(lanes, rows.size() - taken));
      for (; taken < rows.size(); ++taken) blocks_.loose.push_back(rows[taken]);
      rows.clear();
    }
  }

  void add_block(int points, const std::uint32_t* rows, std::size_t count) {
    BlockHead& head = blocks_.heads.emplace_back();
    head.points = static_cast<std::uint32_t>(points);
    head.numbers = reals_;
    reals_ += reals_of(points) * static_cast<std::size_t>(blocks_.kernel.lanes);
    head.lanes = (1u << count) - 1u;
    std::copy_n(rows, count, head.row);
  }

  WorldState& world_;
  StepGroup& group_;
  ContactBlocks& blocks_ = group_.blocks;
  std::size_t reals_ = 0;
};

// The bodies of a block's rows.
void take_bodies(WorldState& world, BlockHead& head) {
  for (std::uint32_t left = head.lanes; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    ContactRow<Real>& row = world.rows[head.row[i]];
    row.in_block = true;
    head.body_a[i] = row.body_a;
    head.body_b[i] = row.body_b;
    if (world.substep[row.body_a].constrained) head.writes_a |= 1u << i;
    if (world.substep[row.body_b].constrained) head.writes_b |= 1u << i;
  }
}

void respond(ContactRow<Real>& row) {
  fill_responses(row);
  choose_softness(row);
  row.responds = true;
}

template <class Task>
void for_blocks(StepGroup& group, Task&& task) {
  std::vector<BlockHead>& heads = group.blocks.heads;
  parallel_for(group.jobs, static_cast<std::uint32_t>(heads.size()), tolerance::kBlockGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) task(heads[i]);
               });
}

}  // namespace

BlockKernel choose_block_kernel(int bits) {
  if (bits > 0 && bits < 128) return {};
  const int chosen = vector_bits(bits);
  return chosen == 512   ? block_kernel_512()
         : chosen == 256 ? block_kernel_256()
                         : block_kernel_128();
}

BlockKernel block_kernel_of(const WorldState& world) {
  const StepDiagnostics& looks = world.diagnostics;
  const bool alone = looks.ledger || world.settings.friction_cone != FrictionCone::Exact;
  return alone ? BlockKernel{} : choose_block_kernel(looks.kernel_bits);
}

void fill_blocks(WorldState& world, StepGroup& group) {
  ContactBlocks& blocks = group.blocks;
  blocks.kernel = block_kernel_of(world);
  Sorter(world, group).sort();
  parallel_for(group.jobs, static_cast<std::uint32_t>(blocks.loose.size()), tolerance::kRowGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) {
                   ContactRow<Real>& row = world.rows[blocks.loose[i]];
                   if (!row.responds) respond(row);
                 }
               });
  BlockPass pass;
  pass.heads = blocks.heads.data();
  pass.numbers = blocks.data();
  const std::size_t lanes = static_cast<std::size_t>(blocks.kernel.lanes);
  for_blocks(group, [&](BlockHead& head) { take_bodies(world, head); });
  for_blocks(group, [&](const BlockHead& head) {
    Real* const to = blocks.data() + head.numbers;
    const std::size_t count = reals_of(static_cast<int>(head.points));
    if (head.lanes != (1u << lanes) - 1u) std::memset(to, 0, count * lanes * sizeof(Real));
    const std::size_t in_tiles = count - count % kTile;
    const auto rest = [&](std::size_t i, const ContactRow<Real>& row, std::size_t begin) {
      const Real* const from = numbers_of(row);
      for (std::size_t k = begin; k < count; ++k) to[k * lanes + i] = from[k];
    };
    for_lanes(
        world.rows, head, lanes,
        [&](std::size_t first, ContactRow<Real>* const(&four)[kTile]) {
          turn_tiles(
              0, in_tiles, [&](std::size_t k, std::size_t i) { return numbers_of(*four[i]) + k; },
              [&](std::size_t k, std::size_t i) { return to + (k + i) * lanes + first; });
          for (std::size_t i = 0; i < kTile; ++i) rest(first + i, *four[i], in_tiles);
        },
        [&](std::size_t i, ContactRow<Real>& row) { rest(i, row, 0); });
    const auto place = static_cast<std::uint32_t>(&head - blocks.heads.data());
    blocks.kernel.prepare(pass, place, place + 1);
  });
}

void empty_blocks(WorldState& world, StepGroup& group) {
  ContactBlocks& blocks = group.blocks;
  const std::size_t lanes = static_cast<std::size_t>(blocks.kernel.lanes);
  for_blocks(group, [&](const BlockHead& head) {
    const Real* const from = blocks.data() + head.numbers;
    const std::size_t count = reals_of(static_cast<int>(head.points));
    const std::size_t in_tiles = count - (count - kHeadReals) % kTile;
    const auto rest = [&](std::size_t i, ContactRow<Real>& row, std::size_t begin) {
      Real* const to = numbers_of(row);
      for (std::size_t k = begin; k < count; ++k) to[k] = from[k * lanes + i];
      Real load = 0;
      for (int p = 0; p < row.count; ++p) load += row.points[p].impulse;
      row.at_rest = load > Real(0);
    };
    for_lanes(
        world.rows, head, lanes,
        [&](std::size_t first, ContactRow<Real>* const(&four)[kTile]) {
          turn_tiles(
              kHeadReals, in_tiles,
              [&](std::size_t k, std::size_t i) { return from + (k + i) * lanes + first; },
              [&](std::size_t k, std::size_t i) { return numbers_of(*four[i]) + k; });
          for (std::size_t i = 0; i < kTile; ++i) rest(first + i, *four[i], in_tiles);
        },
        [&](std::size_t i, ContactRow<Real>& row) { rest(i, row, kHeadReals); });
  });
}

}  // namespace plumb::inline PLUMB_ABI::detail
