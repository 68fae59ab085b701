// The table behind WorldSettings::from_tolerance, measured on this machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/cell.h"

namespace plumb::accuracy {

// What it is measured at; jointed scenes moreover at both orders of joints.
struct TableGrid {
  std::vector<int> rates = {30, 60, 120, 240, 480};  // [Hz]
  std::vector<int> substeps = {1, 2, 4, 8, 16};
  std::vector<Precision> precisions = {Precision::F32, Precision::F32D, Precision::F64};
};

// The text of physics/src/world/measured_table.h. All of it takes minutes.
std::string settings_table(const TableGrid& grid,
                           const std::function<void(std::size_t done)>& progress,
                           std::string& problem);
std::size_t settings_table_cells(const TableGrid& grid);

}  // namespace plumb::accuracy
