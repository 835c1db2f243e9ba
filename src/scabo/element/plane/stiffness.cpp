#include "scabo/element/plane/stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/exact_riccati.hpp"
#include "scabo/element/plane/mirror_symmetry.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/sbfem/ring_doubling.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/cholesky_factor.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// Rows J, as many as R has columns, on which R is as well conditioned as can be had by greedy choice, measured by the
/// energy that E0 gives to a row: were the rows of a soft sector taken out, those of a stiff one would hold a near
/// translation of it, and what the deflation leaves of them would be the difference of large numbers.
std::vector<int> rows_taken_out(const Matrix& R, const Vector& E0_diagonal) {
  std::vector<int> J;
  Matrix rest = E0_diagonal.cwiseSqrt().asDiagonal() * R;
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

/// E0, E1, E2 of one block without the translations, eq. (4).
struct Deflated {
  Matrix E0, E1, E2;       // (n_k - m) x (n_k - m)
  Matrix G, H, M_inverse;  // m x n_k, m x n_k, m x m
};

/// By the Cholesky factor of M: with its inverse, E0R M^-1 R'E0 loses twice the digits of its condition, and M is
/// nearly singular where one incompressible sector outweighs the others (3e-7 of K for nu = 0.49997, 1e-10 this way).
Deflated deflate(const Block& block, const Matrix& E1, const Matrix& E2) {
  const Matrix E0R = block.E0 * block.R, E1R = E1 * block.R;
  const Eigen::LLT<Matrix> M(symmetrised(block.R.transpose() * E0R));
  if (M.info() != Eigen::Success) throw IllPosed("E0 is not positive definite");
  const Matrix Y = M.matrixL().solve(E0R.transpose()), W = M.matrixL().solve(E1R.transpose());
  Deflated d;
  d.M_inverse = M.solve(Matrix::Identity(E0R.cols(), E0R.cols()));
  d.G = M.matrixU().solve(Y);
  d.H = M.matrixU().solve(W);
  d.E0 = symmetrised(block.E0 - Y.transpose() * Y)(block.I, block.I);
  d.E1 = (E1 - W.transpose() * Y)(block.I, block.I);
  d.E2 = symmetrised(E2 - W.transpose() * W)(block.I, block.I);
  return d;
}

/// T' X T, dense. A row of T has a few entries at most, so every entry of X goes to a few places: general products of
/// sparse matrices took longer than the doubling of a small block.
Matrix in_block(const Eigen::SparseMatrix<double>& T_transposed, const Eigen::SparseMatrix<double>& X) {
  using Entries = Eigen::SparseMatrix<double>::InnerIterator;
  Matrix result = Matrix::Zero(T_transposed.rows(), T_transposed.rows());
  for (Eigen::Index column = 0; column < X.outerSize(); ++column)
    for (Entries x(X, column); x; ++x)
      for (Entries right(T_transposed, column); right; ++right)
        for (Entries left(T_transposed, x.row()); left; ++left)
          result(left.row(), right.row()) += left.value() * x.value() * right.value();
  return result;
}

/// The translations that lie in this block (in a symmetry block: none, one or both), and the rows they are taken out
/// of.
void find_translations(const Matrix& translations, Block& block) {
  const Matrix projected = block.T.transpose() * translations;
  // A direction lies in the block by all of its length or not at all.
  Eigen::SelfAdjointEigenSolver<Mat2> directions;
  directions.computeDirect(Mat2(projected.transpose() * projected));
  const auto m = (directions.eigenvalues().array() > 1e-10 * static_cast<double>(translations.rows())).count();
  block.R = projected * directions.eigenvectors().rightCols(m);
  block.J = rows_taken_out(block.R, block.E0.diagonal());
  for (int row = 0; row < static_cast<int>(block.R.rows()); ++row)
    if (!std::binary_search(block.J.begin(), block.J.end(), row)) block.I.push_back(row);
  block.R = block.R * Matrix(block.R(block.J, Eigen::all)).inverse();
}

/// K of a bounded block: K R = 0 and symmetry give the rows J.
Matrix with_translations(const Block& block, const Matrix& K_I) {
  const Matrix R_I = block.R(block.I, Eigen::all), K_IJ = -(K_I * R_I);
  Matrix K(block.R.rows(), block.R.rows());
  K(block.I, block.I) = K_I;
  K(block.I, block.J) = K_IJ;
  K(block.J, block.I) = K_IJ.transpose();
  K(block.J, block.J) = -symmetrised(R_I.transpose() * K_IJ);
  return K;
}

/// What a circle around the scaling centre, far away, knows of the ring: every point of it lies on the ray of a point
/// of the ring.
struct Circle {
  Matrix mean;           // 2 x n: mean over the angle of the displacement of the ring
  double log_far = 0.0;  // mean over the angle of ln xi on the circle, eq. (6)
};

Circle circle_of(const Ring& ring, double far) {
  Circle circle;
  circle.mean = Matrix::Zero(2, places_of(ring.nodes.size()));
  double angle = 0.0, log_of_radius = 0.0, largest = 0.0;
  for (const Vec2& x : ring.nodes) largest = std::max(largest, x.norm());
  for (const mesh::LineElement& element : ring.elements) {
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
    for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
      const Vector N = basis.values_at_rule().row(static_cast<Eigen::Index>(q)).transpose();
      const BoundaryPoint point =
          boundary_point(ring, element, N, basis.derivatives_at_rule().row(static_cast<Eigen::Index>(q)).transpose());
      const double part = basis.rule().weights[q] * point.jacobian() / point.x.squaredNorm();
      angle += part;
      log_of_radius += part * std::log(point.x.norm() / largest);
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        circle.mean.middleCols<2>(place_of(element.nodes[i])) +=
            part * N[static_cast<Eigen::Index>(i)] * Matrix::Identity(2, 2);
    }
  }
  circle.mean /= angle;
  circle.log_far = std::log(far) - log_of_radius / angle;
  return circle;
}

