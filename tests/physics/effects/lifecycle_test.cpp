// Proves that effects belong to the world like everything else: bad numbers are refused and change
// nothing, what is made can be changed and taken away, the same bits come for any number of
// threads, after restore and in replay, and an effect that never acts leaves no trace.
#include <gtest/gtest.h>

#include <limits>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
constexpr Real kInf = std::numeric_limits<Real>::infinity();

template <class Kind, class Change>
Effect bad(BodyId body, Kind kind, Change&& change) {
  change(kind);
  return {body, kind, 0};
}

TEST(EffectInput, BadNumbersAreRefusedAndChangeNothing) {
  PhysicsWorld world;
  const BodyId body = add(world, RigidBody{}, with(sphere(0.5)));
  const BodyId floor = add_floor(world);
  world.step(1.0 / 60);
  const Snapshot before = world.save();
  const std::uint64_t hash = world.state_hash();
  const Effect wrong[] = {
      bad(body, Buoyancy{}, [](auto& e) { e.density = Real(-1000); }),
      bad(body, Buoyancy{}, [](auto& e) { e.density = Real(0); }),
      bad(body, Buoyancy{}, [](auto& e) { e.normal = Vec3::Zero(); }),
      bad(body, Buoyancy{}, [](auto& e) { e.linear_drag = Real(-1); }),
      bad(body, Buoyancy{}, [](auto& e) { e.hull = SurfaceMesh{}; }),
      bad(body, Wind{}, [](auto& e) { e.velocity.x() = kNan; }),
      bad(body, Wind{}, [](auto& e) { e.density = kInf; }),
      bad(body, Spring{}, [](auto& e) { e.stiffness = Real(1e30); }),
      bad(body, Spring{}, [](auto& e) { e.stiffness = Real(0); }),
      bad(body, Spring{}, [](auto& e) { e.rest_length = Real(0); }),
      bad(body, Spring{}, [](auto& e) { e.rest_length = Real(-1); }),
      bad(body, Spring{}, [](auto& e) { e.damping = Real(-1); }),
      bad(body, Spring{}, [&](auto& e) { e.other = body; }),
      bad(body, Spring{},
          [](auto& e) {
            e.other = BodyId{77, 1};
          }),
      bad(body, Spring{}, [](auto& e) { e.acts = static_cast<Spring::Acts>(9); }),
      bad(body, Drag{}, [](auto& e) { e.linear = Real(-1); }),
      bad(body, Drag{}, [](auto& e) { e.quadratic = kNan; }),
      bad(body, Magnus{}, [](auto& e) { e.coefficient = kInf; }),
      bad(body, AeroSurface{}, [](auto& e) { e.control = Real(2); }),
      bad(body, AeroSurface{}, [](auto& e) { e.tensor(1, 2) = kNan; }),
      bad(body, AeroSurface{}, [](auto& e) { e.orientation = Quat(0, 0, 0, 0); }),
      bad(body, Thrust{}, [](auto& e) { e.force = Vec3::Constant(Real(1e20)); }),
      bad(body, Explosion{}, [](auto& e) { e.thickness = Real(0); }),
      bad(body, Explosion{}, [](auto& e) { e.impulse = Real(-1); }),
      bad(body, Explosion{}, [](auto& e) { e.falloff = Real(99); }),
      bad(body, Attractor{}, [](auto& e) { e.softening = Real(0); }),
      bad(body, Attractor{}, [](auto& e) { e.strength = Real(1e30); }),
      bad(body, PointGravity{}, [](auto& e) { e.mu = kInf; }),
      bad(body, PointGravity{}, [](auto& e) { e.softening = Real(-1); }),
      bad(body, ForceField{}, [](auto& e) { e.field = 12; }),  // nobody registered it
      bad(BodyId{}, Thrust{}, [](auto&) {}),
      bad(BodyId{}, Spring{}, [](auto&) {}),
      bad(BodyId{9, 9}, Drag{}, [](auto&) {}),
      bad(floor, Drag{}, [](auto&) {}),  // static
  };
  for (const Effect& effect : wrong) {
    const Created<EffectId> made = world.create_effect(effect);
    EXPECT_FALSE(made.ok()) << effect.kind.index();
    EXPECT_TRUE(made.id.is_null());
    EXPECT_STRNE(made.status.message, "");
  }
  EXPECT_EQ(world.effect_count(), 0u);
  EXPECT_TRUE(world.save() == before);
  EXPECT_EQ(world.state_hash(), hash);
  const EffectId good = must(world.create_effect({body, Drag{real(1)}, 0}));
  for (const Effect& effect : wrong) EXPECT_FALSE(world.set_effect(good, effect).ok());
  EXPECT_EQ(std::get<Drag>(world.effect(good).kind).linear, real(1));
}

