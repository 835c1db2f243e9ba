#include "scabo/element/mass.hpp"

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/linalg/sylvester.hpp"

namespace scabo::element {

namespace {

Matrix shifted(const Matrix& T, double shift) { return T + shift * Matrix::Identity(T.rows(), T.cols()); }

/// X_va of eq. (4) for one block.
Matrix solve_mixed(const ModalBlock& modes, const Matrix& right) {
  const Matrix& U = modes.modes.U();
  const Matrix twice = 2.0 * Matrix::Identity(right.cols(), right.cols());
  return U * linalg::solve_sylvester(modes.modes.T(), twice, U.transpose() * right);
}

/// The part of M between two symmetry blocks, in their coordinates: n_k x n_l.
Matrix mass_between(const Block& k, const ModalBlock& modes_k, const Block& l, const ModalBlock& modes_l,
                    const Eigen::SparseMatrix<double>& M0) {
  const Matrix M0_kl = Eigen::SparseMatrix<double>(k.T.transpose() * M0 * l.T);
  const Matrix M0_k = M0_kl * l.R, M0_l = M0_kl(Eigen::all, l.I);  // the sides of l: on a, on v
  const Matrix M0_vv = k.on_v(M0_l), M0_va = k.on_v(M0_k), M0_av = k.on_a(M0_l), M0_aa = k.on_a(M0_k);

  const Matrix aa = 0.5 * M0_aa;                                         // eq. (3)
  const Matrix va = solve_mixed(modes_k, M0_va - k.A.transpose() * aa);  // eq. (4)
  const Matrix av = solve_mixed(modes_l, (M0_av - aa * l.A).transpose()).transpose();
  const Matrix &U_k = modes_k.modes.U(), &U_l = modes_l.modes.U();
  const Matrix right = M0_vv - k.A.transpose() * av - va * l.A;
  const Matrix Y = linalg::solve_sylvester(shifted(modes_k.modes.T(), 1.0), shifted(modes_l.modes.T(), 1.0),
                                           linalg::multiply(linalg::multiply_transposed(U_k, right), U_l));
  const Matrix vv = linalg::multiply(linalg::multiply(U_k, Y), U_l.transpose());  // eq. (5)

  // Back to displacements: Q' and the rows J from both sides.
  Matrix on_v = l.from_v(vv.transpose()).transpose(), on_a = l.from_v(av.transpose()).transpose();
  on_v(Eigen::all, l.J) += va;
  on_a(Eigen::all, l.J) += aa;
  Matrix M = k.from_v(on_v);
  M(k.J, Eigen::all) += on_a;
  return M;
}

}  // namespace

Eigen::SparseMatrix<double> boundary_mass(const Ring& ring, const std::vector<double>& density, double thickness) {
  ensure(density.size() == 1 || density.size() == ring.elements.size(),
         "a super-element has one density or one for each boundary element");
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const std::vector<int>& nodes = ring.elements[e].nodes;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(nodes.size()) - 1);
    // N'N |J| has degree 2p on straight elements, 4p - 1 on curved ones.
    const geometry::GaussRule rule = geometry::gauss_rule(2 * basis.order());
    Matrix m = Matrix::Zero(basis.nodes(), basis.nodes());
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Vector N = basis.values(rule.points[q]), N_eta = basis.derivatives(rule.points[q]);
      Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec2& node = ring.nodes[static_cast<std::size_t>(nodes[i])];
        x += N[static_cast<Eigen::Index>(i)] * node;
        x_eta += N_eta[static_cast<Eigen::Index>(i)] * node;
      }
      m += N * N.transpose() * (cross(x, x_eta) * rule.weights[q]);
    }
    m *= density[density.size() == 1 ? 0 : e] * thickness;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        for (int component = 0; component < 2; ++component)
          entries.emplace_back(place_of(nodes[i], component), place_of(nodes[j], component),
                               m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  const auto n = places_of(ring.nodes.size());
  Eigen::SparseMatrix<double> M0(n, n);
  M0.setFromTriplets(entries.begin(), entries.end());
  return M0;
}

Matrix mass_matrix(const Ring& ring, const SuperElementSolution& solution, const ModalSolution& modal,
                   const std::vector<double>& density, double thickness, int threads) {
  const Eigen::SparseMatrix<double> M0 = boundary_mass(ring, density, thickness);
  const bool uniform = std::all_of(density.begin(), density.end(), [&](double rho) { return rho == density.front(); });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < solution.blocks.size(); ++k)
    for (std::size_t l = k; l < solution.blocks.size(); ++l)
      if (l == k || !uniform) pairs.emplace_back(k, l);

  std::vector<Matrix> parts(pairs.size());
  linalg::parallel_for(static_cast<int>(pairs.size()), threads, [&](int i) {
    const auto [k, l] = pairs[static_cast<std::size_t>(i)];
    parts[static_cast<std::size_t>(i)] =
        mass_between(solution.blocks[k], modal.blocks[k], solution.blocks[l], modal.blocks[l], M0);
  });
  const Eigen::Index n = M0.rows();
  Matrix M = Matrix::Zero(n, n);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [k, l] = pairs[i];
    const Matrix part = solution.blocks[k].T * parts[i] * solution.blocks[l].T.transpose();
    M += k == l ? part : Matrix(part + part.transpose());
  }
  return 0.5 * (M + M.transpose());
}

}  // namespace scabo::element
