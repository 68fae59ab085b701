#include "accuracy/peers.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "accuracy/setups/setup.h"

namespace plumb::accuracy {
namespace {

constexpr const char* kHeader = "case,engine,settings,dt_s,us_per_body_second,finite,readings";
constexpr std::size_t kColumns = 7;

// Fields between commas; one that holds commas stands in quotes, and holds no quotes.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

bool read_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0';
}

bool read_numbers(const std::string& text, std::vector<double>& out) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    double value = 0;
    if (!read_number(text.substr(begin, end - begin), value)) return false;
    out.push_back(value);
    begin = end + 1;
  }
  return !out.empty();
}

// Starts a program and hands on the lines that it prints; an error text if it fails.
std::string read_lines(const std::vector<std::string>& words,
                       const std::function<std::string(const std::string&)>& take) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return std::string("no pipe: ") + std::strerror(errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string problem;
  if (failed != 0) {
    close(ends[0]);
    return words[0] + " cannot be run (" + std::strerror(failed) + ")";
  }
  std::FILE* lines = fdopen(ends[0], "r");
  std::string line;
  for (int c = std::fgetc(lines); c != EOF; c = std::fgetc(lines)) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    if (problem.empty()) problem = take(line);  // after a mistake: read on, so that it can end
    line.clear();
  }
  std::fclose(lines);
  int status = 0;
  waitpid(child, &status, 0);
  if (problem.empty() && (!WIFEXITED(status) || WEXITSTATUS(status) != 0))
    problem = words[0] + " failed";
  return problem;
}

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

std::optional<PeerRow> parse_peer_row(const std::string& line) {
  const std::vector<std::string> fields = fields_of(line);
  PeerRow row;
  if (fields.size() != kColumns || fields[0].empty() || fields[1].empty()) return {};
  row.name = fields[0];
  row.engine = fields[1];
  row.settings = fields[2];
  double microseconds = 0;
  if (!read_number(fields[3], row.dt) || !(row.dt > 0)) return {};
  if (!read_number(fields[4], microseconds) || !(microseconds > 0)) return {};
  if (fields[5] != "0" && fields[5] != "1") return {};
  row.finite = fields[5] == "1";
  if (!read_numbers(fields[6], row.readings)) return {};
  row.cost = 1e-6 * microseconds;
  return row;
}

std::string peers_program() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return (self.parent_path() / "plumb-peers").string();
}

std::string missing(const std::string& program) {
  if (access(program.c_str(), X_OK) == 0) return {};
  return "--peers: " + program +
         " is not there; it is built with -DPLUMB_BENCHMARKS=ON -DPLUMB_PEERS=ON";
}

std::vector<double> peer_steps(const CaseInfo& info, const KnobChoice& choice) {
  if (find_setup(info.name) == nullptr) return {};
  if (!choice.dt.empty()) return choice.dt;
  if (!choice.empty()) return {Knobs{}.dt};
  std::vector<double> out;
  const std::vector<Series> series = series_of(info, choice);
  for (const Knobs& knobs : series.front().settings) out.push_back(knobs.dt);
  return out;
}

std::string add_peer_line(const std::string& line, CaseResult& result,
                          std::vector<std::string>& notes) {
  if (line.empty() || line == kHeader) return {};
  if (line.rfind("# ", 0) == 0) {
    notes.push_back(line.substr(2));
    return {};
  }
  const std::optional<PeerRow> row = parse_peer_row(line);
  if (!row || row->name != result.info->name || row->readings.size() != result.right.size())
    return "plumb-peers printed what is no row of " + result.info->name + ": " + line;
  if (result.peers.empty() || result.peers.back().engine != row->engine)
    result.peers.push_back({row->engine, row->settings, {}, {}});
  double error = distance(row->readings, result.right);
  if (!row->finite || !std::isfinite(error)) error = std::numeric_limits<double>::infinity();
  result.peers.back().points.push_back({row->dt, error, row->cost});
  return {};
}

std::string add_peers(const std::string& program, CaseResult& result,
                      const std::vector<double>& steps, bool quick,
                      const std::function<void(std::size_t)>& progress,
                      std::vector<std::string>& notes) {
  if (steps.empty()) {
    notes.push_back(result.info->name + ": other engines are not put through it");
    return {};
  }
  std::string list;
  for (const double dt : steps) list += (list.empty() ? "" : ",") + exact(dt);
  const std::size_t expected = kMostPeers * steps.size();
  std::size_t done = 0;
  const auto take = [&](const std::string& line) {
    const std::string wrong = add_peer_line(line, result, notes);
    std::size_t points = 0;
    for (const PeerCurve& curve : result.peers) points += curve.points.size();
    for (; done < std::min(points, expected); ++done) progress(1);
    return wrong;
  };
  const std::string problem = read_lines(
      {program, result.info->name, "--dt", list, "--window", exact(timing_window(quick))}, take);
  progress(expected - done);
  for (PeerCurve& curve : result.peers) curve.fit = fit_order(result, curve.points);
  return problem;
}

std::string label_of(const PeerCurve& curve) {
  std::string name = curve.engine;
  name = name.substr(0, name.find('-'));  // "mujoco-rk4": the settings tell the rest
  if (name == "ode") name = "ODE";
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  if (name == "Box3d") name = "Box3D";
  if (name == "Mujoco") name = "MuJoCo";
  return name + " " + curve.settings;
}

std::string short_label_of(const PeerCurve& curve) {
  const std::string label = label_of(curve);
  const std::size_t comma = label.find(',');
  return label.substr(0, comma == std::string::npos ? comma : label.find(',', comma + 1));
}

}  // namespace plumb::accuracy
