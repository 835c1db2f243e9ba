#include "scabo/element/stiffness.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "scabo/element/mirror_symmetry.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// Largest exponent, roughly: the square root of the largest eigenvalue of E0^-1 E2, by a few power steps.
double largest_exponent(const Matrix& E0, const Matrix& E2) {
  Matrix L = E0;
  ensure(linalg::cholesky_in_place(L), "E0 of a super-element is not positive definite");
  Matrix x = Matrix::Constant(E0.rows(), 1, 1.0);
  for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, 0) = i % 2 == 0 ? 1.0 : -0.7;  // high frequency: quick to settle
  double growth = 1.0;
  for (int step = 0; step < 8; ++step) {
    Matrix y = E2 * x;
    linalg::solve_lower_in_place(L, y);
    linalg::solve_lower_in_place(L, y, true);
    growth = y.norm() / x.norm();
    if (growth == 0.0) return 1.0;
    x = y / y.norm();
  }
  return std::sqrt(growth);
}

/// Rows J, as many as R has columns, on which R is as well conditioned as can be had by greedy choice.
std::vector<int> rows_taken_out(const Matrix& R) {
  std::vector<int> J;
  Matrix rest = R;
  for (Eigen::Index column = 0; column < R.cols(); ++column) {
    Eigen::Index row = 0, pivot = 0;
    rest.cwiseAbs().maxCoeff(&row, &pivot);
    J.push_back(static_cast<int>(row));
    const Eigen::RowVectorXd pivot_row = rest.row(row);
    for (Eigen::Index c = 0; c < rest.cols(); ++c)
      if (c != pivot) rest.col(c) -= rest.col(pivot) * (pivot_row[c] / pivot_row[pivot]);
    rest.col(pivot).setZero();
  }
  std::sort(J.begin(), J.end());
  return J;
}

Matrix symmetrised(const Matrix& A) { return 0.5 * (A + A.transpose()); }

/// Solves one block; sets its stiffness `K` in the coordinates of the block.
Block solve_block(Eigen::SparseMatrix<double> T, const CoefficientMatrices& matrices, const Matrix& translations,
                  Matrix& K, int& doublings) {
  Block block;
  block.T = std::move(T);
  const Eigen::SparseMatrix<double> transposed = block.T.transpose();
  block.E0 = symmetrised(Matrix(transposed * matrices.E0 * block.T));
  const Matrix E1 = transposed * matrices.E1 * block.T;
  const Matrix E2 = symmetrised(Matrix(transposed * matrices.E2 * block.T));

  // The translations that lie in this block (in a symmetry block: none, one or both).
  const Matrix projected = transposed * translations;
  const Eigen::JacobiSVD<Matrix> svd(projected, Eigen::ComputeThinV);
  const auto m = (svd.singularValues().array() > 1e-8 * std::sqrt(static_cast<double>(translations.rows()))).count();
  block.R = projected * svd.matrixV().leftCols(m);
  block.J = rows_taken_out(block.R);
  const auto n = static_cast<int>(block.E0.rows());
  for (int row = 0; row < n; ++row)
    if (!std::binary_search(block.J.begin(), block.J.end(), row)) block.I.push_back(row);
  block.R = block.R * Matrix(block.R(block.J, Eigen::all)).inverse();

  // Eq. (4).
  const Matrix E0R = block.E0 * block.R;
  const Matrix M = symmetrised(block.R.transpose() * E0R);
  const Matrix M_inverse = M.inverse();
  const Matrix G = M_inverse * E0R.transpose();
  const Matrix E1R = E1 * block.R;
  const Matrix H = M_inverse * E1R.transpose();
  const Matrix E0_deflated = symmetrised(block.E0 - E0R * G)(block.I, block.I);
  const Matrix E1_deflated = (E1 - E1R * G)(block.I, block.I);
  const Matrix E2_deflated = symmetrised(E2 - H.transpose() * M * H)(block.I, block.I);

  const Matrix K_deflated = ring_doubling(E0_deflated, E1_deflated, E2_deflated, doublings);

  Matrix L = E0_deflated;
  ensure(linalg::cholesky_in_place(L), "E0 of a super-element is not positive definite");
  block.S = K_deflated - E1_deflated.transpose();
  linalg::solve_lower_in_place(L, block.S);
  linalg::solve_lower_in_place(L, block.S, true);
  block.A = -(Matrix(G(Eigen::all, block.I)) * block.S + Matrix(H(Eigen::all, block.I)));

  // K R = 0 and symmetry give the rows J: v = u_I - R_I u_J.
  const Matrix R_I = block.R(block.I, Eigen::all);
  Matrix Q = Matrix::Zero(static_cast<Eigen::Index>(block.I.size()), n);  // v = Q u
  for (std::size_t i = 0; i < block.I.size(); ++i) Q(static_cast<Eigen::Index>(i), block.I[i]) = 1.0;
  for (std::size_t j = 0; j < block.J.size(); ++j) Q.col(block.J[j]) = -R_I.col(static_cast<Eigen::Index>(j));
  K = symmetrised(linalg::multiply_transposed(Q, linalg::multiply(K_deflated, Q)));
  return block;
}

