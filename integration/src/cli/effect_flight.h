// Every effect once, with numbers that make it act, and bodies in free flight that carry it.
#pragma once

#include <vector>

#include "plumb/world.h"

namespace plumb::cli {

struct NamedEffect {
  const char* name;
  EffectKind kind;
};
std::vector<NamedEffect> every_effect();

// Boxes that fly freely, far from one another; the first `carriers` of them carry the effect.
class EffectFlight {
 public:
  EffectFlight(const EffectKind& kind, int bodies, int carriers);
  void step(int count);  // of 1/60 s

 private:
  PhysicsWorld world_;
};

}  // namespace plumb::cli
