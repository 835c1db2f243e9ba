#include "scabo/system/natural_modes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/symmetric_eigen.hpp"

namespace scabo::system {

namespace {

constexpr Eigen::Index dense_at_most = 300;  // below this size sparse matrices bring no advantage

using Sparse = linalg::SparseMatrix;

std::vector<int> free_dofs(Eigen::Index size, const std::vector<Constraint>& constraints) {
  std::vector<bool> free(static_cast<std::size_t>(size), true);
  for (const Constraint& constraint : constraints) free[static_cast<std::size_t>(constraint.dof)] = false;
  std::vector<int> dofs;
  for (int i = 0; i < static_cast<int>(size); ++i)
    if (free[static_cast<std::size_t>(i)]) dofs.push_back(i);
  return dofs;
}

Sparse part_of(const Sparse& A, const std::vector<int>& dofs) {
  std::vector<int> place(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t i = 0; i < dofs.size(); ++i) place[static_cast<std::size_t>(dofs[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(A.nonZeros()));
  for (Eigen::Index column = 0; column < A.outerSize(); ++column)
    for (Sparse::InnerIterator it(A, column); it; ++it) {
      const int row = place[static_cast<std::size_t>(it.row())], col = place[static_cast<std::size_t>(it.col())];
      if (row >= 0 && col >= 0) entries.emplace_back(row, col, it.value());
    }
  const auto n = static_cast<Eigen::Index>(dofs.size());
  Sparse part(n, n);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

double largest_row(const Matrix& A) { return A.size() > 0 ? A.cwiseAbs().rowwise().sum().maxCoeff() : 0.0; }
double largest_row(const Sparse& A) { return A.size() > 0 ? (A.cwiseAbs() * Vector::Ones(A.cols())).maxCoeff() : 0.0; }

/// Rigid motions with N'M N = 1; the first ones keep their direction.
template <typename Mass>
Matrix orthonormal(const Matrix& N, const Mass& M) {
  if (N.cols() == 0) return N;
  const Eigen::LLT<Matrix> gram(Matrix(N.transpose() * (M * N)));
  return gram.matrixL().solve(N.transpose()).transpose();
}

/// Eq. (1).
linalg::EigenPairs elastic_modes(const Matrix& K, const Matrix& M, const Matrix& N, int count) {
  if (N.cols() == 0) return linalg::largest_eigenpairs(M, K, count);
  const Eigen::HouseholderQR<Matrix> qr(M * N);
  const auto rest = [&](const Matrix& A) {
    Matrix rotated = qr.householderQ().adjoint() * A;
    rotated = rotated * qr.householderQ();
    const Eigen::Index n = A.rows() - N.cols();
    return Matrix(rotated.bottomRightCorner(n, n));
  };
  linalg::EigenPairs pairs = linalg::largest_eigenpairs(rest(M), rest(K), count);
  Matrix vectors = Matrix::Zero(K.rows(), count);
  vectors.bottomRows(pairs.vectors.rows()) = pairs.vectors;
  pairs.vectors = qr.householderQ() * vectors;
  return pairs;
}

/// Whether the number of eigenvalues below the widest gap behind the requested ones is the number found there. Unknown,
/// and false, if there is no gap.
bool none_missed(const Sparse& K, const Sparse& M, const Vector& inverses, int count, int rigid) {
  Eigen::Index widest = count;  // the gap between the modes widest - 1 and widest
  for (Eigen::Index k = count; k < inverses.size(); ++k)
    if (inverses[k - 1] / inverses[k] > inverses[widest - 1] / inverses[widest]) widest = k;
  constexpr double least_gap = 1e-8;  // equal eigenvalues differ by their rounding
  if (inverses[widest - 1] < (1.0 + least_gap) * inverses[widest]) return false;
  const double shift = 1.0 / std::sqrt(inverses[widest - 1] * inverses[widest]);
  return linalg::eigenvalues_below(K, M, shift) == widest + rigid;
}

/// Eq. (2); `body` gives the displacement under forces in equilibrium, and the levels, which the stiffness does not
/// couple with it, theirs.
linalg::EigenPairs elastic_modes(const Sparse& K, const Sparse& M, const Matrix& N, int count, const BodySystem& body,
                                 const std::vector<int>& dofs, const std::vector<BodyLevel>& levels) {
  const Matrix MN = M * N;
  const Vector held = Vector::Zero(static_cast<Eigen::Index>(body.constraints().size()));
  std::vector<Eigen::LLT<Matrix>> of_levels;
  for (const BodyLevel& level : levels) of_levels.emplace_back(level.Z());
  const linalg::Operator inverse = [&](const Vector& y) {
    Vector forces = Vector::Zero(body.size() + size_of(levels));
    forces(dofs) = y - MN * (N.transpose() * y);
    Vector moved(forces.size());
    moved.head(body.size()) = body.displacement(forces.head(body.size()), held);
    for (std::size_t k = 0; k < levels.size(); ++k)
      moved.segment(body.size() + levels[k].first, levels[k].size()) =
          of_levels[k].solve(forces.segment(body.size() + levels[k].first, levels[k].size()));
    Vector u = moved(dofs);
    return Vector(u - N * (MN.transpose() * u));
  };
  int more = 6;  // to find a gap behind the requested ones: a body of many equal parts has as many equal frequencies
  for (unsigned attempt = 0; attempt < 3; ++attempt, more *= 4) {
    const int all = std::min(count + more, static_cast<int>(dofs.size() - N.cols()) - 1);
    linalg::EigenPairs pairs = linalg::largest_by_lanczos(inverse, M, all, attempt);
    if (pairs.values.size() < all || !none_missed(K, M, pairs.values, count, static_cast<int>(N.cols()))) continue;
    return {pairs.values.head(count), pairs.vectors.leftCols(count)};
  }
  throw BrokenInvariant("natural modes were missed: the Lanczos iterations did not find all of them");
}

template <typename Symmetric>
NaturalModes finish(const Symmetric& K, const Symmetric& M, const Matrix& N, const linalg::EigenPairs& elastic,
                    int count, const std::vector<int>& dofs, Eigen::Index size) {
  NaturalModes modes;
  modes.rigid = std::min<int>(count, static_cast<int>(N.cols()));
  const Eigen::Index found = modes.rigid + elastic.values.size();
  modes.eigenvalues = Vector::Zero(found);
  modes.eigenvalues.tail(elastic.values.size()) = elastic.values.cwiseInverse();
  Matrix shapes(K.rows(), found);
  shapes << N.leftCols(modes.rigid), elastic.vectors;
  const double norm_K = largest_row(K), norm_M = largest_row(M);
  modes.residuals.resize(found);
  for (Eigen::Index k = 0; k < found; ++k) {
    const Vector Mphi = M * shapes.col(k), Kphi = K * shapes.col(k);
    const double largest = shapes.col(k).lpNorm<Eigen::Infinity>();
    modes.residuals[k] = (Kphi - modes.eigenvalues[k] * Mphi).template lpNorm<Eigen::Infinity>() /
                         ((norm_K + modes.eigenvalues[k] * norm_M) * largest);
    shapes.col(k) /= std::sqrt(shapes.col(k).dot(Mphi));
  }
  modes.shapes = Matrix::Zero(size, found);
  modes.shapes(dofs, Eigen::all) = shapes;
  return modes;
}

}  // namespace

NaturalModes natural_modes(const Stiffness& of_boundary, const Stiffness& mass_of_boundary,
                           const std::vector<Vec2>& nodes, const std::vector<Constraint>& constraints, int count,
                           const std::vector<BodyLevel>& levels) {
  const auto [K, M] = with_levels(of_boundary, mass_of_boundary, levels);
  const std::vector<int> dofs = free_dofs(K.size(), constraints);
  if (dofs.empty()) return {Vector(0), Matrix(K.size(), 0), 0, Vector(0)};
  Vec2 reference;
  double lever = 0.0;
  const Matrix motions = free_motions(nodes, constraints, K.springs.directions, reference, lever);
  Matrix N = Matrix::Zero(K.size(), motions.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    N.middleRows<2>(place_of(i)) = rigid_point(nodes[i], reference, lever) * motions;
  const Matrix N_free = N(dofs, Eigen::all);
  const auto elastic = static_cast<int>(dofs.size()) - static_cast<int>(motions.cols());
  const int wanted = std::clamp(count - static_cast<int>(motions.cols()), 0, elastic);

  if (K.dense || static_cast<Eigen::Index>(dofs.size()) < std::max<Eigen::Index>(dense_at_most, 4 * wanted)) {
    Matrix K_free = K.dense ? Matrix((*K.dense)(dofs, dofs)) : Matrix(part_of(K.sparse, dofs));
    if (!K.springs.none()) K_free += part_of(K.springs.matrix, dofs);
    const Matrix M_free = M.dense ? Matrix((*M.dense)(dofs, dofs)) : Matrix(part_of(M.sparse, dofs));
    const Matrix rigid = orthonormal(N_free, M_free);
    return finish(K_free, M_free, rigid, elastic_modes(K_free, M_free, rigid, wanted), count, dofs, K.size());
  }
  const Sparse K_free = part_of(K.springs.none() ? K.sparse : Sparse(K.sparse + K.springs.matrix), dofs),
               M_free = part_of(M.sparse, dofs);
  const Matrix rigid = orthonormal(N_free, M_free);
  linalg::EigenPairs pairs{Vector(0), Matrix(static_cast<Eigen::Index>(dofs.size()), 0)};
  if (wanted > 0)
    pairs = elastic_modes(K_free, M_free, rigid, wanted, *elastic_body(of_boundary, nodes, constraints), dofs, levels);
  return finish(K_free, M_free, rigid, pairs, count, dofs, K.size());
}

}  // namespace scabo::system
