// Invariant: what a scene does not use takes no memory. The heap is asked for the same bytes
// whether a feature never existed, existed in another world, or existed in this one and was taken
// away; its store is made by its first use, once, and ends with the world.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "allocation/world_features.h"
#include "counted_new.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using features::Feature;

constexpr double kDt = 1.0 / 60;  // [s]

struct Asked {
  long calls = 0;
  long long bytes = 0;
  friend bool operator==(const Asked&, const Asked&) = default;
};
void PrintTo(const Asked& a, std::ostream* out) {
  *out << a.calls << " calls, " << a.bytes << " bytes";
}

template <class Work>
Asked asked_by(Work&& work) {
  test::begin_counting();
  work();
  const long calls = test::end_counting();
  return {calls, test::counted_bytes()};
}

void steps(PhysicsWorld& world, int count) {
  for (int i = 0; i < count; ++i) world.step(kDt);
}

// A box at rest on a floor and one that touches nothing, before anything else comes.
struct Pair {
  std::unique_ptr<PhysicsWorld> world = std::make_unique<PhysicsWorld>(no_sleep());
  BodyId a, b;
  Pair() {
    add_floor(*world, material(0.5));
    a = add(*world, body_at(at(-60, 0.5, 0)), with(cube(0.5), material(0.5)));
    RigidBody hovering = body_at(at(-60, 0.5 + features::kApart, 0));
    hovering.gravity_scale = 0;
    b = add(*world, hovering, with(cube(0.5), material(0.5)));
    steps(*world, 2);
  }
};

// A scene that has none of the features, built and stepped.
void add_scene(PhysicsWorld& world) {
  for (int i = 0; i < 100; ++i)
    add(world, body_at(at(1.1 * (i % 5), 0.5 + 1.1 * (i / 25), 1.1 * (i / 5 % 5))),
        with(i % 2 == 0 ? Shape(cube(0.5)) : Shape(sphere(0.5)), material(0.5)));
  steps(world, 30);
}
Asked asked_by_scene(Pair& pair) {
  return asked_by([&] { add_scene(*pair.world); });
}
Asked asked_by_new_world() {
  return asked_by([] {
    Pair pair;
    add_scene(*pair.world);
  });
}

class UnusedFeature : public testing::TestWithParam<Feature> {
 protected:
  static void SetUpTestSuite() { (void)asked_by_new_world(); }  // what is made once a program
};

TEST_P(UnusedFeature, InAnotherWorldTakesNothingFromThisOne) {
  const Asked never = asked_by_new_world();
  {
    Pair other;
    const features::End end = GetParam().begin(*other.world, other.a, other.b);
    steps(*other.world, 10);
    EXPECT_EQ(asked_by_new_world(), never) << "while it is in use elsewhere";
    end(*other.world);
  }
  EXPECT_EQ(asked_by_new_world(), never);
}

TEST_P(UnusedFeature, MadeAndTakenAwayLeavesWhatFollowsAsItIs) {
  Pair with_none, with_past;
  GetParam().begin(*with_past.world, with_past.a, with_past.b)(*with_past.world);
  steps(*with_none.world, 1);
  steps(*with_past.world, 1);
  EXPECT_EQ(asked_by_scene(with_past), asked_by_scene(with_none));
}

class UsedFeature : public testing::TestWithParam<Feature> {};

// What the function itself has on the heap: a copy of it takes as much.
long long bytes_of(const features::End& end) {
  const long long before = test::live_bytes();
  const features::End copy = end;
  return test::live_bytes() - before;
}

// What was in use keeps some memory for the next use: it is told, it does not grow, and what comes
// later asks for no more than without it.
TEST_P(UsedFeature, KeepsNoMoreAfterManyUsesThanAfterOne) {
  Pair with_none, with_past;
  const long long before = test::live_bytes();
  steps(*with_none.world, 120);
  const long long plain = test::live_bytes() - before;
  long long in_use = 0, kept = 0;
  for (int use = 0; use < 6; ++use) {
    const long long start = test::live_bytes();
    features::End end = GetParam().begin(*with_past.world, with_past.a, with_past.b);
    steps(*with_past.world, 10);
    if (use == 0) in_use = test::live_bytes() - start - plain - bytes_of(end);
    end(*with_past.world);
    end = nullptr;
    steps(*with_past.world, 10);
    if (use == 0) kept = test::live_bytes() - start - plain;
    if (use > 1) {
      EXPECT_EQ(test::live_bytes(), start) << "use " << use;
    }
  }
  std::printf("%-24s %8lld bytes in use, %8lld kept\n", GetParam().name.c_str(), in_use, kept);
  const Asked past = asked_by_scene(with_past), none = asked_by_scene(with_none);
  EXPECT_LE(past.bytes, none.bytes);
  EXPECT_LE(past.calls, none.calls);
}

