// Results as text: tables for people, CSV for programs, a script for gnuplot.
#pragma once

#include <string>
#include <vector>

#include "bench/anchors/run.h"

namespace plumb::anchors {

// Times, ratios and quality of one scene.
std::string table_of(const SceneResult& result);
// Where the time of our step goes; empty unless it was profiled.
std::string profile_of(const SceneResult& result);
// One line for each scene, engine and number of threads.
std::string csv_of(const std::vector<SceneResult>& results);
// Bars of milliseconds a step by scene and engine, logarithmic. terminal: "svg" or "png".
std::string chart_script(const std::vector<SceneResult>& results, const std::string& terminal,
                         const std::string& output);

}  // namespace plumb::anchors
