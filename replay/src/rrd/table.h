// Rows of one entity, gathered until they are sent as one chunk: few large chunks cost far less to
// write and to read than many small ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rrd/plumb_rerun.h"

namespace plumb::rrd {

inline constexpr const char* kFrameTimeline = "frame";    // step number
inline constexpr const char* kTimeTimeline = "sim_time";  // simulated time

// The recorded type of a number type.
template <class T>
inline constexpr plumb_rr_type kTypeOf = [] {
  if constexpr (std::is_same_v<T, float>)
    return PLUMB_RR_F32;
  else if constexpr (std::is_same_v<T, double>)
    return PLUMB_RR_F64;
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return PLUMB_RR_U8;
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return PLUMB_RR_U32;
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return PLUMB_RR_U64;
}();

// Bytes that grow without being cleared first: what is extended is about to be written.
class GrowingBytes {
 public:
  std::byte* extend(std::size_t bytes) {
    if (size_ + bytes > capacity_) grow(size_ + bytes);
    std::byte* begin = data_.get() + size_;
    size_ += bytes;
    return begin;
  }
  void clear() { size_ = 0; }
  [[nodiscard]] const std::byte* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  void grow(std::size_t needed);

  std::unique_ptr<std::byte[]> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

// One component: for every row a list of instances, each of `width` numbers or one text.
class Column {
 public:
  Column(std::string component, plumb_rr_type type, std::uint32_t width)
      : component_(std::move(component)), type_(type), width_(width) {}

  // Room for more instances in the current row; T must be the column's type.
  template <class T>
  T* extend(std::size_t instances) {
    in_row_ += static_cast<std::uint32_t>(instances);
    return reinterpret_cast<T*>(bytes_.extend(instances * width_ * sizeof(T)));
  }
  template <class T>
  void append(std::span<const T> numbers) {
    T* out = extend<T>(numbers.size() / width_);
    if (!numbers.empty()) std::memcpy(out, numbers.data(), numbers.size_bytes());
  }
  template <class T>
  void append_one(const T& number) {
    append(std::span<const T>(&number, 1));
  }
  void append_text(std::string_view text);

 private:
  friend class Table;
  std::string component_;
  plumb_rr_type type_;
  std::uint32_t width_;
  GrowingBytes bytes_;
  std::vector<std::uint64_t> text_ends_;
  std::vector<std::uint32_t> counts_;  // instances of each ended row
  std::uint32_t in_row_ = 0;           // instances of the current row
  std::uint64_t instances_ = 0;        // of the ended rows
};

class Writer;

class Table {
 public:
  explicit Table(std::string entity) : entity_(std::move(entity)) {}

  // Columns are added before the first row; the index is how they are found again.
  template <class T>
  std::size_t add_column(std::string component, std::uint32_t width = 1) {
    columns_.emplace_back(std::move(component), kTypeOf<T>, width);
    return columns_.size() - 1;
  }
  std::size_t add_text_column(std::string component) {
    columns_.emplace_back(std::move(component), PLUMB_RR_TEXT, 1u);
    return columns_.size() - 1;
  }
  [[nodiscard]] Column& column(std::size_t index) { return columns_[index]; }

  // Ends the current row and stamps it: step number and simulated time [s].
  void end_row(std::uint64_t frame, double time);
  [[nodiscard]] std::size_t rows() const { return frames_.size(); }
  [[nodiscard]] const std::string& entity() const { return entity_; }

  // Sends all ended rows as one chunk and starts afresh. Nothing to send is no error.
  void send(Writer& writer);
  // Sends the current row as valid at all times.
  void send_static(Writer& writer);

 private:
  void send_rows(Writer& writer, std::size_t rows, bool is_static);

  std::string entity_;
  std::vector<Column> columns_;
  std::vector<std::int64_t> frames_, times_;
};

}  // namespace plumb::rrd
