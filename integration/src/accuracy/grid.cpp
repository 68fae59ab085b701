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

constexpr int kNewton = 1;  // in solver_names()

// What of a setting is not as usual: ", Newton, no warm start".
std::string exceptions_of(const Knobs& knobs) {
  const Knobs usual;
  std::string out;
  if (knobs.solver != usual.solver)
    out += ", " + solver_names()[static_cast<std::size_t>(knobs.solver)];
  if (knobs.joint_order != usual.joint_order)
    out += ", joints of order " + std::to_string(knobs.joint_order);
  if (!knobs.warm_start) out += ", no warm start";
  if (knobs.continuous) out += ", continuous";
  return out;
}

std::string label_of(Precision p) { return kPrecisionNames[static_cast<int>(p)]; }

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

template <class T>
std::vector<T> or_default(const std::vector<T>& given, T standard) {
  return given.empty() ? std::vector<T>{standard} : given;
}

std::vector<Series> users_choice(const KnobChoice& choice) {
  const Knobs standard;
  std::vector<Series> out;
  for (const Precision p : or_default(choice.precision, precisions().front()))
    for (const int rotation : or_default(choice.rotation, standard.rotation))
      for (const int solver : or_default(choice.solver, standard.solver))
        for (const int substeps : or_default(choice.substeps, standard.substeps))
          for (const int joint_order : or_default(choice.joint_order, standard.joint_order))
            for (const bool warm : or_default(choice.warm_start, standard.warm_start))
              for (const bool continuous : or_default(choice.continuous, standard.continuous)) {
                Knobs knobs{standard.dt, substeps, rotation, solver,
                            joint_order, p,        warm,     continuous};
                Series series;
                series.label = label_of(p) + ", " +
                               rotation_names()[static_cast<std::size_t>(rotation)] + ", " +
                               std::to_string(substeps) + " substeps" + exceptions_of(knobs);
                for (const double dt : or_default(choice.dt, standard.dt)) {
                  knobs.dt = dt;
                  series.settings.push_back(knobs);
                }
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
