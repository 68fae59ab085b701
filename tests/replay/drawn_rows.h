// What a recording shows of one entity, by step.
#pragma once

#include <map>

#include "recorded_run.h"

namespace plumb::inline PLUMB_ABI {
namespace replay_test {

// The numbers of one component by step; the last row of a step counts.
template <class T>
std::map<std::uint64_t, std::vector<T>> rows_of(const std::string& path, const std::string& entity,
                                                const std::string& component) {
  std::map<std::uint64_t, std::vector<T>> rows;
  const auto read = rrd::read(path, entity, [&](const rrd::Cell& cell) {
    if (cell.component() != component || !cell.frame()) return true;
    const auto numbers = cell.numbers<T>();
    rows[*cell.frame()].assign(numbers.begin(), numbers.end());
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  return rows;
}

}  // namespace replay_test
}  // namespace plumb::inline PLUMB_ABI
