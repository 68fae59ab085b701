// Tables of a snapshot: one visitor lists a table's columns, and these two carry them out and back.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>

#include "plumb/snapshot.h"

namespace plumb::inline PLUMB_ABI::detail {

// Appends rows to columns that it makes with the first row. `rows`: how many will come.
class TableWriter {
 public:
  TableWriter(Snapshot& out, const char* table, std::size_t rows)
      : out_(out), table_(table), rows_(rows), first_(out.columns.size()) {}
  void next_row() { cursor_ = first_; }
  template <class... T>
  void operator()(const char* name, T&... values) {
    using First = std::tuple_element_t<0, std::tuple<T...>>;
    constexpr bool kIsReal = std::is_floating_point_v<First>;
    if (cursor_ == out_.columns.size()) {
      SnapshotColumn column;
      column.name = std::string(table_) + "." + name;
      column.width = sizeof...(T);
      column.type = kIsReal ? SnapshotColumn::Type::Float64 : SnapshotColumn::Type::Uint64;
      if constexpr (kIsReal) {
        column.reals.reserve(rows_ * sizeof...(T));
      } else {
        column.integers.reserve(rows_ * sizeof...(T));
      }
      out_.columns.push_back(std::move(column));
    }
    SnapshotColumn& column = out_.columns[cursor_++];
    if constexpr (kIsReal) {
      const double row[] = {static_cast<double>(values)...};
      column.reals.insert(column.reals.end(), row, row + sizeof...(T));
    } else {
      const std::uint64_t row[] = {static_cast<std::uint64_t>(values)...};
      column.integers.insert(column.integers.end(), row, row + sizeof...(T));
    }
  }

 private:
  Snapshot& out_;
  const char* table_;
  std::size_t rows_, first_, cursor_ = 0;
};

// Reads rows of the same columns; every mismatch makes it fail, never read outside.
class TableReader {
 public:
  TableReader(const Snapshot& in, const char* table) : in_(in), prefix_(std::string(table) + ".") {
    while (first_ < in.columns.size() && in.columns[first_].name.rfind(prefix_, 0) != 0) ++first_;
    if (first_ < in.columns.size()) {
      const SnapshotColumn& c = in.columns[first_];
      const std::size_t size =
          c.type == SnapshotColumn::Type::Float64 ? c.reals.size() : c.integers.size();
      rows_ = c.width > 0 ? size / c.width : 0;
    }
  }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] bool ok() const { return ok_; }
  void next_row() {
    cursor_ = first_;
    row_ = started_ ? row_ + 1 : 0;
    started_ = true;
  }
  template <class... T>
  void operator()(const char* name, T&... values) {
    using First = std::tuple_element_t<0, std::tuple<T...>>;
    constexpr bool kIsReal = std::is_floating_point_v<First>;
    constexpr std::size_t kWidth = sizeof...(T);
    if (cursor_ >= in_.columns.size()) {
      ok_ = false;
      return;
    }
    const SnapshotColumn& column = in_.columns[cursor_++];
    const bool real_column = column.type == SnapshotColumn::Type::Float64;
    const std::size_t size = real_column ? column.reals.size() : column.integers.size();
    if (column.name != prefix_ + name || column.width != kWidth || real_column != kIsReal ||
        size != rows_ * kWidth || row_ >= rows_) {
      ok_ = false;
      return;
    }
    std::size_t at = row_ * kWidth;
    if constexpr (kIsReal) {
      ((values = static_cast<T>(column.reals[at++])), ...);
    } else {
      ((values = static_cast<T>(column.integers[at++])), ...);
    }
  }

 private:
  const Snapshot& in_;
  std::string prefix_;
  std::size_t first_ = 0, cursor_ = 0, rows_ = 0, row_ = 0;
  bool started_ = false, ok_ = true;
};

}  // namespace plumb::inline PLUMB_ABI::detail