/// Stiffness of an unbounded block, eqs. (5) and (6): forces f = -q for every u. `K`: of v_h.
Matrix unbounded_stiffness(Block& block, const Deflated& d, const Matrix& K, const Circle& circle) {
  const auto m = static_cast<Eigen::Index>(block.J.size());
  const Matrix Q = block.v_of(Matrix::Identity(block.R.rows(), block.R.rows()));
  if (m == 0) return K;
  const Matrix H_I = d.H(Eigen::all, block.I);
  block.V = -d.E2.llt().solve(H_I.transpose());
  block.C = d.M_inverse - H_I * block.V;
  // q_I = -K v_h + (E1'V + G_I') F, and R'q = F.
  const Matrix pull = d.E1.transpose() * block.V + Matrix(d.G(Eigen::all, block.I)).transpose();
  // The mean over the circle of the displacements u of its rays is W u, W R = 1.
  const Matrix mean = circle.mean * block.T, of_a = mean * block.R;
  const Matrix W = (of_a.transpose() * of_a).inverse() * of_a.transpose() * mean;
  const Matrix mean_V = W(Eigen::all, block.I) * block.V, work = block.V.transpose() * pull;
  const Matrix N = symmetrised(mean_V) - 0.5 * (work - work.transpose());
  // F from u: a - A S^-1 v = -(C ln(far) + N + A S^-1 V) F. K is symmetric, as V'(E1'V + G_I') + N is.
  const Matrix moving = block.S.transpose().partialPivLu().solve(block.A.transpose()).transpose();  // A S^-1
  Matrix a_of_u = -moving * Q;
  for (Eigen::Index j = 0; j < m; ++j) a_of_u(j, block.J[static_cast<std::size_t>(j)]) += 1.0;
  const Matrix F_of_u = -(block.C * circle.log_far + N + moving * block.V).inverse() * a_of_u;
  const Matrix q_I = -K * (Q - block.V * F_of_u) + pull * F_of_u;
  Matrix f(block.R.rows(), block.R.rows());
  f(block.I, Eigen::all) = -q_I;
  f(block.J, Eigen::all) = -(F_of_u - Matrix(block.R(block.I, Eigen::all)).transpose() * q_I);
  return symmetrised(f);
}

