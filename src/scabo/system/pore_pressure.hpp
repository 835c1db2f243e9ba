// Pressure of a fluid in contacts (model::PorePressure): forces P n on B and -P n on A of every pair, open or closed,
// with its normal n out of A. What the pairs carry besides are effective forces; the total ones are the sum of both.
//
//     P = t * integral of N p ds                                                                               (1)
//
// over the elements of a side all of whose nodes take part in the contact, as tributary lengths are (of two elastic
// sides the mean), in parts between the kinks and jumps of p: forces and moments of a pressure that is linear between
// them are exact on straight elements. Where a node has several pairs, at the ends of other cracks, or no such element,
// P is the pressure at the pair times its tributary length and t.
#pragma once

#include "scabo/mesh/mesh.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

/// The pressure at a point, at factor 1.
double pressure_at(const model::PorePressure& pores, const Vec2& x);

/// P of the pairs of a contact, one for each pair of its interface, at factor 1.
Vector pore_forces(const model::PorePressure& pores, int contact, const model::Model& model, const mesh::Mesh& mesh);

/// Adds P of all pairs to the last load of a structure, and what acts on the side faces at the tips of cracks, which
/// have no pairs. P of a fluid that enters the contact stands apart, in Structure::entering.
void add_pore_pressure(Structure& structure, const model::PorePressure& pores, const model::Model& model,
                       const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells);

}  // namespace scabo::system
