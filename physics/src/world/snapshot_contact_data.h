// The table of material pairs and the excluded pairs in a snapshot. Empty ones have no columns.
#pragma once

#include "world/snapshot_table.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

void save_contact_data(ColumnWriter& out, const WorldState& world);
bool restore_contact_data(const Snapshot& in, WorldState& world);  // colliders are there already

}  // namespace plumb::inline PLUMB_ABI::detail
