// Inputs as numbers. What a call is given stands in the order of its parameters, in these layouts
// (x3: three numbers; u64: low and high 32 bits):
//
//   body       type, position x3, orientation xyzw x4, v x3, w x3, has mass [mass], locks x6,
//              linear damping, angular damping, gravity scale, can sleep, starts awake,
//              continuous, user data u64
//   mass       mass, centre x3, inertia xx yy zz xy xz yz
//   collider   shape, local pose, material, filter, density, is sensor, user data u64, surface
//              velocity, one-way direction x3
//   local pose position x3, orientation x4
//   material   friction, restitution, two rules, rolling and torsional friction, kind
//   filter     layers, collides with, group
//   surface velocity   linear x3, angular x3
//   material pair      given, and if it is, for friction, restitution, rolling and torsional
//              friction each: given, value
//   shape      0 sphere: radius | 1 box: half extents x3 | 2 capsule: half length, radius
//              3 hull: vertex count, vertices x3, face count, (size, vertices...) a face
//              4 half-space: normal x3, offset
//              5 mesh: scale x3, vertex count, vertices x3, triangle count, corners x3
//              6 heightfield: samples x, samples z, spacing x, spacing z, heights (1e9: a hole)
//              7 compound: child count, (shape, position x3, orientation x4) a child
//              8 cylinder, 9 cone: half length, radius, rounding
//              box and hull: rounding after the half extents, before the vertices
//   settings   gravity x3, substeps, contact frequency, damping ratio, rotation, warm starting,
//              sleeping, time to sleep, profiling, contact solver
#include "world/inputs.h"

#include <array>
#include <cmath>

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

template <class Enum>
Enum choice(NumberReader& in, std::uint32_t count, bool& ok) {
  const std::uint32_t value = in.word();
  if (value >= count) ok = false;
  return static_cast<Enum>(value < count ? value : 0);
}

// The fields of a material pair in their order.
template <class Values>
auto fields_of(Values& values) {
  return std::array{&values.friction, &values.restitution, &values.rolling_friction,
                    &values.torsional_friction};
}

}  // namespace

