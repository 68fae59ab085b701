// Several convex shapes as one: what a table, a chair or a hammer is made of.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {

namespace detail {
struct CompoundData;
}

// Child shapes in place, with a small search tree, checked once when it is made, then shared by any
// number of colliders. One collider, one material; each child that touches has contacts of its own.
// Where children overlap, their mass counts twice, as that of several colliders would.
class CompoundGeometry {
 public:
  static constexpr std::size_t kMaxChildren = 65535;
  struct Child {
    Shape shape = Sphere{};
    LocalPose pose{};  // of the child in the compound's frame
  };
  struct Result {
    std::shared_ptr<const CompoundGeometry> compound;
    Status status;
  };
  // Children: convex and bounded; no half-spaces, meshes, heightfields or compounds.
  static Result create(std::span<const Child> children);

  [[nodiscard]] const std::vector<Child>& children() const { return children_; }
  [[nodiscard]] const detail::CompoundData& data() const { return *data_; }

 private:
  std::vector<Child> children_;
  std::shared_ptr<const detail::CompoundData> data_;
};

}  // namespace plumb::inline PLUMB_ABI
