#include "plumb/integration/fixed_step_loop.h"

#include <algorithm>
#include <cmath>

namespace plumb::inline PLUMB_ABI::integration {
namespace {

constexpr double kShortestStep = 1e-9;  // [s] below it the clock of no machine can feed the loop
constexpr double kLongestStep = 1e3;    // [s]
// Longer ticks, of a machine that slept or of a debugger that held the program, count as this much;
// the rest is dropped before it can reach the division into steps.
constexpr double kLongestTick = 1e5;  // [s] about a day

// a + b exactly, as the rounded sum and what the rounding lost [Knuth 1997].
struct ExactSum {
  double sum, lost;
};
ExactSum exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

Status check(const LoopSettings& settings) {
  if (!std::isfinite(settings.dt) || !std::isfinite(settings.time_scale))
    return {StatusCode::NotFinite, "the step length and the time scale must be finite numbers"};
  if (settings.dt < kShortestStep || settings.dt > kLongestStep)
    return {StatusCode::OutOfRange, "the step length must be from 1e-9 to 1e3 seconds"};
  if (settings.time_scale < 0)
    return {StatusCode::OutOfRange, "the time scale must not be negative: nothing runs backwards"};
  if (settings.max_steps_per_tick < 1)
    return {StatusCode::OutOfRange, "a tick must be allowed one step at least"};
  return {};
}

}  // namespace

FixedStepLoop::FixedStepLoop(PhysicsWorld& world, const LoopSettings& settings) : world_(world) {
  (void)set_settings(settings);
}

Status FixedStepLoop::set_settings(const LoopSettings& settings) {
  const Status status = check(settings);
  if (status.ok()) settings_ = settings;
  return status;
}

void FixedStepLoop::feed(double time) {
  const ExactSum total = exact_sum(high_, time);
  const ExactSum settled = exact_sum(total.sum, total.lost + low_);
  high_ = settled.sum;
  low_ = settled.lost;
}

double FixedStepLoop::take_whole_steps() {
  const double dt = settings_.dt;
  double count = std::floor(high_ / dt);
  if (count > 0) {
    // Minus count * dt exactly: the product and what its rounding lost.
    const double product = count * dt;
    const double lost = std::fma(count, dt, -product);
    feed(-product);
    feed(-lost);
  } else {
    count = 0;
  }
  // The quotient was rounded, so that it may be off by one either way.
  while (high_ > dt || (high_ == dt && low_ >= 0)) {
    feed(-dt);
    ++count;
  }
  while (high_ < 0 || (high_ == 0 && low_ < 0)) {
    feed(dt);
    --count;
  }
  return count;
}

double FixedStepLoop::alpha() const {
  // The quotient of a remainder just below dt can round up to 1.
  const double below_one = std::nextafter(1.0, 0.0);
  return std::clamp(remainder() / settings_.dt, 0.0, below_one);
}

Status FixedStepLoop::do_step() {
  for (std::size_t k = 0; k < before_.size(); ++k) before_[k](world_, settings_.dt);
  const Status status = world_.step(settings_.dt).status;
  if (!status.ok()) return status;
  ++step_total_;
  for (std::size_t k = 0; k < after_.size(); ++k) after_[k](world_, settings_.dt);
  return status;
}

TickReport FixedStepLoop::tick(double elapsed) {
  TickReport report;
  report.alpha = alpha();
  if (!std::isfinite(elapsed)) {
    report.status = {StatusCode::NotFinite, "the time since the last tick must be a finite number"};
    return report;
  }
  if (elapsed < 0) {
    report.status = {StatusCode::OutOfRange,
                     "the time since the last tick is negative; use a clock that never goes back"};
    return report;
  }
  if (paused_) {
    if (requested_ == 0) return report;
    --requested_;
    report.status = do_step();
    report.steps = report.status.ok() ? 1 : 0;
    return report;
  }

  const double scaled = elapsed * settings_.time_scale;
  const double fed = std::min(scaled, kLongestTick);
  feed(fed);
  const double due = take_whole_steps();
  const double allowed = std::min(due, static_cast<double>(settings_.max_steps_per_tick));
  // At most the time scale can make the product infinite; what is then dropped cannot be told.
  report.dropped = (scaled - fed) + (due - allowed) * settings_.dt;

  const int wanted = static_cast<int>(allowed);
  while (report.steps < wanted && report.status.ok() && !paused_) {
    report.status = do_step();
    if (report.status.ok()) ++report.steps;
  }
  // Steps that a hook or a refusal kept from being done.
  report.dropped += static_cast<double>(wanted - report.steps) * settings_.dt;
  dropped_total_ += report.dropped;
  report.alpha = alpha();
  return report;
}

}  // namespace plumb::inline PLUMB_ABI::integration
