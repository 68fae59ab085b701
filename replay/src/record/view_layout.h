// What the viewer shows when the recording is opened, and from where it looks at the scene.
#pragma once

#include <optional>
#include <string>

#include "plumb/replay/recorder.h"
#include "record/visuals.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// A view of more than the scene as it began.
struct FartherView {
  std::string followed;    // entity that the eye goes with; empty: it stays
  double grid_height = 0;  // [m] along up, of a grid of lines that shows how far things go
};

// The later layout of a recording is the one that is shown. ledger: with tabs for LedgerPlots.
void send_layout(rrd::Writer& writer, const SceneExtent& extent, const RecorderOptions& options,
                 bool ledger, const std::optional<FartherView>& farther = {});

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
