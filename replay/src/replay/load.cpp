#include "replay/load.h"

#include <algorithm>

#include "replay/snapshot_cells.h"
#include "schema.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

namespace schema = rrd::schema;

template <class T>
T first_or(const rrd::Cell& cell, T otherwise) {
  const auto numbers = cell.numbers<T>();
  return numbers.empty() ? otherwise : numbers[0];
}

// The cells of one row of inputs, which arrive one component after the other.
struct InputRow {
  std::vector<std::uint32_t> kinds, lengths;
  std::vector<std::uint64_t> targets;
  std::vector<double> numbers;
};

template <class T>
void assign(std::vector<T>& out, const rrd::Cell& cell) {
  const auto numbers = cell.numbers<T>();
  out.assign(numbers.begin(), numbers.end());
}

class Loader {
 public:
  Loader(const std::string& path, std::uint64_t until) : path_(path), until_(until) {}

  bool visit(const rrd::Cell& cell) {
    const std::string_view entity = cell.entity();
    if (entity == schema::recording::kEntity) visit_head(cell);
    if (entity == schema::step::kEntity) visit_step(cell);
    if (entity == schema::input::kEntity) visit_input(cell);
    if (entity == schema::snapshot::kEntity) visit_snapshot(cell);
    if (entity == schema::body::kEntity && cell.component() == schema::body::kIds)
      out_.info.bodies = cell.instances();
    return true;
  }

  Recording finish(const rrd::ReadResult& read) {
    RecordingInfo& info = out_.info;
    info.finished = read.summary.finished;
    info.file_bytes = read.summary.file_bytes;
    info.cut_bytes = read.summary.cut_bytes;
    info.application_id = read.summary.application_id;
    info.recording_id = read.summary.recording_id;
    // First, because what could not be decoded explains all that is missing.
    if (!read.outcome.ok()) fail(read.outcome.error);
    keep_snapshot();
    take_steps();
    take_inputs();
    check();
    if (!failure_.empty()) info.outcome = Outcome::failed(failure_);
    return std::move(out_);
  }

 private:
  void fail(const std::string& why) {
    if (failure_.empty()) failure_ = why;
  }
  void visit_head(const rrd::Cell& cell);
  void visit_step(const rrd::Cell& cell);
  void visit_input(const rrd::Cell& cell);
  void visit_snapshot(const rrd::Cell& cell);
  void keep_snapshot();
  void take_steps();
  void take_inputs();
  void check();

  std::string path_;
  std::uint64_t until_;
  Recording out_;
  std::string failure_;
  bool has_head_ = false;
  std::map<std::uint64_t, RecordedStep> steps_;
  std::map<std::uint64_t, InputRow> inputs_;
  SnapshotCells snapshot_;
  bool has_snapshot_cells_ = false;
};

void Loader::visit_head(const rrd::Cell& cell) {
  namespace names = schema::recording;
  has_head_ = true;
  const std::string_view component = cell.component();
  if (component == names::kSchemaVersion)
    out_.info.schema_version = first_or<std::uint32_t>(cell, 0);
  if (component == names::kPrecision) out_.info.precision = cell.text(0);
  if (component == names::kScene) out_.info.scene = cell.text(0);
  if (component == names::kFirstFrame) out_.info.first_frame = first_or<std::uint64_t>(cell, 0);
}

void Loader::visit_step(const rrd::Cell& cell) {
  const auto frame = cell.frame();
  if (!frame) return;
  RecordedStep& step = steps_[*frame];
  step.frame = *frame;
  if (cell.component() == schema::step::kDt) step.dt = first_or<double>(cell, 0);
  if (cell.component() == schema::step::kTime) step.time = first_or<double>(cell, 0);
  if (cell.component() == schema::step::kStateHash)
    step.state_hash = first_or<std::uint64_t>(cell, 0);
}

void Loader::visit_input(const rrd::Cell& cell) {
  const auto frame = cell.frame();
  if (!frame) return;
  InputRow& row = inputs_[*frame];
  if (cell.component() == schema::input::kKinds) assign(row.kinds, cell);
  if (cell.component() == schema::input::kTargets) assign(row.targets, cell);
  if (cell.component() == schema::input::kLengths) assign(row.lengths, cell);
  if (cell.component() == schema::input::kNumbers) assign(row.numbers, cell);
}

