// Where energy and momentum went, step by step, as curves: the ledger of StepReport, for the steps
// in which StepDiagnostics::ledger was on.
#pragma once

#include <array>

#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class LedgerPlots {
 public:
  LedgerPlots();
  void add(const Frame& frame);
  // With the names of the curves before the first of them.
  void send(rrd::Writer& writer);

 private:
  void send_names(rrd::Writer& writer);

  rrd::Table energy_;
  std::array<rrd::Table, 3> momentum_;  // along x, y, z
  bool begun_ = false;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
