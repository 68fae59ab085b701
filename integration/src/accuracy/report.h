// What the lab writes: tables for people, CSV with every cell, charts.
#pragma once

#include <string>
#include <vector>

#include "accuracy/files.h"
#include "accuracy/lab.h"

namespace plumb::accuracy {

// Where and with what it was measured, in one line each.
struct Circumstances {
  std::string machine, compiler, commit, date;
};
Circumstances circumstances();

std::string table_of(const CaseResult& result);
std::string csv_of(const std::vector<CaseResult>& results, const Circumstances& where);

// A gnuplot program that draws the cases of one family side by side: log error over log
// microseconds a simulated body-second, a curve a series, the Pareto front marked.
std::string chart_script(const std::vector<const CaseResult*>& results, Family family,
                         const std::string& terminal, const std::string& output);

}  // namespace plumb::accuracy