// All that a world asked for it gives back. A thread keeps scratch of its own (what joints close
// by), so a first world goes ahead.
TEST_P(UsedFeature, EndsWithItsWorld) {
  const auto live_and_end = [] {
    const long long before = test::live_bytes();
    Pair pair;
    const features::End end = GetParam().begin(*pair.world, pair.a, pair.b);
    steps(*pair.world, 10);
    EXPECT_GT(test::live_bytes(), before);
  };
  live_and_end();
  const long long before = test::live_bytes();
  live_and_end();
  EXPECT_EQ(test::live_bytes(), before);
}

std::string word(const testing::TestParamInfo<Feature>& info) {
  std::string out;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) out += c;
  return out;
}
INSTANTIATE_TEST_SUITE_P(All, UnusedFeature, testing::ValuesIn(features::all()), word);

INSTANTIATE_TEST_SUITE_P(All, UsedFeature, testing::ValuesIn(features::all()), word);
// What parts a contact changes by how much its lists will grow next time.
INSTANTIATE_TEST_SUITE_P(Parting, UsedFeature,
                         testing::Values(features::sensor("sensor at a contact", true)), word);

// The stores of effects and joints are made by their first use, not before.
TEST(Store, IsMadeByTheFirstUse) {
  std::vector<Feature> stored = features::effects();
  for (const Feature& joint : features::joints()) stored.push_back(joint);
  for (const Feature& feature : stored) {
    Pair pair;
    const auto used_by = [&] {
      const long long before = test::live_bytes();
      features::End end = feature.begin(*pair.world, pair.a, pair.b);
      const long long used = test::live_bytes() - before - bytes_of(end);
      end(*pair.world);
      steps(*pair.world, 1);
      return used;
    };
    EXPECT_GT(used_by(), 0) << feature.name;
    (void)used_by();  // the lists of what is free have room now
    EXPECT_EQ(used_by(), 0) << feature.name;
  }
}

// Diagnostics are no part of the scene: switched off they leave nothing behind.
TEST(Diagnostics, GiveBackWhatTheyTook) {
  StepDiagnostics both;
  both.ledger = true;
  both.error_every = 1;
  Pair pair;
  steps(*pair.world, 120);
  const long long before = test::live_bytes();
  pair.world->set_diagnostics(both);
  steps(*pair.world, 10);
  EXPECT_GT(test::live_bytes(), before);
  pair.world->set_diagnostics({});
  EXPECT_EQ(test::live_bytes(), before);
}

TEST(Events, CostNothingToRead) {
  Pair pair;
  add_scene(*pair.world);
  std::size_t seen = 0;
  const Asked asked = asked_by([&] {
    const Events events = pair.world->events();
    seen = events.contacts.size() + events.hits.size() + events.sensors.size();
    seen += pair.world->overlaps_of(pair.world->colliders_of(pair.a)[0]).size();
  });
  EXPECT_EQ(asked, (Asked{0, 0})) << seen;
}

// The counts themselves see a body more: its bytes, and nothing else.
TEST(Bytes, AreThoseOfTheBodies) {
  const auto of = [](int bodies) {
    const long long before = test::live_bytes();
    PhysicsWorld world(no_gravity());
    for (int i = 0; i < bodies; ++i) add(world, body_at(at(3.0 * i, 0, 0)), with(cube(0.5)));
    steps(world, 3);
    return test::live_bytes() - before;
  };
  const long long few = of(1024), many = of(2048);
  EXPECT_GT(many, few);
  std::printf("%.0f bytes a body\n", static_cast<double>(many - few) / 1024);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
