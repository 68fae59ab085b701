// The surface of every water that bodies float in: a translucent square that covers the scene, a
// row whenever a water comes, goes or changes its level.
#pragma once

#include <optional>
#include <vector>

#include "record/frame.h"
#include "record/visuals.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class Water {
 public:
  Water();

  // Takes the frame's effects instead of those before.
  void rebuild(rrd::Writer& writer, const Frame& frame, const SceneExtent& extent);
  // Every row so far once more, for bodies that went further: the later row of a step holds.
  void widen(const SceneExtent& extent);
  void send(rrd::Writer& writer) { table_.send(writer); }

  // Of the first water, in the first row: the place on its axis `up` [m].
  [[nodiscard]] std::optional<double> height(const Eigen::Vector3d& up) const;

 private:
  struct Surface {
    Eigen::Vector3d normal;  // unit
    double level;            // [m] along it
    friend bool operator==(const Surface&, const Surface&) = default;
  };
  struct Row {
    std::uint64_t frame;
    double time;  // [s]
    std::vector<Surface> surfaces;
  };
  void add(const Row& row, const SceneExtent& extent);

  rrd::Table table_;
  std::vector<Row> rows_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
