#include "plumb/replay/recorder.h"

#include <time.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>

#include "plumb/world.h"
#include "record/body_table.h"
#include "record/contact_marks.h"
#include "record/effect_list.h"
#include "record/frame_queue.h"
#include "record/joint_marks.h"
#include "record/labels.h"
#include "record/ledger_plots.h"
#include "record/plots.h"
#include "record/replay_tables.h"
#include "record/spring_marks.h"
#include "record/text_log.h"
#include "record/travel.h"
#include "record/view_layout.h"
#include "record/visuals.h"
#include "record/water.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay {

// The stepping thread copies each step into a frame; another thread encodes the
// frames and hands them to the writer. What is encoded with the world at hand,
// because bodies came or went, waits until the encoder has nothing left to do.
class Recorder::Run {
 public:
  explicit Run(const RecorderOptions& options)
      : options_(options),
        text_log_(options.event_lines_per_step),
        queue_([this](detail::Frame& frame) { encode(frame, nullptr); }) {}

  Outcome open();
  void attach(const PhysicsWorld& world);
  void step(const StepView& view);
  Outcome flush(double timeout, bool durable);
  Outcome close(double timeout);
  void fail(std::string why);
  [[nodiscard]] Outcome status() const;

  rrd::Writer writer_;
  RecorderCost cost_;
  detail::Visuals visuals_;
  detail::Labels labels_;

 private:
  void copy(const StepView& view, detail::Frame& frame);
  void copy_plan_changes(const PhysicsWorld& world, detail::Frame& frame);
  // `world`: where it may be looked at; null on the encoding thread.
  void encode(detail::Frame& frame, const PhysicsWorld* world);
  void read_image(detail::Frame& frame) const;
  void encode_scene(const detail::Frame& frame, const PhysicsWorld* world);
  void give_effects(detail::Frame& frame);
  void add_plots(const detail::Frame& frame);
  void show_all_places();
  void send();
  [[nodiscard]] bool scene_changed(const detail::Frame& frame, const PhysicsWorld& world) const;

  RecorderOptions options_;
  detail::ReplayTables replay_;
  detail::BodyTable bodies_;
  detail::ContactMarks contacts_;
  detail::JointMarks joints_;
  detail::SpringMarks springs_;
  detail::Water water_;
  detail::Travel travel_;
  detail::Plots plots_;
  detail::LedgerPlots ledger_plots_;
  bool shows_ledger_ = false;  // the layout has tabs for them
  detail::TextLog text_log_;
  detail::SceneExtent extent_;
  int rows_ = 0;

  detail::EffectList effects_;    // of the stepping thread
  std::uint64_t planned_ = 0;     // items of the plan as told last
  bool effects_changed_ = false;  // and no frame has told it yet
  bool attached_ = false;
  std::uint64_t last_step_ = 0;
  int steps_since_snapshot_ = 0;

  mutable std::mutex failure_mutex_;
  std::atomic<bool> ok_ = true;
  Outcome failed_;
  detail::FrameQueue queue_;  // last: its thread uses all the others
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
  const std::lock_guard lock(failure_mutex_);
  if (!ok_) return;
  failed_ = Outcome::failed(std::move(why));
  ok_ = false;
}

Outcome Recorder::Run::status() const {
  if (ok_) return {};
  const std::lock_guard lock(failure_mutex_);
  return failed_;
}

void Recorder::Run::attach(const PhysicsWorld& world) {
  if (!ok_) return;
  if (attached_) return fail("this recorder has recorded a world already: use a new one");
  attached_ = true;
  last_step_ = world.step_count();
  detail::Frame frame;
  frame.number = world.step_count();
  frame.time = world.time();
  world.copy_body_states(frame.bodies);
  extent_ = detail::extent_of(world, frame);
  travel_.begin(extent_);
  if (options_.visuals) effects_.collect(world);
  if (!effects_.empty()) give_effects(frame);
  shows_ledger_ = options_.plots && world.diagnostics().ledger;
  detail::send_layout(writer_, extent_, options_, shows_ledger_);
  if (options_.contacts) contacts_.send_looks(writer_, world, frame, extent_);
  if (options_.plots) plots_.send_names(writer_);
  replay_.send_head(writer_, options_, world);
  replay_.send_snapshot(writer_, world.save(), frame.number, frame.time);
  if (options_.visuals) encode_scene(frame, &world);
  if (options_.body_states) bodies_.add(frame);
  if (options_.text_log) {
    planned_ = world.planned_items();
    text_log_.add_plan(world.plan(), frame);
  }
  if (const Outcome sent = writer_.status(); !sent.ok()) fail(sent.error);
}

