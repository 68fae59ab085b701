// The plan, and what happened, as lines of text.
#pragma once

#include <string>

#include "plumb/world.h"
#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class TextLog {
 public:
  explicit TextLog(int event_lines_per_step);
  // Only when it differs from the one before.
  void add_plan(const PhysicsWorld& world, const Frame& frame);
  void add_events(const Frame& frame);
  void send(rrd::Writer& writer) { table_.send(writer); }

 private:
  void add_line(const Frame& frame, const char* level, const std::string& text);
  bool takes_line();

  rrd::Table table_;
  int lines_per_step_;
  int lines_in_step_ = 0;
  std::string last_plan_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
