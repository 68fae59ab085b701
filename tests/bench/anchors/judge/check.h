// What a run was worth, judged from the bodies' poses and velocities alone, in double, by code that
// no engine shares.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/anchors/scene.h"

namespace plumb::anchors {

struct Quality {
  double penetration = 0;   // [m] worst overlap at the end
  double under_mesh = 0;    // [m] how far the deepest corner lies below the scene's mesh at the end
  double top_sideways = 0;  // [m] that the top body has moved
  double top_up = 0;        // [m] likewise, positive upwards
  double joint_gap = 0;     // [m] worst over the run
  double energy_change = 0;  // [-] end against start, over the start's (potential zero at y = 0)
  double energy_rise = 0;    // [-] highest over the start; where the scene watches it
  double energy_rms = 0;     // [-] root of the mean square error, likewise
  int escaped = 0;           // bodies outside of the scene's bounds or not finite
  double mean_speed = 0;     // [m/s] at the end
  int flips = 0;             // of the first body's y axis
  std::uint64_t hash = 0;    // of the final poses' bits, to compare runs

  // The top moved less than 0.5 m sideways, and in height between -1.5 and +0.5 m.
  [[nodiscard]] bool stands() const { return top_sideways < 0.5 && top_up > -1.5 && top_up < 0.5; }
};

class Checker {
 public:
  // The scene must outlive it.
  explicit Checker(const Scene& scene);
  // Whether after_step() wants to see every step.
  [[nodiscard]] bool watches() const { return watches_; }
  void after_step(const std::vector<BodyState>& bodies);
  // Seconds of work where thousands of bodies touch.
  Quality finish(const std::vector<BodyState>& bodies);

 private:
  const Scene& scene_;
  bool watches_;
  double energy_ = 0;  // [J] at the start
  double square_sum_ = 0;
  int steps_ = 0;
  double last_up_ = 1;
  Quality quality_;
};

// Worst overlap [m] of the bodies with each other and with the ground (not its mesh).
double worst_penetration(const Scene& scene, const std::vector<BodyState>& bodies);
// How far the deepest corner of a box, or lowest point of a ball, lies below the mesh [m] >= 0.
double depth_under_mesh(const Scene& scene, const std::vector<BodyState>& bodies);
// Kinetic and potential, zero at y = 0 [J].
double energy_of(const Scene& scene, const std::vector<BodyState>& bodies);

}  // namespace plumb::anchors