TEST(EffectInput, HandlesGoStale) {
  PhysicsWorld world;
  const BodyId body = add(world, RigidBody{}, with(sphere(0.5)));
  const BodyId other = add(world, body_at(at(3, 0, 0)), with(sphere(0.5)));
  const EffectId drag = must(world.create_effect({body, Drag{real(1)}, 5}));
  Spring spring;
  spring.other = other;
  const EffectId tie = must(world.create_effect({body, spring, 0}));
  EXPECT_EQ(world.effects_of(other).size(), 1u);
  EXPECT_EQ(world.effect(drag).user_data, 5u);
  must(world.destroy_effect(drag));
  EXPECT_FALSE(world.is_valid(drag));
  EXPECT_FALSE(world.destroy_effect(drag).ok());
  must(world.destroy_body(other));
  EXPECT_FALSE(world.is_valid(tie));
  EXPECT_EQ(world.effect_count(), 0u);
  run(world, 0.1);
}

// Some of every kind, on bodies that fly, touch, hang on joints, float and sleep.
struct Busy {
  std::vector<BodyId> bodies;
  std::vector<EffectId> effects;
};
FieldForce swirl(const FieldSample& at, void*) {
  return {at.mass * Vector3d(-at.position.z(), 0, at.position.x()) * 0.1, Vector3d::Zero(), 0};
}
Busy build_busy(PhysicsWorld& world) {
  must(world.set_force_field(1, swirl));
  Busy out;
  add_slab(world, 20, 20);
  for (int i = 0; i < 24; ++i) {
    const Shape shape = i % 4 == 0   ? Shape(sphere(0.25))
                        : i % 4 == 1 ? Shape(cube(0.25))
                        : i % 4 == 2 ? Shape(capsule(0.2, 0.15))
                                     : Shape(cone(0.3, 0.2));
    out.bodies.push_back(add(world,
                             moving(at(0.9 * (i % 6) - 3, 0.4 + 0.7 * (i / 6), 0.9 * (i / 6) - 2),
                                    vec(0, 0, 0), vec(0.1 * i, 1, 0)),
                             with(shape, {}, 300 + 40 * i)));
  }
  Joint joint;
  joint.body_a = out.bodies[18];
  joint.body_b = out.bodies[19];
  joint.kind = BallJoint{};
  joint.frame_a.position = vec(0.45, 0, 0);
  joint.frame_b.position = vec(-0.45, 0, 0);
  must(world.create_joint(joint));
  const auto make = [&](BodyId body, const EffectKind& kind) {
    out.effects.push_back(must(world.create_effect({body, kind, 0})));
  };
  Buoyancy lake;
  lake.level = Real(0.8);
  make({}, lake);
  Wind wind;
  wind.velocity = vec(4, 0, 1);
  make({}, wind);
  make(out.bodies[20], Drag{real(10), real(5), real(0.1), real(0.2)});
  make(out.bodies[21], Magnus{real(0.5), Vec3::Zero()});
  make(out.bodies[22], Thrust{vec(0, 900, 0), vec(0.1, 0, 0)});
  AeroSurface fin;
  fin.tensor.diagonal() = vec(-1, -2, -3);
  fin.point = vec(0, 0.2, 0);
  make(out.bodies[18], fin);
  PointGravity pull;
  pull.mu = real(3);
  pull.softening = real(0.5);
  make(out.bodies[23], pull);
  Attractor attractor;
  attractor.strength = real(50);
  attractor.range = real(3);
  make({}, attractor);
  ForceField field;
  field.field = 1;
  make(out.bodies[17], field);
  for (int i = 0; i < 5; ++i) {
    Spring spring;
    spring.other = out.bodies[static_cast<std::size_t>(i + 7)];
    spring.stiffness = real(500);
    spring.damping = real(5);
    make(out.bodies[static_cast<std::size_t>(i + 6)], spring);
  }
  return out;
}
void disturb(PhysicsWorld& world, Busy& scene, int step) {
  if (step == 60) {
    Explosion blast;
    blast.center = pos(0, 0.2, 0);
    blast.impulse = real(500);
    blast.updraft = real(5);
    scene.effects.push_back(must(world.create_effect({{}, blast, 0})));
  }
  if (step == 90) {
    Buoyancy tide;
    tide.level = real(1.4);
    must(world.set_effect(scene.effects[0], {{}, tide, 0}));
  }
  if (step == 120) must(world.destroy_effect(scene.effects[1]));
  if (step == 130) must(world.destroy_body(scene.bodies[8]));
  if (step == 140) must(world.set_shape(world.colliders_of(scene.bodies[3])[0], sphere(0.4)));
}
constexpr int kSteps = 200;

