// Other engines in the lab's cases. They are in a program of their own, plumb-peers, which need not
// be there: it is started, and the rows that it prints are read.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/grid.h"
#include "accuracy/lab.h"

namespace plumb::accuracy {

// One run of one case in one engine, as plumb-peers prints it.
struct PeerRow {
  std::string name;      // of the case
  std::string engine;    // "bullet"
  std::string settings;  // version and what it is run with
  double dt = 0;         // [s]
  double cost = 0;       // [s] of computing for a body and a simulated second
  bool finite = true;
  std::vector<double> readings;
};
// Empty where the line is no such row.
std::optional<PeerRow> parse_peer_row(const std::string& line);

// Where the program should stand: beside this one.
std::string peers_program();
// An error text, empty where it can be started.
std::string missing(const std::string& program);

// As many engines are known at most; a row each and step.
inline constexpr std::size_t kMostPeers = 6;

// The steps at which the engines are run: the user's, or those of our own curves.
std::vector<double> peer_steps(const CaseInfo& info, const KnobChoice& choice);

// Adds a curve an engine to the case's result, with errors against the same right readings.
// `progress` hears of kMostPeers runs a step, done or left out. Notes say what was left out.
// Returns an error text.
std::string add_peers(const std::string& program, CaseResult& result,
                      const std::vector<double>& steps, bool quick,
                      const std::function<void(std::size_t)>& progress,
                      std::vector<std::string>& notes);
// The same from what the program has printed, line by line.
std::string add_peer_line(const std::string& line, CaseResult& result,
                          std::vector<std::string>& notes);

// How the engine is called in tables, "Bullet 3.24, f32, 10 iterations", and in charts,
// "Bullet 3.24, f32".
std::string label_of(const PeerCurve& curve);
std::string short_label_of(const PeerCurve& curve);

}  // namespace plumb::accuracy
