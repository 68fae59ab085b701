// What a replay needs: the scene, every step with its hash, every input, and exact snapshots.
#pragma once

#include "plumb/replay/recorder.h"
#include "plumb/world.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class ReplayTables {
 public:
  ReplayTables();

  void send_head(rrd::Writer& writer, const RecorderOptions& options, const PhysicsWorld& world);
  void send_snapshot(rrd::Writer& writer, const Snapshot& snapshot, std::uint64_t step,
                     double time);
  // Inputs that were given before a step belong to the row of that step.
  void add_inputs(std::span<const InputRecord> inputs);
  void add_step(const StepReport& report, std::uint64_t state_hash);
  void send(rrd::Writer& writer);

 private:
  rrd::Table steps_, inputs_;
  std::size_t dt_, time_, state_hash_;
  std::size_t kinds_, targets_, lengths_, numbers_;
  bool has_inputs_ = false;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
