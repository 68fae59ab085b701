// Invariant: each of the book's eleven demos does what it is about.
#include <cmath>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using Eigen::Vector3d;

constexpr double kG = 9.81;

struct Demo {
  explicit Demo(const std::string& name) {
    auto read =
        assets::load_scene(std::string(PLUMB_SOURCE_DIR) + "/integration/demos/" + name + ".json");
    if (!read.ok()) throw std::runtime_error(read.error());
    scene = std::move(read).value();
    auto made = assets::instantiate(scene, world);
    if (!made.ok()) throw std::runtime_error(made.error());
    instance = std::move(made).value();
  }
  [[nodiscard]] BodyId body(const std::string& name) const { return instance.find(name); }
  [[nodiscard]] Vector3d at(const std::string& name) const {
    return world.center_of_mass(body(name)).cast<double>();
  }
  [[nodiscard]] Vector3d speed(const std::string& name) const {
    return world.linear_velocity(body(name)).cast<double>();
  }
  [[nodiscard]] Vector3d axis(const std::string& name, const Vector3d& of) const {
    return world.pose(body(name)).orientation.cast<double>() * of;
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / scene.step.dt)); ++i)
      world.step(scene.step.dt);
  }
  assets::Scene scene;
  PhysicsWorld world;
  assets::SceneInstance instance;
};

// Without air the shots are parabolas; the shuttlecock reaches its terminal speed.
TEST(Demos, Ballistic) {
  Demo demo("ballistic");
  demo.run(0.5);
  EXPECT_NEAR(demo.at("pistol").x(), 17.5, 1e-3);
  EXPECT_NEAR(demo.at("pistol").y(), 1.5 - 0.5 * kG * 0.25, 1e-3);
  demo.run(2.5);
  EXPECT_NEAR(demo.at("cannon").x(), 3 * 40 / std::sqrt(2.0), 2e-2);
  EXPECT_NEAR(demo.at("cannon").y(), 0.2 + 3 * 40 / std::sqrt(2.0) - 4.5 * kG, 2e-2);
  EXPECT_NEAR(demo.at("fireball").y(), 1.5 + 0.06 * 4.5 * kG, 1e-2);
  EXPECT_NEAR(demo.speed("shuttlecock").y(), -6.7, 0.1);
  EXPECT_LT(demo.speed("shuttlecock").x(), 1);
}

// The charge drives the stars apart evenly, the air resists in proportion to their speed: their
// mean moves as one star alone would, y = (v + g T) T (1 - e^(-t/T)) - g T t, T = m/c = 1 s.
TEST(Demos, Fireworks) {
  Demo demo("fireworks");
  const auto mean = [&] {
    Vector3d sum = Vector3d::Zero();
    for (const auto& body : demo.instance.bodies)
      sum += demo.world.center_of_mass(body.id).cast<double>();
    return Vector3d(sum / static_cast<double>(demo.instance.bodies.size()));
  };
  const Vector3d start = mean();
  demo.run(0.5);
  double nearest = 1e9;
  for (const auto& body : demo.instance.bodies)
    nearest =
        std::min(nearest, (demo.world.center_of_mass(body.id).cast<double>() - mean()).norm());
  EXPECT_GT(nearest, 1);
  EXPECT_NEAR(mean().y(), start.y() + (10 + kG) * (1 - std::exp(-0.5)) - kG * 0.5, 1);
  EXPECT_LT(std::hypot(mean().x() - start.x(), mean().z() - start.z()), 1);
  EXPECT_EQ(demo.world.last_report().quarantined, 0u);
}

// The bridge holds its load within 10 cm.
TEST(Demos, Bridge) {
  Demo demo("bridge");
  demo.run(10);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(demo.at("plank " + std::to_string(i)).y(), 3, 0.1) << i;
  EXPECT_NEAR(demo.at("crate").y(), 3.45, 0.1);
  EXPECT_LT(demo.speed("crate").norm(), 0.05);
}

