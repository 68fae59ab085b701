// Bodies that touch nothing, under a force: falling through a linear medium, in orbit.
#include "accuracy/cells/build.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Vector3d;

WorldSettings without_gravity(const Making& making) {
  WorldSettings settings = making.settings();
  settings.gravity = Vec3::Zero();
  return settings;
}

// F2: thrown through a medium with linear drag, tau = 2 s.
class LinearDrag : public Case {
 public:
  explicit LinearDrag(const Making& making) : Case(making.settings()) {
    seconds = 4;
    bodies = making.copies;
    for (int i = 0; i < making.copies; ++i) {
      RigidBody body = body_at(at({0, 0, 100.0 * i}));
      body.mass = mass_of(1, Vector3d::Ones());
      body.linear_velocity = vec({30, 40, 0});
      body.linear_damping = real(0.5);
      const BodyId id = must(world.create_body(body));
      if (i == 0) body_ = id;
    }
  }
  [[nodiscard]] std::vector<double> readings() const override {
    std::vector<double> out;
    append_place(out, place(world, body_));
    return out;
  }

 private:
  BodyId body_;
};

// F5: Kepler's ellipse by a force of the user, e = 0.5, a = mu = 1, started at the near end; ten
// periods, as near as whole steps come. The force changes along the way, so it is given as
// impulses: the first half a step early, then one between any two drifts (leapfrog). The reading is
// the largest error of the energy, which stays -1/2.
class Kepler : public Case {
 public:
  explicit Kepler(const Making& making) : Case(without_gravity(making)), dt_(making.knobs.dt) {
    seconds = 63;  // ten periods of 2 pi
    bodies = making.copies;
    for (int i = 0; i < making.copies; ++i) {
      RigidBody body = body_at(at({0.5, 0, 10.0 * i}));
      body.mass = mass_of(1, Vector3d::Ones());
      body.linear_velocity = vec(Vector3d(0, std::sqrt(3.0), 0) - 0.5 * dt_ * pull({0.5, 0, 0}));
      bodies_.push_back(must(world.create_body(body)));
    }
  }
  void before_step() override {
    for (const BodyId body : bodies_)
      must(world.apply_impulse(body, vec(dt_ * pull(place(world, body)))));
  }
  void after_step() override {
    const Vector3d r = place(world, bodies_[0]);
    const Vector3d v = wide(world.linear_velocity(bodies_[0])) + 0.5 * dt_ * pull(r);
    worst_ = std::max(worst_, std::abs((v.squaredNorm() / 2 - 1 / r.norm()) / -0.5 - 1));
  }
  [[nodiscard]] std::vector<double> readings() const override { return {worst_}; }

 private:
  // [m/s^2] towards the axis through the origin.
  static Vector3d pull(Vector3d r) {
    r.z() = 0;
    return -r / std::pow(r.norm(), 3);
  }
  double dt_;
  std::vector<BodyId> bodies_;
  double worst_ = 0;
};

}  // namespace

std::vector<CaseMaker> forced_cases() {
  return {{"F2", 64, make<LinearDrag>}, {"F5", 64, make<Kepler>}};
}

}  // namespace plumb::inline PLUMB_ABI::cells
