// Joints: a pendulum, a heavy top, a chain.
#include "accuracy/cells/build.h"

namespace plumb::inline PLUMB_ABI::cells {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// A joint at a world point; A is the world where it is null.
void join(PhysicsWorld& world, BodyId a, BodyId b, const JointKind& kind, const Vector3d& p,
          const Vector3d& axis) {
  const Quaterniond frame = Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis);
  const auto in = [&](BodyId body) {
    LocalPose local;
    const bool fixed = body.is_null();
    const Quaterniond R = fixed ? Quaterniond::Identity() : wide(world.pose(body).orientation);
    const Vector3d x =
        fixed ? Vector3d::Zero() : Vector3d(world.pose(body).position.cast<double>());
    local.position = vec(R.conjugate() * (p - x));
    local.orientation = quat(R.conjugate() * frame);
    return local;
  };
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  joint.frame_a = in(a);
  joint.frame_b = in(b);
  joint.kind = kind;
  must(world.create_joint(joint));
}

// F9: a point mass on a hinge, 1 m, let go level; the period.
class Pendulum : public Case {
 public:
  explicit Pendulum(const Making& making) : Case(making.settings()) {
    seconds = 12;
    bodies = making.copies;
    for (int i = 0; i < making.copies; ++i) {
      const Vector3d hinge(0, 0, 5.0 * i);
      RigidBody body = body_at(at(hinge + Vector3d::UnitX(), turn(kPi / 2, Vector3d::UnitZ())));
      body.mass = mass_of(1, Vector3d::Constant(1e-6));
      const BodyId id = must(world.create_body(body));
      join(world, {}, id, HingeJoint{}, hinge, Vector3d::UnitZ());
      if (i == 0) bob_ = id;
    }
    last_ = angle();
  }
  // Upward passages through the bottom, between two steps by the cubic through both ends.
  void after_step() override {
    const double now = angle(), t = world.time(), h = t - time_;
    const double rate = wide(world.angular_velocity(bob_)).z();
    if (last_ < 0 && now >= 0) {
      double low = 0, high = 1;
      for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (low + high), s2 = s * s, s3 = s2 * s;
        const double value = (2 * s3 - 3 * s2 + 1) * last_ + (s3 - 2 * s2 + s) * h * rate_ +
                             (3 * s2 - 2 * s3) * now + (s3 - s2) * h * rate;
        (value < 0 ? low : high) = s;
      }
      const double when = time_ + low * h;
      if (passages_++ == 0) first_ = when;
      latest_ = when;
    }
    last_ = now;
    rate_ = rate;
    time_ = t;
  }
  [[nodiscard]] std::vector<double> readings() const override {
    return {passages_ > 1 ? (latest_ - first_) / (passages_ - 1) : 0.0};
  }

 private:
  [[nodiscard]] double angle() const {
    const Vector3d x = place(world, bob_);
    return std::atan2(x.x(), -x.y());
  }
  BodyId bob_;
  double last_ = 0, rate_ = 0, time_ = 0, first_ = 0, latest_ = 0;
  int passages_ = 0;
};

// F8: a heavy top on a ball joint in steady slow precession; the angle after ten seconds.
class HeavyTop : public Case {
 public:
  explicit HeavyTop(const Making& making) : Case(making.settings()) {
    seconds = 10;
    bodies = making.copies;
    constexpr double kTilt = kPi / 6, kSpin = 40, kRate = 0.2479112965, kArm = 0.5;
    const Quaterniond q = turn(-kTilt, Vector3d::UnitZ());
    const Vector3d axis = q * Vector3d::UnitY();
    const Vector3d w = kSpin * axis + kRate * (Vector3d::UnitY() - axis.y() * axis);
    for (int i = 0; i < making.copies; ++i) {
      const Vector3d foot(0, 0, 5.0 * i);
      RigidBody body = body_at(at(foot + kArm * axis, q));
      body.mass = mass_of(1, {1 - kArm * kArm, 0.5, 1 - kArm * kArm});
      body.angular_velocity = vec(w);
      body.linear_velocity = vec(w.cross(kArm * axis));
      const BodyId id = must(world.create_body(body));
      join(world, {}, id, BallJoint{}, foot, Vector3d::UnitX());
      if (i == 0) top_ = id;
    }
  }
  [[nodiscard]] std::vector<double> readings() const override {
    const Vector3d x = place(world, top_);
    return {-std::atan2(x.z(), x.x())};
  }

 private:
  BodyId top_;
};

// Ten links of a chain on ball joints, let go level; where they are after one second.
class Chain : public Case {
 public:
  explicit Chain(const Making& making) : Case(making.settings()) {
    seconds = 1;
    constexpr int kLinks = 10;
    bodies = making.copies * kLinks;
    constexpr double kLength = 0.2;  // [m] of a link
    for (int c = 0; c < making.copies; ++c) {
      const Vector3d hook(0, 0, 5.0 * c);
      BodyId last{};
      for (int i = 0; i < kLinks; ++i) {
        RigidBody body = body_at(at(hook + Vector3d((i + 0.5) * kLength, 0, 0)));
        body.mass = mass_of(1, Vector3d(0.001, 0.0034, 0.0034));
        const BodyId link = must(world.create_body(body));
        join(world, last, link, BallJoint{}, hook + Vector3d(i * kLength, 0, 0), Vector3d::UnitX());
        if (c == 0) links_.push_back(link);
        last = link;
      }
    }
  }
  [[nodiscard]] std::vector<double> readings() const override {
    std::vector<double> out;
    for (const BodyId link : links_) append_place(out, place(world, link));
    return out;
  }

 private:
  std::vector<BodyId> links_;
};

}  // namespace

std::vector<CaseMaker> jointed_cases() {
  return {{"F8", 16, make<HeavyTop>}, {"F9", 16, make<Pendulum>}, {"chain", 4, make<Chain>}};
}

}  // namespace plumb::inline PLUMB_ABI::cells
