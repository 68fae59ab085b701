// plumb effects --scaling: what an effect costs a step against the number of bodies that carry it.
//
// Of a thousand bodies in free flight 0, 1, 10, 100 and all carry it. A repeat steps all five, in
// turn and several times over, and counts what each takes more than the one without; processor time
// of the thread, so that others on the machine disturb little. Over the repeats stands the line
// cost(k) = a + b k with its confidence intervals: a is what an effect costs that hardly anybody
// has.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "accuracy/files.h"
#include "cli/commands.h"
#include "cli/effect_flight.h"
#include "cli/line_fit.h"
#include "cli/output_path.h"

namespace plumb::cli {
namespace {

constexpr int kBodies = 1000;
constexpr int kCarriers[] = {0, 1, 10, 100, kBodies};
constexpr int kRepeats = 20;
constexpr int kRounds = 5;  // within a repeat, of which the fastest counts
constexpr int kSteps = 10;  // of a round
constexpr int kWarmUp = 3;  // [steps]
constexpr double kMicro = 1e6, kNano = 1e9;

double thread_seconds() {
  timespec now{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / kNano;
}

// Seconds a step more than without the effect, for each number of carriers above 0.
std::vector<double> one_repeat(const EffectKind& kind, int repeat) {
  std::vector<std::unique_ptr<EffectFlight>> flights;
  for (const int carriers : kCarriers) {
    flights.push_back(std::make_unique<EffectFlight>(kind, kBodies, carriers));
    flights.back()->step(kWarmUp);
  }
  const std::size_t count = flights.size();
  std::vector<double> best(count, std::numeric_limits<double>::infinity());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t turn = 0; turn < count; ++turn) {
      const std::size_t which = (turn + static_cast<std::size_t>(round + repeat)) % count;
      const double begin = thread_seconds();
      flights[which]->step(kSteps);
      best[which] = std::min(best[which], (thread_seconds() - begin) / kSteps);
    }
  }
  std::vector<double> more;
  for (std::size_t i = 1; i < count; ++i) more.push_back(best[i] - best[0]);
  return more;
}

struct Scaling {
  const char* name;
  RepeatedLine line;  // [s] a step against carriers
};

std::vector<double> carriers_above_none() {
  return {std::begin(kCarriers) + 1, std::end(kCarriers)};
}

std::string csv_of(const std::vector<Scaling>& all) {
  std::ostringstream out;
  out << "effect,bodies_with_it,microseconds_a_step_more,ci95,a_microseconds,a_ci95,"
         "b_nanoseconds,b_ci95\n";
  const std::vector<double> x = carriers_above_none();
  for (const Scaling& s : all)
    for (std::size_t i = 0; i < x.size(); ++i)
      out << s.name << "," << x[i] << "," << kMicro * s.line.points[i].mean << ","
          << kMicro * s.line.points[i].half_width << "," << kMicro * s.line.a.mean << ","
          << kMicro * s.line.a.half_width << "," << kNano * s.line.b.mean << ","
          << kNano * s.line.b.half_width << "\n";
  return out.str();
}

// A panel for each effect: points with their intervals, and the line.
std::string chart_of(const std::vector<Scaling>& all, bool svg, const std::string& output) {
  constexpr int kColumns = 4;
  const int rows = (static_cast<int>(all.size()) + kColumns - 1) / kColumns;
  constexpr double kFoot = 0.1;  // [us] what is smaller stands there: it has no logarithm
  std::ostringstream out;
  out << "set terminal " << (svg ? "svg" : "pngcairo") << " enhanced size 1700," << 340 * rows + 80
      << " font 'DejaVu Sans,12' background rgb 'white'\nset output " << accuracy::in_quotes(output)
      << "\n"
      << "set logscale xy\nset xrange [0.6:" << 1.7 * kBodies << "]\nset yrange [" << kFoot
      << ":20000]\nset format x '%g'\nset format y '%g'\nset border 3\nset tics nomirror\n"
      << "set grid ytics xtics lc rgb '#e8e8e8' lt 1\nset xlabel 'bodies with it'\n"
      << "set ylabel '{/Symbol m}s a step more'\nset key top left Left reverse samplen 2\n"
      << "set multiplot layout " << rows << "," << kColumns << " title '{/:Bold What an effect "
      << "costs a step, of " << kBodies << " bodies in free flight; mean and 95 % of " << kRepeats
      << " repeats}' font ',16'\n";
  const std::vector<double> x = carriers_above_none();
  for (const Scaling& s : all) {
    out << "$points << EOD\n";
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto shown = [&](double seconds) { return std::max(kFoot, kMicro * seconds); };
      const Estimate& p = s.line.points[i];
      out << x[i] << " " << shown(p.mean) << " " << shown(p.mean - p.half_width) << " "
          << shown(p.mean + p.half_width) << "\n";
    }
    const double a = kMicro * s.line.a.mean, b = kMicro * s.line.b.mean;
    char fit[96];
    std::snprintf(fit, sizeof fit, "%.2f {/Symbol m}s + %.0f ns k", a, 1e3 * b);
    out << "EOD\nset title '" << s.name << "'\nplot " << a << " + " << b
        << " * x with lines lw 2 lc rgb '#0072b2' title '" << fit << "', " << b
        << " * x with lines dt 2 lc rgb '#888888' title 'no fixed cost', $points using 1:2:3:4 "
        << "with yerrorbars pt 7 ps 1.1 lw 1.6 lc rgb '#d55e00' notitle\nundefine $points\n";
  }
  out << "unset multiplot\nunset output\n";
  return out.str();
}

