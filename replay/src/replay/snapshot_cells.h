// Puts a snapshot together again from the cells of its row.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plumb/snapshot.h"
#include "rrd/reader.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class SnapshotCells {
 public:
  // Cells of one row follow each other; a cell of another frame begins a new snapshot.
  void add(const rrd::Cell& cell);
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  // Columns in their order; what is missing or of a wrong type is named in the outcome.
  struct Result {
    rrd::Outcome outcome;
    Snapshot snapshot;
  };
  [[nodiscard]] Result take();

 private:
  std::uint64_t frame_ = 0;
  std::uint32_t schema_version_ = 0;
  std::string precision_;
  std::vector<std::string> order_;
  std::map<std::string, SnapshotColumn, std::less<>> columns_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
