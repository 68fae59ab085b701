#include "accuracy/grid.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "cli/read_number.h"

namespace plumb::accuracy {
namespace {

const std::vector<double>& rates(const CaseInfo& info, bool quick) {  // [Hz]
  static const std::vector<double> few{15, 30, 60, 120, 240}, all{15, 30, 60, 120, 240, 480, 1000},
      published{60, 100, 240, 1000}, published_few{60};
  if (info.family == Family::Published && quick) return published_few;
  if (!info.rates.empty()) return info.rates;
  if (info.family == Family::Published) return published;
  return quick ? few : all;
}

std::vector<Precision> precisions() {
  std::vector<Precision> list;
  for (const Precision p : {Precision::F64, Precision::F32, Precision::F32D})
    if (cells_of(p) != nullptr) list.push_back(p);
  return list;
}

Series step_series(std::string label, const CaseInfo& info, bool quick, Knobs knobs) {
  Series series{std::move(label), {}, true};
  for (const double rate : rates(info, quick)) {
    knobs.dt = 1 / rate;
    series.settings.push_back(knobs);
  }
  return series;
}

constexpr int kNewton = 1, kWorstFirst = 3;  // in solver_names()

// What of a setting is not as usual: ", Newton, no warm start".
std::string exceptions_of(const Knobs& knobs) {
  const Knobs usual;
  std::string out;
  if (knobs.solver != usual.solver)
    out += ", " + solver_names()[static_cast<std::size_t>(knobs.solver)];
  if (knobs.iterations != usual.iterations)
    out += ", " + std::to_string(knobs.iterations) + " iterations";
  if (knobs.friction != usual.friction)
    out += ", friction " + friction_names()[static_cast<std::size_t>(knobs.friction)];
  if (knobs.joint_order != usual.joint_order)
    out += ", joints of order " + std::to_string(knobs.joint_order);
  if (!knobs.warm_start) out += ", no warm start";
  if (knobs.continuous) out += ", continuous";
  return out;
}

std::string label_of(Precision p) { return kPrecisionNames[static_cast<int>(p)]; }

// What is there to be compared with: friction on polygons, the resolver of the textbook, more
// passes in place of more substeps.
void add_comparisons(const CaseInfo& info, bool quick, const Knobs& base,
                     std::vector<Series>& out) {
  for (int cone = 1; info.rubs_askew && cone < static_cast<int>(friction_names().size()); ++cone) {
    Knobs knobs = base;
    knobs.friction = cone;
    out.push_back(step_series("dt, friction " + friction_names()[static_cast<std::size_t>(cone)],
                              info, quick, knobs));
  }
  if (info.family == Family::Stacked || info.family == Family::Sliding) {
    Knobs knobs = base;
    knobs.solver = kWorstFirst;
    out.push_back(step_series("dt, WorstFirst", info, quick, knobs));
  }
  if (info.family != Family::Stacked) return;
  Series iterations{"iterations at 1/60, soft steps", {}, false};
  for (const int n :
       quick ? std::vector<int>{1, 4, 16} : std::vector<int>{1, 2, 4, 8, 16, 32, 64}) {
    Knobs knobs = base;
    knobs.iterations = n;
    iterations.settings.push_back(knobs);
  }
  out.push_back(std::move(iterations));
}

std::vector<Series> own_choice(const CaseInfo& info, bool quick) {
  std::vector<Series> out;
  Knobs base;
  const std::vector<Precision> types = precisions();
  base.precision = types.front();
  for (const Precision p : types) {
    if (quick && p == Precision::F32D) continue;
    Knobs knobs = base;
    knobs.precision = p;
    const std::string what = info.turns ? "dt, Exact, " : "dt, ";
    out.push_back(step_series(what + label_of(p), info, quick, knobs));
  }
  if (info.turns) {
    for (int method = 1; method < static_cast<int>(rotation_names().size()); ++method) {
      Knobs knobs = base;
      knobs.rotation = method;
      out.push_back(step_series("dt, " + rotation_names()[static_cast<std::size_t>(method)], info,
                                quick, knobs));
    }
  }
  if (info.flies_fast) {
    Knobs knobs = base;
    knobs.continuous = true;
    out.push_back(step_series("dt, continuous", info, quick, knobs));
  }
  if (info.family == Family::Free || (quick && info.family == Family::Published)) return out;
  if (info.swings) {
    Knobs knobs = base;
    knobs.joint_order = 4;
    out.push_back(step_series("dt, joints of order 4", info, quick, knobs));
  }
  if (info.touches) {
    Knobs knobs = base;
    knobs.solver = kNewton;
    out.push_back(step_series("dt, Newton, " + label_of(base.precision), info, quick, knobs));
  }
  if (info.touches) add_comparisons(info, quick, base, out);
  if (info.touches && !quick) {
    Knobs knobs = base;
    knobs.warm_start = false;
    out.push_back(step_series("dt, no warm start", info, quick, knobs));
  }
  Series substeps{"substeps at 1/60, " + label_of(base.precision), {}, false};
  const std::vector<int> counts =
      quick ? std::vector<int>{1, 4, 16} : std::vector<int>{1, 2, 4, 8, 16, 32, 64};
  for (const int n : counts) {
    if (n > 8 && info.family == Family::Published) continue;
    Knobs knobs = base;
    knobs.substeps = n;
    substeps.settings.push_back(knobs);
  }
  out.push_back(std::move(substeps));
  return out;
}

// Every setting so far with each value of one knob.
template <class T, class Given>
void combine(std::vector<Knobs>& settings, const std::vector<Given>& given, T Knobs::*knob) {
  if (given.empty()) return;
  std::vector<Knobs> out;
  for (const Knobs& setting : settings)
    for (const Given value : given) {
      out.push_back(setting);
      out.back().*knob = value;
    }
  settings = std::move(out);
}

std::vector<Series> users_choice(const KnobChoice& choice) {
  Knobs standard;
  standard.precision = precisions().front();
  std::vector<Knobs> settings{standard};
  combine(settings, choice.precision, &Knobs::precision);
  combine(settings, choice.rotation, &Knobs::rotation);
  combine(settings, choice.solver, &Knobs::solver);
  combine(settings, choice.substeps, &Knobs::substeps);
  combine(settings, choice.iterations, &Knobs::iterations);
  combine(settings, choice.friction, &Knobs::friction);
  combine(settings, choice.joint_order, &Knobs::joint_order);
  combine(settings, choice.warm_start, &Knobs::warm_start);
  combine(settings, choice.continuous, &Knobs::continuous);
  std::vector<Series> out;
  for (const Knobs& knobs : settings) {
    Series series;
    series.label = label_of(knobs.precision) + ", " +
                   rotation_names()[static_cast<std::size_t>(knobs.rotation)] + ", " +
                   std::to_string(knobs.substeps) + " substeps" + exceptions_of(knobs);
    series.settings = {knobs};
    combine(series.settings, choice.dt, &Knobs::dt);
    out.push_back(std::move(series));
  }
  return out;
}

}  // namespace

std::vector<Series> series_of(const CaseInfo& info, const KnobChoice& choice) {
  return choice.empty() ? own_choice(info, choice.quick) : users_choice(choice);
}

std::size_t cell_count(const std::vector<Series>& series) {
  std::size_t count = 0;
  for (const Series& s : series) count += s.settings.size();
  return count;
}

std::string step_words(double dt) {
  char text[32];
  const double rate = 1 / dt;
  if (std::abs(rate - std::round(rate)) < 1e-6 * rate && rate >= 1) {
    std::snprintf(text, sizeof text, "1/%.0f", rate);
  } else {
    std::snprintf(text, sizeof text, "%g", dt);
  }
  return text;
}

std::string words_of(const Knobs& knobs) {
  return "dt " + step_words(knobs.dt) + " s, " + std::to_string(knobs.substeps) + " substeps, " +
         label_of(knobs.precision) + ", " +
         rotation_names()[static_cast<std::size_t>(knobs.rotation)] + exceptions_of(knobs);
}

bool parse_step(const std::string& text, double& dt) {
  constexpr double kShortest = 1e-5, kLongest = 0.5;  // [s]
  return cli::parse_seconds(text, dt) && dt >= kShortest && dt <= kLongest;
}

bool parse_duration(const std::string& text, double& seconds) {
  std::string unit;
  if (!cli::parse_number(text, seconds, unit)) return false;
  if (unit == "ns") {
    seconds *= 1e-9;
  } else if (unit == "us") {
    seconds *= 1e-6;
  } else if (unit == "ms") {
    seconds *= 1e-3;
  } else if (!unit.empty() && unit != "s") {
    return false;
  }
  return seconds > 0;
}

}  // namespace plumb::accuracy
