#include "solver/contact_blocks.h"

#include <algorithm>
#include <cstring>

#include "math/vector_bits.h"
#include "math/wide.h"
#include "solver/row_responses.h"
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

// Bounces look at all rows of the bodies that may bounce, and change them.
StepList<std::uint8_t> bodies_that_bounce(WorldState& world) {
  StepList<std::uint8_t> bounces(&world.memory);
  if (world.bouncing_rows.empty()) return bounces;
  bounces.assign(world.bodies.awake_end, 0);
  for (const std::uint32_t k : world.bouncing_rows) {
    const ContactRow<Real>& row = world.rows[k];
    if (world.substep[row.body_a].constrained) bounces[row.body_a] = 1;
    if (world.substep[row.body_b].constrained) bounces[row.body_b] = 1;
  }
  return bounces;
}

bool fits_block(const WorldState& world, const StepList<std::uint8_t>& bounces,
                const ContactRow<Real>& row) {
  if (!bounces.empty() && (bounces[row.body_a] | bounces[row.body_b]) != 0) return false;
  if (row.watched || row.spun || row.restitution > Real(0)) return false;
  if (world.counts.driven > 0 && world.pairs[world.contacts[row.contact].pair].driven) return false;
  return true;
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
  explicit Sorter(WorldState& world)
      : world_(world), blocks_(world.blocks), bounces_(bodies_that_bounce(world)) {}

  void sort() {
    blocks_.heads.clear();
    blocks_.loose.clear();
    blocks_.colors.clear();
    reals_ = 0;
    for (const ColorRange color : world_.colors) sort_color(color);
    blocks_.numbers.resize((reals_ * sizeof(Real) + sizeof(ContactBlocks::Line) - 1) /
                           sizeof(ContactBlocks::Line));
  }

 private:
  void sort_color(ColorRange color) {
    ContactBlocks::Color& sorted = blocks_.colors.emplace_back();
    sorted.heads.begin = heads();
    sorted.loose.begin = loose();
    if (world_.deep_overlap) sort_rows(color, true);
    sorted.deep_heads = heads();
    sorted.deep_loose = loose();
    sort_rows(color, false);
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

  void sort_rows(ColorRange color, bool deep) {
    for (std::uint32_t i = color.begin; i < color.end; ++i) {
      ContactRow<Real>& row = world_.rows[i];
      if (is_deep(row) != deep) continue;
      if (blocks_.kernel.lanes > 1 && fits_block(world_, bounces_, row)) {
        blocks_.by_points[row.count - 1].push_back(i);
      } else {
        blocks_.loose.push_back(i);
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
    for (std::size_t i = 0; i < count; ++i) {
      ContactRow<Real>& row = world_.rows[rows[i]];
      row.in_block = true;
      head.row[i] = rows[i];
      head.body_a[i] = row.body_a;
      head.body_b[i] = row.body_b;
      head.lanes |= 1u << i;
      if (world_.substep[row.body_a].constrained) head.writes_a |= 1u << i;
      if (world_.substep[row.body_b].constrained) head.writes_b |= 1u << i;
    }
  }

  WorldState& world_;
  ContactBlocks& blocks_;
  StepList<std::uint8_t> bounces_;  // per dense body; empty where nothing bounces
  std::size_t reals_ = 0;
};

void respond(ContactRow<Real>& row) {
  fill_responses(row);
  choose_softness(row);
  row.responds = true;
}

template <class Task>
void for_blocks(WorldState& world, Task&& task) {
  parallel_for(world, static_cast<std::uint32_t>(world.blocks.heads.size()), tolerance::kBlockGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) task(world.blocks.heads[i]);
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

void fill_blocks(WorldState& world) {
  const StepDiagnostics& looks = world.diagnostics;
  const bool alone = looks.ledger || world.settings.friction_cone != FrictionCone::Exact;
  world.blocks.kernel = alone ? BlockKernel{} : choose_block_kernel(looks.kernel_bits);
  Sorter(world).sort();
  ContactBlocks& blocks = world.blocks;
  parallel_for(world, static_cast<std::uint32_t>(blocks.loose.size()), tolerance::kRowGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) {
                   ContactRow<Real>& row = world.rows[blocks.loose[i]];
                   if (!row.responds) respond(row);
                 }
               });
  BlockPass pass;
  pass.heads = blocks.heads.data();
  pass.numbers = blocks.data();
  const std::size_t lanes = static_cast<std::size_t>(world.blocks.kernel.lanes);
  for_blocks(world, [&](const BlockHead& head) {
    Real* const to = world.blocks.data() + head.numbers;
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

void empty_blocks(WorldState& world) {
  const std::size_t lanes = static_cast<std::size_t>(world.blocks.kernel.lanes);
  for_blocks(world, [&](const BlockHead& head) {
    const Real* const from = world.blocks.data() + head.numbers;
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
