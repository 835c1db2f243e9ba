// Bars between two points of bodies in space or the ground, as those of the plane (system/bars.hpp).
//
//     d = e . (u_Q - u_P),     N = N_0 + k (d - d_0)
//
// The stiffness is a pair of the contact system, after those of all contacts, with p_n = -(N - N_0) and the softness
// 1/k; N_0 = factor x preload is a pair of forces on the bodies. The pair of a bar with preload begins with the step
// after the one in which it is tightened, as that of a body that is added (solid_stages.hpp): -d_0 is its offset.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/analysis/space/face_resultants.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"

namespace scabo::analysis {

/// An end of a bar, and where it is drawn.
struct SolidBarEnd {
  system::PairSide side;
  Eigen::Vector3d at;
};

int node_nearest(const mesh::SolidMesh& mesh, const Eigen::Vector3d& at);

/// An end as it is given; `place`: that of its face or node.
SolidBarEnd end_of_bar(const SolidModel& model, const model::SpaceBar::End& end, const SolidPlaceOfAction& place);

/// Or why there is none.
std::variant<SolidBar, std::string> bar_between(const SolidBarEnd& a, const SolidBarEnd& b,
                                                const model::SpaceBar& given);

/// What a pair of the contact system needs.
system::PairPoints points_of(const SolidBar& bar);

/// Whether its bodies are there.
bool has_both_ends(const PreparedSolids& prepared, const SolidBar& bar);

/// The tension N_0 of a bar under these factors, which is a load; 0 while one of its bodies is absent.
double given_tension(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t bar);

/// Tensions of all bars; `p`: of the pairs that are there.
std::vector<double> tensions_of_bars(const PreparedSolids& prepared, const SolidFactors& factors, const Vector& p);

}  // namespace scabo::analysis
