// Shots: what is fast and thin and may pass unseen.
#include "accuracy/cells/build.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Vector3d;

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

std::vector<CaseMaker> shot_cases() { return {{"H12", 1, make<Bullets>}}; }

}  // namespace plumb::inline PLUMB_ABI::cells