// Rods keep their length, cables never get longer, and the heavy mass hangs lowest.
TEST(Demos, Platform) {
  Demo demo("platform");
  for (int i = 0; i < 600; ++i) {
    demo.world.step(demo.scene.step.dt);
    for (const auto& joint : demo.instance.joints)
      ASSERT_LT(std::abs(static_cast<double>(demo.world.joint_state(joint.id).linear_error)), 0.01)
          << joint.name << " " << i;
  }
  EXPECT_LT(demo.speed("mass e").norm(), 0.2);
  EXPECT_LE(demo.at("mass e").y(), demo.at("mass a").y() + 0.02);
}

// The blob lands, keeps together, and comes to rest above the floor.
TEST(Demos, Blob) {
  Demo demo("blob");
  demo.run(10);
  const Vector3d head = demo.at("head");
  for (int i = 0; i < 10; ++i) {
    const Vector3d drop = demo.at("drop " + std::to_string(i));
    EXPECT_LT((drop - head).norm(), 1.5) << i;
    EXPECT_GT(drop.y(), 0.15);
  }
  EXPECT_LT(demo.world.energy().kinetic_linear, 1);
}

// Momentum goes into the wall: it falls, the ball slows, nothing passes the floor.
TEST(Demos, Bigballistic) {
  Demo demo("bigballistic");
  demo.run(3);
  EXPECT_LT(demo.speed("ball").x(), 15);
  int moved = 0;
  for (const auto& body : demo.instance.bodies) {
    const Vector3d p = demo.world.center_of_mass(body.id).cast<double>();
    if (body.name != "floor") {
      EXPECT_GT(p.y(), 0) << body.name;
    }
    if (body.name.rfind("crate", 0) == 0 && p.x() > 10.5) ++moved;
  }
  EXPECT_GE(moved, 3);
}

// The impulse falls with the square of the distance: by it the crates slide.
TEST(Demos, Explosion) {
  Demo demo("explosion");
  demo.run(0.1);  // all fronts have passed, friction has hardly begun
  const auto out = [&](int i) { return demo.speed("crate " + std::to_string(i)).norm(); };
  for (int ring = 0; ring < 3; ++ring)
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(out(4 * ring + i), out(4 * ring), 0.15 * out(4 * ring));
  // 20000/9 N s/m^2 on 1 m^2 of 400 kg, less what friction takes in 0.09 s.
  EXPECT_NEAR(out(0), 20000 / 9.0 / 400, 0.7);
  EXPECT_NEAR(out(4), 20000 / 36.0 / 400, 0.7);
  EXPECT_GT(out(0), 2.5 * out(4));
  demo.run(1);
  EXPECT_GT(demo.at("sheet").y(), 1.6);
}

// The aeroplane trims: from a start that is too slow it settles on level flight at 50 m/s; the
// elevator's control raises and lowers the nose.
TEST(Demos, Flightsim) {
  Demo demo("flightsim");
  demo.run(120);
  EXPECT_NEAR(demo.speed("plane").x(), 50, 3);
  EXPECT_NEAR(demo.speed("plane").y(), 0, 1.5);
  EXPECT_NEAR(demo.axis("plane", Vector3d::UnitY()).y(), 1, 0.01);
  EXPECT_LT(demo.world.angular_velocity(demo.body("plane")).norm(), 0.02);
  const EffectId elevator = demo.instance.find_effect("elevator");
  Effect pulled = demo.world.effect(elevator);
  std::get<AeroSurface>(pulled.kind).control = Real(-0.5);  // the tail down
  ASSERT_TRUE(demo.world.set_effect(elevator, pulled).ok());
  const double before = demo.speed("plane").y();
  demo.run(3);
  EXPECT_GT(demo.axis("plane", Vector3d::UnitX()).y(), 0.01);
  EXPECT_GT(demo.speed("plane").y(), before + 0.5);
}