std::vector<std::uint64_t> hashes(JobSystem* jobs) {
  PhysicsWorld world;
  world.set_job_system(jobs);
  Busy scene = build_busy(world);
  std::vector<std::uint64_t> out;
  for (int i = 0; i < kSteps; ++i) {
    disturb(world, scene, i);
    world.step(1.0 / 60);
    out.push_back(world.state_hash());
  }
  EXPECT_TRUE(all_finite(world));
  return out;
}

TEST(EffectState, SameBitsForAnyNumberOfThreads) {
  const auto serial = hashes(nullptr);
  for (const int threads : {2, 4}) {
    const auto pool = make_thread_pool(threads);
    EXPECT_EQ(hashes(pool.get()), serial) << threads;
  }
}

TEST(EffectState, RestoreGoesOnWithTheSameBits) {
  for (const int middle : {30, 65, 125}) {
    PhysicsWorld world;
    Busy scene = build_busy(world);
    for (int i = 0; i < middle; ++i) {
      disturb(world, scene, i);
      world.step(1.0 / 60);
    }
    PhysicsWorld other;
    must(other.set_force_field(1, swirl));
    must(other.restore(world.save()));
    EXPECT_TRUE(other.save() == world.save());
    Busy twin = scene;
    for (int i = middle; i < kSteps; ++i) {
      disturb(world, scene, i);
      disturb(other, twin, i);
      world.step(1.0 / 60);
      other.step(1.0 / 60);
      ASSERT_EQ(other.state_hash(), world.state_hash()) << middle << " " << i;
    }
    EXPECT_EQ(other.effect_report(scene.effects[0]).work,
              world.effect_report(scene.effects[0]).work);
  }
}

TEST(EffectState, RecordedInputsDoTheSameAgain) {
  PhysicsWorld world;
  InputRecorder recorder;
  world.attach(&recorder);
  Busy scene = build_busy(world);
  for (int i = 0; i < kSteps; ++i) {
    disturb(world, scene, i);
    world.step(1.0 / 60);
  }
  PhysicsWorld again;
  must(again.set_force_field(1, swirl));
  for (const InputRecorder::Frame& frame : recorder.frames) {
    for (const InputRecord& input : frame.inputs) must(again.apply_input(input));
    again.step(frame.dt);
    ASSERT_EQ(again.state_hash(), frame.hash);
  }
}

