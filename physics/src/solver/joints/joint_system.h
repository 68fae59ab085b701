// The joints of a piece as one linear system, solved directly.
//
//   (J M^-1 J^T + C) l = r       one unknown a row; rows that do not act are left out
//
// Block (i, j) is empty unless joints i and j share a body. Eliminated from the leaves of a tree of
// bodies towards its root the factors have no block that the matrix has not [Baraff 1996;
// Featherstone 2008]: a chain of n joints costs n. Loops add some. Everything is in double: a chain
// with a heavy end, or a joint far from a small body, leaves single precision no digits.
#pragma once

#include <vector>

#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

struct SystemBlock {
  double at[kMaxJointRows][kMaxJointRows];
};

// A row of the running solve.
struct SystemRow {
  bool acts = false;
  unsigned laws = 0;  // bit p: RowPart p acts along a free row
  int rigid = -1;     // the one of them that is rigid, if any
  double give = 0;    // C: compliance of what acts along the row
  double value = 0;   // r, then l
  double size = 0;    // of the diagonal before anything is eliminated
  // [m/s] or [rad/s] as the laws were chosen: the row's rate, and by how much it misses each part.
  Real rate = 0;
  Real lack[kRowParts] = {};
};

// Joints that are solved together: a connected group, or one joint of a group that is too wide.
struct JointPiece {
  std::uint32_t begin = 0, end = 0;  // blocks, in the order of elimination
  bool whole = true;                 // no joint outside of it shares a body with it
  bool loops = false;                // some may hold what others hold already
  bool anchored = false;             // some hold on to what does not move
  // None of its bodies touches anything: it is a whole group and goes through the substep by
  // itself.
  bool split = false;
  Real h = 0;           // [s] its substep
  bool newton = false;  // solved with the contacts of its island (solver/newton)
  // Substeps of its own within this step, beyond the world's: taken, asked for, and the most of
  // them that it asked for at once.
  std::uint32_t own_substeps = 0, wanted_substeps = 0, most_wanted = 1;
};

struct JointSystem {
  std::vector<JointPiece> pieces;
  // Column i of the factor: blocks (entry_row[e], i) for e in [column[i], column[i + 1]), rows
  // ascending.
  std::vector<std::uint32_t> column, entry_row;
  std::vector<SystemBlock> diagonal;     // per block of the joints
  std::vector<SystemBlock> entry, work;  // per entry
  std::vector<SystemRow> rows;           // kMaxJointRows per block
};

// Matrix and factors of a piece, from its blocks' Jacobians and what its rows say.
void factor_piece(JointSystem& system, const std::vector<JointBlock>& blocks,
                  const JointPiece& piece);
// Right-hand sides to impulses, in rows.value.
void solve_factored(JointSystem& system, const std::vector<JointBlock>& blocks,
                    const JointPiece& piece);

}  // namespace plumb::inline PLUMB_ABI::detail
