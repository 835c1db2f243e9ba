// The cells of bodies in space and their fields, in the arrays of a .vtu file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"

namespace scabo::result {

/// Of a cell with so many nodes, in VTK, whose nodes have the order of CellTopology.
std::uint8_t vtk_type(std::size_t nodes);

struct SolidCells {
  std::vector<double> points;  // 3 per point
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> point_body, cell_body;  // from 1
  std::vector<double> displacement;                 // 3 per point
  std::vector<float> stress;                        // 6 per point: xx, yy, zz, xy, yz, xz
  std::vector<float> principal_1, principal_2, principal_3, von_mises;
};

/// At the nodes of all bodies; stresses are the mean of those of the elements around a node of a body.
SolidCells solid_cells(const analysis::SolidModel& model, const analysis::SolidIncrement& increment);

/// Content of a .vtu file (vtu.cpp).
std::string vtu_content(const SolidCells& cells, int threads = 1);

}  // namespace scabo::result
