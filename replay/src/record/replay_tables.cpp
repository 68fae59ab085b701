#include "record/replay_tables.h"

#include "rrd/writer.h"
#include "schema.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

namespace schema = rrd::schema;

ReplayTables::ReplayTables()
    : steps_(schema::step::kEntity),
      inputs_(schema::input::kEntity),
      dt_(steps_.add_column<double>(schema::step::kDt)),
      time_(steps_.add_column<double>(schema::step::kTime)),
      state_hash_(steps_.add_column<std::uint64_t>(schema::step::kStateHash)),
      kinds_(inputs_.add_column<std::uint32_t>(schema::input::kKinds)),
      targets_(inputs_.add_column<std::uint64_t>(schema::input::kTargets)),
      lengths_(inputs_.add_column<std::uint32_t>(schema::input::kLengths)),
      numbers_(inputs_.add_column<double>(schema::input::kNumbers)) {}

void ReplayTables::send_head(rrd::Writer& writer, const RecorderOptions& options,
                             const PhysicsWorld& world) {
  namespace names = schema::recording;
  rrd::Table head(names::kEntity);
  const std::size_t version = head.add_column<std::uint32_t>(names::kSchemaVersion);
  const std::size_t precision = head.add_text_column(names::kPrecision);
  const std::size_t scene = head.add_text_column(names::kScene);
  const std::size_t first = head.add_column<std::uint64_t>(names::kFirstFrame);
  const std::size_t every = head.add_column<std::uint32_t>(names::kSnapshotEvery);
  head.column(version).append_one(schema::kVersion);
  head.column(precision).append_text(kPrecisionName);
  head.column(scene).append_text(options.scene);
  head.column(first).append_one(world.step_count());
  head.column(every).append_one(static_cast<std::uint32_t>(options.snapshot_every));
  head.send_static(writer);
}

void ReplayTables::send_snapshot(rrd::Writer& writer, const Snapshot& snapshot, std::uint64_t step,
                                 double time) {
  namespace names = schema::snapshot;
  rrd::Table table(names::kEntity);
  const std::size_t version = table.add_column<std::uint32_t>(names::kVersion);
  const std::size_t precision = table.add_text_column(names::kPrecision);
  const std::size_t columns = table.add_text_column(names::kNames);
  table.column(version).append_one(snapshot.schema_version);
  table.column(precision).append_text(snapshot.precision);
  for (const SnapshotColumn& column : snapshot.columns) {
    table.column(columns).append_text(column.name);
    const std::string component = names::kColumnPrefix + column.name;
    if (column.type == SnapshotColumn::Type::Float64) {
      const std::size_t at = table.add_column<double>(component, column.width);
      table.column(at).append(std::span<const double>(column.reals));
    } else {
      const std::size_t at = table.add_column<std::uint64_t>(component, column.width);
      table.column(at).append(std::span<const std::uint64_t>(column.integers));
    }
  }
  table.end_row(step, time);
  table.send(writer);
}

void ReplayTables::add_inputs(std::span<const InputRecord> inputs) {
  for (const InputRecord& input : inputs) {
    inputs_.column(kinds_).append_one(static_cast<std::uint32_t>(input.kind));
    inputs_.column(targets_).append_one(input.target);
    inputs_.column(lengths_).append_one(static_cast<std::uint32_t>(input.numbers.size()));
    inputs_.column(numbers_).append(std::span<const double>(input.numbers));
    has_inputs_ = true;
  }
}

void ReplayTables::add_step(const StepReport& report, std::uint64_t state_hash) {
  if (has_inputs_) inputs_.end_row(report.step, report.time);
  has_inputs_ = false;
  steps_.column(dt_).append_one(report.dt);
  steps_.column(time_).append_one(report.time);
  steps_.column(state_hash_).append_one(state_hash);
  steps_.end_row(report.step, report.time);
}

void ReplayTables::send(rrd::Writer& writer) {
  inputs_.send(writer);
  steps_.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