std::string save(const std::vector<Scaling>& all, const std::string& csv,
                 const std::string& chart) {
  if (!csv.empty())
    if (const std::string wrong = accuracy::write_whole(csv, csv_of(all)); !wrong.empty())
      return wrong;
  if (chart.empty()) return {};
  return accuracy::draw(chart_of(all, chart.ends_with(".svg"), chart + ".part"), chart);
}

std::string why_not(const std::string& csv, const std::string& chart) {
  for (const std::string& path : {csv, chart})
    if (const std::string wrong = path.empty() ? "" : why_no_file(path); !wrong.empty())
      return wrong;
  if (chart.empty()) return {};
  if (!chart.ends_with(".svg") && !chart.ends_with(".png"))
    return "--chart: " + chart + " must end in .svg or .png";
  if (!accuracy::has_gnuplot()) return "--chart: gnuplot is not there: apt-get install gnuplot-nox";
  return {};
}

}  // namespace

int print_effect_scaling(const std::string& csv, const std::string& chart) {
  if (const std::string wrong = why_not(csv, chart); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  std::vector<Scaling> all;
  std::printf(
      "What an effect costs a step more, a + b k for k of %d bodies that carry it;"
      " %s, one thread,\nmean of %d repeats and 95 %% of them\n\n%-20s %20s %20s  %s\n",
      kBodies, kPrecisionName, kRepeats, "effect", "a [us a step]", "b [ns a body]", "a may be 0");
  int zero = 0;
  for (const NamedEffect& effect : every_effect()) {
    std::vector<std::vector<double>> y;
    for (int repeat = 0; repeat < kRepeats; ++repeat) y.push_back(one_repeat(effect.kind, repeat));
    all.push_back({effect.name, fit_repeats(carriers_above_none(), y)});
    const RepeatedLine& line = all.back().line;
    zero += line.a.may_be_zero() ? 1 : 0;
    std::printf("%-20s %10.3f +- %6.3f %10.1f +- %6.1f  %s\n", effect.name, kMicro * line.a.mean,
                kMicro * line.a.half_width, kNano * line.b.mean, kNano * line.b.half_width,
                line.a.may_be_zero() ? "yes" : "no");
    std::fflush(stdout);
  }
  std::printf(
      "\n%d of %zu fixed costs cannot be told from 0; of true zeros one in twenty is"
      " told from it.\n",
      zero, all.size());
  if (const std::string wrong = save(all, csv, chart); !wrong.empty()) {
    complain(wrong);
    return kFailed;
  }
  return kOk;
}

}  // namespace plumb::cli
