#include "scabo/system/inertia.hpp"

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/base/error.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/joined_bodies.hpp"

namespace scabo::system {

namespace {

/// Mass of a rigid body for [u_x, u_y, L rotation] about its centroid, with the point masses on it.
Matrix rigid_mass(const model::Model& model, int index, const Vec2& reference, double lever) {
  const model::Body& body = model.bodies[static_cast<std::size_t>(index)];
  const double area_density = body.density.value_or(0.0) * model::thickness_of(model, index);
  const double mass = area_density * body.outline.area();
  Matrix M = Matrix::Zero(3, 3);
  M.diagonal() << mass, mass, area_density * body.outline.polar_moment() / (lever * lever);
  for (const model::PointMass& point : model::point_masses_on(model, index)) {
    const auto R = rigid_point(rigid_points(*point.on, body).front(), reference, lever);
    M += point.mass * R.transpose() * R;
  }
  return M;
}

Stiffness dense(Matrix matrix) {
  Stiffness made;
  made.dense = std::make_shared<const Matrix>(std::move(matrix));
  return made;
}

bool is_zero(const Stiffness& matrix) {
  return matrix.dense ? matrix.dense->isZero(0.0) : matrix.sparse.nonZeros() == 0 || matrix.largest_diagonal() == 0.0;
}

/// M/h^2 + theta C/h + theta^2 K.
Stiffness stiffness_in_time(const PartInertia& part, double h) {
  const double of_K = part.theta * part.theta, of_C = part.theta / h, of_M = 1.0 / (h * h);
  Stiffness made;
  made.rounding = part.K.rounding;
  made.resists_rigid_motions = true;  // no motion is free
  if (part.K.dense) {
    Matrix A = of_K * *part.K.dense + of_M * *part.M.dense;
    if (part.C) A += of_C * *part.C->dense;
    if (!part.K.springs.none()) A += of_K * part.K.springs.matrix;
    made.dense = std::make_shared<const Matrix>(std::move(A));
    return made;
  }
  made.sparse = of_K * part.K.sparse + of_M * part.M.sparse;
  if (part.C) made.sparse += linalg::SparseMatrix(of_C * part.C->sparse);
  if (!part.K.springs.none()) made.sparse += linalg::SparseMatrix(of_K * part.K.springs.matrix);
  return made;
}

/// A rigid body on springs that are its inertia.
std::unique_ptr<BodySystem> rigid_in_time(const BodySystem& part, const PartInertia& inertia, double h) {
  const Vec2& at = part.reference();
  Springs springs;
  Matrix A = inertia.theta * inertia.theta * Matrix(inertia.K.dense ? *inertia.K.dense : Matrix::Zero(3, 3)) +
             *inertia.M.dense / (h * h);
  if (!inertia.K.springs.none()) A += inertia.theta * inertia.theta * inertia.K.springs.matrix;
  springs.matrix = A.sparseView();
  if (!inertia.M.dense->isZero(0.0))
    springs.directions = {{at, Vec2::UnitX()}, {at, Vec2::UnitY()}, {at + Vec2(part.lever(), 0.0), Vec2::UnitY()}};
  else
    springs.directions = inertia.K.springs.directions;
  std::string contradiction;
  return rigid_body(at, part.lever(), part.constraints(), std::move(springs), contradiction);
}

}  // namespace

std::vector<PartInertia> inertia_of(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
                                    const std::vector<element::SolvedCells>& cells, int threads) {
  MassLibrary masses = masses_of(model, threads);
  std::vector<PartInertia> inertia(structure.parts.size());
  for (std::size_t p = 0; p < inertia.size(); ++p) {
    PartInertia& part = inertia[p];
    ensure(!structure.parts[p]->is_divided(), "a part that is divided among processes has no mass");
    if (structure.dofs.is_rigid(p)) {
      part.K = dense(Matrix::Zero(3, 3));
      const int body = structure.dofs.bodies_of(p).front();
      part.M = dense(rigid_mass(model, body, structure.parts[p]->reference(), structure.parts[p]->lever()));
    } else {
      part.K = part_stiffness(model, mesh, cells, structure.dofs, p, threads);
      if (structure.dofs.is_unbounded(p))
        part.M = part.K.dense ? dense(Matrix::Zero(part.K.size(), part.K.size())) : Stiffness{};
      else
        part.M = part_mass(model, mesh, cells, structure.dofs, p, masses);
      if (!part.K.dense && part.M.sparse.rows() == 0) part.M.sparse.resize(part.K.size(), part.K.size());
      if (!structure.dofs.is_unbounded(p)) part.C = part_damping(model, mesh, cells, structure.dofs, p, masses);
      part.levels = levels_of(model, mesh, cells, structure.dofs, p);
    }
    part.K.springs = structure.springs.of_part[p];
    if (is_zero(part.M)) part.theta = 1.0;
    part.moves = !structure.dofs.is_rigid(p) || structure.parts[p]->rigid_motions().cols() > 0 ||
                 part.K.springs.matrix.size() > 0;
  }
  return inertia;
}

std::vector<std::vector<LevelInTime>> levels_in_time(const std::vector<PartInertia>& inertia, double h) {
  std::vector<std::vector<LevelInTime>> made(inertia.size());
  for (std::size_t p = 0; p < inertia.size(); ++p)
    for (const BodyLevel& level : inertia[p].levels) made[p].push_back(level_in_time(level, inertia[p].theta, h));
  return made;
}

Structure structure_in_time(const Structure& structure, const model::Model& model,
                            const std::vector<PartInertia>& inertia,
                            const std::vector<std::vector<LevelInTime>>& levels,
                            const std::vector<Eigen::SparseMatrix<double>>& motion, double h, int threads) {
  Structure made;
  made.dofs = structure.dofs;
  made.parts.resize(structure.parts.size());
  std::vector<std::size_t> elastic;
  std::vector<ElasticPart> parts;
  for (std::size_t p = 0; p < made.parts.size(); ++p) {
    if (structure.dofs.is_rigid(p)) {
      made.parts[p] = rigid_in_time(*structure.parts[p], inertia[p], h);
      continue;
    }
    elastic.push_back(p);
    Stiffness A = stiffness_in_time(inertia[p], h);
    eliminate(inertia[p].levels, levels[p], A);
    parts.push_back(
        {std::move(A), structure.dofs.nodes(p), structure.parts[p]->constraints(), touched_part(motion[p]).dofs});
    // Without mass and supports it is as free as it is at rest.
    if (inertia[p].theta == 1.0) parts.back().stiffness.resists_rigid_motions = structure.dofs.is_unbounded(p);
  }
  linalg::SparseOptions options;
  if (model.solver.factorisation == model::Factorisation::mumps) options.library = linalg::SparseLibrary::mumps;
  auto bodies = elastic_bodies(std::move(parts), threads, options);
  for (std::size_t k = 0; k < elastic.size(); ++k) made.parts[elastic[k]] = std::move(bodies[k]);
  return made;
}

}  // namespace scabo::system
