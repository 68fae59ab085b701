// Exact states of all bodies that can move, a row a step.
#pragma once

#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class BodyTable {
 public:
  BodyTable();
  void add(const Frame& frame);
  void send(rrd::Writer& writer) { table_.send(writer); }

 private:
  rrd::Table table_;
  std::size_t ids_, awake_, position_, orientation_, linear_velocity_, angular_velocity_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
