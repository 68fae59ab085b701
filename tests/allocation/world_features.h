// What a world may have besides bodies and colliders, one by one: how to begin using it on two
// bodies, the first at rest on the ground, and how to end it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace features {

using namespace testing_support;

inline constexpr double kApart = 10;  // [m] from the middle of the first body to the second's

using End = std::function<void(PhysicsWorld&)>;
struct Feature {
  std::string name;
  std::function<End(PhysicsWorld&, BodyId, BodyId)> begin;
};

inline Feature effect(const EffectKind& kind) {
  return {name_of_effect(kind.index()), [kind](PhysicsWorld& world, BodyId body, BodyId) {
            const EffectId made = must(world.create_effect({body, kind, 0}));
            return [made](PhysicsWorld& w) { must(w.destroy_effect(made)); };
          }};
}

inline std::vector<Feature> effects() {
  PointGravity star;
  star.mu = Real(1);
  star.softening = Real(1);
  Drag drag;
  drag.quadratic = Real(0.1);
  Magnus magnus;
  magnus.coefficient = Real(0.1);
  Attractor pull;
  pull.strength = Real(1);
  Thrust thrust;
  thrust.force = Vec3(1, 0, 0);
  AeroSurface wing;
  wing.tensor = -Mat3::Identity();
  Buoyancy lake;
  lake.level = Real(10);
  Feature field = effect(ForceField{});
  field.begin = [](PhysicsWorld& world, BodyId body, BodyId) -> End {
    must(world.set_force_field(0, [](const FieldSample&, void*) { return FieldForce{}; }));
    const EffectId made = must(world.create_effect({body, ForceField{}, 0}));
    return [made](PhysicsWorld& w) {
      must(w.destroy_effect(made));
      must(w.set_force_field(0, nullptr));
    };
  };
  return {effect(star), field,          effect(thrust),  effect(Explosion{}),
          effect(drag), effect(magnus), effect(pull),    effect(Wind{}),
          effect(wing), effect(lake),   effect(Spring{})};
}

// The frames' origins lie at the middles of the bodies, or, `pinned`, both between them.
inline Feature joint(const char* name, const JointKind& kind, bool pinned = true) {
  return {name, [kind, pinned](PhysicsWorld& world, BodyId a, BodyId b) -> End {
            const Pos3 between = world.pose(b).position - world.pose(a).position;
            Joint made;
            made.body_a = a;
            made.body_b = b;
            if (pinned) {
              made.frame_a.position = Real(0.5) * Vec3(between.cast<Real>());
              made.frame_b.position = -made.frame_a.position;
            }
            made.kind = kind;
            const JointId id = must(world.create_joint(made));
            return [id](PhysicsWorld& w) { must(w.destroy_joint(id)); };
          }};
}

// Gear or rack and pinion: `first` is a hinge, `second` of the kind given.
template <class Coupling>
Feature coupling(const char* name, const JointKind& second, Coupling&& couple) {
  return {name, [second, couple](PhysicsWorld& world, BodyId a, BodyId b) -> End {
            const auto place = [&](BodyId body) {
              return Vec3(world.pose(body).position.cast<Real>());
            };
            Joint made;
            made.body_b = a;
            made.frame_a.position = place(a);
            made.kind = HingeJoint{};
            const JointId one = must(world.create_joint(made));
            made.body_b = b;
            made.frame_a.position = place(b);
            made.kind = second;
            const JointId two = must(world.create_joint(made));
            Joint coupled;
            coupled.kind = couple(one, two);
            must(world.create_joint(coupled));
            return [one, two](PhysicsWorld& w) {  // the coupling ends with them
              must(w.destroy_joint(one));
              must(w.destroy_joint(two));
            };
          }};
}

inline std::vector<Feature> joints() {
  return {coupling("gear", HingeJoint{},
                   [](JointId one, JointId two) {
                     return GearJoint{one, two, Real(2)};
                   }),
          coupling("rack and pinion", SliderJoint{},
                   [](JointId one, JointId two) {
                     return RackPinionJoint{one, two, Real(2)};
                   }),
          joint("pulley", PulleyJoint{pos(0, 9, 0), pos(9, 9, 0)}),
          joint("ball joint", BallJoint{}),
          joint("hinge", HingeJoint{}),
          joint("slider", SliderJoint{}),
          joint("fixed joint", FixedJoint{}),
          joint("distance joint", DistanceJoint{real(kApart)}, false),
          joint("rope", RopeJoint{real(kApart)}, false),
          joint("spring joint", SpringJoint{}),
          joint("cone twist", ConeTwistJoint{}),
          joint("six-dof joint", SixDofJoint{}),
          joint("motor joint", MotorJoint{})};
}

// What a collider may do besides being solid: set on the one that the body has, then taken back.
template <class Change>
Feature surface(const char* name, Change&& change) {
  return {name, [change](PhysicsWorld& world, BodyId body, BodyId) -> End {
            const ColliderId collider = world.colliders_of(body)[0];
            const Material before = world.collider(collider).material;
            Material changed = before;
            change(changed);
            must(world.set_material(collider, changed));
            return [collider, before](PhysicsWorld& w) { must(w.set_material(collider, before)); };
          }};
}

