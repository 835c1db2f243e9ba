#include "scabo/element/plane/exact_riccati.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/sbfem/riccati.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::element {

namespace {

using Real = long double;
using Exact = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Eq. (4) of stiffness.hpp.
struct Coefficients {
  Exact E0, E1, E2;  // (n_k - m) x (n_k - m)
  Exact R_I;         // (n_k - m) x m, the translations of the rows that are left
};

using Sparse = Eigen::SparseMatrix<Real>;

/// T with columns of length 1 to all digits: the entries of a column differ in sign only, or belong to one direction.
Sparse orthonormal(const Eigen::SparseMatrix<double>& T) {
  Sparse exact = T.cast<Real>();
  for (Eigen::Index k = 0; k < exact.outerSize(); ++k) {
    Real square = 0;
    for (Sparse::InnerIterator it(exact, k); it; ++it) square += it.value() * it.value();
    for (Sparse::InnerIterator it(exact, k); it; ++it) it.valueRef() /= std::sqrt(square);
  }
  return exact;
}

/// The translations of a block, R_J = 1.
Exact translations(const Sparse& T, const Block& block) {
  const auto m = static_cast<Eigen::Index>(block.J.size());
  if (m == 0) return Exact(T.cols(), 0);
  Exact both = Exact::Zero(T.rows(), 2);
  for (Eigen::Index i = 0; i < T.rows(); ++i) both(i, i % 2) = 1;
  Exact projected = T.transpose() * both;
  if (m == 1) {  // both are multiples of one
    const auto j = static_cast<Eigen::Index>(block.J.front());
    const Eigen::Index of = std::abs(projected(j, 0)) > std::abs(projected(j, 1)) ? 0 : 1;
    return projected.col(of) / projected(j, of);
  }
  return projected * Exact(projected(block.J, Eigen::all)).inverse();
}

Coefficients without_translations(const ExactCoefficientMatrices& of, const Block& block) {
  const Sparse T = orthonormal(block.T), transposed = T.transpose();
  const auto in_block = [&](const Sparse& E) { return Exact(Sparse(Sparse(transposed * E) * T)); };
  const Exact E0 = in_block(of.E0), E1 = in_block(of.E1), E2 = in_block(of.E2), R = translations(T, block);
  const std::vector<int>& I = block.I;
  const Exact R_I = R(I, Eigen::all);
  if (R.cols() == 0) return {E0(I, I), E1(I, I), E2(I, I), R_I};
  const Exact E0R = E0 * R, E1R = E1 * R;
  const Eigen::LLT<Exact> M(R.transpose() * E0R);
  if (M.info() != Eigen::Success) throw IllPosed("E0 is not positive definite");
  const Exact Y = M.matrixL().solve(Exact(E0R.transpose())), W = M.matrixL().solve(Exact(E1R.transpose()));
  return {Exact(E0 - Y.transpose() * Y)(I, I), Exact(E1 - W.transpose() * Y)(I, I), Exact(E2 - W.transpose() * W)(I, I),
          R_I};
}

/// K R = 0 and symmetry give the rows J.
Matrix with_translations(const Exact& K_I, const Exact& R_I, const Block& block) {
  const Exact symmetric = (K_I + K_I.transpose()) / 2, K_IJ = -(symmetric * R_I);
  Exact K(block.T.cols(), block.T.cols());
  K(block.I, block.I) = symmetric;
  K(block.I, block.J) = K_IJ;
  K(block.J, block.I) = K_IJ.transpose();
  K(block.J, block.J) = -(R_I.transpose() * K_IJ);
  return K.cast<double>();
}

/// Largest distance of the boundary from the scaling centre over the smallest.
double slenderness(const Ring& ring) {
  double largest = 0.0, smallest = HUGE_VAL;
  for (const mesh::LineElement& element : ring.elements) {
    const Vec2 &from = ring.node(element.nodes.front()), &to = ring.node(element.nodes.back());
    largest = std::max(largest, from.norm());
    smallest = std::min(smallest, std::abs(cross(from, to)) / (to - from).norm());
  }
  return largest / smallest;
}

}  // namespace

Eigen::Index rows_with_last_digits(const Ring& ring, double contrast) {
  if (slenderness(ring) > great_slenderness) return most_slender_rows;
  return contrast > great_contrast ? most_exact_rows : 0;
}

Matrix correct_last_digits(const Ring& boundary, const Elasticity& D, double thickness, const Block& block,
                           RingStiffness& ring) {
  const Coefficients exact = without_translations(exact_coefficient_matrices(boundary, D, thickness), block);
  const Eigen::LLT<Exact> L(exact.E0);
  if (L.info() != Eigen::Success) throw IllPosed("E0 is not positive definite");
  const auto scale_of = [](const Exact& A) { return Vector(A.diagonal().cast<double>().cwiseSqrt().cwiseInverse()); };
  const Vector scale = scale_of(exact.E0);
  Exact K = ring.K.cast<Real>();
  constexpr int most = 4;
  for (int k = 0;; ++k) {
    const Exact X = L.matrixL().solve(Exact((K - exact.E1).transpose()));
    const RiccatiResidual residual = judged(Exact(exact.E2 - X.transpose() * X).cast<double>(),
                                            Exact(L.matrixU().solve(X)).cast<double>(), exact.E2.cast<double>());
    ring.S = residual.S;
    ring.residual = residual.size;
    if (k == most || !std::isfinite(residual.size)) break;
    const Matrix step = newton_step(residual, scale.cwiseInverse());
    const auto size = [&](const Matrix& A) {
      return (scale.asDiagonal() * A * scale.asDiagonal()).cwiseAbs().maxCoeff();
    };
    K += step.cast<Real>();
    // A step is good to some six digits: is the next one below the rounding of K?
    if (residual.size < 1e-12 && size(step) < 1e-10 * size(ring.K)) {
      ring.S += Exact(L.solve(step.cast<Real>())).cast<double>();
      break;
    }
  }
  ring.K = K.cast<double>();
  return with_translations(K, exact.R_I, block);
}

}  // namespace scabo::element
