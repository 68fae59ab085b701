#include "mesh/topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
      hash ^= static_cast<std::uint64_t>(c);
      hash *= 0x9E3779B97F4A7C15ull;  // 2^64 over the golden ratio: spreads low bits upwards
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

Cell bits_of(const Eigen::Vector3d& p) {
  Cell cell{};
  for (int i = 0; i < 3; ++i) {
    const double value = p[i] == 0 ? 0.0 : p[i];  // -0 and 0 are one place
    cell[static_cast<std::size_t>(i)] = std::bit_cast<std::int64_t>(value);
  }
  return cell;
}

// Number the roots of `same` in the order of their first member.
Places numbered(const std::vector<Eigen::Vector3d>& vertices, UnionFind& same) {
  Places places;
  places.place_of.resize(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const std::uint32_t root = same.find(v);
    if (root == v) {
      places.place_of[v] = static_cast<std::uint32_t>(places.positions.size());
      places.positions.push_back(vertices[v]);
    } else {
      places.place_of[v] = places.place_of[root];  // the root has the smallest number
    }
  }
  return places;
}

}  // namespace

Places gather_places(const std::vector<Eigen::Vector3d>& vertices, double tolerance) {
  UnionFind same(vertices.size());
  if (tolerance <= 0) {
    std::unordered_map<Cell, std::uint32_t, CellHash> first_at;
    first_at.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const auto [entry, fresh] = first_at.try_emplace(bits_of(vertices[v]), v);
      if (!fresh) same.join(entry->second, v);
    }
    return numbered(vertices, same);
  }

  // Cells as large as the tolerance: near vertices stand in the same or in touching cells.
  const auto cell_of = [&](const Eigen::Vector3d& p) {
    Cell cell{};
    for (int i = 0; i < 3; ++i) {
      // Beyond 2^62 cells the numbers would overflow; such vertices only meet their equals anyway.
      const double scaled = std::clamp(std::floor(p[i] / tolerance), -0x1p62, 0x1p62);
      cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(scaled);
    }
    return cell;
  };
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Cell home = cell_of(vertices[v]);
    for (std::int64_t k = 0; k < 27; ++k) {
      const Cell cell{home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1};
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      for (const std::uint32_t other : found->second) {
        if ((vertices[v] - vertices[other]).norm() <= tolerance) same.join(other, v);
      }
    }
    cells[home].push_back(v);
  }
  return numbered(vertices, same);
}

std::vector<EdgeUse> sorted_edge_uses(const std::vector<Triangle>& faces) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (std::uint8_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = faces[f][corner], to = faces[f][(corner + 1u) % 3u];
      if (from == to) continue;
      uses.push_back({std::min(from, to), std::max(from, to), f, corner, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.face, a.corner) < std::tie(b.low, b.high, b.face, b.corner);
  });
  return uses;
}

UnionFind::UnionFind(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

std::uint32_t UnionFind::find(std::uint32_t item) {
  while (parent_[item] != item) {
    parent_[item] = parent_[parent_[item]];
    item = parent_[item];
  }
  return item;
}

void UnionFind::join(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  if (a != b) parent_[std::max(a, b)] = std::min(a, b);
}

Flips consistent_flips(std::size_t face_count, const std::vector<EdgeUse>& uses) {
  struct Neighbour {
    std::uint32_t face;
    bool disagrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(face_count);
  for_each_edge(uses, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const EdgeUse &a = uses[begin], &b = uses[begin + 1];
    if (a.face == b.face) return;
    const bool disagrees = a.forward == b.forward;
    neighbours[a.face].push_back({b.face, disagrees});
    neighbours[b.face].push_back({a.face, disagrees});
  });

  constexpr std::uint32_t kUnseen = ~0u;
  Flips flips;
  flips.flip.assign(face_count, false);
  flips.patch_of.assign(face_count, kUnseen);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < face_count; ++seed) {
    if (flips.patch_of[seed] != kUnseen) continue;
    const auto patch = static_cast<std::uint32_t>(flips.patches++);
    flips.patch_of[seed] = patch;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t face = stack.back();
      stack.pop_back();
      for (const Neighbour& next : neighbours[face]) {
        const bool wanted = flips.flip[face] != next.disagrees;
        if (flips.patch_of[next.face] == kUnseen) {
          flips.patch_of[next.face] = patch;
          flips.flip[next.face] = wanted;
          stack.push_back(next.face);
        } else if (flips.flip[next.face] != wanted) {
          flips.orientable = false;
        }
      }
    }
  }
  return flips;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
