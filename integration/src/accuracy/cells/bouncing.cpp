// Bounces: a ball that comes to rest, one that does not, and one that spins when it hits.
#include <algorithm>

#include "accuracy/cells/build.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Vector3d;

class Balls : public Case {
 public:
  Balls(const Making& making, double friction, double restitution, double height,
        const Vector3d& velocity, const Vector3d& spin)
      : Case(making.settings()) {
    bodies = making.copies;
    const Material surface = material(friction, restitution);
    add_floor(world, surface);
    for (int i = 0; i < making.copies; ++i) {
      RigidBody body = body_at(at({0, kRadius + height, 3.0 * i}));
      body.mass = mass_of(1, Vector3d::Constant(0.4 * kRadius * kRadius));
      body.linear_velocity = vec(velocity);
      body.angular_velocity = vec(spin);
      const BodyId id = add(world, body, Sphere{real(kRadius)}, surface);
      if (i == 0) ball_ = id;
    }
  }

 protected:
  static constexpr double kRadius = 0.5;  // [m]
  BodyId ball_;
};

// I1: dropped 1 m, e = 0.8; the time after which it is at rest.
class ComingToRest : public Balls {
 public:
  explicit ComingToRest(const Making& m) : Balls(m, 0, 0.8, 1, {0, 0, 0}, {0, 0, 0}) {
    seconds = 6;
  }
  void after_step() override {
    constexpr double kRest = 1e-3;  // [m/s]
    if (wide(world.linear_velocity(ball_)).norm() > kRest) last_ = world.time();
  }
  [[nodiscard]] std::vector<double> readings() const override { return {last_}; }

 private:
  double last_ = 0;
};

// I3: e = 1 from 1 m for ten seconds; the largest relative error of the energy.
class Elastic : public Balls {
 public:
  explicit Elastic(const Making& m) : Balls(m, 0, 1, 1, {0.5, 0, 0}, {0, 0, 0}) {
    seconds = 10;
    start_ = kGravity * 1 + 0.5 * 0.25;
  }
  void after_step() override {
    const Vector3d v = wide(world.linear_velocity(ball_));
    const double energy = 0.5 * v.squaredNorm() + kGravity * (place(world, ball_).y() - kRadius);
    worst_ = std::max(worst_, std::abs(energy / start_ - 1));
  }
  [[nodiscard]] std::vector<double> readings() const override { return {worst_}; }

 private:
  double start_ = 0, worst_ = 0;
};

// I4: comes down on a rough floor with sideways speed; after the bounce it rolls at 5/7 of that.
class Rough : public Balls {
 public:
  explicit Rough(const Making& m) : Balls(m, 0.9, 0.5, 1, {2, 0, 0}, {0, 0, 0}) { seconds = 0.6; }
  [[nodiscard]] std::vector<double> readings() const override {
    return {wide(world.linear_velocity(ball_)).x()};
  }
};

// H12: balls of 1 cm at 300 m/s, each shot at a plate of 1 mm that nothing holds, from twenty
// distances; the share that passes.
class Bullets : public Case {
 public:
  explicit Bullets(const Making& making) : Case(making.settings()) {
    seconds = 0.2;
    constexpr int kShots = 20;
    bodies = 2 * kShots;
    for (int i = 0; i < kShots; ++i) {
      const double z = 3.0 * i;
      RigidBody plate = body_at(at({0, 0, z}));
      plate.gravity_scale = 0;
      plates_.push_back(add(world, plate, box(0.0005, 0.5, 0.5), material(0.5)));
      RigidBody bullet = body_at(at({-10 - 0.37 * i, 0.1, z}));
      bullet.gravity_scale = 0;
      bullet.linear_velocity = vec({300, 0, 0});
      bullet.continuous = making.knobs.continuous;
      bullets_.push_back(add(world, bullet, Sphere{real(0.005)}, material(0.5)));
    }
  }
  [[nodiscard]] std::vector<double> readings() const override {
    double passed = 0;
    for (std::size_t i = 0; i < bullets_.size(); ++i)
      if (place(world, bullets_[i]).x() > place(world, plates_[i]).x()) ++passed;
    return {passed / static_cast<double>(bullets_.size())};
  }

 private:
  std::vector<BodyId> plates_, bullets_;
};

}  // namespace

std::vector<CaseMaker> bouncing_cases() {
  return {{"I1", 16, make<ComingToRest>},
          {"I3", 16, make<Elastic>},
          {"I4", 16, make<Rough>},
          {"H12", 1, make<Bullets>}};
}

}  // namespace plumb::inline PLUMB_ABI::cells
