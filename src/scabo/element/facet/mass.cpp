#include "scabo/element/facet/mass.hpp"

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/base/error.hpp"
#include "scabo/element/sbfem/mass.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

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

bool is_uniform(const std::vector<double>& density) {
  return std::all_of(density.begin(), density.end(), [&](double rho) { return rho == density.front(); });
}

Matrix mass_matrix(const Ring& ring, const SuperElementSolution& solution, const ModalSolution& modal,
                   const std::vector<double>& density, double thickness, int threads) {
  return mass_matrix(boundary_mass(ring, density, thickness), solution, modal, !is_uniform(density), threads);
}

}  // namespace scabo::element
