// The complete state of a world as named columns: restoring one and stepping on gives the same bits
// as never having stopped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

// Rows of `width` values each. A float passes through double unchanged.
struct SnapshotColumn {
  std::string name;  // "body.position", "pair.impulse", ...
  std::uint32_t width = 1;
  enum class Type : std::uint8_t { Float64, Uint64 } type = Type::Float64;
  std::vector<double> reals;            // used when type is Float64
  std::vector<std::uint64_t> integers;  // used when type is Uint64
  friend bool operator==(const SnapshotColumn&, const SnapshotColumn&) = default;
};

struct Snapshot {
  static constexpr std::uint32_t kSchemaVersion = 7;
  std::uint32_t schema_version = kSchemaVersion;
  std::string precision;  // "f32", "f32d" or "f64": restored by the same build only
  std::vector<SnapshotColumn> columns;

  [[nodiscard]] const SnapshotColumn* find(const std::string& name) const {
    for (const SnapshotColumn& column : columns)
      if (column.name == name) return &column;
    return nullptr;
  }
  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

}  // namespace plumb::inline PLUMB_ABI
