// The lab's cases: what each is about, what its error is measured in and against, and which knobs
// are turned on it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumb::accuracy {

enum class Family : std::uint8_t { Free, Bouncing, Sliding, Jointed, Stacked, Published };
inline constexpr int kFamilyCount = 6;
const char* name_of(Family family);

// A figure that somebody else has published for the case [Kang 2018], on an i7-7700HQ.
struct Published {
  std::string engine;
  double dt;             // [s]
  double measure;        // in the publication's own measure
  double seconds;        // [s] of computing; 0: not given
  bool at_most = false;  // the measure is not given, but what stood has at most this
};

struct CaseInfo {
  std::string name;  // as in tests/accuracy/README.md
  Family family;
  std::string title;  // what moves, and what is measured
  std::string unit;   // of the error
  double scale;       // the size of the motion in that unit: relative error = error/scale
  // The right readings in closed form; without: those of a reference run, whose own convergence is
  // measured too.
  std::optional<std::vector<double>> exact;
  bool turns = false;       // rotation methods are compared
  bool swings = false;      // joint orders are compared
  bool touches = false;     // warm starting is compared
  bool rubs_askew = false;  // friction cones are compared
  bool flies_fast = false;  // continuous collision is compared
  double measure = 0;       // published measure = this times the square of the error
  std::string measure_unit = "";
  double body_seconds = 0;  // [s] bodies times simulated time
  std::vector<Published> published = {};
  std::vector<double> rates = {};  // [Hz] of its steps; empty: those of its family (grid.cpp)
  bool chaotic = false;            // no error beyond a horizon: ensembles instead (chaos.h)
};

const std::vector<CaseInfo>& catalogue();
const CaseInfo* find_case(const std::string& name);  // null: there is none of that name

}  // namespace plumb::accuracy
