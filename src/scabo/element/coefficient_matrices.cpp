#include "scabo/element/coefficient_matrices.hpp"

#include "scabo/element/line_basis.hpp"

namespace scabo::element {

namespace {

const LineBasis& basis_of(const mesh::LineElement& element) {
  return LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
}

}  // namespace

BoundaryPoint boundary_point(const Ring& ring, const mesh::LineElement& element, const Vector& N,
                             const Vector& N_eta) {
  BoundaryPoint point;
  for (std::size_t i = 0; i < element.nodes.size(); ++i) {
    const Vec2& node = ring.nodes[static_cast<std::size_t>(element.nodes[i])];
    point.x += N[static_cast<Eigen::Index>(i)] * node;
    point.x_eta += N_eta[static_cast<Eigen::Index>(i)] * node;
  }
  return point;
}

Ring ring_of(const mesh::SuperElement& super_element, const std::vector<Vec2>& nodes) {
  Ring ring{nodes, super_element.boundary};
  for (Vec2& node : ring.nodes) node -= super_element.centre;
  return ring;
}

StrainMatrices strain_matrices(const Ring& ring, const mesh::LineElement& element, const Vector& N,
                               const Vector& N_eta) {
  const BoundaryPoint point = boundary_point(ring, element, N, N_eta);
  const auto [x, y] = std::pair(point.x.x(), point.x.y());
  const auto [x_eta, y_eta] = std::pair(point.x_eta.x(), point.x_eta.y());
  Eigen::Matrix<double, 3, 2> b1, b2;
  b1 << y_eta, 0.0, 0.0, -x_eta, -x_eta, y_eta;
  b2 << -y, 0.0, 0.0, x, x, -y;
  StrainMatrices strain;
  strain.J = point.jacobian();
  ensure(strain.J > 0.0, "the scaling centre does not see a boundary element");
  strain.B1.resize(3, 2 * N.size());
  strain.B2.resize(3, 2 * N.size());
  for (Eigen::Index i = 0; i < N.size(); ++i) {
    strain.B1.middleCols<2>(2 * i) = N[i] / strain.J * b1;
    strain.B2.middleCols<2>(2 * i) = N_eta[i] / strain.J * b2;
  }
  return strain;
}

CoefficientMatrices coefficient_matrices(const Ring& ring, const Elasticity& D, double thickness) {
  using Triplet = Eigen::Triplet<double>;
  ensure(D.fits(ring), "a super-element has one elasticity, or one for each boundary element");
  std::vector<Triplet> entries0, entries1, entries2;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const LineBasis& basis = basis_of(element);
    const int m = 2 * basis.nodes();
    Matrix e0 = Matrix::Zero(m, m), e1 = e0, e2 = e0;
    for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
      const auto row = static_cast<Eigen::Index>(q);
      const StrainMatrices strain =
          strain_matrices(ring, element, basis.values_at_rule().row(row), basis.derivatives_at_rule().row(row));
      const Mat3 weighted = D.of(e) * (strain.J * basis.rule().weights[q] * thickness);
      const Eigen::Matrix<double, 3, Eigen::Dynamic> DB1 = weighted * strain.B1, DB2 = weighted * strain.B2;
      e0.noalias() += strain.B1.transpose() * DB1;
      e1.noalias() += strain.B2.transpose() * DB1;
      e2.noalias() += strain.B2.transpose() * DB2;
    }
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) {
        const int row = 2 * element.nodes[static_cast<std::size_t>(i / 2)] + i % 2;
        const int column = 2 * element.nodes[static_cast<std::size_t>(j / 2)] + j % 2;
        // The exactly symmetric parts: products of B' D B differ in the last digit.
        entries0.emplace_back(row, column, 0.5 * (e0(i, j) + e0(j, i)));
        entries1.emplace_back(row, column, e1(i, j));
        entries2.emplace_back(row, column, 0.5 * (e2(i, j) + e2(j, i)));
      }
  }
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  CoefficientMatrices matrices{Eigen::SparseMatrix<double>(n, n), Eigen::SparseMatrix<double>(n, n),
                               Eigen::SparseMatrix<double>(n, n)};
  matrices.E0.setFromTriplets(entries0.begin(), entries0.end());
  matrices.E1.setFromTriplets(entries1.begin(), entries1.end());
  matrices.E2.setFromTriplets(entries2.begin(), entries2.end());
  return matrices;
}

}  // namespace scabo::element
