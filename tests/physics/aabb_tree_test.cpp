// The tree must answer like a list. Whatever was inserted, moved and removed, in any order:
//   - querying every leaf's box gives exactly the pairs that comparing all boxes gives, none twice
//   - a ray visits exactly the boxes that it meets when each is tested on its own
//   - parents contain their children, siblings differ in height by at most 2, no node is lost
#include "collision/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <thread>
#include <utility>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
constexpr PosReal kNoEnd = PosReal(1e30);  // [m] what the engine gives half-spaces

WorldAabb cube_at(PosVec centre, PosReal half) {
  return {{centre.x - half, centre.y - half, centre.z - half},
          {centre.x + half, centre.y + half, centre.z + half}};
}
WorldAabb on_line(PosReal x, PosReal radius = 1) { return cube_at({x, 0, 0}, radius); }

// A tree beside the plain list that it has to agree with. Items count up and are never used twice.
struct Scene {
  struct Entry {
    std::int32_t proxy;
    WorldAabb box;
  };
  AabbTree tree;
  std::map<std::uint32_t, Entry> entries;
  std::uint32_t next_item = 0;

  std::uint32_t add(const WorldAabb& box) {
    entries[next_item] = {tree.insert(box, next_item), box};
    return next_item++;
  }
  void remove(std::uint32_t item) {
    tree.remove(entries.at(item).proxy);
    entries.erase(item);
  }
  void move(std::uint32_t item, const WorldAabb& box) {
    tree.move(entries.at(item).proxy, box);
    entries.at(item).box = box;
  }
  std::uint32_t pick(std::mt19937& random) const {
    auto at = entries.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(random() % entries.size()));
    return at->first;
  }
};

std::set<Pair> pairs_by_list(const Scene& scene) {
  std::set<Pair> pairs;
  for (auto a = scene.entries.begin(); a != scene.entries.end(); ++a) {
    for (auto b = std::next(a); b != scene.entries.end(); ++b) {
      const WorldAabb &p = a->second.box, &q = b->second.box;
      const bool apart = p.upper.x < q.lower.x || q.upper.x < p.lower.x || p.upper.y < q.lower.y ||
                         q.upper.y < p.lower.y || p.upper.z < q.lower.z || q.upper.z < p.lower.z;
      if (!apart) pairs.insert({a->first, b->first});
    }
  }
  return pairs;
}

// Each unordered pair is seen once from either side and each leaf once by itself, or this fails.
std::set<Pair> pairs_by_tree(const Scene& scene) {
  std::set<Pair> seen, pairs;
  for (const auto& [item, entry] : scene.entries) {
    EXPECT_EQ(scene.tree.item(entry.proxy), item);
    const std::uint32_t self = item;
    scene.tree.query(entry.box, [&](std::uint32_t other) {
      EXPECT_TRUE(seen.insert({self, other}).second)
          << "pair " << self << ", " << other << " twice";
      if (self < other) pairs.insert({self, other});
    });
    EXPECT_TRUE(seen.contains({item, item})) << "leaf " << item << " does not find itself";
  }
  EXPECT_EQ(seen.size(), 2 * pairs.size() + scene.entries.size());
  return pairs;
}

// Fewest leaves that a tree of this height can have when siblings differ by at most 2.
std::size_t fewest_leaves(int height) {
  std::vector<std::size_t> n{1, 2, 3};
  for (int h = 3; h <= height; ++h) n.push_back(n[n.size() - 1] + n[n.size() - 3]);
  return height < 0 ? 0 : n[static_cast<std::size_t>(height)];
}

void expect_sound(const Scene& scene) {
  ASSERT_TRUE(scene.tree.is_consistent());
  ASSERT_EQ(scene.tree.leaf_count(), scene.entries.size());
  ASSERT_GE(scene.entries.size(), fewest_leaves(scene.tree.height()));
}
void expect_agrees(const Scene& scene) {
  expect_sound(scene);
  EXPECT_EQ(pairs_by_tree(scene), pairs_by_list(scene));
}

