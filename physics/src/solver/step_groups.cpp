#include "solver/step_groups.h"

#include <algorithm>
#include <limits>

#include "effects/effect_world.h"
#include "solver/worst_first.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Whether some stage between the passes concerns all bodies.
bool concerns_all(const WorldState& world) {
  return world.diagnostics.ledger || resolves_worst_first(world) ||
         (world.effects != nullptr && !world.effects->empty());
}

// What is known of a body, or of all from it to the last one that rows tie to it.
struct Tie {
  std::uint32_t last = 0;  // dense
  std::uint32_t rows = 0;  // that end here: hold no earlier body
  bool special = false;    // takes part in a stage of its own
};

class Grouping {
 public:
  explicit Grouping(WorldState& world)
      : world_(world),
        groups_(world.groups),
        group_of_(world.groups.group_of),
        ties_(world.bodies.awake_end, &world.memory) {}

  void group() {
    tie_by_rows();
    mark_special_bodies();
    std::uint32_t begin = world_.bodies.awake_begin;
    while (begin < world_.bodies.awake_end) {
      const std::uint32_t end = end_of_tied(begin);
      add_tied(begin, end);
      begin = end;
    }
    end_run();
    deal_rows();
  }

 private:
  void mark(std::uint32_t row) {
    const ContactRow<Real>& r = world_.rows[row];
    ties_[r.body_a].special = ties_[r.body_b].special = true;
  }

  void tie_by_rows() {
    for (const ContactRow<Real>& row : world_.rows) {
      std::uint32_t first = std::min(row.body_a, row.body_b);
      const std::uint32_t last = std::max(row.body_a, row.body_b);
      if (first == 0) first = last;  // the world itself ties nothing
      ties_[first].last = std::max(ties_[first].last, last);
      ++ties_[first].rows;
      if (!is_plain(world_, row)) ties_[first].special = true;
    }
  }

  void mark_special_bodies() {
    const std::uint32_t colored = world_.colors.empty() ? 0 : world_.colors.back().end;
    for (auto k = colored; k < world_.rows.size(); ++k) mark(k);
    for (const AdhesiveRow& adhesive : world_.adhesive_rows) mark(adhesive.row);
    for (const SpinningRow& spinning : world_.spinning_rows) mark(spinning.row);
    for (std::uint32_t i = world_.bodies.awake_begin; i < world_.bodies.awake_end; ++i) {
      const SubstepBody& s = world_.substep[i];
      if (s.jointed || s.affected || !(world_.bodies.mass[i].mass > Real(0)) ||
          (world_.deep_overlap && world_.overlaps_deeply[i] != 0))
        ties_[i].special = true;
    }
  }

  // One past the last body that rows tie to those from `begin` on.
  [[nodiscard]] std::uint32_t end_of_tied(std::uint32_t begin) const {
    std::uint32_t last = begin;
    for (std::uint32_t i = begin; i <= last; ++i) last = std::max(last, ties_[i].last);
    return last + 1;
  }

  void add_tied(std::uint32_t begin, std::uint32_t end) {
    std::uint32_t rows = 0;
    bool special = false;
    for (std::uint32_t i = begin; i < end; ++i) {
      rows += ties_[i].rows;
      special = special || ties_[i].special;
    }
    // What has no rows flies: no substep concerns it.
    if (special || rows > tolerance::kMostRowsApart || rows == 0) return;
    if (run_rows_ == 0) run_.begin = begin;
    run_.end = end;
    run_rows_ += rows;
    std::fill(group_of_.begin() + begin, group_of_.begin() + end, run_number());
    if (run_rows_ >= tolerance::kRowsApart) end_run();
  }

  [[nodiscard]] std::uint32_t run_number() const {
    return static_cast<std::uint32_t>(groups_.apart.size()) + 1;
  }
  void end_run() {
    if (run_rows_ == 0) return;
    if (run_rows_ < tolerance::kFewestRowsApart) {
      std::replace(group_of_.begin() + run_.begin, group_of_.begin() + run_.end, run_number(),
                   kTogether);
    } else {
      groups_.apart.push_back({run_, {}});
    }
    run_rows_ = 0;
  }

  void deal_rows() {
    const auto group_of = [&](const ContactRow<Real>& row) {
      return group_of_[std::max(row.body_a, row.body_b)];
    };
    for (const ContactRow<Real>& row : world_.rows)
      if (const std::uint32_t group = group_of(row); group != kTogether)
        ++groups_.apart[group - 1].rows.end;
    std::uint32_t before = 0;
    for (StepGroups::Apart& apart : groups_.apart) {
      const std::uint32_t count = apart.rows.end;
      apart.rows = {before, before};
      before += count;
    }
    groups_.rows.resize(before);
    for (std::uint32_t k = 0; k < world_.rows.size(); ++k) {
      const std::uint32_t group = group_of(world_.rows[k]);
      if (group == kTogether) {
        groups_.together.rows.push_back(k);
      } else {
        groups_.rows[groups_.apart[group - 1].rows.end++] = k;
      }
    }
  }

  WorldState& world_;
  StepGroups& groups_;
  std::vector<std::uint32_t>& group_of_;
  StepList<Tie> ties_;          // per dense body
  IndexRange run_;              // the group that is being gathered
  std::uint32_t run_rows_ = 0;  // in it
};

void find_bouncing_bodies(WorldState& world) {
  std::vector<std::uint8_t>& bounces = world.groups.bounces;
  bounces.clear();
  if (world.bouncing_rows.empty()) return;
  bounces.assign(world.bodies.awake_end, 0);
  for (const std::uint32_t k : world.bouncing_rows) {
    const ContactRow<Real>& row = world.rows[k];
    if (world.substep[row.body_a].constrained) bounces[row.body_a] = 1;
    if (world.substep[row.body_b].constrained) bounces[row.body_b] = 1;
  }
}

}  // namespace

bool is_plain(const WorldState& world, const ContactRow<Real>& row) {
  return !row.watched && !(row.restitution > Real(0)) &&
         !(world.counts.driven > 0 && world.pairs[world.contacts[row.contact].pair].driven);
}

void find_groups(WorldState& world) {
  StepGroups& groups = world.groups;
  groups.apart.clear();
  groups.rows.clear();
  groups.group_of.assign(world.bodies.awake_end, kTogether);
  groups.together.bodies = {world.bodies.awake_begin, world.bodies.awake_end};
  groups.together.rows.clear();
  groups.together.jobs = world.jobs;
  find_bouncing_bodies(world);
  if (world.rows.size() >= 2 * tolerance::kFewestRowsApart && !concerns_all(world)) {
    Grouping(world).group();
    return;
  }
  groups.together.rows.resize(world.rows.size());
  for (std::uint32_t k = 0; k < world.rows.size(); ++k) groups.together.rows[k] = k;
}

}  // namespace plumb::inline PLUMB_ABI::detail
