// The effects that are drawn, followed through the inputs on the thread that steps: a world whose
// effects stay as they are costs one look at the inputs of each step.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "plumb/inputs.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class EffectList {
 public:
  // All that the world has now.
  void collect(const PhysicsWorld& world);
  // Whether the inputs changed what is to be drawn; the world is as they left it.
  bool follow(std::span<const InputRecord> inputs, const PhysicsWorld& world);

  [[nodiscard]] bool empty() const { return drawn_.empty(); }
  void copy_to(std::vector<Effect>& out) const;

 private:
  // Those that are no longer leave, the others are as the world has them.
  void renew(const PhysicsWorld& world);

  std::vector<std::pair<EffectId, Effect>> drawn_;  // in order of their ids
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
