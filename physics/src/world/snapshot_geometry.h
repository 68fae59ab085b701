// Geometries of meshes, heightfields and compounds in a snapshot: each once, whatever the number of
// colliders that share it.
#pragma once

#include <string>
#include <vector>

#include "plumb/shapes.h"
#include "plumb/snapshot.h"
#include "world/snapshot_table.h"

namespace plumb::inline PLUMB_ABI::detail {

// Whole shapes as two columns of a table: how many numbers each takes, and the numbers.
void save_shapes(ColumnWriter& out, const char* table, const std::vector<Shape>& shapes);
// Appends the shapes; false when the columns are not those of shapes.
bool restore_shapes(const Snapshot& in, const std::string& table, std::vector<Shape>& shapes);

class GeometryTable {
 public:
  // The number of the shape's geometry; what is the instance's own goes to `numbers` (mesh: scale).
  std::uint32_t add(const Shape& shape, double (&numbers)[4]);
  void save(ColumnWriter& out) const;

  bool restore(const Snapshot& in);
  // The shape of a kind (its index in Shape) with a geometry read before. False if there is none.
  bool take(std::uint32_t index, std::uint32_t kind, const double (&numbers)[4], Shape& out) const;

 private:
  std::vector<Shape> shapes_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
