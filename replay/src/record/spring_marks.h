// Springs and bungees that are effects: a line from end to end.
#pragma once

#include <vector>

#include "record/frame.h"
#include "record/line_batch.h"
#include "record/visuals.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class SpringMarks {
 public:
  SpringMarks();

  // Takes the frame's effects instead of those before and adds the frame.
  void rebuild(rrd::Writer& writer, const Frame& frame, const SceneExtent& extent);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  LineBatch lines_;
  std::vector<AnchoredLine> parts_;
  bool announced_ = false;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