// The trees of classic engines whose pair search misses or repeats pairs: whatever the order of
// insertion, exactly the pairs named come out.
struct KnownScene {
  std::vector<std::pair<PosReal, PosReal>> spheres;  // place on a line and radius [m]
  std::set<Pair> pairs;                              // by place in the list
};
const std::vector<KnownScene> kKnownScenes = {
    {{{0, 1}, {1, 1}, {100, 1}, {101, 1}}, {{0, 1}, {2, 3}}},
    {{{0, 1}, {1, 1}, {100, 1}}, {{0, 1}}},
    {{{0, 1}, {1, 1}, {12, 1}, {12.5, 1}, {13, 1}}, {{0, 1}, {2, 3}, {2, 4}, {3, 4}}},
    {{{0, 1}, {1, 1}, {PosReal(0.5), PosReal(1.4)}, {PosReal(1.2), PosReal(1.6)}},
     {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}},
};

TEST(AabbTree, FindsTheKnownPairsInEveryOrderOfInsertion) {
  for (const KnownScene& known : kKnownScenes) {
    std::vector<std::uint32_t> order(known.spheres.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    do {
      Scene scene;
      std::set<Pair> expected;
      for (const std::uint32_t k : order) {
        scene.add(on_line(known.spheres[k].first, known.spheres[k].second));
      }
      for (const Pair& pair : known.pairs) {
        const auto place = [&](std::uint32_t k) {
          return static_cast<std::uint32_t>(std::find(order.begin(), order.end(), k) -
                                            order.begin());
        };
        expected.insert(std::minmax(place(pair.first), place(pair.second)));
      }
      EXPECT_EQ(pairs_by_tree(scene), expected);
      expect_agrees(scene);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(AabbTree, FindsTheKnownPairsAfterEveryRemoval) {
  for (const KnownScene& known : kKnownScenes) {
    for (std::uint32_t gone = 0; gone < known.spheres.size(); ++gone) {
      Scene scene;
      for (const auto& [x, radius] : known.spheres) scene.add(on_line(x, radius));
      scene.remove(gone);
      expect_agrees(scene);
    }
  }
}

TEST(AabbTree, TheOnlyLeafCanMoveAndGo) {
  Scene scene;
  EXPECT_EQ(scene.tree.height(), -1);
  expect_agrees(scene);
  const std::uint32_t only = scene.add(on_line(0));
  EXPECT_EQ(scene.tree.height(), 0);
  scene.move(only, on_line(50));
  expect_agrees(scene);
  EXPECT_EQ(scene.tree.box(scene.entries.at(only).proxy).lower.x, PosReal(49));
  scene.remove(only);
  expect_agrees(scene);
  scene.add(on_line(3));
  expect_agrees(scene);
  scene.tree.clear();
  scene.entries.clear();
  expect_agrees(scene);
}

TEST(AabbTree, TouchingBoxesArePairs) {
  Scene scene;
  scene.add(on_line(0));
  scene.add(on_line(2));  // face on face at x = 1
  scene.add(on_line(PosReal(4.5)));
  EXPECT_EQ(pairs_by_tree(scene), (std::set<Pair>{{0, 1}}));
}

// Random boxes of sizes from 1e-2 to 30 m; `shift` puts the world far from the origin.
WorldAabb random_box(std::mt19937& random, PosReal shift) {
  std::uniform_real_distribution<PosReal> place(-50, 50), exponent(-2, PosReal(1.5));
  const PosVec centre{shift + place(random), place(random) - shift, place(random)};
  const PosVec half{std::pow(PosReal(10), exponent(random)),
                    std::pow(PosReal(10), exponent(random)),
                    std::pow(PosReal(10), exponent(random))};
  return {centre - half, centre + half};
}

class AabbTreeRandom : public ::testing::TestWithParam<PosReal> {};

TEST_P(AabbTreeRandom, StaysSoundThroughThousandsOfChanges) {
  std::mt19937 random(7);
  Scene scene;
  std::uniform_real_distribution<PosReal> step(-2, 2);
  for (int i = 0; i < 6000; ++i) {
    // Grows to about 250 leaves, shrinks to none, and grows again.
    const unsigned add_share = (i / 1500) % 2 == 0 ? 45u : 15u;
    const unsigned choice = static_cast<unsigned>(random() % 100);
    if (scene.entries.empty() || choice < add_share) {
      const bool copy = !scene.entries.empty() && random() % 10 == 0;
      scene.add(copy ? scene.entries.at(scene.pick(random)).box : random_box(random, GetParam()));
    } else if (choice < 60) {
      scene.remove(scene.pick(random));
    } else if (choice < 90) {  // a small step: mostly within the parent's box
      const std::uint32_t item = scene.pick(random);
      const PosVec by{step(random), step(random), step(random)};
      const WorldAabb& box = scene.entries.at(item).box;
      scene.move(item, {box.lower + by, box.upper + by});
    } else {
      scene.move(scene.pick(random), random_box(random, GetParam()));
    }
    expect_sound(scene);
    if (HasFatalFailure()) return;
    if (i % 100 == 0) expect_agrees(scene);
  }
  expect_agrees(scene);
}
INSTANTIATE_TEST_SUITE_P(NearAndFar, AabbTreeRandom,
                         ::testing::Values(PosReal(0), PosReal(1e4), PosReal(1e7)));

TEST(AabbTree, IdenticalBoxesArePairedOnceEach) {
  Scene scene;
  for (int i = 0; i < 200; ++i) scene.add(on_line(5));
  expect_agrees(scene);
  EXPECT_EQ(pairs_by_tree(scene).size(), 200u * 199u / 2u);
  for (std::uint32_t item = 0; item < 200; item += 2) scene.remove(item);
  expect_agrees(scene);
}

TEST(AabbTree, PointsOnALineWithoutAnyAreaAreFound) {
  Scene scene;
  for (int i = 0; i < 300; ++i) scene.add(on_line(static_cast<PosReal>((i * 37) % 100), 0));
  expect_agrees(scene);
}

TEST(AabbTree, BoxesWithoutEndPairWithEverythingTheyReach) {
  std::mt19937 random(3);
  Scene scene;
  for (int i = 0; i < 300; ++i) {
    if (i % 30 == 0) {  // half-spaces below a height, and slabs without end sideways
      const PosReal top = static_cast<PosReal>(i) / 10;
      scene.add({{-kNoEnd, i % 60 == 0 ? -kNoEnd : top - 1, -kNoEnd}, {kNoEnd, top, kNoEnd}});
    }
    scene.add(random_box(random, 0));
    expect_sound(scene);
  }
  expect_agrees(scene);
  for (int i = 0; i < 100; ++i) scene.move(scene.pick(random), random_box(random, 0));
  expect_agrees(scene);
}

// Boxes without end must not spoil the tree for the others: a small query opens few nodes. Counted
// as the leaves met, and as the height.
TEST(AabbTree, BoxesWithoutEndKeepTheTreeShallow) {
  Scene scene;
  for (int i = 0; i < 64; ++i) scene.add({{-kNoEnd, -kNoEnd, -kNoEnd}, {kNoEnd, 0, kNoEnd}});
  for (int i = 0; i < 1000; ++i) scene.add(cube_at({PosReal(3 * i), 5, 0}, 1));
  expect_sound(scene);
  std::size_t met = 0;
  scene.tree.query(cube_at({300, 5, 0}, PosReal(0.5)), [&](std::uint32_t) { ++met; });
  EXPECT_EQ(met, 1u);
  EXPECT_LE(scene.tree.height(), 20);  // 1.82 log2(1064) = 18.3 is the bound of the balance
}

TEST(AabbTree, SortedInsertionKeepsTheTreeShallow) {
  Scene scene;
  for (int i = 0; i < 10000; ++i) scene.add(on_line(PosReal(2.5) * static_cast<PosReal>(i)));
  expect_sound(scene);
  EXPECT_LE(scene.tree.height(), 26);  // 2 log2(10000) = 26.6
  EXPECT_TRUE(pairs_by_tree(scene).empty());
  for (std::uint32_t item = 0; item < 9990; ++item) scene.remove(item);  // and sorted removal
  expect_agrees(scene);
}

// --- Rays ---------------------------------------------------------------------------------------

// Slab test in wide arithmetic, one box on its own; `grow` moves the faces outwards [m].
bool meets(PosVec origin, PosVec direction, PosReal max_fraction, const WorldAabb& box,
           long double grow, long double& entry) {
  long double t0 = 0, t1 = max_fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const long double o = component(origin, axis), d = component(direction, axis);
    const long double lower = component(box.lower, axis) - grow,
                      upper = component(box.upper, axis) + grow;
    if (d == 0) {
      if (o < lower || o > upper) return false;
      continue;
    }
    t0 = std::max(t0, std::min((lower - o) / d, (upper - o) / d));
    t1 = std::min(t1, std::max((lower - o) / d, (upper - o) / d));
  }
  entry = t0;
  return t0 <= t1;
}

class AabbTreeRay : public ::testing::TestWithParam<PosReal> {};

TEST_P(AabbTreeRay, VisitsExactlyTheBoxesItMeets) {
  std::mt19937 random(11);
  Scene scene;
  for (int i = 0; i < 400; ++i) scene.add(random_box(random, GetParam()));
  scene.add({{-kNoEnd, -kNoEnd, -kNoEnd}, {kNoEnd, -GetParam() - 40, kNoEnd}});
  std::uniform_real_distribution<PosReal> place(-60, 60);
  // A box that the exact test misses by less than the rounding of places may be visited too.
  const long double blur =
      8 * std::numeric_limits<PosReal>::epsilon() * (std::abs(GetParam()) + 200);
  std::size_t met = 0;
  for (int i = 0; i < 500; ++i) {
    const PosVec origin{GetParam() + place(random), place(random) - GetParam(), place(random)};
    PosVec direction{place(random), place(random), place(random)};
    if (i % 5 == 0) direction.x = 0;
    if (i % 10 == 0) direction.z = 0;
    const PosReal reach = i % 3 == 0 ? PosReal(0.5) : PosReal(10);
    std::set<std::uint32_t> visited;
    scene.tree.cast_ray(origin, direction, reach, [&](std::uint32_t item, PosReal max_fraction) {
      EXPECT_TRUE(visited.insert(item).second);
      EXPECT_EQ(max_fraction, reach);
      return max_fraction;
    });
    for (const auto& [item, entry] : scene.entries) {
      long double t;
      const bool hit = meets(origin, direction, reach, entry.box, 0, t);
      met += hit ? 1u : 0u;
      const bool hit_nearly = hit || meets(origin, direction, reach, entry.box, blur, t);
      EXPECT_TRUE(!hit || visited.contains(item)) << "missed " << item;
      EXPECT_TRUE(hit_nearly || !visited.contains(item)) << "should not visit " << item;
    }
  }
  EXPECT_GT(met, 500u);  // one a ray: the scene is not empty where they pass
}
INSTANTIATE_TEST_SUITE_P(NearAndFar, AabbTreeRay,
                         ::testing::Values(PosReal(0), PosReal(1e4), PosReal(1e7)));

TEST(AabbTree, RayAlongFacesEdgesAndCornersMissesNoBox) {
  Scene scene;
  for (int i = 0; i < 50; ++i) {
    scene.add(cube_at({PosReal(2) * static_cast<PosReal>(i), PosReal(i % 3), PosReal(i % 5)}, 1));
  }
  for (int i = 0; i < 3 * 50; ++i) {
    const WorldAabb& box = scene.entries.at(static_cast<std::uint32_t>(i / 3)).box;
    const PosVec corner = i % 2 == 0 ? box.lower : box.upper;
    const PosVec from{PosReal(-7.3), i % 3 == 1 ? corner.y : PosReal(-9.1),
                      i % 3 == 2 ? corner.z : PosReal(4.7)};
    std::set<std::uint32_t> visited;
    scene.tree.cast_ray(from, corner - from, 2, [&](std::uint32_t item, PosReal max_fraction) {
      visited.insert(item);
      return max_fraction;
    });
    EXPECT_TRUE(visited.contains(static_cast<std::uint32_t>(i / 3)));
  }
}

TEST(AabbTree, RayThatShrinksFindsTheNearestBox) {
  std::mt19937 random(5);
  Scene scene;
  for (int i = 0; i < 300; ++i) scene.add(random_box(random, 0));
  std::uniform_real_distribution<PosReal> place(-60, 60);
  for (int i = 0; i < 300; ++i) {
    const PosVec origin{place(random) * 3, place(random) * 3, place(random) * 3};
    const PosVec direction = PosVec{place(random), place(random), place(random)} - origin;
    long double nearest = 2;
    for (const auto& [item, entry] : scene.entries) {
      long double t;
      if (meets(origin, direction, 1, entry.box, 0, t)) nearest = std::min(nearest, t);
    }
    PosReal found = 2;
    scene.tree.cast_ray(origin, direction, 1, [&](std::uint32_t item, PosReal max_fraction) {
      long double t;
      if (!meets(origin, direction, 1, scene.entries.at(item).box, 0, t)) return max_fraction;
      found = std::min(found, static_cast<PosReal>(t));
      return found;
    });
    EXPECT_EQ(found, static_cast<PosReal>(nearest));
  }
}

TEST(AabbTree, RayMeetsARowOfBoxesInOrderAndStopsWhenTold) {
  Scene scene;
  for (int i = 0; i < 200; ++i) scene.add(on_line(static_cast<PosReal>(3 * ((i * 71) % 200))));
  std::vector<PosReal> places;
  scene.tree.cast_ray({-10, 0, 0}, {1, 0, 0}, 1000, [&](std::uint32_t item, PosReal max_fraction) {
    places.push_back(scene.entries.at(item).box.lower.x);
    return max_fraction;
  });
  EXPECT_EQ(places.size(), 200u);
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  int visits = 0;
  scene.tree.cast_ray({-10, 0, 0}, {1, 0, 0}, 1000, [&](std::uint32_t, PosReal) {
    return ++visits == 3 ? PosReal(0) : PosReal(1000);
  });
  EXPECT_EQ(visits, 3);
}

// --- Use ----------------------------------------------------------------------------------------

TEST(AabbTree, TheSameCallsGiveTheSameOrderOfVisits) {
  const auto visits = [] {
    std::mt19937 random(23);
    Scene scene;
    for (int i = 0; i < 400; ++i) scene.add(random_box(random, 0));
    for (int i = 0; i < 400; ++i) scene.move(scene.pick(random), random_box(random, 0));
    for (int i = 0; i < 100; ++i) scene.remove(scene.pick(random));
    std::vector<std::uint32_t> order;
    scene.tree.query(cube_at({0, 0, 0}, 100), [&](std::uint32_t item) { order.push_back(item); });
    return order;
  };
  const std::vector<std::uint32_t> first = visits();
  EXPECT_EQ(first.size(), 300u);
  EXPECT_EQ(first, visits());
}

TEST(AabbTree, QueriesRunInSeveralThreadsAtOnce) {
  std::mt19937 random(29);
  Scene scene;
  for (int i = 0; i < 500; ++i) scene.add(random_box(random, 0));
  const auto count_all = [&scene] {
    std::size_t count = 0;
    for (const auto& [item, entry] : scene.entries) {
      scene.tree.query(entry.box, [&](std::uint32_t) { ++count; });
    }
    return count;
  };
  const std::size_t expected = count_all();
  std::vector<std::size_t> counts(4);
  std::vector<std::thread> threads;
  for (std::size_t& count : counts) threads.emplace_back([&] { count = count_all(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(counts, std::vector<std::size_t>(4, expected));
}

TEST(AabbTree, StackGrowsBeyondItsInlinePart) {
  TraversalStack<int> stack;
  for (int i = 0; i < 1000; ++i) stack.push(i);
  for (int i = 999; i >= 0; --i) ASSERT_EQ(stack.pop(), i);
  EXPECT_TRUE(stack.empty());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI::detail
