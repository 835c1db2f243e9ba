// Bars between two points of bodies in space or the ground, as those of the plane (system/bars.hpp).
//
//     d = e . (u_Q - u_P),     N = N_0 + k (d - d_0)
//
// The stiffness is a pair of the contact system, after those of all contacts, with p_n = -(N - N_0) and the softness
// 1/k; N_0 = factor x preload is a pair of forces on the bodies. While a bar with preload waits for its stiffness its
// pair is left out, and d_0 is kept where other pairs have their gap.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/analysis/space/face_resultants.hpp"
#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/contact/laws/evolution.hpp"

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

/// Whether the stiffness of each bar waits in the increment after these factors.
std::vector<char> waiting_bars(const SolidModel& model, const SolidFactors& before);

/// The tension N_0 of a bar under these factors, which is a load.
double given_tension(const SolidModel& model, const SolidFactors& factors, std::size_t bar);

/// d of a bar.
double elongation(const SolidBar& bar, const std::vector<Vector>& u);

/// The rows of a contact problem without the bars that wait.
class WithoutWaiting {
 public:
  /// `pairs`: of the whole problem, of which the indices of bars follow those of `contact_pairs`.
  WithoutWaiting(const std::vector<system::ContactSystem::Pair>& pairs, std::size_t contact_pairs,
                 const std::vector<char>& waiting);

  contact::Problem of(const contact::Problem& problem) const;
  contact::JointLaws of(const contact::JointLaws& laws) const;
  contact::History of(const contact::History& history) const;
  Vector of(const Vector& forces) const;
  /// Brings back the rows that were left out; they have no force.
  void put_back(const contact::History& before, contact::Evolution& evolution) const;

 private:
  std::vector<int> there_;  // pairs
  Eigen::Index all_;
};

}  // namespace scabo::analysis
