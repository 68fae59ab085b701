#include "plumb/replay/recorder.h"

#include <time.h>

#include <chrono>
#include <exception>

#include "plumb/world.h"
#include "record/body_table.h"
#include "record/contact_marks.h"
#include "record/plots.h"
#include "record/replay_tables.h"
#include "record/text_log.h"
#include "record/view_layout.h"
#include "record/visuals.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

class Recorder::Run {
 public:
  explicit Run(const RecorderOptions& options)
      : options_(options), text_log_(options.event_lines_per_step) {}

  Outcome open();
  void attach(const PhysicsWorld& world);
  void step(const StepView& view);
  void send();
  void fail(std::string why);
  [[nodiscard]] Outcome status() const { return failed_.ok() ? writer_.status() : failed_; }

  rrd::Writer writer_;
  RecorderCost cost_;
  detail::Visuals visuals_;

 private:
  detail::Frame frame_of(const PhysicsWorld& world);
  void send_looks(const detail::Frame& frame);
  [[nodiscard]] bool scene_changed(std::span<const InputRecord> inputs) const;

  RecorderOptions options_;
  detail::ReplayTables replay_;
  detail::BodyTable bodies_;
  detail::ContactMarks contacts_;
  detail::Plots plots_;
  detail::TextLog text_log_;

  std::vector<BodyState> states_;
  detail::SceneExtent extent_;
  Outcome failed_;
  bool attached_ = false;
  std::uint64_t last_step_ = 0;
  int rows_ = 0;
  int steps_since_snapshot_ = 0;
};

