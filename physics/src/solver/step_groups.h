// Groups of bodies that go through the substeps one group after the other. No row ties bodies of
// two groups, so each can go through all substeps by itself: a few hundred bodies with their rows
// stay in the processor's cache from the first substep to the last, and threads take whole groups.
// Which bodies go together is a question of speed only: every body and every row has the same bits.
//
//   apart      islands that lie near one another in memory and need no more than the plain passes
//              over rows and bodies
//   together   all others: large islands, whose colours are shared by the threads, and whatever
//              takes part in a stage of its own (joints, effects, bounces, the accurate solver,
//              ...)
#pragma once

#include <vector>

#include "solver/contact_blocks.h"
#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI {
class JobSystem;
}

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr std::uint32_t kTogether = 0;  // those that go apart are numbered from 1

// Bodies side by side in memory, as many as the kernel has lanes, and which of them are a group's.
struct BodyChunk {
  std::uint32_t first = 0;              // dense
  std::uint32_t kernel = 0, alone = 0;  // bits: taken by the kernel, by themselves
};

struct StepGroup {
  std::uint32_t number = kTogether;
  int halvings = 0;  // of the world's substeps (step_levels.h)
  int substeps = 0;
  Real h = 0;                            // [s] of each
  IndexRange bodies;                     // dense; others may lie among them
  std::vector<BodyChunk> chunks;         // that hold some of them (plain_bodies.h)
  std::vector<std::uint32_t> rows;       // ascending, so by colour
  std::vector<std::uint32_t> spun_rows;  // of them (turned_rows.h)
  ContactBlocks blocks;
  JobSystem* jobs = nullptr;     // who shares its loops
  std::uint32_t body_count = 0;  // only with a tolerance
};

struct StepGroups {
  StepGroup together;
  // Built, run and gone one after the other, in a StepGroup of the thread that runs it. Among their
  // bodies lie only such that go together, which are at rest meanwhile.
  struct Apart {
    IndexRange bodies, rows;       // dense; of `rows` below
    int halvings = 0;              // of the world's substeps
    bool spun = false;             // some body was set spinning
    std::uint32_t body_count = 0;  // only with a tolerance
  };
  std::vector<Apart> apart;
  std::vector<std::uint32_t> rows;      // of all that are apart
  std::vector<std::uint32_t> group_of;  // per dense body; the number of its group
  bool all_fly = false;                 // nothing holds any body that is awake
  std::vector<std::uint8_t> bounces;    // per dense body: may bounce; empty where nothing does
};

// Whether the row needs nothing but the plain passes.
bool is_plain(const WorldState& world, const ContactRow<Real>& row);

// Groups this step's bodies, once its rows are built.
void find_groups(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
