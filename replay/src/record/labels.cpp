#include "record/labels.h"

#include <algorithm>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint32_t kLabelColor = 0xffffffff;
// The viewer hides labels where one entity has more of them.
constexpr std::size_t kBatch = 25;

}  // namespace

void Labels::rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame) {
  if (of_bodies_.empty() && of_joints_.empty()) return;
  send(writer);
  places_.clear();
  const std::vector<std::size_t> slots = slots_of(frame);
  std::vector<std::string> texts;
  for (const auto& [body, text] : of_bodies_) {
    if (!world.is_valid(body)) continue;
    places_.emplace_back(body, LocalPose{}, slots);
    texts.push_back(text);
  }
  for (const auto& [id, text] : of_joints_) {
    if (!world.is_valid(id)) continue;
    Joint joint = world.joint(id);
    if (const auto* gear = std::get_if<GearJoint>(&joint.kind)) joint = world.joint(gear->first);
    if (const auto* rack = std::get_if<RackPinionJoint>(&joint.kind))
      joint = world.joint(rack->rack);
    const bool at_b = !joint.body_b.is_null();
    places_.emplace_back(at_b ? joint.body_b : joint.body_a, at_b ? joint.frame_b : joint.frame_a,
                         slots);
    texts.push_back(text);
  }
  // As many batches as ever; those that have become empty say so.
  while (batches_.size() * kBatch < places_.size()) {
    rrd::Table& batch = batches_.emplace_back("labels/" + std::to_string(batches_.size()));
    batch.add_column<float>("Points3D:positions", 3);
  }
  for (std::size_t k = 0; k < batches_.size(); ++k) {
    rrd::Table look(batches_[k].entity());
    const std::size_t column = look.add_text_column("Points3D:labels");
    const std::size_t color = look.add_column<std::uint32_t>("Points3D:colors");
    const std::size_t end = std::min(texts.size(), (k + 1) * kBatch);
    for (std::size_t i = k * kBatch; i < end; ++i) look.column(column).append_text(texts[i]);
    look.column(color).append_one(kLabelColor);
    look.end_row(frame.number, frame.time);
    look.send(writer);
  }
  add(frame);
  send(writer);
}

void Labels::add(const Frame& frame) {
  for (std::size_t k = 0; k < batches_.size(); ++k) {
    const std::size_t begin = std::min(places_.size(), k * kBatch);
    const std::size_t end = std::min(places_.size(), begin + kBatch);
    auto* out = batches_[k].column(0).extend<float>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = places_[i].position(frame);
      out = std::transform(p.data(), p.data() + 3, out,
                           [](double x) { return static_cast<float>(x); });
    }
    batches_[k].end_row(frame.number, frame.time);
  }
}

void Labels::send(rrd::Writer& writer) {
  for (rrd::Table& batch : batches_) batch.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
