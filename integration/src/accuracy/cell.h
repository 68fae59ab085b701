// A cell of the accuracy lab: one case at one setting of the knobs, and how it is run.
//
// The engine is built once per number type, each under a namespace of its own. The files in cells/
// are compiled once against each; this header is what they and the rest have in common, in types
// that are the same for all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::accuracy {

enum class Precision : std::uint8_t { F32, F32D, F64 };
inline constexpr const char* kPrecisionNames[] = {"f32", "f32d", "f64"};

struct Knobs {
  double dt = 1.0 / 60;  // [s] > 0
  int substeps = 4;      // [-] 1..64
  int rotation = 0;      // a RotationMethod by its number
  int solver = 0;        // a ContactSolver by its number
  int iterations = 1;    // [-] 1..64, WorldSettings::velocity_iterations
  int friction = 0;      // a FrictionCone by its number
  int joint_order = 2;   // [-] 2 or 4
  Precision precision = Precision::F64;
  bool warm_start = true;
  bool continuous = false;  // RigidBody::continuous of what moves fast

  friend bool operator==(const Knobs&, const Knobs&) = default;
};

// What a run ended with. Readings are chosen so that the Euclidean distance of two lists is the
// error in the case's unit.
struct Readings {
  std::vector<double> values;
  bool finite = true;
};

// A run looked at every so often, for cases whose end says little.
struct Trace {
  std::vector<std::vector<double>> places;  // [m] all coordinates, at the start and every `every`
  std::vector<double> statistics;           // at the end, in the order of kStatistics
  bool finite = true;
};
inline constexpr const char* kStatistics[] = {"centre of mass [m]", "highest body [m]",
                                              "energy [J]", "deepest overlap [m]"};

// The cases as compiled for one number type.
struct CellCode {
  Readings (*run)(std::string_view name, const Knobs& knobs);
  // `disturb` [m]: how far the first body is shifted at the start. `seed`: which of an ensemble.
  Trace (*trace)(std::string_view name, const Knobs& knobs, double every, double disturb,
                 std::uint32_t seed);
  // Computing time for a body and a simulated second [s]: the least of a few runs that do nothing
  // else, each of about `window` seconds, by the clock of the one thread that steps.
  double (*time)(std::string_view name, const Knobs& knobs, double window);
};
const CellCode& cells_f32();  // where the build has them
const CellCode& cells_f32d();
const CellCode& cells_f64();
// Null where the build does not have this number type.
const CellCode* cells_of(Precision precision);

// How methods are called on the command line and in reports, in the order of RotationMethod.
const std::vector<std::string>& rotation_names();
const std::vector<std::string>& solver_names();    // likewise of ContactSolver
const std::vector<std::string>& friction_names();  // likewise of FrictionCone

}  // namespace plumb::accuracy
