// Lines between places that follow their bodies, one entity for all: thin boxes, because those have
// their thickness in metres and are seen from every distance as what they are.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "record/anchor.h"
#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

struct AnchoredLine {
  Anchor from, to;
};

class LineBatch {
 public:
  explicit LineBatch(std::string entity);

  // thickness: half of a line's width [m]; color: 0xRRGGBBAA
  void send_look(rrd::Writer& writer, double thickness, std::uint32_t color);
  void add(const Frame& frame, std::span<const AnchoredLine> lines);
  void send(rrd::Writer& writer);

 private:
  rrd::Table table_;
  double thickness_ = 0;  // [m]
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
