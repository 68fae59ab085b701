// The same planar joint in Box2D 2.4.1 and here: anchors and axes in the world, as the bodies
// stand. Bodies that a joint connects collide in neither engine.
#pragma once

#include <functional>
#include <tuple>
#include <utility>

#include "box2d/planar_pair.h"

namespace plumb::inline PLUMB_ABI {
namespace box2d_comparison {

using Eigen::Vector2d;
using Body = PlanarPair::Body;

// Bodies that joints keep in the plane: these need no locks.
class JointedPair : public PlanarPair {
 public:
  explicit JointedPair(double gravity = kGravity) : PlanarPair(gravity) { lock_to_plane(false); }
};

inline b2Vec2 b2(const Vector2d& p) { return {f(p.x()), f(p.y())}; }

// The frame at a world point, its x axis along `axis`, its z axis the plane's normal where it can
// be; seen from the body.
inline LocalPose frame_in(const PhysicsWorld& world, BodyId body, const Vector2d& p,
                          const Eigen::Quaterniond& R_WJ) {
  LocalPose frame;
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  if (!body.is_null()) {
    R = orientation(world, body);
    x = position(world, body);
  }
  frame.position = vec(R.conjugate() * (Eigen::Vector3d(p.x(), p.y(), 0) - x));
  frame.orientation = Quat((R.conjugate() * R_WJ).cast<Real>()).normalized();
  return frame;
}

// The hinge's axis is the plane's normal, a slider's lies in the plane.
inline Eigen::Quaterniond out_of_plane() {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ());
}
inline Eigen::Quaterniond in_plane(const Vector2d& axis) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(std::atan2(axis.y(), axis.x()), Eigen::Vector3d::UnitZ()));
}

inline JointId join(PlanarPair& pair, const Body& a, const Body& b, const JointKind& kind,
                    const Vector2d& at_a, const Vector2d& at_b, const Eigen::Quaterniond& R_WJ) {
  Joint joint;
  joint.body_a = a.ours;
  joint.body_b = b.ours;
  joint.frame_a = frame_in(pair.world(), a.ours, at_a, R_WJ);
  joint.frame_b = frame_in(pair.world(), b.ours, at_b, R_WJ);
  joint.kind = kind;
  return must(pair.world().create_joint(joint));
}

struct PairedHinge {
  b2RevoluteJoint* theirs;
  JointId ours;
};
// motor: target [rad/s] and largest torque [N m].
inline PairedHinge hinge(PlanarPair& pair, const Body& a, const Body& b, const Vector2d& p,
                         std::optional<std::pair<double, double>> motor = {}) {
  b2RevoluteJointDef def;
  def.Initialize(a.theirs, b.theirs, b2(p));
  HingeJoint kind;
  if (motor) {
    def.enableMotor = true;
    def.motorSpeed = f(motor->first);
    def.maxMotorTorque = f(motor->second);
    kind.axis.motor = JointMotor{.target = real(motor->first), .max_effort = real(motor->second)};
  }
  return {static_cast<b2RevoluteJoint*>(pair.their_world().CreateJoint(&def)),
          join(pair, a, b, kind, p, p, out_of_plane())};
}

// Mean time between upward passages of a reading through zero, over `periods` of them, in both
// engines.
struct Periods {
  double theirs, ours;
};
inline Periods periods_of(PlanarPair& pair, int periods,
                          const std::function<std::pair<double, double>()>& read) {
  std::pair<double, double> last = read();
  double first[2] = {-1, -1}, mean[2] = {0, 0};
  int found[2] = {-1, -1};
  for (int step = 0; step < 100000 && (mean[0] == 0 || mean[1] == 0); ++step) {
    pair.step();
    const std::pair<double, double> now = read();
    const double before[2] = {last.first, last.second}, after[2] = {now.first, now.second};
    for (int k = 0; k < 2; ++k) {
      if (!(before[k] < 0 && after[k] >= 0) || mean[k] != 0) continue;
      const double when = kDt * (step + before[k] / (before[k] - after[k]));
      if (++found[k] == 0) first[k] = when;
      if (found[k] == periods) mean[k] = (when - first[k]) / periods;
    }
    last = now;
  }
  return {mean[0], mean[1]};
}

// K(k), by the arithmetic-geometric mean: a swing of amplitude A takes 4 K(sin(A / 2)) / w0.
inline double elliptic_k(double k) {
  double a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 40 && a != b; ++i) std::tie(a, b) = std::pair((a + b) / 2, std::sqrt(a * b));
  return kPi / (2 * a);
}
inline double swing_period(double w0, double amplitude) {
  return 4 * elliptic_k(std::sin(amplitude / 2)) / w0;
}

}  // namespace box2d_comparison
}  // namespace plumb::inline PLUMB_ABI
