// Curves over time: the rows of one entity, each with a number for every curve.
#pragma once

#include <string>
#include <vector>

#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// A table for them.
rrd::Table series_table(const char* entity);
// What the curves are called, with their units, and their colours; once.
void send_series(rrd::Writer& writer, const std::string& entity,
                 const std::vector<std::string>& names);
void add_row(rrd::Table& table, const Frame& frame, std::span<const double> values);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
