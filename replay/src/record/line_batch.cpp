#include "record/line_batch.h"

#include <algorithm>
#include <utility>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint8_t kSolid = 3;  // Rerun's FillMode

enum LineColumn : std::size_t { kCenter, kHalfSize, kQuaternion };

template <class Vector>
float* write(float* out, const Vector& v) {
  return std::transform(v.data(), v.data() + v.size(), out,
                        [](double x) { return static_cast<float>(x); });
}

}  // namespace

LineBatch::LineBatch(std::string entity) : table_(std::move(entity)) {
  table_.add_column<float>("Boxes3D:centers", 3);
  table_.add_column<float>("Boxes3D:half_sizes", 3);
  table_.add_column<float>("Boxes3D:quaternions", 4);
}

void LineBatch::send_look(rrd::Writer& writer, double thickness, std::uint32_t color) {
  thickness_ = thickness;
  rrd::Table look(table_.entity());
  const std::size_t fill = look.add_column<std::uint8_t>("Boxes3D:fill_mode");
  const std::size_t colors = look.add_column<std::uint32_t>("Boxes3D:colors");
  look.column(fill).append_one(kSolid);
  look.column(colors).append_one(color);
  look.send_static(writer);
}

void LineBatch::add(const Frame& frame, std::span<const AnchoredLine> lines) {
  auto* center = table_.column(kCenter).extend<float>(lines.size());
  auto* half_size = table_.column(kHalfSize).extend<float>(lines.size());
  auto* quaternion = table_.column(kQuaternion).extend<float>(lines.size());
  for (const AnchoredLine& line : lines) {
    const Eigen::Vector3d from = line.from.position(frame), to = line.to.position(frame);
    const Eigen::Vector3d along = to - from;
    center = write(center, Eigen::Vector3d((from + to) / 2));
    half_size = write(half_size, Eigen::Vector3d(thickness_, along.norm() / 2, thickness_));
    // Lines without length have no direction.
    const Eigen::Quaterniond turn =
        along.norm() > 0 ? Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), along)
                         : Eigen::Quaterniond::Identity();
    quaternion = write(quaternion, turn.coeffs());
  }
  table_.end_row(frame.number, frame.time);
}

void LineBatch::send(rrd::Writer& writer) { table_.send(writer); }

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
