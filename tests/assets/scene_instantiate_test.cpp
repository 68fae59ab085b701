// Invariant: a scene becomes exactly the world it describes, or an error and an untouched world.
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"
#include "plumb/job_system.h"
#include "scene/repeat.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;

const std::string kScenes = std::string(PLUMB_SOURCE_DIR) + "/assets/scenes/";

TEST(SceneInstantiate, BuildsWhatIsWritten) {
  const auto scene = parse_scene(R"({
    "plumb_scene": 1,
    "settings": { "gravity": [0, -1.5, 0], "substeps": 7 },
    "materials": { "ice": { "friction": 0.25, "restitution": 0.5 } },
    "bodies": [{
      "name": "crate", "position": [1, 2, 3], "orientation": { "euler_degrees": [90, 0, 90] },
      "linear_velocity": [4, 5, 6], "angular_velocity": [7, 8, 9], "gravity_scale": 0.5,
      "locks": ["linear_z", "angular_y"],
      "colliders": [{ "shape": "box", "half_extents": [1, 2, 4], "material": "ice", "density": 2,
                      "layers": [3], "collides_with": [0, 31] }]
    }]
  })",
                                 "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();

  EXPECT_EQ(world.settings().gravity, Vec3(0, Real(-1.5), 0));
  EXPECT_EQ(world.settings().substeps, 7);
  const BodyId id = instance->find("crate");
  ASSERT_TRUE(world.is_valid(id));
  EXPECT_EQ(instance->find("grate"), BodyId{});
  const RigidBody body = world.body(id);
  EXPECT_EQ(body.pose.position, Pos3(1, 2, 3));
  // The locked axes have no velocity.
  EXPECT_EQ(body.linear_velocity, Vec3(4, 5, 0));
  EXPECT_EQ(body.angular_velocity, Vec3(7, 0, 9));
  EXPECT_EQ(body.gravity_scale, Real(0.5));
  EXPECT_TRUE(body.locks.linear_z && body.locks.angular_y);
  EXPECT_FALSE(body.locks.linear_x || body.locks.linear_y || body.locks.angular_x ||
               body.locks.angular_z);
  // A quarter turn about the fixed x axis, then one about z, takes y to z, where it stays, and x to
  // y. Tolerance: a few roundings of the number type.
  const Real rounding = 8 * std::numeric_limits<Real>::epsilon();
  EXPECT_LT((body.pose.orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), rounding);
  EXPECT_LT((body.pose.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), rounding);

  ASSERT_EQ(world.colliders_of(id).size(), 1u);
  const Collider collider = world.collider(world.colliders_of(id)[0]);
  EXPECT_EQ(std::get<Box>(collider.shape).half_extents, Vec3(1, 2, 4));
  EXPECT_EQ(collider.material.friction, Real(0.25));
  EXPECT_EQ(collider.material.restitution, Real(0.5));
  EXPECT_EQ(collider.filter.layers, 8u);
  EXPECT_EQ(collider.filter.collides_with, 0x80000001u);
  // 2 x 4 x 8 m^3 of 2 kg/m^3, exact in any number type.
  EXPECT_EQ(world.mass_properties(id).mass, 128);
}