// Whether something was done that changes what is to be drawn, or where what
// never moves stands.
bool Recorder::Run::scene_changed(const detail::Frame& frame, const PhysicsWorld& world) const {
  if (!frame.broken.empty()) return true;
  for (const InputRecord& input : frame.inputs) {
    switch (input.kind) {
      case InputKind::CreateBody:
      case InputKind::DestroyBody:
      case InputKind::CreateCollider:
      case InputKind::DestroyCollider:
      case InputKind::SetMotionType:
      case InputKind::SetShape:
      case InputKind::SetLocalPose:
      case InputKind::SetSensor:
      case InputKind::CreateJoint:
      case InputKind::DestroyJoint:
      case InputKind::SetSettings:
        return true;
      case InputKind::SetPose: {
        const BodyState body = world.state(BodyId::from_value(input.target));
        if (body.id && body.type == MotionType::Static) return true;
        break;
      }
      default:
        break;
    }
  }
  return false;
}

void Recorder::Run::copy(const StepView& view, detail::Frame& frame) {
  const PhysicsWorld& world = view.world;
  frame.number = world.step_count();
  frame.time = world.time();
  frame.moved = frame.number != last_step_;
  frame.report = view.report;
  frame.inputs.assign(view.inputs.begin(), view.inputs.end());
  const Events& events = view.events;
  frame.hits.assign(events.hits.begin(), events.hits.end());
  frame.touches.assign(events.contacts.begin(), events.contacts.end());
  frame.sensors.assign(events.sensors.begin(), events.sensors.end());
  frame.sleep.assign(events.sleep.begin(), events.sleep.end());
  frame.refused.assign(events.quarantined.begin(), events.quarantined.end());
  frame.broken.assign(events.broken_joints.begin(), events.broken_joints.end());
  frame.has_snapshot = false;
  frame.effects_changed = false;
  if (options_.visuals) effects_changed_ |= effects_.follow(frame.inputs, world);
  if (!frame.moved) return;
  if (effects_changed_) give_effects(frame);
  if (options_.text_log) copy_plan_changes(world, frame);
  world.copy_image(frame.image);
  frame.profiled = world.settings().profiling;
  frame.ledger = world.diagnostics().ledger;
  frame.has_snapshot = ++steps_since_snapshot_ >= options_.snapshot_every;
  if (!frame.has_snapshot) return;
  steps_since_snapshot_ = 0;
  world.save(frame.snapshot);
}

// To ask for the plan costs a look at every body and pair: more than all the rest of a frame, if
// it were done at every step. Words are made only for what changed.
void Recorder::Run::copy_plan_changes(const PhysicsWorld& world, detail::Frame& frame) {
  frame.plan.clear();
  if (world.step_count() % RecorderOptions::kPlanEvery != 0) return;
  const std::uint64_t planned = world.planned_items(), changed = planned ^ planned_;
  planned_ = planned;
  if (changed == 0) return;
  for (PlanDecision& decision : world.plan().decisions)
    if ((changed & bit_of(decision.item)) != 0) frame.plan.push_back(std::move(decision));
}

void Recorder::Run::step(const StepView& view) {
  if (!attached_ || !ok_) return;
  const std::uint64_t step = view.world.step_count();
  if (step != last_step_ && step != last_step_ + 1) {
    queue_.drain();  // what came before is sound
    return fail("step " + std::to_string(step) + " follows step " + std::to_string(last_step_) +
                ": the world was restored while it was recorded; use a new "
                "recorder for what follows");
  }
  std::unique_ptr<detail::Frame> frame =
      queue_.take_empty(steps_since_snapshot_ + 1 >= options_.snapshot_every);
  copy(view, *frame);
  last_step_ = step;
  if (frame->moved) {
    cost_.steps += 1;
    cost_.body_steps += view.world.body_count();
  }
  if (frame->moved && scene_changed(*frame, view.world)) {
    if (!effects_.empty()) give_effects(*frame);  // bodies stand in other places of the list
    queue_.drain();
    encode(*frame, &view.world);
  } else {
    queue_.push(std::move(frame));
  }
}

void Recorder::Run::give_effects(detail::Frame& frame) {
  effects_.copy_to(frame.effects);
  frame.effects_changed = true;
  effects_changed_ = false;
}

void Recorder::Run::encode_scene(const detail::Frame& frame, const PhysicsWorld* world) {
  if (world) {
    visuals_.rebuild(writer_, *world, frame, extent_);
    joints_.rebuild(writer_, *world, frame, extent_);
    labels_.rebuild(writer_, *world, frame);
  } else {
    visuals_.add(frame);
    joints_.add(frame);
    labels_.add(frame);
  }
  if (frame.effects_changed) {
    springs_.rebuild(writer_, frame, extent_);
    water_.rebuild(writer_, frame, extent_);
  } else {
    springs_.add(frame);
  }
  travel_.add(frame);
}

