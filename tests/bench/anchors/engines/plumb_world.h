// An anchor scene in a world of ours.
#pragma once

#include <stdexcept>
#include <vector>

#include "bench/anchors/scene.h"
#include "support/build.h"

namespace plumb::anchors {

namespace build = testing_support;

// The scene's hulls and its mesh, shared by all bodies that have them.
struct Geometries {
  std::vector<std::shared_ptr<const HullGeometry>> hulls;
  std::shared_ptr<const TriangleMeshGeometry> mesh;
};

inline Geometries geometries_of(const Scene& scene) {
  Geometries out;
  for (const Hull& hull : scene.hulls) {
    std::vector<Vec3> points;
    for (const Vector3d& p : hull.points) points.push_back(build::vec(p));
    std::vector<std::uint32_t> sizes(hull.triangles.size(), 3), corners;
    for (const auto& t : hull.triangles) corners.insert(corners.end(), t.begin(), t.end());
    const HullGeometry::Result made = HullGeometry::create(points, sizes, corners);
    build::must(made.status);
    out.hulls.push_back(made.hull);
  }
  if (!scene.mesh.triangles.empty()) {
    std::vector<Vec3> vertices;
    for (const Vector3d& p : scene.mesh.vertices) vertices.push_back(build::vec(p));
    std::vector<std::uint32_t> corners;
    for (const auto& t : scene.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    const TriangleMeshGeometry::Result made = TriangleMeshGeometry::create(vertices, corners);
    build::must(made.status);
    out.mesh = made.mesh;
  }
  return out;
}

inline plumb::Shape shape_of(const anchors::Shape& shape, const Geometries& geometries) {
  switch (shape.kind) {
    case ShapeKind::Sphere:
      return build::sphere(shape.radius);
    case ShapeKind::Capsule:
      return build::capsule(shape.half_length, shape.radius);
    case ShapeKind::Hull:
      return ConvexHull{geometries.hulls[shape.hull]};
    case ShapeKind::Mesh:
      return SurfaceMesh{geometries.mesh};
    case ShapeKind::Plane:
      return HalfSpace{Vec3::UnitY(), Real(0)};
    case ShapeKind::Box:
    case ShapeKind::None:
      break;
  }
  return build::box(shape.half.x(), shape.half.y(), shape.half.z());
}

inline WorldSettings settings_of(const Scene& scene) {
  WorldSettings settings;
  settings.gravity = build::vec(scene.gravity);
  settings.sleeping = scene.sleeping;
  return settings;
}

// Builds the scene in a world that is empty yet; returns the dynamic bodies in their order. Mass
// comes from the shapes' density where there is a shape.
inline std::vector<BodyId> build_in(PhysicsWorld& world, const Scene& scene) {
  const Geometries geometries = geometries_of(scene);
  const auto add = [&](const Body& body, MotionType type) {
    RigidBody made =
        build::body_at(build::at(body.position, Quat(body.orientation.cast<Real>())), type);
    made.linear_velocity = build::vec(body.velocity);
    made.angular_velocity = build::vec(body.spin);
    if (body.shape.kind == ShapeKind::None) {
      MassProperties properties;
      properties.mass = body.mass;
      properties.I_Bcm_B = body.inertia.asDiagonal();
      made.mass = properties;
      return build::must(world.create_body(made));
    }
    const bool ground = type == MotionType::Static;
    Material surface =
        build::material(ground ? scene.friction : scene.friction_of_bodies(), scene.restitution);
    if (ground) surface.friction_rule = CombineRule::Minimum;
    Collider collider = build::with(shape_of(body.shape, geometries), surface, body.density);
    if (!scene.collide) collider.filter.collides_with = 0;
    return build::add(world, made, collider);
  };
  for (const Body& body : scene.ground) add(body, MotionType::Static);
  std::vector<BodyId> ids;
  for (const Body& body : scene.bodies) ids.push_back(add(body, MotionType::Dynamic));
  for (const anchors::BallJoint& held : scene.joints) {
    Joint joint;
    if (held.a >= 0) joint.body_a = ids[static_cast<std::size_t>(held.a)];
    if (held.b >= 0) joint.body_b = ids[static_cast<std::size_t>(held.b)];
    joint.frame_a.position = build::vec(held.at_a);
    joint.frame_b.position = build::vec(held.at_b);
    build::must(world.create_joint(joint));
  }
  return ids;
}

}  // namespace plumb::anchors
