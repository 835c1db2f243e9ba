// Elastic energy that changes of temperature store in bodies.
//
// With the free strain e0 = alpha T the stored energy of a body is
//
//     U = 1/2 int (e - e0)' D (e - e0) dV = 1/2 u'K u - u'f + U0                                                (1)
//
// u: displacements of its nodes, f: nodal forces of the temperature, U0: the energy while all nodes are held, quadratic
// in the factors of the loads, U0 = 1/2 z'Q z. Q is a sum over cells. For two changes of temperature T, T' in one of
// them, with what plane strain stores across the plane, E3 alpha3^2,
//
//     finite element     Q = int T T' (a'D a + E3 alpha3^2) dV                                                  (2)
//     super-element      the same, less what its inside gains by moving while its boundary is held,
//                        sum_ij (h_i - c_i)' E0^-1 (h'_j - c'_j) / (i + j)                                      (3)
//
// a: free strain per unit of temperature; c, h: radial_load.hpp, equivalent_load() in modal_solution.hpp. (3) follows
// from (19.4) of docs/methods: held at the boundary, M_i = int xi^i u dxi / xi is -(S + i)^-1 sum_j E0^-1 (c_j - h_j) /
// (i + j), the energy gained 1/2 sum_i (g_i - i c_i)'M_i, and (S' + i)(h_i - c_i) = g_i - i c_i. It is 0 where one
// material has one temperature. Where a table bends inside a cell (temperature_table.hpp), its remainder r adds
//
//     u_p'f' + u_p''f - u_p'K u_p' + int r r' dV sigma_p'D^-1 sigma_p'                                          (4)
//
// with the particular displacements u_p, u_p', the whole forces f, f' of both changes and the stress sigma_p per unit
// of temperature. r has no moments with the linear part, exactly in cells with straight sides.
#pragma once

#include <vector>

#include "scabo/element/cell_library.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::system {

struct ThermalEnergy {
  std::vector<int> loads;  ///< indices into Model::loads of the temperatures that act on the part
  Matrix Q;                ///< energy of eq. (1) at factors z of these loads: U0 = 1/2 z'Q z
};

/// One for each part; empty if no temperature changes. `interior`: [load][body][cell], Structure::interior.
std::vector<ThermalEnergy> thermal_energies(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                                            const std::vector<element::SolvedCells>& cells,
                                            const std::vector<std::vector<element::CellLoads>>& interior);

}  // namespace scabo::system
