// The contacts after an increment as lines, for ParaView: one point for each pair, at its undeformed position on A, and
// a line between neighbouring pairs of a contact (a contact of one pair is a point).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::result {

/// Stored in the arrays that are written to the file.
struct ContactLines {
  std::vector<double> points;              // 3 per pair, z = 0
  std::vector<std::int32_t> connectivity;  // point numbers of all cells in sequence
  std::vector<std::int32_t> offsets;       // one per cell: end of its points in `connectivity`
  std::vector<std::uint8_t> types;         // one per cell: VTK cell type
  std::vector<std::int32_t> cell_contact;  // number of the contact from 1, in the order of the model

  // One per pair
  std::vector<std::int32_t> contact, pair;             // numbers from 1
  std::vector<std::uint8_t> state;                     // 0 open, 1 stick, 2 slip
  std::vector<double> pressure, shear;                 // force / length^2
  std::vector<double> gap, slip;                       // length
  std::vector<double> normal_force, tangential_force;  // on B
  std::vector<double> traction;                        // 3 per pair: pressure along n and shear along t, on B
  std::vector<double> displacement;                    // 3 per pair, of the point on A

  std::optional<double> forces_of_radians;  // bodies of revolution: the angle whose forces these are
};

ContactLines contact_lines(const analysis::IncrementResult& increment, const model::Analysis& analysis);

}  // namespace scabo::result
