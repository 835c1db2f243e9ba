#include "scabo/analysis/state/pair_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

/// Degrees of freedom of a part that its pairs touch.
std::vector<int> touched_dofs(const system::ContactSystem& contact, std::size_t p) {
  std::vector<int> dofs;
  const auto is_touched = [](const Eigen::SparseMatrix<double>& motion, Eigen::Index dof) {
    return motion.outerIndexPtr()[dof] < motion.outerIndexPtr()[dof + 1];
  };
  for (Eigen::Index dof = 0; dof < contact.motion[p].cols(); ++dof)
    if (is_touched(contact.motion[p], dof) || (!contact.held.empty() && is_touched(contact.held_motion[p], dof)))
      dofs.push_back(static_cast<int>(dof));
  return dofs;
}

}  // namespace

Vector motion_under(const std::vector<Eigen::SparseMatrix<double>>& motion, const std::vector<Vector>& u,
                    Eigen::Index rows) {
  Vector sum = Vector::Zero(rows);
  for (std::size_t p = 0; p < motion.size(); ++p) sum += motion[p] * u[p];
  return sum;
}

FreeMotion free_motion(const Prepared& prepared, const State& state, std::vector<system::BegunSolve>* begun) {
  const system::ContactSystem& contact = prepared.contact;
  FreeMotion free{Vector::Zero(static_cast<Eigen::Index>(2 * contact.pairs.size())),
                  Vector::Zero(static_cast<Eigen::Index>(2 * contact.held.size()))};
  if (begun) begun->resize(prepared.structure.parts.size());
  if (contact.pairs.empty() && contact.held.empty()) return free;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    if (prepared.is_absent(p)) continue;
    const Vector u = prepared.structure.parts[p]->displacement_at(
        state.forces[p], state.prescribed[p], touched_dofs(contact, p), begun ? &(*begun)[p] : nullptr);
    free.pairs.noalias() += contact.motion[p] * u;
    if (!contact.held.empty()) free.held.noalias() += contact.held_motion[p] * u;
  }
  return free;
}

void check_held_pairs(const Prepared& prepared, Vector motion, const State& state) {
  const system::ContactSystem& contact = prepared.contact;
  if (contact.held.empty()) return;
  if (state.held_offset.size() > 0) motion += state.held_offset;
  for (std::size_t i = 0; i < contact.held.size(); ++i) {
    const mesh::ContactPair& pair = mesh_pair(prepared, contact.held[i]);
    const double gap = pair.gap + motion[static_cast<Eigen::Index>(2 * i)] +
                       unplaced_motion(prepared, state.replaced, contact.held[i].contact).dot(pair.normal);
    double size = 0.0;
    for (const Vec2& x : {pair.point_a, pair.point_b}) size = std::max(size, x.norm());
    if (gap >= -1e-12 * std::max(size, std::abs(pair.gap))) continue;
    const model::Contact& named = prepared.model.contacts[static_cast<std::size_t>(contact.held[i].contact)];
    throw InputError(
        prepared.model.file,
        {{named.source, fmt::format("supports on both sides of the pair at ({:.6g}, {:.6g}) keep it at an overlap of "
                                    "{:.3g}, which no contact force can remove: free one side there",
                                    pair.point_a.x(), pair.point_a.y(), -gap)}});
  }
}

}  // namespace scabo::analysis
