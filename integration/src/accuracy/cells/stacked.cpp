// Contacts that carry: columns of equal boxes, a heavy box on a light one, and a pile, which is
// chaotic.
#include <algorithm>

#include "accuracy/cells/build.h"
#include "accuracy/random.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Vector3d;

// A column of cubes of one metre. The reading is the largest relative error of the mean force in
// any contact over the last half second.
class Column : public Case {
 public:
  Column(const Making& making, int count, double top_mass_ratio) : Case(making.settings()) {
    seconds = 2;
    bodies = count * making.copies;
    const Material surface = material(0.6);
    floor_ = add_floor(world, surface);
    for (int c = 0; c < making.copies; ++c)
      for (int i = 0; i < count; ++i) {
        const double density = i == count - 1 ? 1000 * top_mass_ratio : 1000;
        const BodyId id =
            add(world, body_at(at({0, 0.5 + i, 5.0 * c})), box(0.5, 0.5, 0.5), surface, density);
        if (c == 0) column_.push_back(id);
      }
    impulse_.assign(column_.size(), 0);
  }
  void after_step() override {
    if (world.time() <= seconds - 0.5 + 1e-9) return;
    measured_ += world.last_report().dt;
    world.each_contact([&](const ContactState& contact) {
      for (std::size_t k = 0; k < column_.size(); ++k) {
        const BodyId below = k == 0 ? floor_ : column_[k - 1];
        const bool here = (contact.body_a == below && contact.body_b == column_[k]) ||
                          (contact.body_b == below && contact.body_a == column_[k]);
        for (int i = 0; here && i < contact.point_count; ++i)
          impulse_[k] += static_cast<double>(contact.points[i].normal_impulse);
      }
    });
  }
  [[nodiscard]] std::vector<double> readings() const override {
    double load = 0, worst = 0;
    for (std::size_t k = column_.size(); k-- > 0;) {
      load += world.mass_properties(column_[k]).mass * kGravity;
      worst = std::max(worst, std::abs(impulse_[k] / measured_ / load - 1));
    }
    return {worst};
  }

 private:
  BodyId floor_;
  std::vector<BodyId> column_;
  std::vector<double> impulse_;  // [N s] per contact, from the floor up
  double measured_ = 0;          // [s]
};
struct TenBoxes : Column {  // C18
  explicit TenBoxes(const Making& m) : Column(m, 10, 1) {}
};
struct HeavyOnLight : Column {  // H4
  explicit HeavyOnLight(const Making& m) : Column(m, 2, 100) {}
};

// Boxes and balls dropped on each other, shifted a little by the seed; where they are in the end.
class Pile : public Case {
 public:
  explicit Pile(const Making& making) : Case(making.settings()) {
    seconds = 4;
    const Material surface = material(0.5, 0.1);
    add_floor(world, surface);
    accuracy::Random random(making.seed);
    for (int i = 0; i < kCount; ++i) {
      const Vector3d p(0.9 * (i % 3) + random.uniform(-0.05, 0.05), 0.6 + 1.1 * (i / 3),
                       0.4 * (i % 2) + random.uniform(-0.05, 0.05));
      RigidBody body = body_at(at(p + Vector3d(i == 0 ? making.disturb : 0, 0, 0)));
      const Shape shape = i % 2 == 0 ? Shape(box(0.4, 0.3, 0.35)) : Shape(Sphere{real(0.4)});
      pile_.push_back(add(world, body, shape, surface));
    }
    bodies = kCount;
  }
  [[nodiscard]] std::vector<double> readings() const override {
    std::vector<double> out;
    for (const BodyId body : pile_) append_place(out, place(world, body));
    return out;
  }
  [[nodiscard]] std::vector<double> statistics() const override {
    double height = 0, mass = 0, highest = 0, deepest = 0;
    for (const BodyId body : pile_) {
      const double m = world.mass_properties(body).mass, y = place(world, body).y();
      height += m * y;
      mass += m;
      highest = std::max(highest, y);
    }
    world.each_contact([&](const ContactState& contact) {
      for (int i = 0; i < contact.point_count; ++i)
        deepest = std::max(deepest, -static_cast<double>(contact.points[i].separation));
    });
    return {height / mass, highest, world.energy().total(), deepest};
  }

 private:
  static constexpr int kCount = 18;
  std::vector<BodyId> pile_;
};

}  // namespace

std::vector<CaseMaker> stacked_cases() {
  return {{"C18", 2, make<TenBoxes>}, {"H4", 4, make<HeavyOnLight>}, {"pile", 1, make<Pile>}};
}

}  // namespace plumb::inline PLUMB_ABI::cells
