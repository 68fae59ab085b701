// What a call of replay reports: nothing, or why it could not do what was asked.
#pragma once

#include <string>
#include <utility>

namespace plumb::rrd {

struct [[nodiscard]] Outcome {
  std::string error;  // empty: it worked; else what went wrong, where, and what would help

  [[nodiscard]] bool ok() const { return error.empty(); }
  explicit operator bool() const { return ok(); }
  static Outcome failed(std::string why) { return {std::move(why)}; }
};

}  // namespace plumb::rrd
