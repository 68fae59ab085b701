// Invariant: a recording shows springs from end to end and waters at their level, from their making
// to their end, and a view in which the bodies are still seen where they went.
#include "drawn_rows.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using replay_test::kDt;
using replay_test::rows_of;
using replay_test::TemporaryFolder;

using Point = Eigen::Vector3d;

Point point_of(const PhysicsWorld& world, BodyId body, const Vec3& local) {
  const Pose X_WB = world.pose(body);
  return X_WB.position.template cast<double>() + (X_WB.orientation * local).template cast<double>();
}

// Steps the world while it is recorded; `act` is called before each step, `look` after it.
template <class Act, class Look>
void record(PhysicsWorld& world, const std::string& path, int steps, Act act, Look look) {
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = path}).ok());
  world.attach(&recorder);
  for (int step = 1; step <= steps; ++step) {
    act(step);
    ASSERT_TRUE(world.step(kDt).status.ok());
    look(step);
  }
  world.detach(&recorder);
  const auto closed = recorder.close();
  ASSERT_TRUE(closed.ok()) << closed.error;
}
const auto nothing = [](int) {};

// The ends of the lines of one step, of boxes whose length is their y axis.
std::vector<std::pair<Point, Point>> lines_at(const std::string& path, std::uint64_t step) {
  const auto centers = rows_of<float>(path, "world/springs", "Boxes3D:centers");
  const auto sizes = rows_of<float>(path, "world/springs", "Boxes3D:half_sizes");
  const auto turns = rows_of<float>(path, "world/springs", "Boxes3D:quaternions");
  std::vector<std::pair<Point, Point>> lines;
  if (!centers.contains(step)) return lines;
  for (std::size_t i = 0; i < centers.at(step).size() / 3; ++i) {
    const Eigen::Map<const Eigen::Vector3f> center(&centers.at(step)[3 * i]);
    const Eigen::Map<const Eigen::Quaternionf> turn(&turns.at(step)[4 * i]);
    const Eigen::Vector3f reach = turn * Eigen::Vector3f(0, sizes.at(step)[3 * i + 1], 0);
    lines.emplace_back((center - reach).cast<double>(), (center + reach).cast<double>());
  }
  return lines;
}

// A bungee from a turning box to the world is there from the begin and moves its hook before step
// 5; a spring to a second body comes before step 3, and goes with that body before step 8.
TEST(DrawnSprings, ReachFromEndToEndWhileTheyLast) {
  const TemporaryFolder folder;
  const std::string path = folder.file("springs.rrd");
  PhysicsWorld world;
  RigidBody turning = body_at(at(1, 3, 2));
  turning.angular_velocity = Vec3(1, 2, 3);
  const BodyId body = add(world, turning, with(sphere(0.25)));
  const BodyId other = add(world, body_at(at(4, 3, 2)), with(sphere(0.25)));
  Spring bungee;
  bungee.point = vec(0.1, 0.2, 0);
  bungee.other_point = Pos3(1, 6, 2);
  bungee.acts = Spring::Acts::WhenStretched;
  const EffectId first = must(world.create_effect({body, bungee, 0}));
  Spring moved = bungee;
  moved.other_point = Pos3(2, 7, 2);
  Spring between;
  between.point = vec(0, 0.25, 0);
  between.other = other;
  between.other_point = Pos3(0, 0, 0.25);
  std::map<int, std::vector<std::pair<Point, Point>>> expected;
  const auto look = [&](int step) {
    const Spring& held = step < 5 ? bungee : moved;
    expected[step].emplace_back(point_of(world, body, held.point),
                                held.other_point.template cast<double>());
    if (step >= 3 && step < 8)
      expected[step].emplace_back(
          point_of(world, body, between.point),
          point_of(world, other, between.other_point.template cast<Real>()));
  };
  const auto act = [&](int step) {
    if (step == 3) must(world.create_effect({body, between, 0}));
    if (step == 5) must(world.set_effect(first, {body, moved, 0}));
    if (step == 8) must(world.destroy_body(other));
  };
  record(
      world, path, 9, [&](int step) { act(step); }, look);
  for (const auto& [step, lines] : expected) {
    const auto drawn = lines_at(path, static_cast<std::uint64_t>(step));
    ASSERT_EQ(drawn.size(), lines.size()) << step;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_LT((drawn[i].first - lines[i].first).norm(), 2e-6) << step;
      EXPECT_LT((drawn[i].second - lines[i].second).norm(), 2e-6) << step;
    }
  }
}

