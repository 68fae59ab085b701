// Toys: bodies of random shapes, sizes and densities, hung together by random joints, dropped on
// random ground. What children make of a physics engine.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "plumb/triangle_mesh.h"
#include "support/random.h"

namespace plumb::inline PLUMB_ABI {
namespace scenes {

using namespace testing_support;

class ToyBox {
 public:
  // The same box for the same seed. `kind`: index into JointKind's alternatives up to six-dof, or
  // -1 for a mixture of all.
  explicit ToyBox(std::uint32_t seed, int kind = -1)
      : random_(seed * 7 + 1), kind_(kind), world_(settings(seed)) {
    add_ground(static_cast<int>(seed % 4));
    const int toys = 1 + below(4);
    for (int i = 0; i < toys; ++i) add_toy();
  }

  PhysicsWorld& world() { return world_; }
  [[nodiscard]] const std::vector<BodyId>& bodies() const { return bodies_; }

 private:
  using Vector3d = Eigen::Vector3d;

  static WorldSettings settings(std::uint32_t seed) {
    WorldSettings made;
    made.sleeping = seed % 3 != 0;
    made.substeps = std::array{1, 2, 4, 4, 8}[seed % 5];
    return made;
  }
  int below(int n) { return std::min(n - 1, static_cast<int>(random_.uniform(0, n))); }
  double decades(double low, double high) { return std::pow(10, random_.uniform(low, high)); }

  Shape some_shape(double size) {
    const auto side = [&](double least) { return size * random_.uniform(least, 1); };
    switch (below(6)) {
      case 0:
        return sphere(side(0.3));
      case 1: {
        const double half = side(0.3);
        return capsule(half, size * random_.uniform(0.2, 0.6));
      }
      case 2: {
        const double half = side(0.3);
        return cylinder(half, side(0.3));
      }
      case 3: {
        const double half = side(0.4);
        return cone(half, side(0.3));
      }
      default: {
        const double x = side(0.2), y = side(0.2);
        return box(x, y, side(0.2));
      }
    }
  }

  void add_ground(int kind) {
    if (kind == 0) {
      add_floor(world_, material(0.6));
    } else if (kind == 1) {
      add(world_, body_at(at(0, -1, 0), MotionType::Static), with(box(60, 1, 60), material(0.6)));
    } else if (kind == 2) {
      add(world_, body_at(Pose{}, MotionType::Static), with(waves(), material(0.6)));
    } else {
      add_floor(world_, material(0.3));
      for (int i = 0; i < 8; ++i) {
        const Vector3d p(random_.uniform(-6, 6), random_.uniform(0, 1), random_.uniform(-6, 6));
        const Quat q = random_.rotation(3);
        add(world_, body_at(at(p, q), MotionType::Static), with(some_shape(2), material(0.5)));
      }
    }
  }
  static SurfaceMesh waves() {
    constexpr std::uint32_t kCells = 40;
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t k = 0; k <= kCells; ++k)
      for (std::uint32_t i = 0; i <= kCells; ++i)
        vertices.push_back(
            vec(3.0 * (i - 20.0), 0.5 * std::sin(0.7 * i) * std::cos(0.6 * k), 3.0 * (k - 20.0)));
    for (std::uint32_t k = 0; k < kCells; ++k)
      for (std::uint32_t i = 0; i < kCells; ++i) {
        const std::uint32_t a = k * (kCells + 1) + i, d = a + kCells + 1;
        indices.insert(indices.end(), {a, d, d + 1, a, d + 1, a + 1});
      }
    SurfaceMesh mesh;
    mesh.geometry = TriangleMeshGeometry::create(vertices, indices).mesh;
    return mesh;
  }

