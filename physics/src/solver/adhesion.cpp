#include "solver/adhesion.h"

#include <algorithm>

#include "solver/row_velocities.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Up to which gap a pair holds on [m]: what touched in the last step may have fallen since then.
Real reach_of(const WorldState& world, const Pair& pair) {
  if (!pair.was_touching) return pair.slop;
  return std::max(pair.slop, length(to_inner(world.settings.gravity)) * world.dt * world.dt);
}

}  // namespace

void find_adhesive_rows(WorldState& world) {
  world.adhesive_rows.clear();
  if (world.counts.adhesive == 0) return;
  for (std::uint32_t k = 0; k < world.rows.size(); ++k) {
    const ContactRow<Real>& row = world.rows[k];
    const Pair& pair = world.pairs[world.contacts[row.contact].pair];
    if (!(pair.adhesion > Real(0))) continue;
    const Real reach = reach_of(world, pair);
    const auto holds = [&](const Contact& c, int i) {
      return c.manifold.points[i].separation - c.advanced_gap <= reach;
    };
    int held = 0;  // points of all manifolds of the pair, which share the pull
    for (const Contact& c : contacts_of(pair, world.contacts))
      for (int i = 0; i < c.manifold.count; ++i) held += holds(c, i) ? 1 : 0;
    if (held == 0) continue;
    const Real share = pair.adhesion / static_cast<Real>(held);
    AdhesiveRow pull{k};
    for (int i = 0; i < row.count; ++i) {
      if (!holds(world.contacts[row.contact], i)) continue;
      pull.force -= share;
      pull.moment1 -= share * row.points[i].b;
      pull.moment2 += share * row.points[i].a;
    }
    if (pull.force < Real(0)) world.adhesive_rows.push_back(pull);
  }
}

void pull_together(WorldState& world) {
  for (const AdhesiveRow& pull : world.adhesive_rows) {
    const ContactRow<Real>& row = world.rows[pull.row];
    RowVelocities<Real> u = read_velocities(world, row);
    apply_wrench(row, (world.h * pull.force) * row.n,
                 world.h * (pull.moment1 * row.t1 + pull.moment2 * row.t2), u);
    write_velocities(world, row, u);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