// A lake is there from the begin, rises before step 4 and dries up before step 7.
TEST(DrawnWater, StandsAtItsLevelAndCoversTheScene) {
  const TemporaryFolder folder;
  const std::string path = folder.file("lake.rrd");
  PhysicsWorld world;
  const BodyId ball = add(world, body_at(at(3, 1, 2)), with(sphere(0.5), {}, 500));
  Buoyancy lake;
  lake.normal = vec(0, 2, 0);
  lake.level = real(0.75);
  const EffectId water = must(world.create_effect({{}, lake, 0}));
  const auto act = [&](int step) {
    if (step == 4) {
      lake.level = real(1.25);
      must(world.set_effect(water, {{}, lake, 0}));
    }
    if (step == 6) must(world.create_effect({ball, Drag{real(0.1)}, 0}));
    if (step == 7) must(world.destroy_effect(water));
  };
  record(world, path, 9, act, nothing);
  const auto corners = rows_of<float>(path, "world/water", "Mesh3D:vertex_positions");
  const auto triangles = rows_of<std::uint32_t>(path, "world/water", "Mesh3D:triangle_indices");
  ASSERT_EQ(corners.size(), 3u);  // only what changed
  ASSERT_TRUE(corners.contains(0) && corners.contains(4) && corners.contains(7));
  EXPECT_TRUE(corners.at(7).empty());
  for (const auto& [step, level] : {std::pair{0u, 0.75f}, std::pair{4u, 1.25f}}) {
    const std::vector<float>& numbers = corners.at(step);
    ASSERT_EQ(numbers.size(), 12u);
    EXPECT_EQ(triangles.at(step), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    float lowest[2] = {1e9f, 1e9f}, highest[2] = {-1e9f, -1e9f};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(numbers[3 * i + 1], level, 1e-6f);
      for (std::size_t k = 0; k < 2; ++k) {
        lowest[k] = std::min(lowest[k], numbers[3 * i + 2 * k]);
        highest[k] = std::max(highest[k], numbers[3 * i + 2 * k]);
      }
    }
    EXPECT_LT(lowest[0], 2.5f);
    EXPECT_GT(highest[0], 3.5f);
    EXPECT_LT(lowest[1], 1.5f);
    EXPECT_GT(highest[1], 2.5f);
  }
}

TEST(DrawnEffects, NoneLeaveNothing) {
  const TemporaryFolder folder;
  const std::string path = folder.file("none.rrd");
  PhysicsWorld world(no_gravity());
  const BodyId ball = add(world, body_at(at(0, 0, 0)), with(sphere(0.5)));
  must(world.create_effect({ball, Drag{real(0.1)}, 0}));
  record(world, path, 5, nothing, nothing);
  for (const char* entity : {"world/springs", "world/water", "world/middle"}) {
    int cells = 0;
    const auto read = rrd::read(path, entity, [&](const rrd::Cell&) { return ++cells > 0; });
    EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
    EXPECT_EQ(cells, 0) << entity;
  }
}

// A raft of four on a current of 10 m/s that ends 25 m away: the eye goes with its middle, and the
// water reaches as far as the raft.
TEST(DrawnView, GoesWithBodiesThatGoFarTogether) {
  const TemporaryFolder folder;
  const std::string path = folder.file("far.rrd");
  PhysicsWorld world(no_gravity());
  std::vector<BodyId> raft;
  for (const double x : {0.0, 2.0}) {
    for (const double z : {0.0, 2.0}) {
      RigidBody body = body_at(at(x, 0, z));
      body.linear_velocity = Vec3(10, 0, 0);
      raft.push_back(add(world, body, with(sphere(0.5))));
    }
  }
  must(world.create_effect({raft[0], Buoyancy{.level = real(-5)}, 0}));
  std::map<std::uint64_t, Point> middles;
  const auto look = [&](int step) {
    Point sum = Point::Zero();
    for (const BodyId body : raft) sum += point_of(world, body, Vec3::Zero());
    middles[static_cast<std::uint64_t>(step)] = sum / 4;
  };
  record(world, path, 150, nothing, look);
  const auto drawn = rows_of<float>(path, "world/middle", "Points3D:positions");
  ASSERT_EQ(drawn.size(), 151u);
  for (const auto& [step, middle] : middles) {
    ASSERT_EQ(drawn.at(step).size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(drawn.at(step)[k], middle[static_cast<Eigen::Index>(k)], 1e-5) << step;
  }
  const auto corners = rows_of<float>(path, "world/water", "Mesh3D:vertex_positions");
  ASSERT_EQ(corners.size(), 1u);
  float highest = 0;
  for (std::size_t i = 0; i < 4; ++i) highest = std::max(highest, corners.at(0)[3 * i]);
  EXPECT_GT(highest, 27);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