  void add_toy() {
    const double scale = decades(-1, 0.3);
    Vector3d p(random_.uniform(-5, 5), random_.uniform(3, 6), random_.uniform(-5, 5));
    const int links = 2 + below(8);
    std::vector<BodyId> own;
    for (int i = 0; i < links; ++i) {
      const Quat q = random_.rotation(3);
      const Vec3 v = vec(random_.uniform(0, 3) * random_.direction());
      const Vec3 w = vec(random_.uniform(0, 5) * random_.direction());
      const double restitution = random_.uniform(0, 1) < 0.3 ? 0.4 : 0;
      const Shape shape = some_shape(scale);
      own.push_back(add(world_, moving(at(p, q), v, w),
                        with(shape, material(0.5, restitution), decades(2.3, 3.7))));
      if (i > 0) join(own[static_cast<std::size_t>(below(i))], own.back());
      p += scale * random_.uniform(0.8, 1.5) * random_.direction();
      p.y() = std::max(p.y(), 2.0);
    }
    bodies_.insert(bodies_.end(), own.begin(), own.end());
  }

  Vector3d middle(BodyId body) { return world_.pose(body).position.cast<double>(); }
  LocalPose frame_at(BodyId body, const Vector3d& p) {
    const Eigen::Quaterniond R = world_.pose(body).orientation.cast<double>();
    LocalPose frame;
    frame.position = vec(R.conjugate() * (p - middle(body)));
    frame.orientation = Quat(R.conjugate().cast<Real>()).normalized();
    return frame;
  }

  JointAxis some_axis() {
    JointAxis axis;
    if (below(2) == 0) {
      JointLimit limit;
      limit.lower = real(-random_.uniform(0, 1));
      limit.upper = real(random_.uniform(0, 1));
      if (below(2) == 0)
        limit.softness = {real(random_.uniform(1, 10)), real(random_.uniform(0, 1))};
      if (below(3) == 0) limit.restitution = real(random_.uniform(0, 1));
      axis.limit = limit;
    }
    if (below(4) == 0) axis.spring = JointSpring{0, real(decades(0, 4)), real(decades(-1, 2))};
    if (below(3) == 0) axis.friction = real(decades(-1, 2));
    return axis;
  }

  void join(BodyId a, BodyId b) {
    const double apart = (middle(a) - middle(b)).norm();
    const Vector3d between = 0.5 * (middle(a) + middle(b));
    Joint joint;
    joint.body_a = a;
    joint.body_b = b;
    joint.frame_a = frame_at(a, between);
    joint.frame_b = frame_at(b, between);
    joint.collide_connected = below(4) == 0;
    const JointAxis axis = some_axis();
    const int kind = kind_ >= 0 ? kind_ : below(9);
    if (kind >= 4 && kind <= 6)  // along the line through both middles
      joint.frame_a.position = joint.frame_b.position = Vec3::Zero();
    switch (kind) {
      case 0:
        joint.kind = BallJoint{};
        break;
      case 1:
        joint.kind = HingeJoint{axis};
        break;
      case 2:
        joint.kind = SliderJoint{axis};
        break;
      case 3:
        joint.kind = FixedJoint{};
        break;
      case 4:
        joint.kind = DistanceJoint{real(apart)};
        break;
      case 5:
        joint.kind = RopeJoint{real(1.1 * apart)};
        break;
      case 6:
        joint.kind = SpringJoint{real(apart), real(decades(1, 4)), real(decades(-1, 2))};
        break;
      case 7:
        joint.kind = ConeTwistJoint{real(random_.uniform(0.1, 1)), real(-random_.uniform(0, 1)),
                                    real(random_.uniform(0, 1))};
        break;
      default:
        joint.kind = some_six_dof(axis);
    }
    if (below(6) == 0) joint.softness = {real(random_.uniform(2, 20)), real(random_.uniform(0, 1))};
    must(world_.create_joint(joint));
  }
  SixDofJoint some_six_dof(JointAxis axis) {
    using Freedom = SixDofJoint::Freedom;
    SixDofJoint made;
    axis.limit = JointLimit{real(-0.3), real(0.4)};
    for (std::size_t k = 0; k < 6; ++k) {
      const bool linear = k < 3;
      const int choice = linear ? below(4) : below(3);
      made.coordinates[k].freedom =
          linear ? (choice > 0 ? Freedom::Locked : Freedom::Limited) : static_cast<Freedom>(choice);
      made.coordinates[k].axis = axis;
    }
    return made;
  }

  Random random_;
  int kind_;
  PhysicsWorld world_;
  std::vector<BodyId> bodies_;
};

}  // namespace scenes
}  // namespace plumb::inline PLUMB_ABI
