// The cases that are plain data (accuracy/setups), in a world of ours.
#include <algorithm>

#include "accuracy/cells/build.h"
#include "accuracy/setups/setup.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using accuracy::Setup;
using accuracy::SetupBody;
using accuracy::SetupJoint;
using Eigen::Quaterniond;
using Eigen::Vector3d;

class Plain : public Case {
 public:
  Plain(const Setup& setup, const Making& making)
      : Case(settings_of(setup, making)), meter_(setup.meter()) {
    seconds = setup.seconds;
    const Setup all = accuracy::repeated(setup, making.copies);
    bodies = static_cast<int>(all.bodies.size());
    const Material surface = material(std::max(all.friction, all.friction_among), all.restitution);
    Material ground = material(all.friction, all.restitution);
    ground.friction_rule = CombineRule::Minimum;
    if (all.floor) add_floor(world, ground, all.normal);
    for (const SetupBody& body : all.bodies) {
      ids_.push_back(make_body(body, surface));
      if (!body.force.isZero()) pulled_.emplace_back(ids_.back(), vec(body.force));
    }
    for (const SetupJoint& joint : all.joints) join(joint);
    ids_.resize(setup.bodies.size());  // the first copy is the one looked at
    meter_->begin(read());
  }
  void before_step() override {
    for (const auto& [body, force] : pulled_) must(world.apply_force(body, force));
  }
  void after_step() override { meter_->after_step(world.time(), read()); }
  [[nodiscard]] std::vector<double> readings() const override { return meter_->readings(read()); }

 private:
  static WorldSettings settings_of(const Setup& setup, const Making& making) {
    WorldSettings settings = making.settings();
    settings.gravity = vec(setup.gravity);
    return settings;
  }
  BodyId make_body(const SetupBody& from, const Material& surface) {
    RigidBody body = body_at(at(from.position, from.orientation));
    body.mass = mass_of(from.mass, from.moments);
    body.linear_velocity = vec(from.velocity);
    body.angular_velocity = vec(from.spin);
    switch (from.shape) {
      case SetupBody::Shape::Box:
        return add(world, body, Box{vec(from.half)}, surface);
      case SetupBody::Shape::Sphere:
        return add(world, body, Sphere{real(from.radius)}, surface);
      case SetupBody::Shape::None:
        break;
    }
    return must(world.create_body(body));
  }
  void join(const SetupJoint& from) {
    const Quaterniond frame = Quaterniond::FromTwoVectors(Vector3d::UnitX(), from.axis);
    const auto in = [&](BodyId body) {
      LocalPose local;
      const bool fixed = body.is_null();
      const Quaterniond R = fixed ? Quaterniond::Identity() : wide(world.pose(body).orientation);
      const Vector3d x =
          fixed ? Vector3d::Zero() : Vector3d(world.pose(body).position.cast<double>());
      local.position = vec(R.conjugate() * (from.at - x));
      local.orientation = quat(R.conjugate() * frame);
      return local;
    };
    const auto id = [&](int i) { return i < 0 ? BodyId{} : ids_[static_cast<std::size_t>(i)]; };
    Joint joint;
    joint.body_a = id(from.a);
    joint.body_b = id(from.b);
    joint.frame_a = in(joint.body_a);
    joint.frame_b = in(joint.body_b);
    joint.kind = from.hinge ? JointKind(HingeJoint{}) : JointKind(BallJoint{});
    must(world.create_joint(joint));
  }
  [[nodiscard]] accuracy::BodyReadings read() const {
    accuracy::BodyReadings out;
    for (const BodyId id : ids_)
      out.push_back({place(world, id), wide(world.pose(id).orientation),
                     wide(world.linear_velocity(id)), wide(world.angular_velocity(id))});
    return out;
  }

  accuracy::MeterPtr meter_;
  std::vector<BodyId> ids_;
  std::vector<std::pair<BodyId, Vec3>> pulled_;  // [N]
};

}  // namespace

std::vector<CaseMaker> plain_cases() {
  std::vector<CaseMaker> out;
  for (const accuracy::Setup& setup : accuracy::setups())
    out.push_back({setup.name.c_str(), setup.copies, [&setup](const Making& making) {
                     return std::make_unique<Plain>(setup, making);
                   }});
  return out;
}

}  // namespace plumb::inline PLUMB_ABI::cells
