// Which cells are run: series, in each of which one knob is turned.
#pragma once

#include <string>
#include <vector>

#include "accuracy/catalogue.h"
#include "accuracy/cell.h"

namespace plumb::accuracy {

// A curve of the chart.
struct Series {
  std::string label;
  std::vector<Knobs> settings;  // in the order of the knob
  bool by_step = true;          // dt is what changes: an order of convergence can be fitted
};

// What the user asked for; empty lists: the lab's own choice.
struct KnobChoice {
  std::vector<double> dt;  // [s]
  std::vector<int> substeps;
  std::vector<int> rotation;
  std::vector<int> solver;
  std::vector<int> iterations;
  std::vector<int> friction;
  std::vector<int> joint_order;
  std::vector<Precision> precision;
  std::vector<bool> warm_start;
  std::vector<bool> continuous;
  bool quick = false;

  [[nodiscard]] bool empty() const {
    return dt.empty() && substeps.empty() && rotation.empty() && solver.empty() &&
           iterations.empty() && friction.empty() && joint_order.empty() && precision.empty() &&
           warm_start.empty() && continuous.empty();
  }
};

// The series of a case. With choices of the user: all their combinations, a series for each of
// those that differ in more than dt.
std::vector<Series> series_of(const CaseInfo& info, const KnobChoice& choice);
std::size_t cell_count(const std::vector<Series>& series);

// "1/60 s, 4 substeps, f64, Exact": a setting in words.
std::string words_of(const Knobs& knobs);
std::string step_words(double dt);  // "1/60"

// False where the text is no such thing.
bool parse_step(const std::string& text, double& dt);           // "1/60", "0.01" [s], 1e-5..0.5
bool parse_duration(const std::string& text, double& seconds);  // "200us", "1.5ms", "3e-4"

}  // namespace plumb::accuracy
