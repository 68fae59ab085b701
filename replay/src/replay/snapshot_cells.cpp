#include "replay/snapshot_cells.h"

#include <string_view>

#include "schema.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

namespace names = rrd::schema::snapshot;

void SnapshotCells::add(const rrd::Cell& cell) {
  const std::uint64_t frame = cell.frame().value_or(0);
  if (frame != frame_) *this = SnapshotCells();
  frame_ = frame;
  const std::string_view component = cell.component();
  if (component == names::kVersion) {
    if (const auto version = cell.numbers<std::uint32_t>(); !version.empty())
      schema_version_ = version[0];
  } else if (component == names::kPrecision) {
    precision_ = cell.text(0);
  } else if (component == names::kNames) {
    order_.clear();
    for (std::size_t i = 0; i < cell.instances(); ++i) order_.emplace_back(cell.text(i));
  } else if (component.starts_with(names::kColumnPrefix)) {
    SnapshotColumn column;
    column.name = component.substr(std::string_view(names::kColumnPrefix).size());
    column.width = cell.width();
    if (cell.type() == PLUMB_RR_U64) {
      const auto numbers = cell.numbers<std::uint64_t>();
      column.type = SnapshotColumn::Type::Uint64;
      column.integers.assign(numbers.begin(), numbers.end());
    } else {
      const auto numbers = cell.numbers<double>();
      column.type = SnapshotColumn::Type::Float64;
      column.reals.assign(numbers.begin(), numbers.end());
    }
    columns_.insert_or_assign(column.name, std::move(column));
  }
}

SnapshotCells::Result SnapshotCells::take() {
  Result result;
  result.snapshot.schema_version = schema_version_;
  result.snapshot.precision = precision_;
  for (const std::string& name : order_) {
    const auto found = columns_.find(name);
    if (found == columns_.end()) {
      result.outcome = rrd::Outcome::failed("the snapshot at frame " + std::to_string(frame_) +
                                            " lacks its column " + name);
      return result;
    }
    result.snapshot.columns.push_back(std::move(found->second));
  }
  columns_.clear();
  return result;
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
