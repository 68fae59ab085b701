// Scenes of SimBenchmark [Kang 2018] with its measures; y up instead of z.
#pragma once

#include "accuracy/setups/setup.h"

namespace plumb::accuracy {

std::vector<Setup> published_setups();

}  // namespace plumb::accuracy
