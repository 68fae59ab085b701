#include "record/mesh_batch.h"

#include <array>
#include <cmath>

#include "plumb/heightfield.h"
#include "plumb/triangle_mesh.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

enum PoseColumn : std::size_t { kTranslation, kQuaternion, kScale };

void add_pose_columns(rrd::Table& table) {
  table.add_column<float>("InstancePoses3D:translations", 3);
  table.add_column<float>("InstancePoses3D:quaternions", 4);
  table.add_column<float>("InstancePoses3D:scales", 3);
}

void send_mesh(rrd::Writer& writer, const std::string& entity, const VisualMesh& mesh,
               std::uint32_t color) {
  rrd::Table table(entity);
  const std::size_t positions = table.add_column<float>("Mesh3D:vertex_positions", 3);
  const std::size_t normals = table.add_column<float>("Mesh3D:vertex_normals", 3);
  const std::size_t indices = table.add_column<std::uint32_t>("Mesh3D:triangle_indices", 3);
  const std::size_t albedo = table.add_column<std::uint32_t>("Mesh3D:albedo_factor");
  std::uint32_t next = 0;
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3f corner[3];
    bool whole = true;
    for (Eigen::Index i = 0; i < 3; ++i) {
      whole = whole && triangle[i] < mesh.vertices.size();
      if (whole) corner[i] = mesh.vertices[triangle[i]];
    }
    if (!whole) continue;
    const Eigen::Vector3f normal =
        (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    const std::uint32_t index[3] = {next, next + 1, next + 2};
    next += 3;
    for (const Eigen::Vector3f& point : corner) {
      table.column(positions).append(std::span<const float>(point.data(), 3));
      table.column(normals).append(std::span<const float>(normal.data(), 3));
    }
    table.column(indices).append(std::span<const std::uint32_t>(index));
  }
  table.column(albedo).append_one(color);
  table.send_static(writer);
}

}  // namespace

VisualMesh mesh_of(const HullGeometry& hull) {
  VisualMesh mesh;
  for (const Vec3& vertex : hull.vertices()) mesh.vertices.push_back(vertex.cast<float>());
  for (std::size_t k = 0; k < hull.face_count(); ++k) {
    const auto face = hull.face(k);
    for (std::size_t i = 2; i < face.size(); ++i)
      mesh.triangles.emplace_back(face[0], face[i - 1], face[i]);
  }
  return mesh;
}

VisualMesh mesh_of(const SurfaceMesh& surface) {
  VisualMesh mesh;
  for (std::size_t t = 0; t < surface.geometry->triangle_count(); ++t) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : surface.geometry->triangle(t))
      mesh.vertices.push_back(corner.cwiseProduct(surface.scale).template cast<float>());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh.color = kStaticColor;
  return mesh;
}

VisualMesh mesh_of(const HeightfieldGeometry& field) {
  VisualMesh mesh;
  for (std::uint32_t k = 0; k < field.samples_z(); ++k) {
    for (std::uint32_t i = 0; i < field.samples_x(); ++i) {
      const Real height = field.height(i, k);
      // A sample without height belongs to holes only; it stands somewhere, in no triangle.
      mesh.vertices.emplace_back(static_cast<float>(static_cast<Real>(i) * field.spacing_x()),
                                 std::isnan(height) ? 0.0F : static_cast<float>(height),
                                 static_cast<float>(static_cast<Real>(k) * field.spacing_z()));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return k * field.samples_x() + i; };
  for (std::uint32_t k = 0; k + 1 < field.samples_z(); ++k) {
    for (std::uint32_t i = 0; i + 1 < field.samples_x(); ++i) {
      if (field.is_hole(i, k)) continue;
      mesh.triangles.emplace_back(at(i, k), at(i, k + 1), at(i + 1, k + 1));
      mesh.triangles.emplace_back(at(i, k), at(i + 1, k + 1), at(i + 1, k));
    }
  }
  mesh.color = kStaticColor;
  return mesh;
}

MeshBatch::MeshBatch(rrd::Writer& writer, const std::string& entity, const VisualMesh& mesh)
    : awake_(entity + "/awake"), asleep_(entity + "/asleep") {
  add_pose_columns(awake_);
  add_pose_columns(asleep_);
  send_mesh(writer, awake_.entity(), mesh, mesh.color);
  send_mesh(writer, asleep_.entity(), mesh, kAsleepColor);
}

void MeshBatch::add_instances(rrd::Table& table, const Frame& frame, bool awake) {
  std::size_t count = 0;
  for (const PlacedPart& part : parts_) {
    const BodyState& body = frame.bodies[part.slot];
    if ((body.awake || body.type == MotionType::Static) != awake) continue;
    part.write_pose(frame.bodies, table.column(kTranslation).extend<float>(1),
                    table.column(kQuaternion).extend<float>(1));
    ++count;
  }
  // Without any instance the viewer would draw the mesh once, at the origin: one of no size is not
  // seen. One scale holds for all instances of a row.
  const float scale = count == 0 ? 0.0f : 1.0f;
  if (count == 0) {
    const float at_origin[7] = {0, 0, 0, 0, 0, 0, 1};
    table.column(kTranslation).append(std::span<const float>(at_origin, 3));
    table.column(kQuaternion).append(std::span<const float>(at_origin + 3, 4));
  }
  table.column(kScale).append(std::span<const float>(std::array{scale, scale, scale}));
  table.end_row(frame.number, frame.time);
}

void MeshBatch::add(const Frame& frame) {
  add_instances(awake_, frame, true);
  add_instances(asleep_, frame, false);
}

void MeshBatch::send(rrd::Writer& writer) {
  awake_.send(writer);
  asleep_.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
