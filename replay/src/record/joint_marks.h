// Joints as the eye wants them: lines from each body to where it is held and between these places,
// the ropes of pulleys, the axes of hinges and sliders as arrows.
#pragma once

#include <vector>

#include "plumb/world.h"
#include "record/anchor.h"
#include "record/frame.h"
#include "record/line_batch.h"
#include "record/visuals.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class JointMarks {
 public:
  JointMarks();

  // Looks for the joints of the world again and adds the frame.
  void rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
               const SceneExtent& extent);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  void add_joint(const PhysicsWorld& world, const Joint& joint, std::span<const std::size_t> slots);
  void send_looks(rrd::Writer& writer, const SceneExtent& extent);

  LineBatch lines_;
  rrd::Table axes_;
  std::vector<AnchoredLine> line_parts_;
  std::vector<Anchor> axis_parts_;
  double axis_length_ = 0;  // [m]
  bool announced_ = false;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
