#include "record/shape_batch.h"

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

// Rerun's FillMode.
constexpr std::uint8_t kOutline = 1, kSolid = 3;

const char* archetype_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::Box:
      return "Boxes3D";
    case Primitive::Sphere:
      return "Ellipsoids3D";
    case Primitive::Capsule:
      return "Capsules3D";
  }
  return "";
}

std::string entity_of(Primitive primitive, Role role) {
  const char* roles[] = {"world/moving/", "world/static/", "world/outlines/"};
  const char* names[] = {"boxes", "spheres", "capsules"};
  return std::string(roles[static_cast<int>(role)]) + names[static_cast<int>(primitive)];
}

// The columns of each table, in this order.
enum SizeColumn : std::size_t { kFill, kSize, kRadius };
enum PoseColumn : std::size_t { kCenter, kQuaternion };

}  // namespace

ShapeBatch::ShapeBatch(Primitive primitive, Role role)
    : primitive_(primitive),
      role_(role),
      sizes_(entity_of(primitive, role)),
      poses_(entity_of(primitive, role)),
      colors_(entity_of(primitive, role)) {
  const std::string archetype = archetype_of(primitive) + std::string(":");
  sizes_.add_column<std::uint8_t>(archetype + "fill_mode");
  if (primitive == Primitive::Capsule) {
    sizes_.add_column<float>(archetype + "lengths");
    sizes_.add_column<float>(archetype + "radii");
    poses_.add_column<float>(archetype + "translations", 3);
  } else {
    sizes_.add_column<float>(archetype + "half_sizes", 3);
    poses_.add_column<float>(archetype + "centers", 3);
  }
  poses_.add_column<float>(archetype + "quaternions", 4);
  colors_.add_column<std::uint32_t>(archetype + "colors");
}

void ShapeBatch::clear_parts() {
  parts_.clear();
  part_sizes_.clear();
  awake_.clear();
}

void ShapeBatch::add_part(const PlacedPart& part, const Eigen::Vector3f& size) {
  PlacedPart placed = part;
  if (primitive_ == Primitive::Capsule) {
    // Rerun's capsule runs from its origin along z; ours is centred and runs along y.
    const Quat z_to_y(Eigen::AngleAxis<Real>(Real(-EIGEN_PI / 2), Vec3::UnitX()));
    placed.pose.position -= placed.pose.orientation * Vec3(0, Real(size[0]), 0);
    placed.pose.orientation = placed.pose.orientation * z_to_y;
    placed.at_body_frame = false;
  }
  parts_.push_back(placed);
  part_sizes_.push_back(size);
}

void ShapeBatch::announce(rrd::Writer& writer, const Frame& frame) {
  if (parts_.empty() && !announced_) return;  // never had any
  announced_ = true;
  send(writer);  // rows with the old parts come first
  sizes_.column(kFill).append_one(role_ == Role::Outline ? kOutline : kSolid);
  for (const Eigen::Vector3f& size : part_sizes_) {
    if (primitive_ == Primitive::Capsule) {
      sizes_.column(kSize).append_one(2 * size[0]);
      sizes_.column(kRadius).append_one(size[1]);
    } else {
      sizes_.column(kSize).append(std::span<const float>(size.data(), 3));
    }
  }
  sizes_.end_row(frame.number, frame.time);
  (void)awake_changed(frame);
  add_colors(frame);
  add_poses(frame);
  send(writer);
}

bool ShapeBatch::awake_changed(const Frame& frame) {
  bool changed = awake_.size() != parts_.size();
  awake_.resize(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool awake = frame.bodies[parts_[i].slot].awake;
    changed |= awake_[i] != awake;
    awake_[i] = awake;
  }
  return changed;
}

void ShapeBatch::add_colors(const Frame& frame) {
  auto* color = colors_.column(0).extend<std::uint32_t>(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    *color++ = role_ != Role::Moving || awake_[i] ? parts_[i].color : kAsleepColor;
  colors_.end_row(frame.number, frame.time);
}

void ShapeBatch::add_poses(const Frame& frame) {
  auto* center = poses_.column(kCenter).extend<float>(parts_.size());
  auto* quaternion = poses_.column(kQuaternion).extend<float>(parts_.size());
  for (const PlacedPart& part : parts_) {
    part.write_pose(frame.bodies, center, quaternion);
    center += 3;
    quaternion += 4;
  }
  poses_.end_row(frame.number, frame.time);
}

void ShapeBatch::add(const Frame& frame) {
  if (role_ == Role::Static || parts_.empty()) return;
  add_poses(frame);
  if (role_ == Role::Moving && awake_changed(frame)) add_colors(frame);
}

void ShapeBatch::send(rrd::Writer& writer) {
  sizes_.send(writer);
  poses_.send(writer);
  colors_.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