/// Takes K r = 0 of the rotation r, known exactly, for what short elements beside long ones left of it: 5e-10 of K where
/// lengths differ by 1e6, 1e-15 where they are alike. K t = 0 of the translations, perpendicular to r, stays.
Matrix without_rotation(const Matrix& K, const Ring& ring) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& x : ring.nodes) mean += x / static_cast<double>(ring.nodes.size());
  Vector r(K.rows());
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    const Vec2 arm = ring.nodes[i] - mean;
    r.segment<2>(static_cast<Eigen::Index>(2 * i)) = Vec2(-arm.y(), arm.x());
  }
  r.normalize();
  const Vector force = K * r;
  const Vector half = force - 0.5 * r.dot(force) * r;
  Matrix freed = K;
  freed.noalias() -= r * half.transpose();
  freed.noalias() -= half * r.transpose();
  return symmetrised(freed);
}

}  // namespace

Matrix ring_doubling(const Matrix& E0, const Matrix& E1, const Matrix& E2, int& doublings) {
  doublings = 0;
  if (E0.rows() == 0) return E0;
  // The ring's factors (gamma - lambda) / (gamma + lambda) are smallest for exponents near gamma; those of a closed
  // super-element begin at 1.
  const double gamma = std::sqrt(largest_exponent(E0, E2));
  const double d = 2.0 / gamma;
  const Matrix even = E0 / d + d / 4.0 * E2, odd = 0.5 * (E1 + E1.transpose());
  Matrix K22 = even + odd, K11 = even - odd;                                              // eq. (1)
  Matrix K12 = -E0 / d + 0.5 * (E1 - E1.transpose()) + d / 4.0 * E2;
  constexpr int most = 60;
  while (doublings < most) {                                                              // eq. (2)
    Matrix B = K11 + K22;
    ensure(linalg::cholesky_in_place(B), "a ring of a super-element is not positive definite");
    Matrix X = K12, Y = K12.transpose();
    linalg::solve_lower_in_place(B, X);
    linalg::solve_lower_in_place(B, Y);
    linalg::add_gram(K22, X, -1.0, 1.0);
    linalg::add_gram(K11, Y, -1.0, 1.0);
    K12 = linalg::multiply_transposed(Y, X, -1.0);
    ++doublings;
    // |X'X| of the next step is about |K12|^2 / |B|: below rounding, K22 has arrived.
    if (K12.cwiseAbs().maxCoeff() < 1e-10 * K22.cwiseAbs().maxCoeff()) return K22;
  }
  throw BrokenInvariant("ring doubling did not end");
}

SuperElementSolution solve_super_element(const Ring& ring, const Mat3& D, double thickness, int threads) {
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, thickness);
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  Matrix translations = Matrix::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) translations(i, i % 2) = 1.0;

  std::vector<Eigen::SparseMatrix<double>> bases = symmetry_blocks(ring);
  SuperElementSolution solution;
  solution.blocks.resize(bases.size());
  std::vector<Matrix> stiffness(bases.size());
  std::vector<int> doublings(bases.size(), 0);
  const auto solve = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    solution.blocks[i] = solve_block(std::move(bases[i]), matrices, translations, stiffness[i], doublings[i]);
  };
  linalg::parallel_for(static_cast<int>(bases.size()), threads, solve);
  solution.K = Matrix::Zero(n, n);
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const Eigen::SparseMatrix<double>& basis = solution.blocks[i].T;
    solution.K += basis * stiffness[i] * basis.transpose();
    solution.doublings = std::max(solution.doublings, doublings[i]);
  }
  solution.K = without_rotation(symmetrised(solution.K), ring);
  return solution;
}

}  // namespace scabo::element
