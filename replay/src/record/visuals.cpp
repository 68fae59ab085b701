#include "record/visuals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "plumb/compound.h"
#include "plumb/heightfield.h"
#include "plumb/triangle_mesh.h"
#include "record/shape_mesh.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::size_t kPrimitives = 3, kRoles = 3;

// A half-space is drawn as a plate of this many scene radii to each side ...
constexpr double kGroundRadii = 2.5;
// ... and of this share of its width.
constexpr double kGroundThickness = 1.0 / 400;

std::size_t batch_index(Primitive primitive, Role role) {
  return static_cast<std::size_t>(primitive) * kRoles + static_cast<std::size_t>(role);
}

Eigen::Vector3f sizes_of(double a, double b, double c) {
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)};
}

// Of a sphere around the shape's own origin [m]; 0 for a half-space.
double radius_of(const Shape& shape) {
  struct Visitor {
    double operator()(const Sphere& s) const { return s.radius; }
    double operator()(const Box& b) const {
      return b.half_extents.template cast<double>().norm() + double{b.rounding};
    }
    double operator()(const Capsule& c) const { return double{c.half_length} + double{c.radius}; }
    double operator()(const ConvexHull& h) const {
      if (!h.geometry) return 0;
      return h.geometry->interior_point().template cast<double>().norm() +
             double{h.geometry->outer_radius()} + double{h.rounding};
    }
    double operator()(const Cylinder& c) const {
      return std::hypot(double{c.half_length}, double{c.radius}) + double{c.rounding};
    }
    double operator()(const Cone& c) const {
      return std::hypot(double{c.half_length}, double{c.radius}) + double{c.rounding};
    }
    double operator()(const HalfSpace&) const { return 0; }
    double operator()(const SurfaceMesh& m) const {
      if (!m.geometry) return 0;
      const Vec3 far = m.geometry->lower().cwiseAbs().cwiseMax(m.geometry->upper().cwiseAbs());
      return far.cwiseProduct(m.scale).template cast<double>().norm();
    }
    double operator()(const Heightfield& f) const {
      if (!f.geometry) return 0;
      const Vec3 far = f.geometry->lower().cwiseAbs().cwiseMax(f.geometry->upper().cwiseAbs());
      return far.template cast<double>().norm();
    }
    double operator()(const Compound& c) const {
      double radius = 0;
      if (!c.geometry) return 0;
      for (const CompoundGeometry::Child& child : c.geometry->children())
        radius = std::max(radius, child.pose.position.template cast<double>().norm() +
                                      std::visit(*this, child.shape));
      return radius;
    }
  };
  return std::visit(Visitor{}, shape);
}

Eigen::Vector3d up_axis(const PhysicsWorld& world) {
  const Eigen::Vector3d gravity = world.settings().gravity.template cast<double>();
  return gravity.norm() > 0 ? Eigen::Vector3d(-gravity.normalized()) : Eigen::Vector3d::UnitY();
}

// Whether a box rises above everything that moves: a wall that would hide it.
bool towers(const Box& box, const LocalPose& X_BC, const BodyState& body,
            const SceneExtent& extent) {
  const Quat R_WC = body.pose.orientation * X_BC.orientation;
  const Eigen::Vector3d center = body.pose.position.template cast<double>() +
                                 (body.pose.orientation * X_BC.position).template cast<double>();
  const Vec3 up_C = R_WC.conjugate() * extent.up.template cast<Real>();
  const double reach = double{up_C.cwiseAbs().dot(box.half_extents)};
  return center.dot(extent.up) + reach + double{box.rounding} > extent.top;
}

}  // namespace

SceneExtent extent_of(const PhysicsWorld& world, const Frame& frame) {
  Eigen::AlignedBox3d moving, all;
  const Eigen::Vector3d up = up_axis(world);
  double radius_sum = 0, top = -std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (const BodyState& body : frame.bodies) {
    for (const ColliderId id : world.colliders_of(body.id)) {
      const Collider collider = world.collider(id);
      const double radius = radius_of(collider.shape);
      if (radius == 0) continue;
      const Eigen::Vector3d center =
          body.pose.position.template cast<double>() +
          (body.pose.orientation * collider.pose.position).template cast<double>();
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
      const Eigen::AlignedBox3d box(center - reach, center + reach);
      if (!center.allFinite()) continue;
      all.extend(box);
      if (body.type == MotionType::Static) continue;
      moving.extend(box);
      top = std::max(top, center.dot(up) + radius);
      radius_sum += radius;
      ++count;
    }
  }
  const Eigen::AlignedBox3d& seen = moving.isEmpty() ? all : moving;
  SceneExtent extent;
  extent.up = up;
  extent.top = count ? top : std::numeric_limits<double>::infinity();
  if (seen.isEmpty()) return extent;
  extent.center = seen.center();
  extent.radius = seen.diagonal().norm() / 2;
  extent.half_height = seen.diagonal().dot(up.cwiseAbs()) / 2;
  if (count) extent.body_radius = radius_sum / static_cast<double>(count);
  return extent;
}