/// K of a bounded block must be positive definite but for the rigid motions r in it: K + sum of D r (D r)' / r'D r, D =
/// diag K, is (its Cholesky factor exists). Where stiff sectors hang together by soft ones only, rounding can make it
/// indefinite. A row that only a translation moves, as in a rectangle of four nodes, has no stiffness at all, and
/// counts as the stiffest one.
bool is_definite(const Block& block, const Matrix& K, const Matrix& motions) {
  Vector D = K.diagonal();
  const double largest = D.maxCoeff();
  D = (D.array().abs() > 1e-14 * largest).select(D, largest);
  const Matrix r = block.T.transpose() * motions;
  linalg::CholeskyFactor factor;
  Matrix& shifted = factor.A = K;
  for (Eigen::Index m = 0; m < r.cols(); ++m) {
    const Vector w = D.cwiseProduct(r.col(m));
    const double size = w.dot(r.col(m));
    if (size > 0.0) shifted.noalias() += w * (w / size).transpose();
  }
  return factor.factorise();
}

constexpr double too_much = 1e-9;  // of a Riccati residual

IllPosed digits_lost(double residual) {
  return IllPosed(fmt::format("loss of precision: the Riccati residual remains at {:.0e}", residual));
}

/// A super-element as its blocks see it.
struct Whole {
  const Ring& ring;
  const Elasticity& D;
  double thickness;
  const Domain& domain;
  const CoefficientMatrices& matrices;
  const Matrix& motions;           // n x 3: two translations, the rotation
  Eigen::Index all_digits = 0;     // rows of a block up to which K has its last digits without being asked
  const Circle* circle = nullptr;  // unbounded
};

/// What is found of a block besides itself.
struct BlockResult {
  Matrix K;  // in the coordinates of the block
  RingStiffness ring;
  bool all_digits = false;
};

/// K of a bounded block from what ring doubling made of it, with its last digits where they are needed and the block is
/// not too large for them.
void finish_bounded(const Whole& whole, Block& block, BlockResult& result) {
  Matrix& K = result.K;
  RingStiffness& ring = result.ring;
  const auto is_right = [&] { return ring.residual <= too_much && is_definite(block, K, whole.motions); };
  const Eigen::Index rows = block.E0.rows();
  if (rows > whole.all_digits) {
    K = with_translations(block, ring.K);
    if (is_right()) return;
  }
  if (rows <= std::max(whole.all_digits, most_exact_rows)) {
    K = correct_last_digits(whole.ring, whole.D, whole.thickness, block, ring);
    result.all_digits = true;
    if (is_right()) return;
  }
  if (!(ring.residual <= too_much)) throw digits_lost(ring.residual);
  throw IllPosed("loss of precision: its stiffness is not positive definite");
}

Block solve_block(const Whole& whole, Eigen::SparseMatrix<double> T, BlockResult& result) {
  const CoefficientMatrices& matrices = whole.matrices;
  const Domain& domain = whole.domain;
  RingStiffness& ring = result.ring;
  Block block;
  block.T = std::move(T);
  const Eigen::SparseMatrix<double> transposed = block.T.transpose();
  block.E0 = symmetrised(in_block(transposed, matrices.E0));
  find_translations(whole.motions.leftCols(2), block);
  const Matrix E1 = in_block(transposed, matrices.E1), E2 = symmetrised(in_block(transposed, matrices.E2));
  const Deflated d = deflate(block, E1, E2);
  ring = ring_doubling(d.E0, d.E1, d.E2, domain.unbounded ? Side::outside : Side::inside);
  if (domain.unbounded && !(ring.residual <= too_much)) throw digits_lost(ring.residual);
  if (!domain.unbounded) finish_bounded(whole, block, result);
  block.S = std::move(ring.S);
  block.A = -(Matrix(d.G(Eigen::all, block.I)) * block.S + Matrix(d.H(Eigen::all, block.I)));
  if (domain.unbounded) result.K = unbounded_stiffness(block, d, ring.K, *whole.circle);
  ring.K.resize(0, 0);  // large ones: no copy of what is no longer needed
  return block;
}

