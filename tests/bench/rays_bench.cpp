// A million rays through ten thousand bodies: nearest hit, one at a time and as a batch, against
// Bullet and Box3D where PLUMB_PEERS is on. The same boxes, the same rays; each counts its hits.
#include <benchmark/benchmark.h>

#include <vector>

#include "support/build.h"
#include "support/random.h"
#ifdef PLUMB_HAS_BULLET
#include <btBulletCollisionCommon.h>

#include <memory>
#endif
#ifdef PLUMB_HAS_BOX3D
#include <box3d/box3d.h>
#endif

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr int kBodies = 10000;
constexpr int kRays = 1000000;
constexpr double kSpan = 100;  // [m] half edge of the cube in which bodies and rays lie

struct Placing {
  Eigen::Vector3d position, half;
  Quat turn;
};
std::vector<Placing> placings() {
  Random random(1);
  std::vector<Placing> all(kBodies);
  for (Placing& p : all) {
    p.position = kSpan * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1),
                                         random.uniform(-1, 1));
    p.half =
        Eigen::Vector3d(random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2));
    p.turn = random.rotation(3);
  }
  return all;
}
std::vector<Ray> rays() {
  Random random(2);
  std::vector<Ray> all(kRays);
  for (Ray& ray : all) {
    ray.origin =
        pos(Eigen::Vector3d(kSpan * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1),
                                                    random.uniform(-1, 1))));
    ray.translation = vec(Eigen::Vector3d(random.uniform(1, kSpan) * random.direction()));
  }
  return all;
}

const PhysicsWorld& scene() {
  static const PhysicsWorld world = [] {
    PhysicsWorld made;
    int i = 0;
    for (const Placing& p : placings())
      add(made,
          body_at(at(p.position, p.turn), i++ % 2 == 0 ? MotionType::Static : MotionType::Dynamic),
          with(box(p.half.x(), p.half.y(), p.half.z())));
    return made;
  }();
  return world;
}

void rays_one_by_one(benchmark::State& state) {
  const std::vector<Ray> all = rays();
  std::int64_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : all) hits += scene().cast_ray(ray.origin, ray.translation).has_value();
  }
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * kRays);
}
BENCHMARK(rays_one_by_one)->Unit(benchmark::kMillisecond);

void rays_blocked(benchmark::State& state) {
  const std::vector<Ray> all = rays();
  std::int64_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : all) hits += scene().ray_is_blocked(ray.origin, ray.translation);
  }
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * kRays);
}
BENCHMARK(rays_blocked)->Unit(benchmark::kMillisecond);

void rays_batch(benchmark::State& state) {
  const std::vector<Ray> all = rays();
  std::vector<RayHitResult> found(all.size());
  const auto pool = make_thread_pool(static_cast<int>(state.range(0)));
  for (auto _ : state)
    if (!scene().cast_rays(all, found, {}, pool.get()).ok()) state.SkipWithError("refused");
  std::int64_t hits = 0;
  for (const RayHitResult& hit : found) hits += hit.collider.is_null() ? 0 : 1;
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * kRays);
}
BENCHMARK(rays_batch)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

#ifdef PLUMB_HAS_BULLET
btVector3 bullet(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

struct BulletScene {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  std::vector<std::unique_ptr<btBoxShape>> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> objects;

  BulletScene() {
    for (const Placing& p : placings()) {
      shapes.push_back(std::make_unique<btBoxShape>(bullet(p.half)));
      shapes.back()->setMargin(0);
      objects.push_back(std::make_unique<btCollisionObject>());
      objects.back()->setCollisionShape(shapes.back().get());
      const Eigen::Quaterniond q = p.turn.cast<double>();
      objects.back()->setWorldTransform(
          btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                   static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                      bullet(p.position)));
      world.addCollisionObject(objects.back().get());
    }
    world.updateAabbs();
    broadphase.optimize();
  }
  ~BulletScene() {
    for (const auto& object : objects) world.removeCollisionObject(object.get());
  }
};

void rays_bullet(benchmark::State& state) {
  BulletScene scene_of_boxes;
  const std::vector<Ray> all = rays();
  std::int64_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : all) {
      const btVector3 from = bullet(ray.origin.cast<double>()),
                      to = from + bullet(ray.translation.cast<double>());
      btCollisionWorld::ClosestRayResultCallback callback(from, to);
      // Exact to rounding, as ours is; and boxes that hold the origin are not passed by.
      scene_of_boxes.world.rayTest(from, to, callback);
      hits += callback.hasHit() ? 1 : 0;
    }
  }
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * kRays);
}
BENCHMARK(rays_bullet)->Unit(benchmark::kMillisecond);
#endif

#ifdef PLUMB_HAS_BOX3D
b3Vec3 box3d(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// Compiled for this processor, in float. A box that holds the origin is passed by.
void rays_box3d(benchmark::State& state) {
  b3WorldDef definition = b3DefaultWorldDef();
  const b3WorldId world = b3CreateWorld(&definition);
  int i = 0;
  for (const Placing& p : placings()) {
    b3BodyDef body = b3DefaultBodyDef();
    body.type = i++ % 2 == 0 ? b3_staticBody : b3_dynamicBody;
    const Eigen::Quaterniond q = p.turn.cast<double>();
    body.position = box3d(p.position);
    body.rotation = {box3d(Eigen::Vector3d(q.vec())), static_cast<float>(q.w())};
    b3ShapeDef shape = b3DefaultShapeDef();
    const b3Vec3 h = box3d(p.half);
    const b3BoxHull hull = b3MakeBoxHull(h.x, h.y, h.z);
    b3CreateHullShape(b3CreateBody(world, &body), &shape, &hull.base);
  }
  b3World_RebuildStaticTree(world);
  const std::vector<Ray> all = rays();
  std::int64_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : all)
      hits += b3World_CastRayClosest(world, box3d(ray.origin.cast<double>()),
                                     box3d(ray.translation.cast<double>()), b3DefaultQueryFilter())
                  .hit;
  }
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * kRays);
  b3DestroyWorld(world);
}
BENCHMARK(rays_box3d)->Unit(benchmark::kMillisecond);
#endif

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
