// The contact faces of bodies in space after an increment, in the arrays of a .vtu file: the triangles and
// quadrilaterals between the corners of the side whose corners are the pairs, where all of them have one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"

namespace scabo::result {

struct SolidFaces {
  std::vector<double> points;  // 3 per point, undeformed
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> cell_contact;  // from 1

  // One point for each pair
  std::vector<std::int32_t> contact, pair;  // from 1
  std::vector<std::uint8_t> state;          // 0 open, 1 stick, 2 slip
  std::vector<double> pressure, gap;        // force / length^2; length
  std::vector<double> shear, slip, normal;  // 3 per point, along the axes; shear on side b, the normal out of a
};

SolidFaces solid_faces(const analysis::SolidModel& model, const analysis::SolidIncrement& increment);

/// Content of a .vtu file (vtu.cpp).
std::string vtu_content(const SolidFaces& faces);

}  // namespace scabo::result
