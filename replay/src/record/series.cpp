#include "record/series.h"

#include <array>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

namespace {

// As many as the curves of one plot at most, each unlike the others. 0xRRGGBBAA
constexpr std::array<std::uint32_t, 12> kCurveColors{
    0x4e9fe6ff, 0xf2a541ff, 0x5fbf7fff, 0xe0666aff, 0xa487d8ff, 0x4fc1c0ff,
    0xd9c14aff, 0xdd86b8ff, 0x9fb35aff, 0xb7f24aff, 0x8a8f98ff, 0xb07a52ff};

}  // namespace

rrd::Table series_table(const char* entity) {
  rrd::Table table(entity);
  table.add_column<double>("Scalars:scalars");
  return table;
}

void send_series(rrd::Writer& writer, const std::string& entity,
                 const std::vector<std::string>& names) {
  rrd::Table table(entity);
  const std::size_t column = table.add_text_column("SeriesLines:names");
  const std::size_t colors = table.add_column<std::uint32_t>("SeriesLines:colors");
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.column(column).append_text(names[i]);
    table.column(colors).append_one(kCurveColors[i % kCurveColors.size()]);
  }
  table.send_static(writer);
}

void add_row(rrd::Table& table, const Frame& frame, std::span<const double> values) {
  table.column(0).append(values);
  table.end_row(frame.number, frame.time);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