Visuals::Visuals() {
  shapes_.reserve(kPrimitives * kRoles);
  for (const Primitive primitive : {Primitive::Box, Primitive::Sphere, Primitive::Capsule})
    for (const Role role : {Role::Moving, Role::Static, Role::Outline})
      shapes_.emplace_back(primitive, role);
}

void Visuals::show_as(BodyId body, std::shared_ptr<const VisualMesh> mesh) {
  shown_as_[body] = std::move(mesh);
}

const VisualMesh* Visuals::shape_mesh(const Shape& shape) {
  std::vector<double> key{static_cast<double>(shape.index())};
  const auto add = [&key](auto... sizes) { (key.push_back(static_cast<double>(sizes)), ...); };
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    add(cylinder->half_length, cylinder->radius, cylinder->rounding);
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    add(cone->half_length, cone->radius, cone->rounding);
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    const Vec3& h = box->half_extents;
    if (!(box->rounding > Real(0))) return nullptr;
    add(h.x(), h.y(), h.z(), box->rounding);
  } else if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
    if (!hull->geometry || !(hull->rounding > Real(0))) return nullptr;
    kept_alive_.push_back(hull->geometry);
    add(reinterpret_cast<std::uintptr_t>(hull->geometry.get()), hull->rounding);
  } else {
    return nullptr;
  }
  std::shared_ptr<const VisualMesh>& mesh = shape_meshes_[key];
  if (!mesh) mesh = std::make_shared<const VisualMesh>(mesh_of_shape(shape).value());
  return mesh.get();
}

MeshBatch& Visuals::mesh_batch(rrd::Writer& writer, const void* key, const VisualMesh& mesh) {
  const auto [found, is_new] = mesh_index_.try_emplace(key, meshes_.size());
  if (is_new) {
    const std::string entity = "world/meshes/" + std::to_string(meshes_.size());
    if (mesh.color != 0) {
      meshes_.emplace_back(writer, entity, mesh);
    } else {
      VisualMesh colored = mesh;
      colored.color = kBodyColors[meshes_.size() % kBodyColors.size()];
      meshes_.emplace_back(writer, entity, colored);
    }
  }
  return meshes_[found->second];
}