// Whoever left the first view is seen in another one, and in water that reaches so far.
void Recorder::Run::show_all_places() {
  using View = detail::Travel::View;
  const View view = travel_.view();
  if (view == View::AsBegun || !ok_) return;
  const detail::SceneExtent everywhere = travel_.everywhere();
  water_.widen(everywhere);
  detail::FartherView farther;
  farther.grid_height = water_.height(extent_.up).value_or(travel_.lowest());
  if (view == View::Following) {
    farther.followed = travel_.middle_entity();
    travel_.send_middle(writer_);
  }
  detail::send_layout(writer_, travel_.seen(), options_, shows_ledger_, farther);
}

void Recorder::Run::read_image(detail::Frame& frame) const {
  frame.image.copy_body_states(frame.bodies);
  if (options_.contacts) frame.image.copy_contact_points(frame.contacts);
  if (options_.plots) frame.energy = frame.image.energy();
  frame.state_hash = frame.image.motion_hash();
}

void Recorder::Run::add_plots(const detail::Frame& frame) {
  plots_.add(frame);
  if (!frame.ledger) return;
  ledger_plots_.add(frame);
  if (shows_ledger_) return;
  shows_ledger_ = true;
  detail::send_layout(writer_, extent_, options_, shows_ledger_);
}

void Recorder::Run::encode(detail::Frame& frame, const PhysicsWorld* world) {
  if (!ok_) return;
  try {
    replay_.add_inputs(frame.inputs);
    if (options_.text_log) text_log_.add_events(frame);
    if (!frame.moved) return;
    read_image(frame);
    if (options_.visuals) encode_scene(frame, world);
    if (options_.text_log) text_log_.add_plan_changes(frame);
    if (options_.contacts) contacts_.add(frame);
    if (options_.plots) add_plots(frame);
    if (options_.body_states) bodies_.add(frame);
    replay_.add_step(frame.report, frame.state_hash);
    if (++rows_ >= options_.rows_per_chunk) send();
    if (frame.has_snapshot) {
      send();  // a snapshot never stands before the steps that lead to it
      replay_.send_snapshot(writer_, frame.snapshot, frame.number, frame.time);
    }
    if (const Outcome sent = writer_.status(); !sent.ok()) fail(sent.error);
  } catch (const std::exception& error) {
    fail(std::string("recording stopped: ") + error.what());
  }
}

void Recorder::Run::send() {
  rows_ = 0;
  replay_.send(writer_);
  bodies_.send(writer_);
  visuals_.send(writer_);
  joints_.send(writer_);
  springs_.send(writer_);
  water_.send(writer_);
  labels_.send(writer_);
  contacts_.send(writer_);
  plots_.send(writer_);
  ledger_plots_.send(writer_);
  text_log_.send(writer_);
}

Outcome Recorder::Run::flush(double timeout, bool durable) {
  queue_.drain();
  send();
  const Outcome flushed = writer_.flush(timeout, durable);
  if (const Outcome sent = writer_.status(); !sent.ok()) fail(sent.error);
  return flushed.ok() ? status() : flushed;
}

Outcome Recorder::Run::close(double timeout) {
  queue_.drain();
  if (!writer_.is_open()) return status();
  if (options_.visuals) show_all_places();
  send();
  const Outcome closed = writer_.close(timeout);
  if (!closed.ok()) fail(closed.error);
  return closed.ok() ? status() : closed;
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

void Recorder::label(BodyId body, std::string text) {
  if (run_) run_->labels_.set(body, std::move(text));
}

void Recorder::label(JointId joint, std::string text) {
  if (run_) run_->labels_.set(joint, std::move(text));
}

Outcome Recorder::flush(double timeout, bool durable) {
  return run_ ? run_->flush(timeout, durable) : Outcome::failed("no recording is open");
}

Outcome Recorder::close(double timeout) {
  return run_ ? run_->close(timeout) : Outcome::failed("no recording is open");
}

Outcome Recorder::status() const {
  return run_ ? run_->status() : Outcome::failed("no recording is open");
}

RecorderCost Recorder::cost() const { return run_ ? run_->cost_ : RecorderCost{}; }

std::uint64_t Recorder::bytes_written() const { return run_ ? run_->writer_.bytes_written() : 0; }

// Nothing that recording lacks, memory least of all, may pass into the step
// that is being recorded.
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