/// K <- K + T K_k T', the lower triangle.
void add_block(const Eigen::SparseMatrix<double>& T, const Matrix& K_k, Matrix& K) {
  const Matrix columns = T * K_k;
  const Eigen::SparseMatrix<double> transposed = T.transpose();
  for (Eigen::Index j = 0; j < K.cols(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(transposed, j); entry; ++entry)
      K.col(j).tail(K.rows() - j) += entry.value() * columns.col(entry.row()).tail(K.rows() - j);
}

}  // namespace

void take_rotation_out(const Ring& ring, Matrix& K) {
  const Vector D = K.diagonal();
  Vec2 centre = Vec2::Zero(), weight = Vec2::Zero();
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    const Vec2 d = D.segment<2>(place_of(i));
    weight += d;
    centre += Vec2(d.y() * ring.nodes[i].x(), d.x() * ring.nodes[i].y());
  }
  centre = Vec2(centre.x() / weight.y(), centre.y() / weight.x());
  Vector r(K.rows());
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    const Vec2 arm = ring.nodes[i] - centre;
    r.segment<2>(place_of(i)) = Vec2(-arm.y(), arm.x());
  }
  const auto lower = K.selfadjointView<Eigen::Lower>();
  const Vector force = lower * r, w = D.cwiseProduct(r) / D.cwiseProduct(r).dot(r);
  if (!(force.norm() <= 1e-8 * D.norm() * r.norm()))
    throw IllPosed("loss of precision: its stiffness resists rigid rotation");
  const Vector half = force - 0.5 * r.dot(force) * w;
  K.selfadjointView<Eigen::Lower>().rankUpdate(w, half, -1.0);
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
}

SuperElementSolution solve_super_element(const Ring& ring, const Elasticity& D, double thickness, int threads,
                                         const Domain& domain) {
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, thickness);
  const auto n = places_of(ring.nodes.size());
  Matrix motions = Matrix::Zero(n, 3);  // two translations, the rotation
  for (Eigen::Index i = 0; i < n; ++i) motions(i, i % 2) = 1.0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    motions.block<2, 1>(place_of(i), 2) = Vec2(-ring.nodes[i].y(), ring.nodes[i].x());

  std::vector<Eigen::SparseMatrix<double>> bases = symmetry_blocks(ring, D);
  SuperElementSolution solution;
  solution.domain = domain;
  solution.blocks.resize(bases.size());
  Whole whole{ring, D, thickness, domain, matrices, motions};
  const Circle circle = domain.unbounded ? circle_of(ring, domain.far) : Circle();
  whole.circle = &circle;
  whole.all_digits = rows_with_last_digits(ring, D.contrast());
  std::vector<BlockResult> results(bases.size());
  const auto solve = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    solution.blocks[i] = solve_block(whole, std::move(bases[i]), results[i]);
  };
  linalg::parallel_for(static_cast<int>(bases.size()), threads, solve);
  bool all_digits = true;
  for (const BlockResult& of_block : results) {
    solution.doublings = std::max(solution.doublings, of_block.ring.doublings);
    solution.residual = std::max(solution.residual, of_block.ring.residual);
    all_digits = all_digits && of_block.all_digits;
  }
  if (bases.size() == 1) {  // T = 1
    solution.K = std::move(results.front().K);
  } else {
    solution.K = Matrix::Zero(n, n);
    for (std::size_t i = 0; i < bases.size(); ++i) add_block(solution.blocks[i].T, results[i].K, solution.K);
  }
  // Otherwise rounding of E2 counts, whose entries are far larger where the boundary is close to the centre.
  solution.rounding = std::numeric_limits<double>::epsilon();
  if (!all_digits)
    solution.rounding *= std::max(1.0, matrices.E2.diagonal().cwiseQuotient(solution.K.diagonal()).maxCoeff());
  if (domain.unbounded)  // it resists rotation
    solution.K.triangularView<Eigen::StrictlyUpper>() = solution.K.transpose();
  else
    take_rotation_out(ring, solution.K);
  return solution;
}

}  // namespace scabo::element
