// Charts by gnuplot: the script is ours, the drawing is its.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "accuracy/peers.h"
#include "accuracy/report.h"

namespace plumb::accuracy {
namespace {

// Errors of zero have no logarithm: they stand at the foot of the chart.
constexpr double kFoot = 1e-17;

std::string line_of(double x, double y) {
  char text[80];
  std::snprintf(text, sizeof text, "%.6g %.6g\n", x, std::max(kFoot, y));
  return text;
}
std::string point(double cost, double error) { return line_of(1e6 * cost, error); }
std::string point(const CellResult& cell) { return point(cell.cost, cell.error); }

std::string with_order(const std::string& label, const OrderFit& fit) {
  if (!fit.found) return label;
  char text[32];
  std::snprintf(text, sizeof text, "  (order %.1f)", fit.order);
  return label + text;
}

// Line styles of other engines stand after our own.
constexpr int kFirstPeerStyle = 101, kPeerStyles = 6;
constexpr int kAtMost = 11;  // the mark that points down

// The curves of one panel: their points, and how they are drawn.
class Curves {
 public:
  void add(const std::string& name, const std::string& points, const std::string& look) {
    if (points.empty()) return;
    data_ += "$" + name + " << EOD\n" + points + "EOD\n";
    plots_ += (plots_.empty() ? "plot " : ", \\\n     ") + ("$" + name) + " using 1:2 " + look;
  }
  [[nodiscard]] std::string panel(const std::string& title, const std::string& x,
                                  const std::string& y) const {
    return data_ + "set title '" + title + "'\nset xlabel '" + x + "' offset 0,0.4\nset ylabel '" +
           y + "'\n" + plots_ + "\nundefine $*\n";
  }