void append_long(std::vector<double>& out, std::uint64_t v) {
  append_all(out, {static_cast<double>(v & 0xffffffffu), static_cast<double>(v >> 32)});
}
void append(std::vector<double>& out, const Vec3& v) {
  append_all(out, {as_number(v.x()), as_number(v.y()), as_number(v.z())});
}
void append_position(std::vector<double>& out, const Pos3& p) {
  append_all(out,
             {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())});
}
void append(std::vector<double>& out, const Quat& q) {
  append_all(out, {as_number(q.x()), as_number(q.y()), as_number(q.z()), as_number(q.w())});
}
void append(std::vector<double>& out, const MassProperties& m) {
  const Eigen::Matrix3d& I = m.I_Bcm_B;
  append_all(out, {m.mass, m.center.x(), m.center.y(), m.center.z(), I(0, 0), I(1, 1), I(2, 2),
                   I(0, 1), I(0, 2), I(1, 2)});
}
void append(std::vector<double>& out, const RigidBody& body) {
  append_all(out, {static_cast<double>(body.type)});
  append_position(out, body.pose.position);
  append(out, body.pose.orientation);
  append(out, body.linear_velocity);
  append(out, body.angular_velocity);
  append_all(out, {body.mass.has_value() ? 1.0 : 0.0});
  if (body.mass.has_value()) append(out, *body.mass);
  append(out, body.locks);
  append_all(out, {as_number(body.linear_damping), as_number(body.angular_damping),
                   as_number(body.gravity_scale), body.can_sleep ? 1.0 : 0.0,
                   body.starts_awake ? 1.0 : 0.0, body.continuous ? 1.0 : 0.0});
  append_long(out, body.user_data);
}
void append(std::vector<double>& out, const MotionLocks& k) {
  for (const bool lock :
       {k.linear_x, k.linear_y, k.linear_z, k.angular_x, k.angular_y, k.angular_z})
    append_all(out, {lock ? 1.0 : 0.0});
}
void append(std::vector<double>& out, const LocalPose& pose) {
  append(out, pose.position);
  append(out, pose.orientation);
}
void append(std::vector<double>& out, const Material& m) {
  append_all(out,
             {as_number(m.friction), as_number(m.restitution), static_cast<double>(m.friction_rule),
              static_cast<double>(m.restitution_rule), as_number(m.rolling_friction),
              as_number(m.torsional_friction), static_cast<double>(m.kind)});
  append(out, m.grain);
  append_all(out, {as_number(m.grain_friction), as_number(m.adhesion)});
}
void append(std::vector<double>& out, const Collider& collider) {
  append_shape(out, collider.shape);
  append(out, collider.pose);
  append(out, collider.material);
  append(out, collider.filter);
  append_all(out, {collider.density, collider.is_sensor ? 1.0 : 0.0});
  append_long(out, collider.user_data);
  append(out, collider.surface_velocity);
  append(out, collider.one_way);
}
void append(std::vector<double>& out, const SurfaceVelocity& velocity) {
  append(out, velocity.linear);
  append(out, velocity.angular);
}
void append(std::vector<double>& out, const Filter& filter) {
  append_all(out, {static_cast<double>(filter.layers), static_cast<double>(filter.collides_with),
                   static_cast<double>(filter.group)});
}
void append(std::vector<double>& out, const std::optional<MaterialPair>& values) {
  out.push_back(values.has_value() ? 1.0 : 0.0);
  if (!values.has_value()) return;
  for (const auto* field : fields_of(*values))
    append_all(out, {field->has_value() ? 1.0 : 0.0, as_number(field->value_or(Real(0)))});
}
void append(std::vector<double>& out, const WorldSettings& s) {
  append(out, s.gravity);
  append_all(out,
             {static_cast<double>(s.substeps), as_number(s.step_tolerance),
              as_number(s.contact_frequency), as_number(s.contact_damping_ratio),
              static_cast<double>(s.rotation), s.warm_starting ? 1.0 : 0.0, s.sleeping ? 1.0 : 0.0,
              as_number(s.time_to_sleep), s.profiling ? 1.0 : 0.0,
              static_cast<double>(s.contact_solver), static_cast<double>(s.joint_order),
              static_cast<double>(s.velocity_iterations), static_cast<double>(s.friction_cone)});
  append_long(out, s.forced.items_off());
  append_long(out, s.forced.items_on());
}

