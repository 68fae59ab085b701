// All boxes, all spheres or all capsules of one role as one entity: one row of poses a step, sizes
// only when they change, colours only when somebody wakes or falls asleep.
#pragma once

#include <vector>

#include "record/frame.h"
#include "record/placed_part.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

enum class Primitive { Box, Sphere, Capsule };
// Outlines are drawn of what would hide or be mistaken for the rest: sensors, towering walls.
enum class Role { Moving, Static, Outline };

class ShapeBatch {
 public:
  ShapeBatch(Primitive primitive, Role role);

  // Rebuilding: all parts are taken out, put in again, and announced with the next row.
  void clear_parts();
  // size: half extents; radius in each; half length and radius (third unused).
  void add_part(const PlacedPart& part, const Eigen::Vector3f& size);
  void announce(rrd::Writer& writer, const Frame& frame);

  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  void add_poses(const Frame& frame);
  void add_colors(const Frame& frame);
  [[nodiscard]] bool awake_changed(const Frame& frame);

  Primitive primitive_;
  Role role_;
  rrd::Table sizes_, poses_, colors_;
  std::vector<PlacedPart> parts_;
  std::vector<Eigen::Vector3f> part_sizes_;
  std::vector<bool> awake_;
  bool announced_ = false;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