// The mass of a mesh body is that of the mesh and not that of the hull it collides as, and a
// density or a mass in the scene scales it.
TEST(SceneInstantiate, MeshBodiesWeighWhatTheMeshWeighs) {
  const auto scene = parse_scene(R"({
    "plumb_scene": 1,
    "meshes": { "torus": { "file": "../models/torus.stl", "collision": "hull", "density": 1000 } },
    "bodies": [
      { "name": "plain", "colliders": [{ "shape": "mesh", "mesh": "torus" }] },
      { "name": "dense", "position": [5, 0, 0],
        "colliders": [{ "shape": "mesh", "mesh": "torus", "density": 3000 }] },
      { "name": "given", "position": [9, 0, 0], "mass": 7,
        "colliders": [{ "shape": "mesh", "mesh": "torus" }] },
      { "name": "pair", "position": [15, 0, 0],
        "colliders": [{ "shape": "mesh", "mesh": "torus", "position": [-1, 0, 0] },
                      { "shape": "mesh", "mesh": "torus", "position": [1, 0, 0] }] }
    ]
  })",
                                 "test.json", kScenes);
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();

  const MassProperties plain = world.mass_properties(instance->find("plain"));
  // Volume of the polyhedron from the model's own description; the coordinates came through floats.
  EXPECT_NEAR(plain.mass, 57.33721793872322, 57.3 * 1e-6);
  const double rounding = 1e-6;  // relative: inertia may pass through floats
  const MassProperties dense = world.mass_properties(instance->find("dense"));
  EXPECT_NEAR(dense.mass / plain.mass, 3, 3 * rounding);
  EXPECT_LT((dense.I_Bcm_B / 3 - plain.I_Bcm_B).norm(), rounding * plain.I_Bcm_B.norm());
  const MassProperties given = world.mass_properties(instance->find("given"));
  EXPECT_NEAR(given.mass, 7, 7 * rounding);
  EXPECT_LT((given.I_Bcm_B * (plain.mass / 7) - plain.I_Bcm_B).norm(),
            rounding * plain.I_Bcm_B.norm());
  // Two of them 1 m off the centre: twice the inertia about x, plus 2 m (1 m)^2 about y and z.
  const MassProperties pair = world.mass_properties(instance->find("pair"));
  Eigen::Matrix3d expected = 2 * plain.I_Bcm_B;
  expected(1, 1) += 2 * plain.mass;
  expected(2, 2) += 2 * plain.mass;
  EXPECT_LT((pair.I_Bcm_B - expected).norm(), rounding * expected.norm());

  ASSERT_EQ(instance->meshes.size(), 1u);
  EXPECT_EQ(instance->bodies[3].visuals.size(), 2u);
  // The hole of the torus is filled by its hull, and the instance says so.
  EXPECT_GT(instance->meshes[0].hull_excess, 0.2);
  ASSERT_EQ(instance->notes.size(), 1u);
  EXPECT_NE(instance->notes[0].find("'torus'"), std::string::npos);
}

// Where nothing brings a mass, the world makes a point of 1 kg: the scene's author is told.
TEST(SceneInstantiate, TellsOfCollidersThatBringNoMass) {
  const auto scene = parse_scene(R"({
    "plumb_scene": 1,
    "bodies": [
      { "name": "hollow", "colliders": [{ "shape": "sphere", "radius": 1, "density": 0 }] },
      { "name": "seeing", "colliders": [{ "shape": "sphere", "radius": 1, "sensor": true }] },
      { "name": "still", "type": "static",
        "colliders": [{ "shape": "sphere", "radius": 1, "density": 0 }] },
      { "name": "partly", "colliders": [{ "shape": "sphere", "radius": 1, "density": 0 },
                                        { "shape": "sphere", "radius": 1 }] },
      { "name": "given", "mass": { "mass": 2, "inertia": [1, 1, 1] },
        "colliders": [{ "shape": "sphere", "radius": 1, "density": 0 }] },
      { "name": "point" }
    ]
  })",
                                 "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  ASSERT_EQ(instance->notes.size(), 2u);
  EXPECT_NE(instance->notes[0].find("'hollow'"), std::string::npos) << instance->notes[0];
  EXPECT_NE(instance->notes[1].find("'seeing'"), std::string::npos) << instance->notes[1];
  EXPECT_EQ(world.mass_properties(instance->find("hollow")).mass, 1);  // as the note says
}

TEST(SceneInstantiate, LeavesTheWorldAloneOnAnError) {
  PhysicsWorld world;
  const auto kept = world.create_body(RigidBody{});
  const WorldSettings before = world.settings();
  const auto scene = parse_scene(R"({
    "plumb_scene": 1, "settings": { "substeps": 9 },
    "meshes": {
      "none": { "file": "nothing.obj", "collision": "hull" } },
    "bodies": [{ "name": "first", "colliders": [{ "shape": "sphere", "radius": 1 }] },
               { "name": "second", "colliders": [{ "shape": "mesh", "mesh": "none" }] }]
  })",
                                 "test.json", kScenes);
  ASSERT_TRUE(scene.ok()) << scene.error();
  const auto instance = instantiate(*scene, world);
  ASSERT_FALSE(instance.ok());
  EXPECT_EQ(instance.error().rfind("test.json:4: mesh 'none': ", 0), 0u) << instance.error();
  EXPECT_EQ(world.body_count(), 1u);
  EXPECT_TRUE(world.is_valid(kept.id));
  EXPECT_EQ(world.settings().substeps, before.substeps);
}

