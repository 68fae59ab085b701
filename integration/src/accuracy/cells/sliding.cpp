// Friction: stopping, starting to roll, rolling and sliding downhill.
#include "accuracy/cells/build.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Vector3d;

// A body on a floor or slope (through the origin, rising towards -x), given a velocity along it.
class OnFloor : public Case {
 public:
  OnFloor(const Making& making, double slope, double friction, const Shape& shape, double height,
          const std::optional<MassProperties>& mass, double speed, double spin, bool locked)
      : Case(making.settings()), down_(std::cos(slope), -std::sin(slope), 0) {
    bodies = making.copies;
    const Vector3d normal(std::sin(slope), std::cos(slope), 0);
    const Material surface = material(friction);
    add_floor(world, surface, normal);
    for (int i = 0; i < making.copies; ++i) {
      RigidBody body =
          body_at(at(height * normal + Vector3d(0, 0, 4.0 * i), turn(-slope, Vector3d::UnitZ())));
      body.mass = mass;
      body.linear_velocity = vec(speed * down_);
      body.angular_velocity = vec({0, 0, spin});
      body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = locked;
      const BodyId id = add(world, body, shape, surface);
      if (i == 0) {
        body_ = id;
        start_ = place(world, id);
      }
    }
  }
  // [m] along the floor.
  [[nodiscard]] std::vector<double> readings() const override {
    return {(place(world, body_) - start_).dot(down_)};
  }

 private:
  BodyId body_;
  Vector3d down_, start_;
};

std::optional<MassProperties> solid_ball() {
  return mass_of(1, Vector3d::Constant(0.4 * 0.5 * 0.5));
}

struct Stopping : OnFloor {  // C1
  explicit Stopping(const Making& m)
      : OnFloor(m, 0, 0.5, box(0.5, 0.05, 0.5), 0.05, {}, 10, 0, false) {
    seconds = 3;
  }
};
struct StartingToRoll : OnFloor {  // C5
  explicit StartingToRoll(const Making& m)
      : OnFloor(m, 0, 0.3, Sphere{real(0.5)}, 0.5, solid_ball(), 7, 0, false) {
    seconds = 2;
  }
};
struct RollingDown : OnFloor {  // C6
  explicit RollingDown(const Making& m)
      : OnFloor(m, kPi / 6, 0.8, Sphere{real(0.5)}, 0.5, solid_ball(), 0, 0, false) {
    seconds = 2;
  }
};
struct SlidingDown : OnFloor {  // C3
  explicit SlidingDown(const Making& m)
      : OnFloor(m, kPi / 6, 0.3, box(0.5, 0.05, 0.5), 0.05, {}, 0, 0, false) {
    seconds = 2;
  }
};

}  // namespace

std::vector<CaseMaker> sliding_cases() {
  return {{"C1", 16, make<Stopping>},
          {"C3", 16, make<SlidingDown>},
          {"C5", 16, make<StartingToRoll>},
          {"C6", 16, make<RollingDown>}};
}

}  // namespace plumb::inline PLUMB_ABI::cells
