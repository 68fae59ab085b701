// Hard cases H5, H7 to H12, H17, H19: chains, spin, sizes, distances, overlap, gravity, bullets,
// gas. See hard_cell.h for the rule.
#include "hard_cell.h"
#include "plumb/job_system.h"
#include "support/chain.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace hard;

TEST(HardChains, H5_HeavyEnds) {
  struct Knob {
    int links;
    double end;
  };
  for (const Knob& knob : {Knob{19, 1800}, Knob{17, 1000}, Knob{100, 1000}})
    for_cells("H5 chain " + std::to_string(knob.links), [&](const Cell& cell) {
      Chain chain(knob.links, knob.end);
      WorldSettings settings = settings_of(cell);
      must(chain.world.set_settings(settings));
      const Chain::Worst worst = chain.fall(3, cell.dt);
      if (!all_finite(chain.world)) return kFell;
      // 0.1 % of a link, 1 % of the energy.
      return std::max(worst.gap / (1e-3 * Chain::kLink), worst.rise / 0.01);
    });
}

TEST(HardSpin, H7_ThinBodiesTumbleAndLand) {
  struct Knob {
    const char* name;
    Shape shape;
    double thickness;
  };
  const Knob knobs[] = {{"rod 1:0.05", box(0.5, 0.025, 0.025), 0.05},
                        {"disc 1:0.05", cylinder(0.025, 0.5), 0.05}};
  for (const Knob& knob : knobs)
    for (const double spin : {20.0, 100.0})
      for_cells("H7 " + std::string(knob.name) + " " + std::to_string(std::lround(spin)) + " rad/s",
                [&](const Cell& cell) {
                  PhysicsWorld world(settings_of(cell));
                  add_slab(world, 100, 100);
                  add(world, moving(at(0, 1.2, 0), vec(0, 0, 0), vec(1, 0.3, spin)),
                      with(knob.shape));
                  Rules rules;
                  rules.thickness = knob.thickness;
                  rules.overlaps_at_first = true;
                  return judge(world, cell, 3, rules);
                });
}

TEST(HardSizes, H8_FromAMillimetreToTenKilometres) {
  for (const double half : {0.0005, 0.025, 5000.0}) {
    char name[32];
    std::snprintf(name, sizeof name, "H8 edge %g m", 2 * half);
    for_cells(name, [&](const Cell& cell) {
      PhysicsWorld world(settings_of(cell));
      const Built built = build_stack(world, {.count = 5, .half = half});
      Rules rules;
      rules.thickness = 2 * half;
      rules.stands = built.bodies;
      rules.way = half;
      rules.energy_scale = 5000 * 8 * half * half * half * kGravity * half;
      return judge(world, cell, 3, rules);
    });
  }
}

TEST(HardPlaces, H9_FarFromTheOrigin) {
  for (const double distance : {1e4, 1e5, 1e6, 1e7}) {
    char name[32];
    std::snprintf(name, sizeof name, "H9 at %g m", distance);
    for_cells(name, [&](const Cell& cell) {
      PhysicsWorld world(settings_of(cell));
      const Built built = build_stack(world, {.count = 5, .foot = {distance, 0, distance}});
      Rules rules;
      rules.stands = built.bodies;
      rules.energy_scale = 1e5;
      return judge(world, cell, 3, rules);
    });
  }
}

TEST(HardStarts, H10_OverlapAtBirth) {
  for (const double share : {0.25, 1.0})
    for_cells(share < 1 ? "H10 overlap 25 %" : "H10 ten in one place", [&](const Cell& cell) {
      PhysicsWorld world(settings_of(cell));
      add_slab(world, 100, 100);
      std::vector<BodyId> bodies;
      const int count = share < 1 ? 5 : 10;
      for (int i = 0; i < count; ++i)
        bodies.push_back(add(world, body_at(at(0, 0.5 + (1 - share) * i, 0)), with(cube(0.5))));
      Rules rules;
      rules.overlaps_at_first = true;
      rules.thickness = 1e9;  // they are let overlap
      return judge(world, cell, 1, rules, [&] { return max_speed(world) / 5; });
    });
}

TEST(HardForces, H11_GravityOfAHundredAndAThousand) {
  for (const double g : {100.0, 1000.0})
    for_cells("H11 g " + std::to_string(std::lround(g)), [&](const Cell& cell) {
      WorldSettings settings = settings_of(cell);
      settings.gravity = vec(0, -g, 0);
      PhysicsWorld world(settings);
      add_slab(world, 100, 100, material(0.6, 0.5));
      for (int i = 0; i < 4; ++i)
        add(world, body_at(at(0.1 * i, 0.6 + 1.2 * i, 0)), with(cube(0.5), material(0.6, 0.5)));
      Rules rules;
      rules.energy_scale = 4 * 1000 * g * 2;
      rules.overlaps_at_first = true;
      return judge(world, cell, 3, rules);
    });
}

TEST(HardBullets, H12_NothingPasses) {
  for_cells("H12 1 cm at 1000 m/s on 1 mm", [&](const Cell& cell) {
    Random random(12);
    int passed = 0;
    for (int shot = 0; shot < 50; ++shot) {
      WorldSettings settings = settings_of(cell);
      settings.gravity = Vec3::Zero();
      PhysicsWorld world(settings);
      add(world, body_at(Pose{}, MotionType::Static), with(box(0.0005, 5, 5)));
      const double y = random.uniform(-0.2, 0.2), z = random.uniform(-0.2, 0.2);
      const BodyId bullet =
          add(world, moving(at(-random.uniform(0.1, 20), y, z), vec(1000, y, z), vec(z, y, 30)),
              with(sphere(0.005)));
      run(world, 8 * cell.dt, cell.dt);
      passed += position(world, bullet).x() > 0 ? 1 : 0;
    }
    return passed > 0 ? kFell : 0.0;
  });
}

TEST(HardGas, H17_AHundredElasticSpheresInABox) {
  for_cells("H17 gas", [&](const Cell& cell) {
    WorldSettings settings = settings_of(cell);
    settings.gravity = Vec3::Zero();
    PhysicsWorld world(settings);
    const Material elastic = material(0, 1);
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vector3d normal = Vector3d::Zero();
        normal[axis] = -side;
        add_floor(world, elastic, normal, -3);
      }
    Random random(17);
    for (int i = 0; i < 100; ++i) {
      const Vector3d p(-2 + i % 5, -2 + i / 5 % 5, -2 + i / 25);
      add(world, moving(at(p, Quat::Identity()), vec(3 * random.direction())),
          with(sphere(0.2), elastic));
    }
    const double start = world.energy().total();
    Rules rules;
    rules.thickness = 0.4;
    return judge(world, cell, 3, rules,
                 [&] { return std::abs(world.energy().total() - start) / (1e-3 * start); });
  });
}

TEST(HardDeterminism, H19_SameBitsForAnyNumberOfThreads) {
  for (const ContactSolver solver :
       {ContactSolver::SoftStep, ContactSolver::Newton, ContactSolver::Auto}) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 4}) {
      const auto jobs = make_thread_pool(threads);
      PhysicsWorld world(settings_of({solver, 1.0 / 60}));
      world.set_job_system(jobs.get());
      build_column(world, {8, 3, 0.01});
      for (int k = 0; k < 4; ++k)
        add(world, body_at(at(3 + k, 1 + 0.3 * k, 0)), with(cube(0.4), material(0.5, 0.3)));
      run(world, 1);
      if (threads == 2) must(world.restore(world.save()));
      run(world, 0.5);
      hashes.push_back(world.state_hash());
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
