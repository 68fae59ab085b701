// What the viewer shows when the recording is opened, and from where it looks at the scene.
#pragma once

#include "plumb/replay/recorder.h"
#include "record/visuals.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

void send_layout(rrd::Writer& writer, const SceneExtent& extent, const RecorderOptions& options);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
