#include "world/snapshot_geometry.h"

#include <algorithm>

#include "plumb/compound.h"
#include "world/inputs.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

const void* geometry_of(const Shape& shape) {
  if (const auto* mesh = std::get_if<SurfaceMesh>(&shape)) return mesh->geometry.get();
  if (const auto* field = std::get_if<Heightfield>(&shape)) return field->geometry.get();
  if (const auto* compound = std::get_if<Compound>(&shape)) return compound->geometry.get();
  return nullptr;
}

}  // namespace

void save_shapes(ColumnWriter& out, const char* table, const std::vector<Shape>& shapes) {
  std::vector<std::uint64_t> sizes;
  std::vector<double> numbers, written;
  for (const Shape& shape : shapes) {
    Collider carrier;
    carrier.shape = shape;
    written.clear();
    append(written, carrier);
    sizes.push_back(written.size());
    numbers.insert(numbers.end(), written.begin(), written.end());
  }
  out.add(table, "size", 1, false).integers = std::move(sizes);
  out.add(table, "numbers", 1, true).reals = std::move(numbers);
}

bool restore_shapes(const Snapshot& in, const std::string& table, std::vector<Shape>& shapes) {
  const SnapshotColumn* sizes = in.find(table + ".size");
  const SnapshotColumn* numbers = in.find(table + ".numbers");
  if (sizes == nullptr || numbers == nullptr) return false;
  std::size_t at = 0;
  for (const std::uint64_t size : sizes->integers) {
    if (size > numbers->reals.size() - at) return false;
    NumberReader reader(std::span(numbers->reals).subspan(at, size));
    const Collider carrier = reader.collider();
    if (!reader.complete()) return false;
    shapes.push_back(carrier.shape);
    at += size;
  }
  return at == numbers->reals.size();
}

std::uint32_t GeometryTable::add(const Shape& shape, double (&numbers)[4]) {
  Shape carrier = shape;
  if (auto* mesh = std::get_if<SurfaceMesh>(&carrier)) {
    for (int i = 0; i < 3; ++i) numbers[i] = static_cast<double>(mesh->scale[i]);
    mesh->scale = Vec3::Ones();
  }
  std::uint32_t index = 0;
  while (index < shapes_.size() && geometry_of(shapes_[index]) != geometry_of(shape)) ++index;
  if (index == shapes_.size()) shapes_.push_back(std::move(carrier));
  return index;
}

void GeometryTable::save(ColumnWriter& out) const { save_shapes(out, "geometry", shapes_); }

bool GeometryTable::restore(const Snapshot& in) {
  return restore_shapes(in, "geometry", shapes_) &&
         std::all_of(shapes_.begin(), shapes_.end(),
                     [](const Shape& shape) { return geometry_of(shape) != nullptr; });
}

bool GeometryTable::take(std::uint32_t index, std::uint32_t kind, const double (&numbers)[4],
                         Shape& out) const {
  if (index >= shapes_.size() || shapes_[index].index() != kind) return false;
  out = shapes_[index];
  if (auto* mesh = std::get_if<SurfaceMesh>(&out)) {
    for (int i = 0; i < 3; ++i) mesh->scale[i] = static_cast<Real>(numbers[i]);
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
