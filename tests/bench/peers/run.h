// A case of the accuracy lab in an engine behind anchors/engines/engine.h: once for its readings
// and apart from that for its time.
#pragma once

#include <string>
#include <vector>

#include "accuracy/setups/setup.h"
#include "bench/anchors/engines/engine.h"

namespace plumb::peers {

// The case as a scene that every engine builds. Hinges become ball joints.
anchors::Scene scene_of(const accuracy::Setup& setup);

struct Outcome {
  bool built = false;  // false: the engine cannot build the scene
  bool finite = true;
  std::vector<double> readings;
};
Outcome run(const anchors::EngineKind& kind, const accuracy::Setup& setup, double dt);

// Computing time for a body and a simulated second [s], the least of a few runs of at least
// `window` [s] that do nothing else, by the processor's clock of this program.
double cost(const anchors::EngineKind& kind, const accuracy::Setup& setup, double dt,
            double window);

// A row of the CSV with its line end, and what its columns are called.
std::string header_row();
std::string row_of(const std::string& name, const anchors::EngineKind& kind, double dt,
                   const Outcome& outcome, double seconds);

}  // namespace plumb::peers