// On the body that touches nothing, or on the one that lies on the ground.
inline Feature sensor(const char* name, bool at_contact) {
  return {name, [at_contact](PhysicsWorld& world, BodyId a, BodyId b) -> End {
            const ColliderId collider = world.colliders_of(at_contact ? a : b)[0];
            must(world.set_sensor(collider, true));
            return [collider](PhysicsWorld& w) { must(w.set_sensor(collider, false)); };
          }};
}

inline std::vector<Feature> contact_features() {
  return {
      sensor("sensor", false),
      {"one-way collider",
       [](PhysicsWorld& world, BodyId body, BodyId) -> End {
         const ColliderId collider = world.colliders_of(body)[0];
         must(world.set_one_way(collider, Vec3::UnitY()));
         return [collider](PhysicsWorld& w) { must(w.set_one_way(collider, Vec3::Zero())); };
       }},
      {"surface velocity",
       [](PhysicsWorld& world, BodyId body, BodyId) -> End {
         const ColliderId collider = world.colliders_of(body)[0];
         SurfaceVelocity belt;
         belt.linear = vec(1, 0, 0);
         must(world.set_surface_velocity(collider, belt));
         return [collider](PhysicsWorld& w) { must(w.set_surface_velocity(collider, {})); };
       }},
      surface("restitution", [](Material& m) { m.restitution = Real(0.5); }),
      surface("rolling friction", [](Material& m) { m.rolling_friction = Real(0.01); }),
      surface("grain",
              [](Material& m) {
                m.grain = Vec3::UnitX();
                m.grain_friction = Real(0.1);
              }),
      surface("adhesion", [](Material& m) { m.adhesion = Real(1); }),
      {"table of material pairs",
       [](PhysicsWorld& world, BodyId, BodyId) -> End {
         MaterialPair pair;
         pair.friction = Real(0.1);
         must(world.set_material_pair(1, 2, pair));
         return [](PhysicsWorld& w) { must(w.set_material_pair(1, 2, std::nullopt)); };
       }},
      {"excluded pair",
       [](PhysicsWorld& world, BodyId a, BodyId b) -> End {
         must(world.exclude_pair(a, b));
         return [a, b](PhysicsWorld& w) { must(w.exclude_pair(a, b, false)); };
       }},
  };
}

inline Feature diagnostics(const char* name, const StepDiagnostics& wanted) {
  return {name, [wanted](PhysicsWorld& world, BodyId, BodyId) -> End {
            world.set_diagnostics(wanted);
            return [](PhysicsWorld& w) { w.set_diagnostics({}); };
          }};
}

inline Feature setting(const char* name, const std::function<void(WorldSettings&)>& change) {
  return {name, [change](PhysicsWorld& world, BodyId, BodyId) -> End {
            const WorldSettings before = world.settings();
            WorldSettings changed = before;
            change(changed);
            must(world.set_settings(changed));
            return [before](PhysicsWorld& w) { must(w.set_settings(before)); };
          }};
}

inline std::vector<Feature> world_features() {
  StepDiagnostics ledger, estimate;
  ledger.ledger = true;
  estimate.error_every = 1;
  return {diagnostics("ledger", ledger),
          diagnostics("error estimate", estimate),
          setting("profile", [](WorldSettings& s) { s.profiling = true; }),
          setting("accurate contacts",
                  [](WorldSettings& s) { s.contact_solver = ContactSolver::Newton; }),
          {"locked axes",
           [](PhysicsWorld& world, BodyId body, BodyId) -> End {
             must(world.set_locks(body, MotionLocks::planar()));
             return [body](PhysicsWorld& w) { must(w.set_locks(body, {})); };
           }},
          {"damping",
           [](PhysicsWorld& world, BodyId body, BodyId) -> End {
             must(world.set_damping(body, Real(1), Real(1)));
             return [body](PhysicsWorld& w) { must(w.set_damping(body, 0, 0)); };
           }},
          {"continuous",
           [](PhysicsWorld& world, BodyId body, BodyId) -> End {
             must(world.set_continuous(body, true));
             return [body](PhysicsWorld& w) { must(w.set_continuous(body, false)); };
           }},
          {"observer", [](PhysicsWorld& world, BodyId, BodyId) -> End {
             struct Watcher final : StepObserver {
               void on_step(const StepView&) override {}
             };
             static Watcher watcher;
             world.attach(&watcher);
             return [](PhysicsWorld& w) { w.detach(&watcher); };
           }}};
}

inline std::vector<Feature> all() {
  std::vector<Feature> out;
  for (const auto& some : {effects(), joints(), contact_features(), world_features()})
    out.insert(out.end(), some.begin(), some.end());
  return out;
}

}  // namespace features
}  // namespace plumb::inline PLUMB_ABI
