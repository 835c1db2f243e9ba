// The motion of a mechanism in space for mechanism.vtu: the tetrahedra of all bodies, then the contact faces as
// triangles between pairs. Arrays as of MechanismCells, but that slip is a vector along the axes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"

namespace scabo::result {

struct SolidMechanismCells {
  std::vector<double> points;  // 3 per point, before any motion
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  // One per point
  std::vector<double> displacement;   // 3 per point; of a pair that of the point on A
  std::vector<double> opening, slip;  // of B relative to A; the latter 3 per point; 0 at points of bodies
  std::vector<std::int32_t> pair,
      point_body;  // from 1; the former 0 at points of bodies, the latter of a pair that of A
  // One per cell
  std::vector<double> motion;  // largest displacement of the body, of a contact its largest slip or opening
  std::vector<std::int32_t> body, contact;  // from 1; 0 of contacts, of bodies
};

SolidMechanismCells solid_mechanism_cells(const analysis::SolidModel& model, const analysis::SolidMechanism& mechanism);

/// Content of a .vtu file (vtu.cpp).
std::string vtu_content(const SolidMechanismCells& cells, int threads = 1);

}  // namespace scabo::result
