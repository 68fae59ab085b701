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

std::string point(double cost, double error) {
  char text[80];
  std::snprintf(text, sizeof text, "%.6g %.6g\n", 1e6 * cost, std::max(kFoot, error));
  return text;
}
std::string point(const CellResult& cell) { return point(cell.cost, cell.error); }

std::string with_order(const std::string& label, const OrderFit& fit) {
  if (!fit.found) return label;
  char text[32];
  std::snprintf(text, sizeof text, "  (order %.1f)", fit.order);
  return label + text;
}

// Line styles of other engines stand after our own.
constexpr int kFirstPeerStyle = 101, kPeerStyles = 6;

std::string panel(const CaseResult& result) {
  const CaseInfo& info = *result.info;
  std::string data, plots;
  const auto add = [&](const std::string& name, const std::string& points,
                       const std::string& look) {
    if (points.empty()) return;
    data += "$" + name + " << EOD\n" + points + "EOD\n";
    plots += (plots.empty() ? "plot " : ", \\\n     ") + ("$" + name) + " using 1:2 " + look;
  };
  const std::string whose = result.peers.empty() ? "" : "Plumb: ";  // needs telling only then
  // The front first, wide and pale, so that the curves lie on it.
  std::vector<const CellResult*> front;
  for (const CellResult& cell : result.cells)
    if (cell.pareto) front.push_back(&cell);
  std::sort(front.begin(), front.end(), [](auto* a, auto* b) { return a->cost < b->cost; });
  std::string points;
  for (const CellResult* cell : front) points += point(*cell);
  add("front", points, "with steps lw 7 lc rgb '#d8d8d8' title '" + whose + "Pareto front'");
  for (std::size_t s = 0; s < result.series.size(); ++s) {
    points.clear();
    for (const CellResult& cell : result.cells)
      if (cell.series == s && std::isfinite(cell.error)) points += point(cell);
    std::string label = whose + result.series[s].label;
    for (const OrderFit& fit : result.fits)
      if (fit.series == s) label = with_order(label, fit);
    add("series" + std::to_string(s), points,
        "with linespoints ls " + std::to_string(s + 1) + " title '" + label + "'");
  }
  for (std::size_t i = 0; i < result.peers.size(); ++i) {
    const PeerCurve& curve = result.peers[i];
    points.clear();
    for (const CurvePoint& p : curve.points)
      if (std::isfinite(p.error)) points += point(p.cost, p.error);
    add("peer" + std::to_string(i), points,
        "with linespoints ls " +
            std::to_string(kFirstPeerStyle + static_cast<int>(i) % kPeerStyles) + " title '" +
            with_order(short_label_of(curve), curve.fit) + "'");
  }
  // What others have published, where the time is known too; on their machine, not on this one.
  for (std::size_t i = 0; i < info.published.size(); ++i) {
    const Published& p = info.published[i];
    if (!(p.seconds > 0)) continue;
    CellResult cell;
    cell.cost = p.seconds / info.body_seconds;
    cell.error = std::sqrt(p.measure / info.measure);
    add("published" + std::to_string(i), point(cell),
        "with points pt " + std::to_string(1 + static_cast<int>(i % 4)) +
            " ps 1.8 lw 2.5 lc rgb 'black' title '" + p.engine + " " + step_words(p.dt) +
            " s, published'");
  }
  points.clear();
  for (const CellResult* cell : front) points += point(*cell);
  add("marks", points, "with points pt 6 ps 2 lw 1.5 lc rgb 'black' notitle");
  return data + "set title '{/:Bold " + info.name + "}  " + info.title + "'\nset ylabel 'error [" +
         info.unit + "]'\n" + plots + "\nundefine $*\n";
}

}  // namespace

std::string chart_script(const std::vector<const CaseResult*>& results, Family family,
                         const std::string& terminal, const std::string& output) {
  const int count = static_cast<int>(results.size());
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
      "set xlabel 'computing time [{/Symbol m}s per simulated second and body]'\n"
      "set grid xtics ytics lc rgb '#e8e8e8' lt 1\nset border 3\nset tics nomirror\n"
      "set key below Left reverse maxcols 2 samplen 3 spacing 1.25 font ',11'\n"
      "set autoscale xfix\nset offsets graph 0.06, graph 0.06, graph 0.05, graph 0.05\n"
      "set multiplot layout " +
      std::to_string(rows) + "," + std::to_string(columns) +
      " title '{/:Bold What accuracy costs: " + name_of(family) + "}' font ',17'\n";
  for (const CaseResult* result : results) script += panel(*result);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace plumb::accuracy
