#include "record/joint_marks.h"

#include <algorithm>
#include <variant>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint32_t kLineColor = 0xf4f1e8ff, kAxisColor = 0xff4fa3ff;
// Thickness and length of the marks, in mean body radii.
constexpr double kLineRadius = 0.03, kAxisRadius = 0.03, kAxisLength = 0.9;

template <class Vector>
float* write(float* out, const Vector& v) {
  return std::transform(v.data(), v.data() + v.size(), out,
                        [](double x) { return static_cast<float>(x); });
}

// A line whose ends are held by a joint that does not let them coincide.
bool is_stretched(const JointKind& kind) {
  return !std::holds_alternative<BallJoint>(kind) && !std::holds_alternative<HingeJoint>(kind) &&
         !std::holds_alternative<FixedJoint>(kind) && !std::holds_alternative<PulleyJoint>(kind);
}

// The joints that a coupling couples; false if it is none.
bool coupled(const JointKind& kind, JointId& first, JointId& second) {
  if (const auto* gear = std::get_if<GearJoint>(&kind)) {
    first = gear->first;
    second = gear->second;
    return true;
  }
  const auto* rack = std::get_if<RackPinionJoint>(&kind);
  if (!rack) return false;
  first = rack->pinion;
  second = rack->rack;
  return true;
}

}  // namespace

JointMarks::JointMarks() : lines_("world/joints/lines"), axes_("world/joints/axes") {
  axes_.add_column<float>("Arrows3D:origins", 3);
  axes_.add_column<float>("Arrows3D:vectors", 3);
}

void JointMarks::send_looks(rrd::Writer& writer, const SceneExtent& extent) {
  axis_length_ = kAxisLength * extent.body_radius;
  lines_.send_look(writer, kLineRadius * extent.body_radius, kLineColor);
  rrd::Table axis(axes_.entity());
  const std::size_t radii = axis.add_column<float>("Arrows3D:radii");
  const std::size_t axis_color = axis.add_column<std::uint32_t>("Arrows3D:colors");
  axis.column(radii).append_one(static_cast<float>(kAxisRadius * extent.body_radius));
  axis.column(axis_color).append_one(kAxisColor);
  axis.send_static(writer);
}

void JointMarks::add_joint(const PhysicsWorld& world, const Joint& joint,
                           std::span<const std::size_t> slots) {
  JointId first, second;
  if (coupled(joint.kind, first, second)) {
    const Joint p = world.joint(first), q = world.joint(second);
    line_parts_.push_back({Anchor(p.body_b, p.frame_b, slots), Anchor(q.body_b, q.frame_b, slots)});
    return;
  }
  const Anchor a(joint.body_a, joint.frame_a, slots), b(joint.body_b, joint.frame_b, slots);
  // From what may swing to where it is held; what stands still needs no line.
  for (const auto& [body, at] : {std::pair(joint.body_a, a), std::pair(joint.body_b, b)}) {
    if (!body.is_null() && world.state(body).type == MotionType::Dynamic)
      line_parts_.push_back({Anchor(body, {}, slots), at});
  }
  if (const auto* pulley = std::get_if<PulleyJoint>(&joint.kind)) {
    Anchor over_a, over_b;
    over_a.frame.position = pulley->over_a.template cast<Real>();
    over_b.frame.position = pulley->over_b.template cast<Real>();
    line_parts_.push_back({a, over_a});
    line_parts_.push_back({over_a, over_b});
    line_parts_.push_back({over_b, b});
  } else if (is_stretched(joint.kind)) {
    line_parts_.push_back({a, b});
  }
  if (std::holds_alternative<HingeJoint>(joint.kind) ||
      std::holds_alternative<SliderJoint>(joint.kind))
    axis_parts_.push_back(b.slot == kNoSlot ? a : b);
}

void JointMarks::rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
                         const SceneExtent& extent) {
  if (world.joint_count() == 0 && !announced_) return;  // never had any
  send(writer);                                         // rows with the old joints come first
  if (!announced_) send_looks(writer, extent);
  announced_ = true;
  line_parts_.clear();
  axis_parts_.clear();
  const std::vector<std::size_t> slots = slots_of(frame);
  std::vector<JointId> joints;
  for (const BodyState& body : frame.bodies) {
    const std::vector<JointId> own = world.joints_of(body.id);
    joints.insert(joints.end(), own.begin(), own.end());
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  for (const JointId id : joints) add_joint(world, world.joint(id), slots);
  add(frame);
  send(writer);
}

void JointMarks::add(const Frame& frame) {
  if (!announced_) return;
  lines_.add(frame, line_parts_);
  auto* origin = axes_.column(0).extend<float>(axis_parts_.size());
  auto* vector = axes_.column(1).extend<float>(axis_parts_.size());
  for (const Anchor& at : axis_parts_) {
    origin = write(origin, at.position(frame));
    vector = write(vector, Eigen::Vector3d(axis_length_ * at.axis(frame)));
  }
  axes_.end_row(frame.number, frame.time);
}

void JointMarks::send(rrd::Writer& writer) {
  lines_.send(writer);
  axes_.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
