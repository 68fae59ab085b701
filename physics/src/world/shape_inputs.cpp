// Shapes as numbers, with their geometry. The layouts stand in inputs.cpp.
#include <cmath>
#include <limits>

#include "plumb/compound.h"
#include "plumb/heightfield.h"
#include "plumb/triangle_mesh.h"
#include "world/inputs.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A hole's height: NaN would not be equal to itself where inputs and snapshots are compared.
constexpr double kHole = 1e9;

void append_mesh(std::vector<double>& out, const SurfaceMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  mesh.geometry->copy_input(vertices, indices);
  append(out, mesh.scale);
  append_all(out, {static_cast<double>(vertices.size())});
  for (const Vec3& v : vertices) append(out, v);
  append_all(out, {static_cast<double>(indices.size() / 3)});
  for (const std::uint32_t i : indices) append_all(out, {static_cast<double>(i)});
}

void append_heightfield(std::vector<double>& out, const HeightfieldGeometry& field) {
  append_all(out, {static_cast<double>(field.samples_x()), static_cast<double>(field.samples_z()),
                   as_number(field.spacing_x()), as_number(field.spacing_z())});
  for (const Real h : field.heights()) append_all(out, {std::isnan(h) ? kHole : as_number(h)});
}

bool read_mesh(NumberReader& in, SurfaceMesh& mesh) {
  mesh.scale = in.vector();
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t n = in.word(); n > 0 && in.ok(); --n) vertices.push_back(in.vector());
  for (std::uint32_t n = in.word(); n > 0 && in.ok(); --n)
    for (int k = 0; k < 3; ++k) indices.push_back(in.word());
  if (!in.ok()) return false;
  mesh.geometry = TriangleMeshGeometry::create(vertices, indices).mesh;
  return mesh.geometry != nullptr;
}

bool read_heightfield(NumberReader& in, Heightfield& field) {
  const std::uint32_t samples_x = in.word(), samples_z = in.word();
  const Real spacing_x = in.real(), spacing_z = in.real();
  std::vector<Real> heights;
  for (std::uint64_t n = std::uint64_t{samples_x} * samples_z; n > 0 && in.ok(); --n) {
    const double height = in.number();
    heights.push_back(height == kHole ? std::numeric_limits<Real>::quiet_NaN()
                                      : static_cast<Real>(height));
  }
  if (!in.ok()) return false;
  field.geometry =
      HeightfieldGeometry::create(samples_x, samples_z, spacing_x, spacing_z, heights).field;
  return field.geometry != nullptr;
}

bool read_compound(NumberReader& in, Compound& compound) {
  std::vector<CompoundGeometry::Child> children;
  bool ok = true;
  for (std::uint32_t n = in.word(); n > 0 && in.ok() && ok; --n) {
    CompoundGeometry::Child child;
    child.shape = read_shape(in, ok);
    child.pose.position = in.vector();
    child.pose.orientation = in.orientation();
    children.push_back(child);
  }
  if (!in.ok() || !ok) return false;
  compound.geometry = CompoundGeometry::create(children).compound;
  return compound.geometry != nullptr;
}

}  // namespace

void append_shape(std::vector<double>& out, const Shape& shape) {
  append_all(out, {static_cast<double>(shape.index())});
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    append_all(out, {as_number(sphere->radius)});
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    append(out, box->half_extents);
    append_all(out, {as_number(box->rounding)});
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    append_all(out, {as_number(capsule->half_length), as_number(capsule->radius)});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    append_all(out, {as_number(cylinder->half_length), as_number(cylinder->radius),
                     as_number(cylinder->rounding)});
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    append_all(out,
               {as_number(cone->half_length), as_number(cone->radius), as_number(cone->rounding)});
  } else if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
    append_all(out, {as_number(hull->rounding)});
    const HullGeometry& geometry = *hull->geometry;
    append_all(out, {static_cast<double>(geometry.vertices().size())});
    for (const Vec3& v : geometry.vertices()) append(out, v);
    append_all(out, {static_cast<double>(geometry.face_count())});
    for (std::size_t k = 0; k < geometry.face_count(); ++k) {
      append_all(out, {static_cast<double>(geometry.face(k).size())});
      for (const std::uint32_t v : geometry.face(k)) append_all(out, {static_cast<double>(v)});
    }
  } else if (const auto* space = std::get_if<HalfSpace>(&shape)) {
    append(out, space->normal);
    append_all(out, {as_number(space->offset)});
  } else if (const auto* mesh = std::get_if<SurfaceMesh>(&shape)) {
    append_mesh(out, *mesh);
  } else if (const auto* heightfield = std::get_if<Heightfield>(&shape)) {
    append_heightfield(out, *heightfield->geometry);
  } else if (const auto* compound = std::get_if<Compound>(&shape)) {
    append_all(out, {static_cast<double>(compound->geometry->children().size())});
    for (const CompoundGeometry::Child& child : compound->geometry->children()) {
      append_shape(out, child.shape);
      append(out, child.pose.position);
      append(out, child.pose.orientation);
    }
  }
}

Shape read_shape(NumberReader& in, bool& ok) {
  switch (in.word()) {
    case 0:
      return Sphere{in.real()};
    case 1: {
      const Vec3 half_extents = in.vector();
      return Box{half_extents, in.real()};
    }
    case 2: {
      const Real half_length = in.real();
      return Capsule{half_length, in.real()};
    }
    case 3: {
      const Real rounding = in.real();
      std::vector<Vec3> vertices;
      for (std::uint32_t n = in.word(); n > 0 && in.ok(); --n) vertices.push_back(in.vector());
      std::vector<std::uint32_t> sizes, indices;
      for (std::uint32_t n = in.word(); n > 0 && in.ok(); --n) {
        sizes.push_back(in.word());
        for (std::uint32_t k = sizes.back(); k > 0 && in.ok(); --k) indices.push_back(in.word());
      }
      if (!in.ok()) break;
      auto made = HullGeometry::create(vertices, sizes, indices);
      if (!made.status.ok()) break;
      return ConvexHull{std::move(made.hull), rounding};
    }
    case 4: {
      const Vec3 normal = in.vector();
      return HalfSpace{normal, in.real()};
    }
    case 5: {
      SurfaceMesh mesh;
      if (read_mesh(in, mesh)) return mesh;
      break;
    }
    case 6: {
      Heightfield field;
      if (read_heightfield(in, field)) return field;
      break;
    }
    case 7: {
      Compound compound;
      if (read_compound(in, compound)) return compound;
      break;
    }
    case 8: {
      const Real half_length = in.real(), radius = in.real();
      return Cylinder{half_length, radius, in.real()};
    }
    case 9: {
      const Real half_length = in.real(), radius = in.real();
      return Cone{half_length, radius, in.real()};
    }
    default:
      break;
  }
  ok = false;
  return Sphere{};
}

}  // namespace plumb::inline PLUMB_ABI::detail
