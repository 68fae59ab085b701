// Tables of a snapshot: one visitor lists a table's columns, and these two carry them out and back.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>

#include "plumb/snapshot.h"

namespace plumb::inline PLUMB_ABI::detail {

// The columns of a snapshot in the order in which they are written.
class ColumnWriter {
 public:
  explicit ColumnWriter(Snapshot& out) : out_(out) {}
  // Those that are not written any more go.
  ~ColumnWriter() { out_.columns.resize(count_); }
  ColumnWriter(const ColumnWriter&) = delete;
  ColumnWriter& operator=(const ColumnWriter&) = delete;

  SnapshotColumn& add(const char* table, const char* name, std::size_t width, bool reals) {
    if (count_ == out_.columns.size()) out_.columns.emplace_back();
    SnapshotColumn& column = out_.columns[count_++];
    column.name.assign(table).append(".").append(name);
    column.width = static_cast<std::uint32_t>(width);
    column.type = reals ? SnapshotColumn::Type::Float64 : SnapshotColumn::Type::Uint64;
    column.reals.clear();
    column.integers.clear();
    return column;
  }
  SnapshotColumn& operator[](std::size_t i) { return out_.columns[i]; }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  Snapshot& out_;
  std::size_t count_ = 0;
};

// Writes `rows` rows to columns, of which the first row tells the names. Columns left over from an
// older snapshot give their storage.
class TableWriter {
 public:
  TableWriter(ColumnWriter& out, const char* table, std::size_t rows)
      : out_(out), table_(table), rows_(rows), first_(out.count()) {}
  void next_row() {
    row_ = started_ ? row_ + 1 : 0;
    started_ = true;
    cursor_ = first_;
  }
  template <class... T>
  void operator()(const char* name, T&... values) {
    using First = std::tuple_element_t<0, std::tuple<T...>>;
    constexpr std::size_t kWidth = sizeof...(T);
    if (row_ == 0) {
      SnapshotColumn& column = out_.add(table_, name, kWidth, std::is_floating_point_v<First>);
      if constexpr (std::is_floating_point_v<First>) {
        column.reals.resize(rows_ * kWidth);
      } else {
        column.integers.resize(rows_ * kWidth);
      }
    }
    SnapshotColumn& column = out_[cursor_++];
    std::size_t at = row_ * kWidth;
    if constexpr (std::is_floating_point_v<First>) {
      ((column.reals[at++] = static_cast<double>(values)), ...);
    } else {
      ((column.integers[at++] = static_cast<std::uint64_t>(values)), ...);
    }
  }
  // A column that need not be finite in a sound world: bounds of a half-space, and what is
  // remembered of the forces on a body that became non-finite and was taken out.
  template <class... T>
  void unbounded(const char* name, T&... values) {
    (*this)(name, values...);
  }

 private:
  ColumnWriter& out_;
  const char* table_;
  std::size_t rows_, first_, cursor_ = 0, row_ = 0;
  bool started_ = false;
};

// Reads rows of the same columns; every mismatch makes it fail, never read outside. So does a
// number that is not finite in the type it goes to, save in unbounded columns.
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
    unbounded(name, values...);
    if constexpr ((std::is_floating_point_v<T> && ...)) {
      if (!(std::isfinite(values) && ...)) ok_ = false;
    }
  }
  template <class... T>
  void unbounded(const char* name, T&... values) {
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
