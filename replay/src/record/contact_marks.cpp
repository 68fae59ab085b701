#include "record/contact_marks.h"

#include <algorithm>

#include "plumb/world.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::uint32_t kPointColor = 0xff5a36ff, kArrowColor = 0xffd23fff;
// Thickness of the marks, in mean body radii.
constexpr double kPointRadius = 0.06, kArrowRadius = 0.02;
// An impact may carry a thousand weights; its arrow ends here [mean body radii].
constexpr double kLongestArrow = 6;
// Without gravity a body's "weight" is taken as its mass times this [m/s^2].
constexpr double kStandardGravity = 9.81;

double mean_mass(const PhysicsWorld& world, const Frame& frame) {
  double sum = 0;
  std::size_t count = 0;
  for (const BodyState& body : frame.bodies) {
    if (body.type != MotionType::Dynamic) continue;
    sum += world.mass_properties(body.id).mass;
    ++count;
  }
  return count && sum > 0 ? sum / static_cast<double>(count) : 1;
}

float* write_point(float* out, const Pos3& p) {
  return std::transform(p.data(), p.data() + 3, out,
                        [](PosReal x) { return static_cast<float>(x); });
}

void send_look(rrd::Writer& writer, const std::string& entity, const std::string& archetype,
               double radius, std::uint32_t color) {
  rrd::Table look(entity);
  const std::size_t radii = look.add_column<float>(archetype + ":radii");
  const std::size_t colors = look.add_column<std::uint32_t>(archetype + ":colors");
  look.column(radii).append_one(static_cast<float>(radius));
  look.column(colors).append_one(color);
  look.send_static(writer);
}

}  // namespace

ContactMarks::ContactMarks() : points_("contacts/points"), arrows_("contacts/normals") {
  points_.add_column<float>("Points3D:positions", 3);
  arrows_.add_column<float>("Arrows3D:origins", 3);
  arrows_.add_column<float>("Arrows3D:vectors", 3);
}

void ContactMarks::send_looks(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
                              const SceneExtent& extent) {
  double gravity = world.settings().gravity.template cast<double>().norm();
  if (gravity == 0) gravity = kStandardGravity;
  meters_per_newton_ = extent.body_radius / (mean_mass(world, frame) * gravity);
  longest_ = kLongestArrow * extent.body_radius;
  const double size = extent.body_radius;
  send_look(writer, points_.entity(), "Points3D", size * kPointRadius, kPointColor);
  send_look(writer, arrows_.entity(), "Arrows3D", size * kArrowRadius, kArrowColor);
}

void ContactMarks::add(const Frame& frame) {
  const double dt = frame.report.dt;
  const std::size_t count = frame.contacts.size();
  auto* point = points_.column(0).extend<float>(count);
  auto* origin = arrows_.column(0).extend<float>(count);
  auto* vector = arrows_.column(1).extend<float>(count);
  for (const ContactPoint& at : frame.contacts) {
    const double force = dt > 0 ? double{at.normal_impulse} / dt : 0;
    const auto length = static_cast<Real>(std::min(force * meters_per_newton_, longest_));
    point = write_point(point, at.position);
    origin = write_point(origin, at.position);
    for (Eigen::Index k = 0; k < 3; ++k) *vector++ = static_cast<float>(at.normal[k] * length);
  }
  points_.end_row(frame.number, frame.time);
  arrows_.end_row(frame.number, frame.time);
}

void ContactMarks::send(rrd::Writer& writer) {
  points_.send(writer);
  arrows_.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
