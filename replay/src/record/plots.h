// Numbers over time: energies, counts, the deepest overlap, and what each stage of the step costs.
#pragma once

#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class Plots {
 public:
  Plots();
  void send_names(rrd::Writer& writer);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  rrd::Table energy_, counts_, overlap_, timing_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
