#include "record/body_table.h"

#include <algorithm>

#include "schema.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

namespace names = rrd::schema::body;

BodyTable::BodyTable()
    : table_(names::kEntity),
      ids_(table_.add_column<std::uint64_t>(names::kIds)),
      awake_(table_.add_column<std::uint8_t>(names::kAwake)),
      position_(table_.add_column<PosReal>(names::kPosition, 3)),
      orientation_(table_.add_column<Real>(names::kOrientation, 4)),
      linear_velocity_(table_.add_column<Real>(names::kLinearVelocity, 3)),
      angular_velocity_(table_.add_column<Real>(names::kAngularVelocity, 3)) {}

void BodyTable::add(const Frame& frame) {
  const auto moves = [](const BodyState& body) { return body.type != MotionType::Static; };
  const auto count =
      static_cast<std::size_t>(std::count_if(frame.bodies.begin(), frame.bodies.end(), moves));
  auto* id = table_.column(ids_).extend<std::uint64_t>(count);
  auto* awake = table_.column(awake_).extend<std::uint8_t>(count);
  auto* position = table_.column(position_).extend<PosReal>(count);
  auto* orientation = table_.column(orientation_).extend<Real>(count);
  auto* linear = table_.column(linear_velocity_).extend<Real>(count);
  auto* angular = table_.column(angular_velocity_).extend<Real>(count);
  for (const BodyState& body : frame.bodies) {
    if (!moves(body)) continue;
    *id++ = body.id.value();
    *awake++ = body.awake ? 1 : 0;
    position = std::copy_n(body.pose.position.data(), 3, position);
    orientation = std::copy_n(body.pose.orientation.coeffs().data(), 4, orientation);
    linear = std::copy_n(body.linear_velocity.data(), 3, linear);
    angular = std::copy_n(body.angular_velocity.data(), 3, angular);
  }
  table_.end_row(frame.number, frame.time);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
