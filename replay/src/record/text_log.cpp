#include "record/text_log.h"

#include <cstdio>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

std::string body_name(BodyId body) { return "body " + std::to_string(body.index); }
std::string collider_name(ColliderId collider) {
  return "collider " + std::to_string(collider.index);
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", x);
  return text;
}

}  // namespace

TextLog::TextLog(int event_lines_per_step) : table_("log"), lines_per_step_(event_lines_per_step) {
  table_.add_text_column("TextLog:text");
  table_.add_text_column("TextLog:level");
}

void TextLog::add_line(const Frame& frame, const char* level, const std::string& text) {
  table_.column(0).append_text(text);
  table_.column(1).append_text(level);
  table_.end_row(frame.number, frame.time);
}

// Counts an event, and says whether its line is still to be written: the others cost no text.
bool TextLog::takes_line() { return ++lines_in_step_ <= lines_per_step_; }

void TextLog::add_decision(const PlanDecision& decision, const Frame& frame, const char* level) {
  std::string text = std::string("plan: ") + name_of(decision.item) +
                     (decision.active ? " on: " : " off: ") + decision.reason;
  if (!decision.loss.empty()) text += "; lost: " + decision.loss;
  add_line(frame, level, text);
}

void TextLog::add_plan(const StepPlan& plan, const Frame& frame) {
  for (const PlanDecision& decision : plan.decisions)
    add_decision(decision, frame, decision.active ? "INFO" : "DEBUG");
}

void TextLog::add_plan_changes(const Frame& frame) {
  for (const PlanDecision& decision : frame.plan) add_decision(decision, frame, "INFO");
}

void TextLog::add_events(const Frame& frame) {
  const Events events = frame.events();
  lines_in_step_ = 0;
  if (!frame.report.status.ok())
    add_line(frame, "ERROR", std::string("step refused: ") + frame.report.status.message);
  for (const QuarantineEvent& event : events.quarantined)
    add_line(frame, "ERROR", body_name(event.body) + ": not finite, put back and disabled");
  for (const JointBreakEvent& event : events.broken_joints)
    add_line(frame, "WARN", "joint " + std::to_string(event.joint.index) + " breaks");
  for (const HitEvent& event : events.hits)
    if (takes_line())
      add_line(frame, "INFO",
               body_name(event.body_a) + " hits " + body_name(event.body_b) + " at " +
                   short_number(event.approach_speed) + " m/s, " + short_number(event.impulse) +
                   " N s");
  for (const SensorEvent& event : events.sensors)
    if (takes_line())
      add_line(
          frame, "INFO",
          collider_name(event.other) +
              (event.kind == SensorEvent::Kind::Enter ? " enters sensor " : " leaves sensor ") +
              std::to_string(event.sensor.index));
  for (const SleepEvent& event : events.sleep)
    if (takes_line())
      add_line(frame, "DEBUG",
               body_name(event.body) + (event.fell_asleep ? " falls asleep" : " wakes"));
  for (const ContactEvent& event : events.contacts)
    if (takes_line())
      add_line(frame, "TRACE",
               body_name(event.body_a) +
                   (event.kind == ContactEvent::Kind::Begin ? " touches " : " leaves ") +
                   body_name(event.body_b));
  if (lines_in_step_ > lines_per_step_)
    add_line(frame, "INFO",
             "and " + std::to_string(lines_in_step_ - lines_per_step_) + " more events");
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