namespace {

double thread_cpu_seconds() {
  constexpr double kSecondsPerNanosecond = 1e-9;
  timespec now{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
  return static_cast<double>(now.tv_sec) + kSecondsPerNanosecond * static_cast<double>(now.tv_nsec);
}

// Adds the time between its making and its end.
class Stopwatch {
 public:
  explicit Stopwatch(RecorderCost& cost) : cost_(cost) {}
  ~Stopwatch() {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    cost_.seconds += taken.count();
    cost_.cpu_seconds += thread_cpu_seconds() - cpu_begin_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  RecorderCost& cost_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = thread_cpu_seconds();
};

}  // namespace

Outcome Recorder::Run::open() {
  const auto refuse = [](const char* why) { return Outcome::failed(why); };
  if (options_.path.empty()) return refuse("the recording has no path");
  if (options_.snapshot_every < 1) return refuse("snapshot_every must be at least 1");
  if (options_.rows_per_chunk < 1) return refuse("rows_per_chunk must be at least 1");
  if (options_.event_lines_per_step < 0) return refuse("event_lines_per_step is negative");
  if (!(options_.frames_per_second > 0)) return refuse("frames_per_second must be above 0");
  const std::string& name = options_.name.empty() ? options_.path : options_.name;
  return writer_.open(options_.path, options_.application_id, name);
}

void Recorder::Run::fail(std::string why) {
  if (failed_.ok()) failed_ = Outcome::failed(std::move(why));
}

detail::Frame Recorder::Run::frame_of(const PhysicsWorld& world) {
  world.copy_body_states(states_);
  return {world, world.step_count(), world.time(), states_};
}

void Recorder::Run::send_looks(const detail::Frame& frame) {
  extent_ = detail::extent_of(frame);
  detail::send_layout(writer_, extent_, options_);
  if (options_.contacts) contacts_.send_looks(writer_, frame, extent_);
  if (options_.plots) plots_.send_names(writer_);
}

void Recorder::Run::attach(const PhysicsWorld& world) {
  if (!status().ok()) return;
  if (attached_) return fail("this recorder has recorded a world already: use a new one");
  attached_ = true;
  last_step_ = world.step_count();
  const detail::Frame frame = frame_of(world);
  send_looks(frame);
  replay_.send_head(writer_, options_, world);
  replay_.send_snapshot(writer_, world);
  if (options_.visuals) visuals_.rebuild(writer_, frame, extent_);
  if (options_.body_states) bodies_.add(frame);
  if (options_.text_log) text_log_.add_plan(frame);
}

// Whether something was done that changes what is to be drawn, or where what never moves stands.
bool Recorder::Run::scene_changed(std::span<const InputRecord> inputs) const {
  for (const InputRecord& input : inputs) {
    switch (input.kind) {
      case InputKind::CreateBody:
      case InputKind::DestroyBody:
      case InputKind::CreateCollider:
      case InputKind::DestroyCollider:
      case InputKind::SetSettings:
        return true;
      case InputKind::SetPose: {
        const std::uint32_t index = BodyId::from_value(input.target).index;
        for (const BodyState& body : states_)
          if (body.id.index == index && body.type == MotionType::Static) return true;
        break;
      }
      default:
        break;
    }
  }
  return false;
}

void Recorder::Run::step(const StepView& view) {
  if (!attached_ || !status().ok()) return;
  replay_.add_inputs(view.inputs);
  const detail::Frame frame = frame_of(view.world);
  if (options_.text_log) text_log_.add_events(frame, view.events, view.report);
  const std::uint64_t step = view.world.step_count();
  if (step == last_step_) return;  // refused, or of no length: nothing moved
  if (step != last_step_ + 1)
    return fail(
        "step " + std::to_string(step) + " follows step " + std::to_string(last_step_) +
        ": the world was restored while it was recorded; use a new recorder for what follows");
  last_step_ = step;

  const bool changed = scene_changed(view.inputs);
  if (options_.visuals && changed) visuals_.rebuild(writer_, frame, extent_);
  if (options_.visuals && !changed) visuals_.add(frame);
  if (options_.text_log && changed) text_log_.add_plan(frame);
  if (options_.contacts) contacts_.add(frame, view.report.dt);
  if (options_.plots) plots_.add(frame, view.report);
  if (options_.body_states) bodies_.add(frame);
  replay_.add_step(view.report, view.world.state_hash());
  cost_.steps += 1;
  cost_.body_steps += frame.bodies.size();

  if (++rows_ >= options_.rows_per_chunk) send();
  if (++steps_since_snapshot_ >= options_.snapshot_every) {
    steps_since_snapshot_ = 0;
    send();  // a snapshot never stands before the steps that lead to it
    replay_.send_snapshot(writer_, view.world);
  }
}

void Recorder::Run::send() {
  rows_ = 0;
  replay_.send(writer_);
  bodies_.send(writer_);
  visuals_.send(writer_);
  contacts_.send(writer_);
  plots_.send(writer_);
  text_log_.send(writer_);
}

Recorder::Recorder() = default;
Recorder::~Recorder() {
  if (run_) (void)close();
}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Outcome Recorder::open(const RecorderOptions& options) {
  if (run_ && run_->writer_.is_open())
    return Outcome::failed("a recording is open already: close it first");
  run_ = std::make_unique<Run>(options);
  return run_->open();
}

void Recorder::show_as(BodyId body, std::shared_ptr<const VisualMesh> mesh) {
  if (run_) run_->visuals_.show_as(body, std::move(mesh));
}

Outcome Recorder::flush(double timeout, bool durable) {
  if (!run_) return Outcome::failed("no recording is open");
  run_->send();
  const Outcome flushed = run_->writer_.flush(timeout, durable);
  return flushed.ok() ? run_->status() : flushed;
}

Outcome Recorder::close(double timeout) {
  if (!run_) return Outcome::failed("no recording is open");
  if (!run_->writer_.is_open()) return run_->status();
  run_->send();
  const Outcome closed = run_->writer_.close(timeout);
  return closed.ok() ? run_->status() : closed;
}

Outcome Recorder::status() const {
  return run_ ? run_->status() : Outcome::failed("no recording is open");
}

RecorderCost Recorder::cost() const { return run_ ? run_->cost_ : RecorderCost{}; }

std::uint64_t Recorder::bytes_written() const { return run_ ? run_->writer_.bytes_written() : 0; }

// Nothing that recording lacks, memory least of all, may pass into the step that is being recorded.
void Recorder::on_attach(const PhysicsWorld& world) {
  if (!run_) return;
  try {
    run_->attach(world);
  } catch (const std::exception& error) {
    run_->fail(std::string("recording stopped: ") + error.what());
  }
}

void Recorder::on_step(const StepView& view) {
  if (!run_) return;
  const Stopwatch stopwatch(run_->cost_);
  try {
    run_->step(view);
  } catch (const std::exception& error) {
    run_->fail(std::string("recording stopped: ") + error.what());
  }
}

}  // namespace replay
}  // namespace plumb::inline PLUMB_ABI
