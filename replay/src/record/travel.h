// Where the moving bodies went in the whole run, and from where that is best seen. A twentieth of
// them on each side of each axis counts as strays, so that one that falls off the edge of the world
// does not take the view with it.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "record/frame.h"
#include "record/visuals.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class Travel {
 public:
  enum class View {
    AsBegun,    // they stayed where the first view shows them
    Wider,      // one that shows all the places
    Following,  // they went far together: one that goes with their middle
  };

  Travel();
  void begin(const SceneExtent& first) { first_ = first; }
  void add(const Frame& frame);

  [[nodiscard]] View view() const;
  // What a wider view shows, or one that follows at its begin.
  [[nodiscard]] SceneExtent seen() const;
  // Of all places where they were.
  [[nodiscard]] SceneExtent everywhere() const;
  [[nodiscard]] double lowest() const;  // [m] along up

  // The middle in each step, for the eye to follow; only who needs it sends it.
  [[nodiscard]] const std::string& middle_entity() const { return middle_.entity(); }
  void send_middle(rrd::Writer& writer) { middle_.send(writer); }

 private:
  SceneExtent first_;
  Eigen::AlignedBox3d went_;                                // [m]
  Eigen::Vector3d first_middle_ = Eigen::Vector3d::Zero();  // [m]
  double widest_ = 0;                                       // [m] radius of the box of one step
  rrd::Table middle_;
  std::vector<double> along_[3];  // scratch: coordinates of one step
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
