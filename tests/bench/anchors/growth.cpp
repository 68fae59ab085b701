#include "bench/anchors/growth.h"

#include <cmath>
#include <cstdio>

#include "bench/anchors/scenes.h"

namespace plumb::anchors {
namespace {

constexpr int kSizes[] = {1000, 3162, 10000, 31623, 100000};

int columns_of(int count) { return static_cast<int>(std::ceil(std::sqrt(count))); }

// Boxes that lie on the ground, each by itself.
Scene resting(int count) {
  const int columns = columns_of(count);
  Scene s{.title = "at rest on the ground", .steps = 60, .warm_up = 20};
  s.ground = {floor_of(2.0 * columns)};
  for (int c = 0; c < count; ++c)
    s.bodies.push_back(
        box(kCube, {(c % columns - columns / 2.0) * 2, 0.5, (c / columns - columns / 2.0) * 2}));
  return s;
}

// Boxes, balls and capsules in eight layers, poured onto the ground.
Scene bed(int count) {
  constexpr int kLayers = 8;
  const int columns = columns_of(count / kLayers);
  Scene s{.title = "poured in eight layers", .steps = 150, .warm_up = 90};
  s.ground = {floor_of(2.0 * columns + 50)};
  Random random(12);
  for (int c = 0; c < count; ++c) {
    const int place = c / kLayers;
    const Vector3d p((place % columns - columns / 2.0) * 1.2 + random.range(-.05, .05),
                     0.6 + 1.2 * (c % kLayers),
                     (place / columns - columns / 2.0) * 1.2 + random.range(-.05, .05));
    s.bodies.push_back(c % 3 == 0   ? box({.4, .45, .5}, p)
                       : c % 3 == 1 ? sphere(.5, p)
                                    : capsule(.3, .3, p));
  }
  return s;
}

Scene flying(int count) {
  Scene s = free_bodies(count);
  s.title = "flying free";
  s.steps = 60;
  return s;
}

std::string number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

double Growth::exponent() const {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const At& a : at) {
    const double size = std::log(a.bodies * std::log(a.bodies)), time = std::log(a.step);
    n += 1, x += size, y += time, xx += size * size, xy += size * time;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

std::vector<Growth> measure_growth(const std::vector<const EngineKind*>& engines,
                                   const GrowthProgress& progress) {
  std::vector<Growth> out;
  for (const auto& make : {flying, resting, bed}) {
    for (const EngineKind* engine : engines) {
      Growth growth;
      growth.engine = engine->name;
      for (const int bodies : kSizes) {
        Scene scene = make(bodies);
        scene.name = growth.title = scene.title;
        const std::string what =
            scene.title + ", " + engine->name + ", " + std::to_string(bodies) + " bodies";
        const Run done = run(*engine, scene, {1, 0, false}, false,
                             [&](int step) { progress(what, step, scene.steps); });
        if (done.built) growth.at.push_back({bodies, done.median});
      }
      if (growth.at.size() > 1) out.push_back(growth);
    }
  }
  return out;
}

std::string table_of(const std::vector<Growth>& growths) {
  std::string out = "Time of a step; p: it grows like (n log n)^p.\n";
  for (const Growth& growth : growths) {
    out += "\n" + growth.title + ", " + growth.engine +
           ": p = " + number("%.2f", growth.exponent()) + "\n    bodies   ms a step   us a body\n";
    for (const Growth::At& at : growth.at) {
      char line[96];
      std::snprintf(line, sizeof line, "  %8d  %10.4f  %10.4f\n", at.bodies, 1e3 * at.step,
                    1e6 * at.step / at.bodies);
      out += line;
    }
  }
  return out;
}

std::string csv_of(const std::vector<Growth>& growths) {
  std::string out = "scene,engine,bodies,ms_a_step\n";
  for (const Growth& growth : growths)
    for (const Growth::At& at : growth.at)
      out += growth.title + "," + growth.engine + "," + std::to_string(at.bodies) + "," +
             number("%.6g", 1e3 * at.step) + "\n";
  return out;
}

std::string chart_script(const std::vector<Growth>& growths, const std::string& terminal,
                         const std::string& output) {
  std::string data, plots;
  for (std::size_t i = 0; i < growths.size(); ++i) {
    const std::string name = "$growth" + std::to_string(i);
    data += name + " << EOD\n";
    for (const Growth::At& at : growths[i].at)
      data += std::to_string(at.bodies) + number(" %.6g\n", 1e6 * at.step / at.bodies);
    data += "EOD\n";
    plots += name + " with linespoints lw 2 pt 7 title '" + growths[i].title + ", " +
             growths[i].engine + ": p = " + number("%.2f", growths[i].exponent()) + "', \\\n     ";
  }
  // n log n through the first point of the last kind.
  const Growth::At& first = growths.back().at.front();
  const double unit = 1e6 * first.step / first.bodies / std::log(first.bodies);
  return data + "set terminal " + (terminal == "svg" ? "svg" : "pngcairo") +
         " size 1100,700 font 'DejaVu Sans,13' background rgb 'white'\nset output '" + output +
         "'\nset title 'Time of a step for each body; p: the step grows like (n log n)^p'\n"
         "set xlabel 'bodies'\nset ylabel 'us a body and step'\nset logscale xy\n"
         "set xrange [800:125000]\nset grid lc rgb '#e0e0e0' lt 1\nset border 3\n"
         "set tics nomirror\nset key outside below Left reverse noenhanced\nplot " +
         plots + number("%.8g", unit) + "*log(x) dashtype 2 lc rgb '#808080' title 'n log n'\n" +
         "unset output\n";
}

}  // namespace plumb::anchors
