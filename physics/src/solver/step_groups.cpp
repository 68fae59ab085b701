#include "solver/step_groups.h"

#include <algorithm>
#include <limits>

#include "solver/step_levels.h"
#include "solver/worst_first.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Whether some stage between the passes concerns all bodies.
bool concerns_all(const WorldState& world) {
  // The ledger is kept of one group after the other where that is not the same as all together.
  const bool levels = step_tolerance_of(world.settings) > Real(0);
  return (world.diagnostics.ledger && !levels) || resolves_worst_first(world);
}

// What a row ties, in a few bytes: rows are long, and are read once, by all threads.
struct RowEnds {
  std::uint32_t first = 0, last = 0;  // dense; equal where the other one is the world itself
  bool plain = true;
};

RowEnds ends_of(const WorldState& world, const ContactRow<Real>& row) {
  const std::uint32_t first = std::min(row.body_a, row.body_b);
  const std::uint32_t last = std::max(row.body_a, row.body_b);
  return {first == 0 ? last : first, last, is_plain(world, row)};  // the world itself ties nothing
}

// What is known of a body, or of all from it to the last one that rows tie to it.
struct Tie {
  std::uint32_t last = 0;                           // dense
  std::uint32_t rows = 0;                           // that end here: hold no earlier body
  bool special = false;                             // takes part in a stage of its own
  Real approach = 0;                                // [m/s] the fastest of what begins to touch
  Real longest = std::numeric_limits<Real>::max();  // [s] substep that its contacts bear
};

class Grouping {
 public:
  explicit Grouping(WorldState& world)
      : world_(world),
        groups_(world.groups),
        group_of_(world.groups.group_of),
        ends_(world.rows.size(), &world.memory),
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
    for (Run& run : runs_) end_run(run);
    deal_rows();
  }

 private:
  void mark(std::uint32_t row) {
    const ContactRow<Real>& r = world_.rows[row];
    ties_[r.body_a].special = ties_[r.body_b].special = true;
  }

  void tie_by_rows() {
    const auto count = static_cast<std::uint32_t>(world_.rows.size());
    parallel_for(world_, count, tolerance::kRowGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) ends_[k] = ends_of(world_, world_.rows[k]);
    });
    for (const RowEnds& row : ends_) {
      Tie& tie = ties_[row.first];
      tie.last = std::max(tie.last, row.last);
      ++tie.rows;
      tie.special = tie.special || !row.plain;
    }
    for (std::uint32_t k = 0; levels_ && k < count; ++k) {
      const ContactRow<Real>& row = world_.rows[k];
      Tie& tie = ties_[ends_[k].first];
      tie.approach = std::max(tie.approach, row.approach_speed);
      tie.longest = std::min(tie.longest, longest_substep(world_, row));
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
    Real approach = 0, longest = std::numeric_limits<Real>::max();
    for (std::uint32_t i = begin; i < end; ++i) {
      rows += ties_[i].rows;
      special = special || ties_[i].special;
      approach = std::max(approach, ties_[i].approach);
      longest = std::min(longest, ties_[i].longest);
    }
    // What has no rows flies: no substep concerns it.
    if (special || rows > tolerance::kMostRowsApart || rows == 0) return;
    const int halvings =
        levels_ ? halvings_for(world_, wanted_halvings(begin, end), approach, longest) : 0;
    Run& run = runs_[halvings];
    if (run.rows == 0) {
      groups_.apart.push_back({.bodies = {begin, end}, .rows = {}, .halvings = halvings});
      run.number = static_cast<std::uint32_t>(groups_.apart.size());
    }
    groups_.apart[run.number - 1].bodies.end = end;
    run.rows += rows;
    std::fill(group_of_.begin() + begin, group_of_.begin() + end, run.number);
    if (run.rows >= most_rows_) end_run(run);
  }

  [[nodiscard]] int wanted_halvings(std::uint32_t begin, std::uint32_t end) const {
    int wanted = kMostHalvings;
    for (std::uint32_t i = begin; i < end; ++i)
      wanted = std::min(wanted, int{world_.bodies.info[world_.bodies.slot_of[i]].level.halvings});
    return wanted;
  }

  // A group that is being gathered; one for each level of detail.
  struct Run {
    std::uint32_t number = 0, rows = 0;
  };
  void end_run(Run& run) {
    if (run.rows == 0) return;
    if (run.rows < fewest_rows_) {  // nothing is left of it
      IndexRange& bodies = groups_.apart[run.number - 1].bodies;
      std::replace(group_of_.begin() + bodies.begin, group_of_.begin() + bodies.end, run.number,
                   kTogether);
      bodies.end = bodies.begin;
    }
    run = {};
  }

  void deal_rows() {
    const auto count = static_cast<std::uint32_t>(world_.rows.size());
    StepList<std::uint32_t> group_of_row(count, kTogether, &world_.memory);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t group = group_of_[ends_[k].last];
      group_of_row[k] = group;
      if (group != kTogether) ++groups_.apart[group - 1].rows.end;
    }
    std::uint32_t before = 0;
    for (StepGroups::Apart& apart : groups_.apart) {
      const std::uint32_t of_group = apart.rows.end;
      apart.rows = {before, before};
      before += of_group;
    }
    groups_.rows.resize(before);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (const std::uint32_t group = group_of_row[k]; group == kTogether) {
        groups_.together.rows.push_back(k);
      } else {
        groups_.rows[groups_.apart[group - 1].rows.end++] = k;
      }
    }
  }

  WorldState& world_;
  StepGroups& groups_;
  static constexpr int kMostHalvings = 6;  // of 64 substeps
  // With levels of detail every island counts, and the ledger is kept of few groups.
  const bool levels_ = step_tolerance_of(world_.settings) > Real(0);
  const std::uint32_t fewest_rows_ = levels_ ? 1 : tolerance::kFewestRowsApart;
  const std::uint32_t most_rows_ =
      world_.diagnostics.ledger ? std::numeric_limits<std::uint32_t>::max() : tolerance::kRowsApart;
  std::vector<std::uint32_t>& group_of_;
  StepList<RowEnds> ends_;  // per row
  StepList<Tie> ties_;      // per dense body
  Run runs_[kMostHalvings + 1];
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
  groups.together.substeps = world.settings.substeps;
  groups.together.h = world.h;
  groups.together.jobs = world.jobs;
  find_bouncing_bodies(world);
  const bool levels = step_tolerance_of(world.settings) > Real(0);
  if ((levels || world.rows.size() >= 2 * tolerance::kFewestRowsApart) && !concerns_all(world)) {
    Grouping(world).group();
    return;
  }
  groups.together.rows.resize(world.rows.size());
  for (std::uint32_t k = 0; k < world.rows.size(); ++k) groups.together.rows[k] = k;
}

}  // namespace plumb::inline PLUMB_ABI::detail