double NumberReader::number() {
  if (at_ >= numbers_.size()) {
    ok_ = false;
    return 0;
  }
  return numbers_[at_++];
}
std::uint32_t NumberReader::word() {
  const double v = number();
  if (!(v >= 0 && v <= 4294967295.0) || v != std::floor(v)) {
    ok_ = false;
    return 0;
  }
  return static_cast<std::uint32_t>(v);
}
std::uint64_t NumberReader::long_word() {
  const std::uint64_t low = word();
  return low | (std::uint64_t{word()} << 32);
}
Vec3 NumberReader::vector() {
  const Real x = real(), y = real(), z = real();
  return {x, y, z};
}
Pos3 NumberReader::position() {
  const double x = number(), y = number(), z = number();
  return {static_cast<PosReal>(x), static_cast<PosReal>(y), static_cast<PosReal>(z)};
}
Quat NumberReader::orientation() {
  const Real x = real(), y = real(), z = real(), w = real();
  return {w, x, y, z};
}
MassProperties NumberReader::mass() {
  MassProperties m;
  m.mass = number();
  for (int i = 0; i < 3; ++i) m.center[i] = number();
  for (int i = 0; i < 3; ++i) m.I_Bcm_B(i, i) = number();
  m.I_Bcm_B(0, 1) = m.I_Bcm_B(1, 0) = number();
  m.I_Bcm_B(0, 2) = m.I_Bcm_B(2, 0) = number();
  m.I_Bcm_B(1, 2) = m.I_Bcm_B(2, 1) = number();
  return m;
}
MotionType NumberReader::motion_type() { return choice<MotionType>(*this, 3, ok_); }
MotionLocks NumberReader::locks() {
  MotionLocks k;
  for (bool* lock :
       {&k.linear_x, &k.linear_y, &k.linear_z, &k.angular_x, &k.angular_y, &k.angular_z})
    *lock = flag();
  return k;
}
RigidBody NumberReader::body() {
  RigidBody body;
  body.type = motion_type();
  body.pose.position = position();
  body.pose.orientation = orientation();
  body.linear_velocity = vector();
  body.angular_velocity = vector();
  if (flag()) body.mass = mass();
  body.locks = locks();
  body.linear_damping = real();
  body.angular_damping = real();
  body.gravity_scale = real();
  body.can_sleep = flag();
  body.starts_awake = flag();
  body.continuous = flag();
  body.user_data = long_word();
  return body;
}
Shape NumberReader::shape() { return read_shape(*this, ok_); }
LocalPose NumberReader::local_pose() {
  LocalPose pose;
  pose.position = vector();
  pose.orientation = orientation();
  return pose;
}
Material NumberReader::material() {
  Material m;
  m.friction = real();
  m.restitution = real();
  m.friction_rule = choice<CombineRule>(*this, 5, ok_);
  m.restitution_rule = choice<CombineRule>(*this, 5, ok_);
  m.rolling_friction = real();
  m.torsional_friction = real();
  m.kind = word();
  m.grain = vector();
  m.grain_friction = real();
  m.adhesion = real();
  return m;
}
Collider NumberReader::collider() {
  Collider collider;
  collider.shape = shape();
  collider.pose = local_pose();
  collider.material = material();
  collider.filter = filter();
  collider.density = number();
  collider.is_sensor = flag();
  collider.user_data = long_word();
  collider.surface_velocity = surface_velocity();
  collider.one_way = vector();
  return collider;
}
SurfaceVelocity NumberReader::surface_velocity() {
  SurfaceVelocity velocity;
  velocity.linear = vector();
  velocity.angular = vector();
  return velocity;
}
Filter NumberReader::filter() {
  Filter filter;
  filter.layers = word();
  filter.collides_with = word();
  const double group = number();
  if (!(group >= -2147483648.0 && group <= 2147483647.0) || group != std::floor(group)) {
    ok_ = false;
    return filter;
  }
  filter.group = static_cast<std::int32_t>(group);
  return filter;
}
std::optional<MaterialPair> NumberReader::material_pair() {
  if (!flag()) return {};
  MaterialPair values;
  for (auto* field : fields_of(values)) {
    const bool given = flag();
    const Real value = real();
    if (given) *field = value;
  }
  return values;
}
WorldSettings NumberReader::settings() {
  WorldSettings s;
  s.gravity = vector();
  s.substeps = static_cast<int>(word());
  s.step_tolerance = real();
  s.contact_frequency = real();
  s.contact_damping_ratio = real();
  s.rotation = choice<RotationMethod>(*this, kRotationMethodCount, ok_);
  s.warm_starting = flag();
  s.sleeping = flag();
  s.time_to_sleep = real();
  s.profiling = flag();
  s.contact_solver = choice<ContactSolver>(*this, kContactSolverCount, ok_);
  s.joint_order = static_cast<int>(word());
  s.velocity_iterations = static_cast<int>(word());
  s.friction_cone = choice<FrictionCone>(*this, kFrictionConeCount, ok_);
  const std::uint64_t items_off = long_word();
  s.forced = PlanChoices(items_off, long_word());
  return s;
}

}  // namespace detail

}  // namespace plumb::inline PLUMB_ABI
