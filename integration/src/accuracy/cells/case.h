// One run of one case, in the number types of this build.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "accuracy/cell.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::cells {

class Case {
 public:
  explicit Case(const WorldSettings& settings) : world(settings) {}
  virtual ~Case() = default;
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;

  virtual void before_step() {}  // forces of the user
  virtual void after_step() {}   // looks at the world; not called in timed runs
  [[nodiscard]] virtual std::vector<double> readings() const = 0;
  [[nodiscard]] virtual std::vector<double> statistics() const { return {}; }  // of chaotic cases

  PhysicsWorld world;
  double seconds = 1;  // [s] to simulate
  int bodies = 1;      // dynamic ones, for the price of one
};

// What a case is made from. `copies`: so many of it side by side, none of which meets another; the
// readings are of the first. Timed runs have several, so that a step is longer than its overhead.
struct Making {
  accuracy::Knobs knobs;
  int copies = 1;
  double disturb = 0;  // [m]
  std::uint32_t seed = 1;
  [[nodiscard]] WorldSettings settings() const;
};

struct CaseMaker {
  const char* name;
  int copies;  // in timed runs
  std::function<std::unique_ptr<Case>(const Making&)> make;
};
std::vector<CaseMaker> plain_cases();   // built from accuracy/setups
std::vector<CaseMaker> forced_cases();  // a medium, a force of the user
std::vector<CaseMaker> shot_cases();
std::vector<CaseMaker> stacked_cases();

}  // namespace plumb::inline PLUMB_ABI::cells
