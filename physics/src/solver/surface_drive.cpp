#include "solver/surface_drive.h"

#include "math/eigen_bridge.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct SurfaceMotion {
  Vec velocity, spin;  // [m/s], [rad/s] world axes
};

// `arm`: of the place from the body's centre of mass [m].
SurfaceMotion surface_motion(const WorldState& world, std::uint32_t slot, Vec arm) {
  const ColliderInfo& collider = world.colliders.info[slot];
  const SurfaceVelocity& surface = collider.component.surface_velocity;
  const Rotation& q_body = world.bodies.pose[world.bodies.info[collider.body].dense].q;
  const Rotation q = q_body * collider.in_body.q;
  const Vec spin = rotate(q, to_inner(surface.angular));
  const Vec from_origin = arm - rotate(q_body, collider.in_body.p);
  return {rotate(q, to_inner(surface.linear)) + cross(spin, from_origin), spin};
}

}  // namespace

SurfaceDrive drive_of(const WorldState& world, const Pair& pair, const ContactRow<Real>& row) {
  const SurfaceMotion a = surface_motion(world, pair.collider_a(), row.arm_a);
  const SurfaceMotion b = surface_motion(world, pair.collider_b(), row.arm_b);
  const Vec v = b.velocity - a.velocity;
  return {{dot(row.t1, v), dot(row.t2, v), dot(row.n, b.spin - a.spin)},
          dot(row.n, a.spin + b.spin)};
}

void find_spinning_rows(WorldState& world) {
  world.spinning_rows.clear();
  if (world.counts.driven == 0) return;
  for (std::uint32_t i = 0; i < world.rows.size(); ++i) {
    const ContactRow<Real>& row = world.rows[i];
    const Pair& pair = world.pairs[world.contacts[row.contact].pair];
    if (!pair.driven) continue;
    const SurfaceDrive start = drive_of(world, pair, row);
    if (start.turn != Real(0)) world.spinning_rows.push_back({i, start});
  }
}

// The contact goes with the body that lies on the other's surface: by D over A's, by -D over B's.
// With s = w x p on either, s_b - s_a changes by -(w_a + w_b) x D.
void carry_drives(WorldState& world) {
  for (const SpinningRow& spinning : world.spinning_rows) {
    ContactRow<Real>& row = world.rows[spinning.row];
    const Vec v = world.bodies.velocity[row.body_b].v - world.bodies.velocity[row.body_a].v;
    const Vec D =
        world.delta[row.body_b].dp - world.delta[row.body_a].dp + (Real(0.5) * world.h) * v;
    row.drive = spinning.start.velocity;
    row.drive.x += spinning.start.turn * dot(row.t2, D);
    row.drive.y -= spinning.start.turn * dot(row.t1, D);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