void Loader::visit_snapshot(const rrd::Cell& cell) {
  const auto frame = cell.frame();
  if (!frame) return;
  if (has_snapshot_cells_ && *frame != snapshot_.frame()) keep_snapshot();
  if (!has_snapshot_cells_) ++out_.info.snapshots;
  snapshot_.add(cell);
  has_snapshot_cells_ = true;
}

// The snapshot whose cells were just read to their end, if it is the first or the nearest yet.
void Loader::keep_snapshot() {
  if (!has_snapshot_cells_) return;
  has_snapshot_cells_ = false;
  const std::uint64_t frame = snapshot_.frame();
  if (out_.snapshot && (frame > until_ || frame < out_.snapshot_frame)) return;
  SnapshotCells::Result taken = snapshot_.take();
  if (!taken.outcome.ok()) return fail(path_ + ": " + taken.outcome.error);
  out_.snapshot = std::move(taken.snapshot);
  out_.snapshot_frame = frame;
}

void Loader::take_steps() {
  for (const auto& [frame, step] : steps_) out_.steps.push_back(step);
  out_.info.steps = out_.steps.size();
  out_.info.last_frame = out_.info.first_frame;
  if (out_.steps.empty()) return;
  out_.info.last_frame = out_.steps.back().frame;
  out_.info.seconds = out_.steps.back().time - out_.steps.front().time + out_.steps.front().dt;
}

void Loader::take_inputs() {
  for (const auto& [frame, row] : inputs_) {
    std::size_t at = 0;
    if (row.targets.size() != row.kinds.size() || row.lengths.size() != row.kinds.size())
      return fail(path_ + ": the inputs at frame " + std::to_string(frame) + " are damaged");
    std::vector<InputRecord>& records = out_.inputs[frame];
    for (std::size_t i = 0; i < row.kinds.size(); ++i) {
      const std::size_t length = row.lengths[i];
      if (row.numbers.size() - at < length)
        return fail(path_ + ": the inputs at frame " + std::to_string(frame) + " are damaged");
      const auto begin = row.numbers.begin() + static_cast<std::ptrdiff_t>(at);
      records.push_back({static_cast<InputKind>(row.kinds[i]),
                         row.targets[i],
                         {begin, begin + static_cast<std::ptrdiff_t>(length)}});
      at += length;
    }
    out_.info.inputs += records.size();
  }
}

void Loader::check() {
  const RecordingInfo& info = out_.info;
  if (!has_head_)
    return fail(
        path_ + ": holds nothing under " + schema::recording::kEntity +
        ", so it was not written by Plumb's recorder, or was cut off before its first step");
  if (info.schema_version != schema::kVersion)
    return fail(path_ + ": has schema version " + std::to_string(info.schema_version) +
                ", this program reads version " + std::to_string(schema::kVersion) +
                "; use the release of Plumb that wrote it");
  for (std::size_t i = 0; i < out_.steps.size(); ++i)
    if (out_.steps[i].frame != info.first_frame + 1 + i)
      return fail(path_ + ": lacks step " + std::to_string(info.first_frame + 1 + i));
}

}  // namespace

Recording load(const std::string& path, std::uint64_t until) {
  Loader loader(path, until);
  const rrd::ReadResult read =
      rrd::read(path, schema::kPrefix, [&](const rrd::Cell& cell) { return loader.visit(cell); });
  return loader.finish(read);
}

std::optional<BodyRow> load_bodies(const std::string& path, std::uint64_t frame) {
  namespace names = schema::body;
  BodyRow row;
  const rrd::ReadResult read = rrd::read(path, names::kEntity, [&](const rrd::Cell& cell) {
    if (cell.frame() != frame) return true;
    const std::string_view component = cell.component();
    if (component == names::kIds) assign(row.ids, cell);
    if (component == names::kAwake) assign(row.awake, cell);
    if (component == names::kPosition) assign(row.position, cell);
    if (component == names::kOrientation) assign(row.orientation, cell);
    if (component == names::kLinearVelocity) assign(row.linear_velocity, cell);
    if (component == names::kAngularVelocity) assign(row.angular_velocity, cell);
    return true;
  });
  const std::size_t n = row.ids.size();
  const bool whole = n > 0 && row.awake.size() == n && row.position.size() == 3 * n &&
                     row.orientation.size() == 4 * n && row.linear_velocity.size() == 3 * n &&
                     row.angular_velocity.size() == 3 * n;
  if (!whole) return std::nullopt;
  return row;
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
