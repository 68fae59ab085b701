#include "scene/shape_maker.h"

#include <variant>
#include <vector>

#include "scene/heights_file.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

std::string ShapeMaker::place_of(int line) const {
  return scene_.source + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
}

Result<Shape> ShapeMaker::make(const SceneCollider& collider) {
  if (!collider.mesh.empty()) return make_mesh(collider.mesh, collider.collider.shape);
  if (!collider.heightfield.empty()) return make_heightfield(collider.heightfield);
  if (!collider.children.empty()) return make_compound(collider);
  return collider.collider.shape;
}

Result<Shape> ShapeMaker::make_mesh(const std::string& name, const Shape& asked) {
  const Result<std::size_t> index = meshes_.index_of(name);
  if (!index.ok()) return Error{index.error()};
  const PreparedMesh& mesh = meshes_.at(index.value());
  if (mesh.surface) {
    const auto* surface = std::get_if<SurfaceMesh>(&asked);
    return Shape{SurfaceMesh{mesh.surface, surface ? surface->scale : Vec3(Vec3::Ones())}};
  }
  if (mesh.parts) return Shape{Compound{mesh.parts}};
  const auto* hull = std::get_if<ConvexHull>(&asked);
  return Shape{ConvexHull{mesh.hull, hull ? hull->rounding : Real(0)}};
}

Result<Shape> ShapeMaker::make_heightfield(const std::string& name) {
  const auto found = heightfields_.find(name);
  if (found != heightfields_.end()) return Shape{Heightfield{found->second}};
  const SceneHeightfield* source = scene_.find_heightfield(name);
  if (!source) return Error{place_of(0) + "there is no heightfield '" + name + "'"};
  const std::string place = place_of(source->line) + "heightfield '" + name + "': ";
  SceneHeightfield field = *source;
  if (!field.file.empty()) {
    if (const std::string wrong = read_heights_file(field); !wrong.empty())
      return Error{place + wrong};
  }
  std::vector<Real> heights;
  for (const double height : field.heights)
    heights.push_back(static_cast<Real>(height * field.height_scale));
  const std::size_t rows = field.samples_x > 0 ? heights.size() / field.samples_x : 0;
  HeightfieldGeometry::Result made = HeightfieldGeometry::create(
      static_cast<std::uint32_t>(field.samples_x), static_cast<std::uint32_t>(rows),
      static_cast<Real>(field.spacing[0]), static_cast<Real>(field.spacing[1]), heights);
  if (!made.status.ok()) return Error{place + made.status.message};
  heightfields_.emplace(name, made.field);
  return Shape{Heightfield{std::move(made.field)}};
}

Result<Shape> ShapeMaker::make_compound(const SceneCollider& collider) {
  std::vector<CompoundGeometry::Child> children;
  for (const SceneChild& part : collider.children) {
    CompoundGeometry::Child& child = children.emplace_back(part.child);
    if (part.mesh.empty()) continue;
    Result<Shape> shape = make_mesh(part.mesh, part.child.shape);
    if (!shape.ok()) return shape;
    child.shape = std::move(shape).value();
  }
  CompoundGeometry::Result made = CompoundGeometry::create(children);
  if (!made.status.ok()) return Error{place_of(collider.line) + made.status.message};
  return Shape{Compound{std::move(made.compound)}};
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
