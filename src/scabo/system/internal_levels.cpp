#include "scabo/system/internal_levels.hpp"

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/base/error.hpp"
#include "scabo/system/assembly.hpp"

namespace scabo::system {

namespace {

std::vector<double> densities(const model::Model& model, const element::SolvedSuperElement& cell) {
  std::vector<double> density;
  for (const int material : cell.sectors.materials)
    density.push_back(model.materials[static_cast<std::size_t>(material)].density.value_or(0.0));
  return density;
}

/// The super-element of a body that has a level; null: it has none. With faces that are held its inside does not move
/// as the mass of page 16 says.
const element::SolvedSuperElement* super_element_of(const model::Model& model, const mesh::BodyMesh& mesh,
                                                    const element::SolvedCells& cells) {
  if (!is_whole(mesh) || cells.front()->domain.unbounded || cells.front()->held) return nullptr;
  const std::vector<double> density = densities(model, *cells.front());
  const bool has_mass = std::all_of(density.begin(), density.end(), [](double of) { return of > 0.0; });
  return has_mass ? cells.front().get() : nullptr;
}

}  // namespace

std::vector<BodyLevel> levels_of(const model::Model& model, const mesh::Mesh& mesh,
                                 const std::vector<element::SolvedCells>& cells, const Dofs& dofs, std::size_t part) {
  std::vector<BodyLevel> levels;
  if (dofs.is_rigid(part) || dofs.is_unbounded(part)) return levels;
  for (const int body : dofs.bodies_of(part)) {
    const auto b = static_cast<std::size_t>(body);
    const element::SolvedSuperElement* cell = super_element_of(model, mesh.bodies[b], cells[b]);
    if (!cell) continue;
    BodyLevel level;
    level.body = body;
    for (int node = 0; node < static_cast<int>(mesh.bodies[b].nodes.size()); ++node)
      for (int component = 0; component < 2; ++component) level.dofs.push_back(dofs.of(body, node, component));
    level.matrices =
        std::shared_ptr<const element::InternalLevel>(cells[b].front(), &cell->level(densities(model, *cell)));
    const auto& damping = model.materials[static_cast<std::size_t>(cell->sectors.materials.front())].damping;
    if (damping) level.of_mass = damping->of_mass(), level.of_stiffness = damping->of_stiffness();
    level.first = size_of(levels);
    levels.push_back(std::move(level));
  }
  return levels;
}

Eigen::Index size_of(const std::vector<BodyLevel>& levels) {
  return levels.empty() ? 0 : levels.back().first + levels.back().size();
}

element::InternalMotion internal_motion(const model::Model& model, const mesh::Mesh& mesh,
                                        const std::vector<element::SolvedCells>& cells, int body, Vector w) {
  const auto b = static_cast<std::size_t>(body);
  const element::SolvedSuperElement* cell = super_element_of(model, mesh.bodies[b], cells[b]);
  if (!cell) return {};
  return {std::shared_ptr<const element::InternalModes>(cells[b].front(), &cell->level_modes(densities(model, *cell))),
          std::move(w),
          {}};
}

Vector translation_of(const BodyLevel& level, const Vec2& by) { return by.replicate(level.size() / 2, 1); }

WithLevels with_levels(const Stiffness& K, const Stiffness& M, const std::vector<BodyLevel>& levels) {
  WithLevels made{K, M};
  if (levels.empty()) return made;
  const Eigen::Index n = K.size(), all = n + size_of(levels);
  std::vector<Eigen::Triplet<double>> of_K, of_M;
  const auto add = [&](const Matrix& block, double factor, std::vector<Eigen::Triplet<double>>& to, const auto& row,
                       const auto& column) {
    for (Eigen::Index i = 0; i < block.rows(); ++i)
      for (Eigen::Index j = 0; j < block.cols(); ++j) to.emplace_back(row(i), column(j), factor * block(i, j));
  };
  for (const BodyLevel& level : levels) {
    const auto outer = [&](Eigen::Index i) { return level.dofs[static_cast<std::size_t>(i)]; };
    const auto inner = [&](Eigen::Index i) { return static_cast<int>(n + level.first + i); };
    add(level.Z(), 1.0, of_K, inner, inner);
    add(level.Q(), 1.0, of_M, inner, inner);
    add(level.Z(), -1.0, of_M, inner, outer);
    add(level.Z(), -1.0, of_M, outer, inner);
  }
  const auto enlarge = [&](Stiffness& matrix, const std::vector<Eigen::Triplet<double>>& entries) {
    linalg::SparseMatrix more(all, all);
    more.setFromTriplets(entries.begin(), entries.end());
    if (matrix.dense) {
      Matrix larger = Matrix(more);
      larger.topLeftCorner(n, n) += *matrix.dense;
      matrix.dense = std::make_shared<const Matrix>(std::move(larger));
    } else {
      matrix.sparse.conservativeResize(all, all);
      matrix.sparse += more;
    }
    if (!matrix.springs.none()) matrix.springs.matrix.conservativeResize(all, all);
  };
  enlarge(made.K, of_K);
  enlarge(made.M, of_M);
  return made;
}

LevelInTime level_in_time(const BodyLevel& level, double theta, double h) {
  LevelInTime made;
  made.coupling = 1.0 / (h * h) + theta * level.of_mass / h;
  made.A.compute(made.coupling * level.Q() + (theta * level.of_stiffness / h + theta * theta) * level.Z());
  ensure(made.A.info() == Eigen::Success, "the inertia inside a super-element is not positive");
  return made;
}

void eliminate(const std::vector<BodyLevel>& levels, const std::vector<LevelInTime>& in_time, Stiffness& A) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const BodyLevel& level = levels[k];
    const Matrix half = in_time[k].coupling * in_time[k].A.matrixL().solve(level.Z()), taken = half.transpose() * half;
    if (A.dense) {
      Matrix less = *A.dense;
      less(level.dofs, level.dofs) -= taken;
      A.dense = std::make_shared<const Matrix>(std::move(less));
      continue;
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index i = 0; i < level.size(); ++i)
      for (Eigen::Index j = 0; j < level.size(); ++j)
        entries.emplace_back(level.dofs[static_cast<std::size_t>(i)], level.dofs[static_cast<std::size_t>(j)],
                             taken(i, j));
    linalg::SparseMatrix less(A.sparse.rows(), A.sparse.cols());
    less.setFromTriplets(entries.begin(), entries.end());
    A.sparse -= less;
  }
}

}  // namespace scabo::system
