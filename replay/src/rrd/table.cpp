#include "rrd/table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rrd/writer.h"

namespace plumb::rrd {

void GrowingBytes::grow(std::size_t needed) {
  const std::size_t capacity = std::max(needed, capacity_ * 2);
  auto larger = std::make_unique_for_overwrite<std::byte[]>(capacity);
  if (size_ > 0) std::memcpy(larger.get(), data_.get(), size_);
  data_ = std::move(larger);
  capacity_ = capacity;
}

void Column::append_text(std::string_view text) {
  if (!text.empty()) std::memcpy(bytes_.extend(text.size()), text.data(), text.size());
  text_ends_.push_back(bytes_.size());
  ++in_row_;
}

void Table::end_row(std::uint64_t frame, double time) {
  constexpr double kNanosecondsPerSecond = 1e9;
  frames_.push_back(static_cast<std::int64_t>(frame));
  times_.push_back(std::llround(time * kNanosecondsPerSecond));
  for (Column& column : columns_) {
    column.counts_.push_back(column.in_row_);
    column.instances_ += column.in_row_;
    column.in_row_ = 0;
  }
}

void Table::send(Writer& writer) {
  if (rows() > 0) send_rows(writer, rows(), false);
}

void Table::send_static(Writer& writer) {
  end_row(0, 0);
  send_rows(writer, 1, true);
}

void Table::send_rows(Writer& writer, std::size_t rows, bool is_static) {
  std::vector<plumb_rr_column> columns;
  columns.reserve(columns_.size());
  for (const Column& column : columns_)
    columns.push_back({column.component_.c_str(), static_cast<std::uint32_t>(column.type_),
                       column.width_, column.bytes_.data(), column.instances_,
                       column.counts_.data(), column.text_ends_.data()});
  const std::array<plumb_rr_timeline, 2> timelines{
      plumb_rr_timeline{kFrameTimeline, PLUMB_RR_SEQUENCE, frames_.data()},
      plumb_rr_timeline{kTimeTimeline, PLUMB_RR_DURATION, times_.data()}};
  writer.send({entity_.c_str(), rows, timelines.data(), is_static ? 0 : timelines.size(),
               columns.data(), columns.size()});
  for (Column& column : columns_) {
    column.bytes_.clear();
    column.text_ends_.clear();
    column.counts_.clear();
    column.instances_ = 0;
    column.in_row_ = 0;
  }
  frames_.clear();
  times_.clear();
}

}  // namespace plumb::rrd