void Visuals::add_collider(rrd::Writer& writer, const Collider& collider, PlacedPart part,
                           Role role, const SceneExtent& extent) {
  part.pose = collider.pose;
  part.at_body_frame = collider.pose.position.isZero(Real(0)) &&
                       collider.pose.orientation.coeffs() == Quat::Identity().coeffs();
  const auto batch = [&](Primitive primitive) -> ShapeBatch& {
    return shapes_[batch_index(primitive, role)];
  };
  if (const VisualMesh* mesh = role == Role::Outline ? nullptr : shape_mesh(collider.shape)) {
    mesh_batch(writer, mesh, *mesh).add_part(part);
  } else if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
    const double r = sphere->radius;
    batch(Primitive::Sphere).add_part(part, sizes_of(r, r, r));
  } else if (const auto* box = std::get_if<Box>(&collider.shape)) {
    const Vec3 grown = box->half_extents + Vec3::Constant(box->rounding);
    batch(Primitive::Box).add_part(part, grown.template cast<float>());
  } else if (const auto* capsule = std::get_if<Capsule>(&collider.shape)) {
    batch(Primitive::Capsule).add_part(part, sizes_of(capsule->half_length, capsule->radius, 0));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&collider.shape)) {
    // Sensors are drawn as the outline of the box around them.
    const double r = double{cylinder->radius} + double{cylinder->rounding};
    const double h = double{cylinder->half_length} + double{cylinder->rounding};
    batch(Primitive::Box).add_part(part, sizes_of(r, h, r));
  } else if (const auto* cone = std::get_if<Cone>(&collider.shape)) {
    const double r = double{cone->radius} + double{cone->rounding};
    const double h = double{cone->half_length} + double{cone->rounding};
    batch(Primitive::Box).add_part(part, sizes_of(r, h, r));
  } else if (const auto* hull = std::get_if<ConvexHull>(&collider.shape)) {
    if (!hull->geometry) return;
    const void* key = hull->geometry.get();
    if (!mesh_index_.contains(key)) kept_alive_.push_back(hull->geometry);
    mesh_batch(writer, key, mesh_of(*hull->geometry)).add_part(part);
  } else if (const auto* half = std::get_if<HalfSpace>(&collider.shape)) {
    const double side = kGroundRadii * extent.radius, thickness = side * kGroundThickness;
    const Real length = half->normal.norm();
    const Vec3 normal = half->normal / length;
    part.at_body_frame = false;
    part.pose.orientation = collider.pose.orientation * Quat::FromTwoVectors(Vec3::UnitY(), normal);
    part.pose.position += collider.pose.orientation *
                          (normal * (half->offset / length - static_cast<Real>(thickness)));
    batch(Primitive::Box).add_part(part, sizes_of(side, thickness, side));
  } else if (const auto* mesh = std::get_if<SurfaceMesh>(&collider.shape)) {
    if (!mesh->geometry) return;
    // One drawing for each geometry and scale.
    const MeshAndScale key{mesh->geometry.get(), mesh->scale.x(), mesh->scale.y(), mesh->scale.z()};
    const auto [found, is_new] = scaled_meshes_.try_emplace(key);
    if (is_new) {
      kept_alive_.push_back(mesh->geometry);
      found->second = std::make_shared<const VisualMesh>(mesh_of(*mesh));
    }
    mesh_batch(writer, found->second.get(), *found->second).add_part(part);
  } else if (const auto* field = std::get_if<Heightfield>(&collider.shape)) {
    if (!field->geometry) return;
    const void* key = field->geometry.get();
    if (mesh_index_.contains(key)) {
      mesh_batch(writer, key, {}).add_part(part);
    } else {
      kept_alive_.push_back(field->geometry);
      mesh_batch(writer, key, mesh_of(*field->geometry)).add_part(part);
    }
  } else if (const auto* compound = std::get_if<Compound>(&collider.shape)) {
    if (!compound->geometry) return;
    for (const CompoundGeometry::Child& child : compound->geometry->children()) {
      Collider piece = collider;
      piece.shape = child.shape;
      piece.pose.position += collider.pose.orientation * child.pose.position;
      piece.pose.orientation = collider.pose.orientation * child.pose.orientation;
      add_collider(writer, piece, part, role, extent);
    }
  }
}

void Visuals::rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame,
                      const SceneExtent& extent) {
  for (ShapeBatch& batch : shapes_) batch.clear_parts();
  for (MeshBatch& batch : meshes_) batch.clear_parts();
  for (std::size_t slot = 0; slot < frame.bodies.size(); ++slot) {
    const BodyState& body = frame.bodies[slot];
    const bool is_static = body.type == MotionType::Static;
    PlacedPart part;
    part.slot = slot;
    part.color = is_static ? kStaticColor : kBodyColors[body.id.index % kBodyColors.size()];
    if (const auto shown = shown_as_.find(body.id); shown != shown_as_.end() && shown->second) {
      if (!mesh_index_.contains(shown->second.get())) kept_alive_.push_back(shown->second);
      mesh_batch(writer, shown->second.get(), *shown->second).add_part(part);
      continue;
    }
    for (const ColliderId id : world.colliders_of(body.id)) {
      const Collider collider = world.collider(id);
      const auto* box = std::get_if<Box>(&collider.shape);
      const bool hides = is_static && box && towers(*box, collider.pose, body, extent);
      const Role role = collider.is_sensor || hides ? Role::Outline
                        : is_static                 ? Role::Static
                                                    : Role::Moving;
      PlacedPart colored = part;
      if (collider.is_sensor) colored.color = kSensorColor;
      add_collider(writer, collider, colored, role, extent);
    }
  }
  for (ShapeBatch& batch : shapes_) batch.announce(writer, frame);
  for (MeshBatch& batch : meshes_) {
    batch.add(frame);
    batch.send(writer);
  }
}

void Visuals::add(const Frame& frame) {
  for (ShapeBatch& batch : shapes_) batch.add(frame);
  for (MeshBatch& batch : meshes_) batch.add(frame);
}

void Visuals::send(rrd::Writer& writer) {
  for (ShapeBatch& batch : shapes_) batch.send(writer);
  for (MeshBatch& batch : meshes_) batch.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
