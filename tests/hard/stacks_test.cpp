// Hard cases H1, H2, H4, H18: what stands on one another. See hard_cell.h for the rule.
#include "hard_cell.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace hard;

double weigh(const PhysicsWorld& world, const std::vector<BodyId>& bodies) {
  double sum = 0;
  for (const BodyId body : bodies)
    sum += world.mass_properties(body).mass * kGravity * position(world, body).y();
  return sum;
}

double column_cell(const Cell& cell, const Column& column, double seconds) {
  PhysicsWorld world(settings_of(cell));
  const Built built = build_column(world, column);
  Rules rules;
  rules.stands = built.bodies;
  rules.energy_scale = 0.1 * weigh(world, built.bodies);
  return judge(world, cell, seconds, rules);
}

TEST(HardColumns, H1_ShiftedToAndFroByACentimetre) {
  for (const int count : {10, 20, 50})
    for_cells("H1 column " + std::to_string(count), [&](const Cell& cell) {
      return column_cell(cell, {count, 1, 0.01}, 4);
    });
}

TEST(HardColumns, H4_HeavyOnLightAndLightOnHeavy) {
  for (const double ratio : {1e2, 1e3, 1e4, 1e5, 1e-2, 1e-5}) {
    char name[32];
    std::snprintf(name, sizeof name, "H4 ratio %g", ratio);
    for_cells(name, [&](const Cell& cell) { return column_cell(cell, {2, ratio}, 4); });
  }
  for_cells("H4 alternating", [&](const Cell& cell) {
    PhysicsWorld world(settings_of(cell));
    Rules rules;
    add_slab(world, 100, 100);
    for (int i = 0; i < 5; ++i)
      rules.stands.push_back(add(world, body_at(at(0, 0.5 + i, 0)),
                                 with(cube(0.5), Material{}, i % 2 == 0 ? 0.1 : 10)));
    rules.energy_scale = 0.1 * weigh(world, rules.stands);
    return judge(world, cell, 4, rules);
  });
}

TEST(HardPyramids, H2_AndH4_WithAHeavyTip) {
  for (const double tip : {1.0, 100.0, 300.0}) {
    char name[32];
    std::snprintf(name, sizeof name, "H2 pyramid 10 tip %g", tip);
    for_cells(name, [&](const Cell& cell) {
      PhysicsWorld world(settings_of(cell));
      const Built built = build_pyramid(world, {.base = 10});
      const BodyId top = built.bodies.back();
      MassProperties heavy = world.mass_properties(top);
      heavy.mass *= tip;
      heavy.I_Bcm_B *= tip;
      must(world.set_mass(top, heavy));
      Rules rules;
      rules.stands = built.bodies;
      rules.energy_scale = 0.1 * weigh(world, built.bodies);
      return judge(world, cell, 3, rules);
    });
  }
}

TEST(HardColumns, H18_IceAndGlue) {
  for (const double mu : {0.0, 1e9})
    for_cells(mu == 0 ? "H18 ice" : "H18 friction 1e9", [&](const Cell& cell) {
      return column_cell(cell, {.count = 5, .surface = material(mu)}, 3);
    });
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