TEST(EffectState, DamagedSnapshotsAndRecordsAreRefused) {
  PhysicsWorld world;
  InputRecorder recorder;
  world.attach(&recorder);
  Busy scene = build_busy(world);
  world.step(1.0 / 60);
  const Snapshot good = world.save();
  for (const char* name : {"effect_numbers.value", "effect_free.slot", "effect.memory"}) {
    Snapshot damaged = good;
    std::erase_if(damaged.columns, [&](const SnapshotColumn& c) { return c.name == name; });
    EXPECT_FALSE(world.restore(damaged).ok()) << name;
  }
  Snapshot damaged = good;
  for (SnapshotColumn& c : damaged.columns)
    if (c.name == "effect_numbers.value") c.reals.back() = -5;
  EXPECT_FALSE(world.restore(damaged).ok());
  EXPECT_TRUE(world.save() == good);
  int tried = 0;
  for (const InputRecord& input : recorder.frames[0].inputs) {
    if (input.kind != InputKind::CreateEffect) continue;
    InputRecord shorter = input;
    shorter.numbers.pop_back();
    EXPECT_FALSE(world.apply_input(shorter).ok());
    ++tried;
  }
  EXPECT_GT(tried, 10);
  EXPECT_TRUE(world.save() == good);
}

// Z3: the same bits with no effect, with effects that reach nobody, and after effects were taken
// away.
TEST(EffectState, AnEffectThatNeverActsLeavesNoTrace) {
  const auto run_with = [](int which) {
    PhysicsWorld world;
    add_slab(world, 20, 20);
    for (int i = 0; i < 20; ++i)
      add(world, moving(at(0.3 * i, 1 + 0.5 * i, 0.1 * i), vec(1, 0, 0), vec(1, 2, 3)),
          with(i % 2 == 0 ? Shape(cube(0.2)) : Shape(sphere(0.2))));
    if (which == 1) {
      Buoyancy far_below;
      far_below.level = real(-100);
      must(world.create_effect({{}, far_below, 0}));
      must(world.create_effect({{}, Drag{}, 0}));
      Attractor far;
      far.center = pos(0, 0, 1000);
      far.strength = real(100);
      far.range = real(10);
      must(world.create_effect({{}, far, 0}));
      Explosion away;
      away.center = pos(1000, 0, 0);
      must(world.create_effect({{}, away, 0}));
    }
    if (which == 2) must(world.destroy_effect(must(world.create_effect({{}, Wind{}, 0}))));
    std::vector<std::uint64_t> motion;
    for (int i = 0; i < 200; ++i) {
      world.step(1.0 / 60);
      motion.push_back(world.motion_hash());
    }
    return motion;
  };
  const auto bare = run_with(0);
  EXPECT_EQ(run_with(1), bare);
  EXPECT_EQ(run_with(2), bare);
}

TEST(EffectState, IsRefusedInsideAStep) {
  struct Meddler : StepObserver {
    PhysicsWorld* world = nullptr;
    BodyId body;
    EffectId effect;
    int refused = 0;
    void on_step(const StepView&) override {
      refused += world->create_effect({body, Drag{}, 0}).status.code == StatusCode::InsideStep;
      refused += world->set_effect(effect, {body, Drag{}, 0}).code == StatusCode::InsideStep;
      refused += world->destroy_effect(effect).code == StatusCode::InsideStep;
      refused += world->set_force_field(1, nullptr).code == StatusCode::InsideStep;
    }
  } meddler;
  PhysicsWorld world;
  meddler.world = &world;
  meddler.body = add(world, RigidBody{}, with(sphere(0.5)));
  meddler.effect = must(world.create_effect({meddler.body, Drag{}, 0}));
  world.attach(&meddler);
  world.step(1.0 / 60);
  EXPECT_EQ(meddler.refused, 4);
}

TEST(EffectState, SleepsWithItsBodyAndWakesWhatASpringTies) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId crate = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId hand = add(world, body_at(at(0, 4, 0), MotionType::Kinematic), with(sphere(0.1)));
  Spring rope;
  rope.other = hand;
  rope.rest_length = real(3.5);
  rope.stiffness = real(2e5);
  rope.damping = real(2e3);
  rope.acts = Spring::Acts::WhenStretched;
  must(world.create_effect({crate, rope, 0}));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(crate));
  must(world.set_linear_velocity(hand, vec(0, 1, 0)));
  EXPECT_TRUE(world.is_awake(crate));
  run(world, 3);
  EXPECT_GT(position(world, crate).y(), 2.5);  // lifted
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