// The boat floats at the draught that Archimedes gives, heels with the wind to lee, sails forward,
// and comes upright when the wind drops.
TEST(Demos, Sailboat) {
  Demo demo("sailboat");
  const EffectId sail = demo.instance.find_effect("sail");
  const Effect set = demo.world.effect(sail);
  Effect calm = set;
  std::get<AeroSurface>(calm.kind).wind = Vec3::Zero();
  ASSERT_TRUE(demo.world.set_effect(sail, calm).ok());
  demo.run(20);
  EXPECT_NEAR(demo.at("boat").y(), 0.4 - 0.8 * 0.2, 2e-3);
  ASSERT_TRUE(demo.world.set_effect(sail, set).ok());
  demo.run(20);
  const Vector3d up = demo.axis("boat", Vector3d::UnitY());
  const double heel = std::atan2(up.z(), up.y()) * 180 / M_PI;
  EXPECT_GT(heel, 1);
  EXPECT_LT(heel, 30);
  EXPECT_GT(demo.speed("boat").dot(demo.axis("boat", Vector3d::UnitX())), 0.2);
  ASSERT_TRUE(demo.world.set_effect(sail, calm).ok());
  demo.run(30);
  EXPECT_GT(demo.axis("boat", Vector3d::UnitY()).y(), std::cos(0.02));
}

// The block breaks; its pieces are together what it was, and take the ball's momentum.
TEST(Demos, Fracture) {
  Demo demo("fracture");
  double mass = 0;
  Vector3d center = Vector3d::Zero();
  for (const auto& body : demo.instance.bodies) {
    if (body.name.rfind("piece", 0) != 0) continue;
    const double m = demo.world.mass_properties(body.id).mass;
    mass += m;
    center += m * demo.world.center_of_mass(body.id).cast<double>();
  }
  center /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const auto& body : demo.instance.bodies) {
    if (body.name.rfind("piece", 0) != 0) continue;
    const MassProperties p = demo.world.mass_properties(body.id);
    const Vector3d r = demo.world.center_of_mass(body.id).cast<double>() - center;
    inertia +=
        p.I_Bcm_B + p.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const MassProperties whole = inertia_of::box(2000 * 1.2 * 1.2 * 1.2, Vector3d(0.6, 0.6, 0.6));
  EXPECT_NEAR(mass, whole.mass, 1e-3 * whole.mass);
  EXPECT_NEAR(inertia.trace(), whole.I_Bcm_B.trace(), 1e-3 * whole.I_Bcm_B.trace());
  const std::size_t bonds = demo.world.joint_count();
  const double before = demo.world.energy().momentum.x();
  double at_impact = before;
  for (int i = 0; i < 6; ++i) {
    demo.world.step(demo.scene.step.dt);
    at_impact = demo.world.energy().momentum.x();
  }
  // Friction with the floor, 0.6 m g over 0.1 s at most, is all that may take momentum.
  EXPECT_NEAR(at_impact, before, 0.6 * mass * kG * 0.1 + 1);
  demo.run(3);
  EXPECT_LT(demo.world.joint_count(), bonds);
  for (const auto& body : demo.instance.bodies) {
    if (body.name != "floor") {
      EXPECT_GT(demo.world.center_of_mass(body.id).y(), 0) << body.name;
    }
  }
}

// The ragdoll falls and its joints stay within 1 cm. How its limbs strike the ground hangs on the
// last digit of the start, so it falls sixteen times, from starts that differ by 1e-5 m/s.
TEST(Demos, Ragdoll) {
  for (int k = 0; k < 16; ++k) {
    Demo demo("ragdoll");
    const BodyId torso = demo.body("torso");
    ASSERT_TRUE(demo.world.set_linear_velocity(
        torso, demo.world.linear_velocity(torso) + Vec3(1e-5F * static_cast<float>(k), 0, 0)));
    double worst = 0;
    for (int i = 0; i < 600; ++i) {
      demo.world.step(demo.scene.step.dt);
      for (const auto& joint : demo.instance.joints)
        worst = std::max(worst, static_cast<double>(demo.world.joint_state(joint.id).linear_error));
    }
    EXPECT_LT(worst, 0.01) << k;
    EXPECT_LT(demo.at("torso").y(), 0.6) << k;
    EXPECT_LT(demo.world.energy().kinetic_linear, 5) << k;
  }
}

}  // namespace
