// The chart by gnuplot: the script is ours, the drawing is its.
#include <cmath>
#include <cstdio>

#include "bench/anchors/table.h"

namespace plumb::anchors {

std::string chart_script(const std::vector<SceneResult>& results, const std::string& terminal,
                         const std::string& output) {
  // A bar for each engine and number of threads that any scene has, in the order of the first.
  std::vector<std::pair<const EngineKind*, int>> bars;
  for (const SceneResult& result : results)
    for (const Entry& entry : result.entries) {
      const std::pair<const EngineKind*, int> bar(entry.kind, entry.threads);
      bool known = !entry.built();
      for (const auto& other : bars) known = known || other == bar;
      if (!known) bars.push_back(bar);
    }
  std::string data = "$times << EOD\nscene";
  for (const auto& [kind, threads] : bars)
    data += " \"" + kind->name + (threads > 1 ? ", " + std::to_string(threads) + " threads" : "") +
            "\"";
  data += "\n";
  for (const SceneResult& result : results) {
    data += "\"" + result.scene.name + "\\n" + result.scene.title + "\"";
    for (const auto& [kind, threads] : bars) {
      std::string value = " ?";
      for (const Entry& entry : result.entries)
        if (entry.built() && entry.kind == kind && entry.threads == threads) {
          char number[32];
          std::snprintf(number, sizeof number, " %.6g", 1e3 * entry.best());
          value = number;
        }
      data += value;
    }
    data += "\n";
  }
  data += "EOD\n";
  constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                     "#56b4e9", "#882255", "#999933", "#44aa99", "#332288"};
  std::string script =
      data + "set terminal " + (terminal == "svg" ? "svg" : "pngcairo") +
      " size 1500,700 font 'DejaVu Sans,13' background rgb 'white'\nset output '" + output + "'\n" +
      "set title 'The anchor scenes: time of a step, best of the repeats'\n"
      "set ylabel 'ms a step'\nset logscale y\nset datafile missing '?'\n"
      "set style data histograms\nset style histogram clustered gap 1.5\n"
      "set style fill solid 0.9 noborder\nset boxwidth 0.95\n"
      "set bmargin 4\nset grid ytics lc rgb '#e0e0e0' lt 1\nset border 3\nset tics nomirror\n"
      "set key outside right top vertical Left reverse noenhanced\n";
  script += "plot ";
  for (std::size_t i = 0; i < bars.size(); ++i)
    script += std::string(i == 0 ? "" : ", \\\n     ") + "$times using " + std::to_string(i + 2) +
              (i == 0 ? ":xtic(1)" : "") + " title columnheader(" + std::to_string(i + 2) +
              ") lc rgb '" + kColors[i % 10] + "'";
  return script + "\nunset output\n";
}

}  // namespace plumb::anchors