 private:
  std::string data_, plots_;
};

std::string look_of_peer(std::size_t i, const std::string& label) {
  return "with linespoints ls " +
         std::to_string(kFirstPeerStyle + static_cast<int>(i) % kPeerStyles) + " title '" + label +
         "'";
}
std::string look_of_series(std::size_t i, const std::string& label) {
  return "with linespoints ls " + std::to_string(i + 1) + " title '" + label + "'";
}
// Plumb needs telling only where there are others.
std::string whose(const CaseResult& result) { return result.peers.empty() ? "" : "Plumb: "; }

// Published figures, a curve an engine with the same mark in both panels: over their time, where
// one was given, or over their step.
void add_published(Curves& curves, const CaseInfo& info, bool over_time) {
  constexpr int kMarks[] = {1, 2, 3, 4, 8, 10};
  std::vector<std::string> engines;
  for (const Published& p : info.published)
    if (std::find(engines.begin(), engines.end(), p.engine) == engines.end())
      engines.push_back(p.engine);
  for (std::size_t i = 0; i < engines.size(); ++i) {
    std::string points, steps, note;
    for (const Published& p : info.published) {
      if (p.engine != engines[i] || (over_time && !(p.seconds > 0))) continue;
      points += over_time
                    ? point(p.seconds / info.body_seconds, std::sqrt(p.measure / info.measure))
                    : line_of(p.dt, p.measure);
      steps += (steps.empty() ? " " : ", ") + step_words(p.dt);
      if (p.at_most) note = ": at most";
    }
    const int mark = note.empty() ? kMarks[i % std::size(kMarks)] : kAtMost;
    curves.add("published" + std::to_string(i), points,
               "with linespoints lw 2.5 ps 1.8 dt 3 pt " + std::to_string(mark) +
                   " lc rgb 'black' title '" + engines[i] + (over_time ? steps + " s" : "") +
                   ", published" + note + "'");
  }
}

std::string panel(const CaseResult& result) {
  const CaseInfo& info = *result.info;
  Curves curves;
  // The front first, wide and pale, so that the curves lie on it.
  std::vector<const CellResult*> front;
  for (const CellResult& cell : result.cells)
    if (cell.pareto) front.push_back(&cell);
  std::sort(front.begin(), front.end(), [](auto* a, auto* b) { return a->cost < b->cost; });
  std::string points;
  for (const CellResult* cell : front) points += point(*cell);
  curves.add("front", points,
             "with steps lw 7 lc rgb '#d8d8d8' title '" + whose(result) + "Pareto front'");
  for (std::size_t s = 0; s < result.series.size(); ++s) {
    points.clear();
    for (const CellResult& cell : result.cells)
      if (cell.series == s && std::isfinite(cell.error)) points += point(cell);
    std::string label = whose(result) + result.series[s].label;
    for (const OrderFit& fit : result.fits)
      if (fit.series == s) label = with_order(label, fit);
    curves.add("series" + std::to_string(s), points, look_of_series(s, label));
  }
  for (std::size_t i = 0; i < result.peers.size(); ++i) {
    const PeerCurve& curve = result.peers[i];
    points.clear();
    for (const CurvePoint& p : curve.points)
      if (std::isfinite(p.error)) points += point(p.cost, p.error);
    curves.add("peer" + std::to_string(i), points,
               look_of_peer(i, with_order(short_label_of(curve), curve.fit)));
  }
  // On their machine, not on this one.
  add_published(curves, info, true);
  points.clear();
  for (const CellResult* cell : front) points += point(*cell);
  curves.add("marks", points, "with points pt 6 ps 2 lw 1.5 lc rgb 'black' notitle");
  return curves.panel("{/:Bold " + info.name + "}  " + info.title,
                      "computing time [{/Symbol m}s per simulated second and body]",
                      "error [" + info.unit + "]");
}

// What was published is mostly error by step alone: ours and what was run here in the publication's
// own measure over the step, and the published curves under them.
std::string panel_by_step(const CaseResult& result) {
  const CaseInfo& info = *result.info;
  Curves curves;
  const auto from_error = [&](double dt, double error) {
    return std::isfinite(error) ? line_of(dt, info.measure * error * error) : std::string();
  };
  for (std::size_t s = 0; s < result.series.size(); ++s) {
    if (!result.series[s].by_step) continue;
    std::string points;
    for (const CellResult& cell : result.cells)
      if (cell.series == s) points += from_error(cell.knobs.dt, cell.error);
    curves.add("series" + std::to_string(s), points,
               look_of_series(s, whose(result) + result.series[s].label));
  }
  for (std::size_t i = 0; i < result.peers.size(); ++i) {
    std::string points;
    for (const CurvePoint& p : result.peers[i].points) points += from_error(p.dt, p.error);
    curves.add("peer" + std::to_string(i), points,
               look_of_peer(i, short_label_of(result.peers[i])));
  }
  add_published(curves, info, false);
  return curves.panel("{/:Bold " + info.name + "}  as published", "step [s]",
                      "mean square [" + info.measure_unit + "]");
}

}  // namespace

std::string chart_script(const std::vector<const CaseResult*>& results, Family family,
                         const std::string& terminal, const std::string& output) {
  int count = static_cast<int>(results.size());
  for (const CaseResult* result : results) count += result->info->published.empty() ? 0 : 1;
  const int columns = count == 1 ? 1 : 2, rows = (count + columns - 1) / columns;
  const int width = columns == 1 ? 1100 : 1900, height = 720 * rows + 60;
  const bool svg = terminal == "svg";
  std::string script = "set terminal " + std::string(svg ? "svg" : "pngcairo") + " enhanced size " +
                       std::to_string(width) + "," + std::to_string(height) +
                       " font 'DejaVu Sans," + (svg ? "14" : "13") + "' background rgb 'white'\n" +
                       "set output " + in_quotes(output) + "\n";
  constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                     "#e69f00", "#56b4e9", "#882255", "#999933",
                                     "#44aa99", "#332288", "#aa4499"};
  int style = 1;
  for (const char* color : kColors) {
    const std::string n = std::to_string(style);
    constexpr int kShapes[] = {7, 5, 9, 11, 13};
    script += "set style line " + n + " lw 2.2 ps 1.1 pt " +
              std::to_string(kShapes[(style - 1) % 5]) + " lc rgb '" + color + "'\n";
    ++style;
  }
  // Others: thin, broken and dark, with open marks.
  struct Look {
    const char* color;
    int mark;
  };
  constexpr Look kPeerLooks[kPeerStyles] = {{"#222222", 6},  {"#8a4b12", 4},  {"#4d6b12", 8},
                                            {"#777777", 10}, {"#b03060", 12}, {"#2f6f8f", 14}};
  style = kFirstPeerStyle;
  for (const Look& look : kPeerLooks)
    script += "set style line " + std::to_string(style++) + " lw 1.6 ps 1.3 dt 2 pt " +
              std::to_string(look.mark) + " lc rgb '" + look.color + "'\n";
  script +=
      "set logscale xy 10\nset format x '10^{%L}'\nset format y '10^{%L}'\n"
      "set grid xtics ytics lc rgb '#e8e8e8' lt 1\nset border 3\nset tics nomirror\n"
      "set key below Left reverse maxcols 2 samplen 3 spacing 1.25 font ',11'\n"
      "set autoscale xfix\nset offsets graph 0.06, graph 0.06, graph 0.05, graph 0.05\n"
      "set multiplot layout " +
      std::to_string(rows) + "," + std::to_string(columns) +
      " title '{/:Bold What accuracy costs: " + name_of(family) + "}' font ',17'\n";
  for (const CaseResult* result : results) {
    script += panel(*result);
    if (!result->info->published.empty()) script += panel_by_step(*result);
  }
  return script + "unset multiplot\nunset output\n";
}

}  // namespace plumb::accuracy
