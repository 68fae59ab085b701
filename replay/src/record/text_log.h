// The plan, and what happened, as lines of text.
#pragma once

#include <string>

#include "plumb/plan.h"
#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class TextLog {
 public:
  explicit TextLog(int event_lines_per_step);
  // The whole plan.
  void add_plan(const StepPlan& plan, const Frame& frame);
  // What of it went on or off.
  void add_plan_changes(const Frame& frame);
  void add_events(const Frame& frame);
  void send(rrd::Writer& writer) { table_.send(writer); }

 private:
  void add_decision(const PlanDecision& decision, const Frame& frame, const char* level);
  void add_line(const Frame& frame, const char* level, const std::string& text);
  bool takes_line();

  rrd::Table table_;
  int lines_per_step_;
  int lines_in_step_ = 0;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