// A program reads meshes apart from itself: what takes too long there is an error that names the
// mesh, and what is read is what is read in the same process.
TEST(SceneInstantiate, ReadsMeshesInAnotherProcessIfAsked) {
  const auto scene = assets::load_scene(kScenes + "hollow.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld here, apart, late;
  ASSERT_TRUE(instantiate(*scene, here).ok());
  ASSERT_TRUE(instantiate(*scene, apart, {.guarded = true}).ok());
  EXPECT_EQ(here.state_hash(), apart.state_hash());
  EXPECT_GT(here.body_count(), 0u);
  const auto refused = instantiate(*scene, late, {.guarded = true, .time_limit = 1e-9});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().find("did not finish within"), std::string::npos) << refused.error();
  EXPECT_NE(refused.error().find("mesh '"), std::string::npos) << refused.error();
  EXPECT_EQ(late.body_count(), 0u);
}

TEST(SceneRepeat, StandsOnTheGridWithinTheJitter) {
  assets::SceneRepeat repeat;
  repeat.count = {3, 2, 4};
  repeat.spacing = {2, 3, 5};
  repeat.jitter = {0.25, 0, 0.5};
  repeat.random_orientation = true;
  const auto places = assets::scene::places_of(repeat);
  ASSERT_EQ(places.size(), 24u);
  std::set<double> x_of_copies;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Eigen::Vector3d grid(static_cast<double>(n % 3) * 2, static_cast<double>(n / 3 % 2) * 3,
                               static_cast<double>(n / 6) * 5);
    const Eigen::Vector3d off = places[n].offset - grid;
    EXPECT_LE(std::abs(off.x()), 0.25);
    EXPECT_EQ(off.y(), 0);
    EXPECT_LE(std::abs(off.z()), 0.5);
    EXPECT_NEAR(places[n].turn.norm(), 1, 1e-15);  // one rounding or two
    x_of_copies.insert(off.x());
  }
  EXPECT_EQ(x_of_copies.size(), 24u);

  const auto again = assets::scene::places_of(repeat);
  EXPECT_EQ(again[23].offset, places[23].offset);
  repeat.seed = 2;
  EXPECT_NE(assets::scene::places_of(repeat)[23].offset, places[23].offset);
}

// The mean of many uniform rotations of any direction is zero: 4 standard deviations of 1/sqrt(3
// n).
TEST(SceneRepeat, TurnsUniformly) {
  assets::SceneRepeat repeat;
  repeat.count = {10000, 1, 1};
  repeat.random_orientation = true;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& place : assets::scene::places_of(repeat))
    mean += place.turn * Eigen::Vector3d::UnitX();
  mean /= 10000;
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4 / std::sqrt(3 * 10000.0));
}

class DefaultScene : public testing::Test {
 protected:
  void SetUp() override {
    auto loaded = assets::load_scene(kScenes + "default.json");
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    scene_ = std::move(loaded).value();
  }
  // Hash after every tenth step of the first `steps`.
  std::vector<std::uint64_t> run(int threads, int steps) {
    const auto jobs = threads > 1 ? make_thread_pool(threads) : nullptr;
    PhysicsWorld world;
    const auto instance = instantiate(scene_, world);
    EXPECT_TRUE(instance.ok()) << instance.error();
    world.set_job_system(jobs.get());
    std::vector<std::uint64_t> hashes;
    for (int k = 1; k <= steps; ++k) {
      EXPECT_TRUE(world.step(scene_.step.dt).status.ok());
      if (k % 10 == 0) hashes.push_back(world.state_hash());
    }
    return hashes;
  }
  assets::Scene scene_;
};

TEST_F(DefaultScene, HasTheSizeItPromises) {
  std::set<std::string> files, used;
  for (const assets::SceneMesh& mesh : scene_.meshes) files.insert(mesh.file);
  PhysicsWorld world;
  const auto instance = instantiate(scene_, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  EXPECT_EQ(world.body_count(), scene_.body_count());
  std::size_t moving_meshes = 0;
  for (const assets::SceneInstanceBody& body : instance->bodies) {
    if (world.state(body.id).type != MotionType::Dynamic) continue;
    moving_meshes += body.visuals.empty() ? 0 : 1;
    for (const auto& visual : body.visuals) used.insert(instance->meshes[visual.mesh].name);
  }
  EXPECT_GE(moving_meshes, 200u);
  EXPECT_GE(files.size(), 6u);
  EXPECT_EQ(used.size(), scene_.meshes.size());
  EXPECT_EQ(scene_.step.count(), 600u);
}

// Long enough for all bodies to have met ramps, pegs and each other.
constexpr int kSteps = 150;

TEST_F(DefaultScene, IsBitIdenticalFromRunToRunAndForAnyNumberOfThreads) {
  const auto first = run(1, kSteps);
  EXPECT_EQ(run(1, kSteps), first);
  EXPECT_EQ(run(2, kSteps), first);
}

}  // namespace
