// A recording being read: RAII and C++ types over the C interface of the Rerun bridge.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plumb/replay/outcome.h"
#include "rrd/table.h"

namespace plumb::rrd {

// One component of one row; valid during the visit only.
class Cell {
 public:
  explicit Cell(const plumb_rr_cell& cell) : cell_(cell) {}

  [[nodiscard]] std::string_view entity() const { return cell_.entity; }
  [[nodiscard]] std::string_view component() const { return cell_.component; }
  [[nodiscard]] plumb_rr_type type() const { return static_cast<plumb_rr_type>(cell_.type); }
  [[nodiscard]] std::uint32_t width() const { return cell_.width; }
  [[nodiscard]] std::size_t instances() const { return cell_.instances; }
  [[nodiscard]] bool is_static() const { return cell_.time_count == 0; }
  // The step number of the row, where it has one.
  [[nodiscard]] std::optional<std::uint64_t> frame() const;

  // All numbers of the cell; empty when it holds another type.
  template <class T>
  [[nodiscard]] std::span<const T> numbers() const {
    if (type() != kTypeOf<T>) return {};
    return {static_cast<const T*>(cell_.data), instances() * width()};
  }
  [[nodiscard]] std::string_view text(std::size_t instance) const;

 private:
  const plumb_rr_cell& cell_;
};

struct Summary {
  bool finished = false;  // closed by its writer
  std::uint64_t file_bytes = 0;
  std::uint64_t cut_bytes = 0;  // of a last message that is not whole
  std::uint64_t chunks = 0;
  std::string application_id, recording_id;
};

struct ReadResult {
  Outcome outcome;
  Summary summary;
};

// Visits the cells of all entities that begin with the prefix, in the order they were written,
// until the visitor returns false.
ReadResult read(const std::string& path, const std::string& entity_prefix,
                const std::function<bool(const Cell&)>& visit);

}  // namespace plumb::rrd
