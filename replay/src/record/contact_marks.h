// Contact points and, from each, its normal as an arrow: as long as a mean body's radius where it
// carries a mean body's weight.
#pragma once

#include <vector>

#include "plumb/world.h"
#include "record/frame.h"
#include "record/visuals.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class ContactMarks {
 public:
  ContactMarks();

  void send_looks(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
                  const SceneExtent& extent);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  rrd::Table points_, arrows_;
  double meters_per_newton_ = 0;  // [m/N]
  double longest_ = 0;            // [m] of an arrow
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
