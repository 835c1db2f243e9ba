#include "scabo/element/facet/coefficient_matrices.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "scabo/base/components.hpp"
#include "scabo/element/facet/cell_ring.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::element {

namespace {

const geometry::LineBasis& basis_of(const mesh::LineElement& element) {
  return geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
}

}  // namespace

BoundaryPoint boundary_point(const Ring& ring, const mesh::LineElement& element, const Vector& N, const Vector& N_eta) {
  BoundaryPoint point;
  for (std::size_t i = 0; i < element.nodes.size(); ++i) {
    const Vec2& node = ring.nodes[static_cast<std::size_t>(element.nodes[i])];
    point.x += N[static_cast<Eigen::Index>(i)] * node;
    point.x_eta += N_eta[static_cast<Eigen::Index>(i)] * node;
  }
  return point;
}

double Elasticity::contrast() const {
  const auto [softest, stiffest] =
      std::minmax_element(D_.begin(), D_.end(), [](const Mat3& a, const Mat3& b) { return a.trace() < b.trace(); });
  return D_.empty() ? 1.0 : stiffest->trace() / softest->trace();
}

Ring ring_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes) {
  Ring ring;
  set_ring(ring, cell, nodes);
  return ring;
}

void set_ring(Ring& ring, const mesh::Cell& cell, const std::vector<Vec2>& nodes) {
  ring.nodes.clear();
  const auto add = [&](int node) { ring.nodes.push_back(nodes[static_cast<std::size_t>(node)] - cell.centre); };
  for (const mesh::LineElement& element : cell.boundary)
    for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i) add(element.nodes[i]);
  if (cell.is_open()) add(cell.boundary.back().nodes.back());
  const auto total = static_cast<int>(ring.nodes.size());
  ring.elements.resize(cell.boundary.size());
  int next = 0;
  for (std::size_t e = 0; e < cell.boundary.size(); ++e) {
    const std::size_t count = cell.boundary[e].nodes.size();
    std::vector<int>& own = ring.elements[e].nodes;
    own.resize(count);
    for (std::size_t i = 0; i < count; ++i) own[i] = (next + static_cast<int>(i)) % total;
    next += static_cast<int>(count) - 1;
  }
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
  ensure(strain.J > 0.0, "every boundary element is visible from the scaling centre");
  strain.B1.resize(3, 2 * N.size());
  strain.B2.resize(3, 2 * N.size());
  for (Eigen::Index i = 0; i < N.size(); ++i) {
    strain.B1.middleCols<2>(place_of(i)) = N[i] / strain.J * b1;
    strain.B2.middleCols<2>(place_of(i)) = N_eta[i] / strain.J * b2;
  }
  return strain;
}

namespace {

/// Three matrices with the pattern of the ring: 2 x 2 blocks for every two nodes of one element.
template <typename Real>
class Assembly {
 public:
  explicit Assembly(const Ring& ring) : neighbours_(ring.nodes.size()) {
    for (const mesh::LineElement& element : ring.elements)
      for (const int node : element.nodes) {
        auto& list = neighbours_[static_cast<std::size_t>(node)];
        list.insert(list.end(), element.nodes.begin(), element.nodes.end());
      }
    const auto n = places_of(ring.nodes.size());
    Eigen::SparseMatrix<Real> pattern(n, n);
    Eigen::Index entries = 0;
    for (auto& list : neighbours_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      entries += 4 * static_cast<Eigen::Index>(list.size());
    }
    pattern.resizeNonZeros(entries);
    int at = 0;
    for (std::size_t node = 0; node < neighbours_.size(); ++node)
      for (std::size_t c = 0; c < 2; ++c) {
        pattern.outerIndexPtr()[place_of(node, static_cast<int>(c))] = at;
        for (const int row : neighbours_[node])
          for (int r = 0; r < 2; ++r) pattern.innerIndexPtr()[at++] = 2 * row + r;
      }
    pattern.outerIndexPtr()[n] = at;
    std::fill(pattern.valuePtr(), pattern.valuePtr() + entries, Real(0));
    matrices_ = {pattern, pattern, pattern};
  }

  using Block = Eigen::Matrix<Real, 2, 2>;
  void add(int row, int column, const Block& e0, const Block& e1, const Block& e2) {
    const auto& list = neighbours_[static_cast<std::size_t>(column)];
    const auto place = 2 * (std::lower_bound(list.begin(), list.end(), row) - list.begin());
    for (Eigen::Index c = 0; c < 2; ++c) {
      const auto at = matrices_.E0.outerIndexPtr()[2 * column + c] + place;
      for (Eigen::Index r = 0; r < 2; ++r) {
        matrices_.E0.valuePtr()[at + r] += e0(r, c);
        matrices_.E1.valuePtr()[at + r] += e1(r, c);
        matrices_.E2.valuePtr()[at + r] += e2(r, c);
      }
    }
  }

  CoefficientMatricesOf<Real> take() { return std::move(matrices_); }

 private:
  std::vector<std::vector<int>> neighbours_;  // of each node, itself among them
  CoefficientMatricesOf<Real> matrices_;
};

/// Throws what is wrong where |J| is not positive.
[[noreturn]] void refuse_element(const Ring& ring, std::size_t e) {
  const std::string name = "boundary element " + std::to_string(e);
  const auto& nodes = ring.elements[e].nodes;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (ring.nodes[static_cast<std::size_t>(nodes[i])] == ring.nodes[static_cast<std::size_t>(nodes[i - 1])])
      throw IllPosed(name + " has no length");
  throw IllPosed(name + " is not entirely visible from the scaling centre");
}

/// int over one element, 2 x 2 blocks e[i * count + j] for its nodes i, j.
template <typename Real>
struct ElementBlocks {
  std::vector<Eigen::Matrix<Real, 2, 2>> e0, e1, e2;
};

/// A row of shape functions or of their derivatives, whose sum (1 or 0) is exact.
template <typename Real, typename Row>
Eigen::Matrix<Real, 1, Eigen::Dynamic> with_sum(const Row& row, Real sum) {
  Eigen::Matrix<Real, 1, Eigen::Dynamic> values = row.template cast<Real>();
  if constexpr (!std::is_same_v<Real, double>) values[0] += sum - values.sum();
  return values;
}

template <typename Real>
void integrate(const Ring& ring, std::size_t e, const Mat3& D, double thickness, ElementBlocks<Real>& blocks) {
  using Vec = Eigen::Matrix<Real, 2, 1>;
  using Strain = Eigen::Matrix<Real, 3, 2>;
  using Block = Eigen::Matrix<Real, 2, 2>;
  const mesh::LineElement& element = ring.elements[e];
  const geometry::LineBasis& basis = basis_of(element);
  const auto count = static_cast<Eigen::Index>(element.nodes.size());
  for (auto* part : {&blocks.e0, &blocks.e1, &blocks.e2})
    part->assign(static_cast<std::size_t>(count * count), Block::Zero());
  for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
    const auto N = with_sum<Real>(basis.values_at_rule().row(static_cast<Eigen::Index>(q)), 1);
    const auto N_eta = with_sum<Real>(basis.derivatives_at_rule().row(static_cast<Eigen::Index>(q)), 0);
    Vec point = Vec::Zero(), along = Vec::Zero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec node = ring.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])].cast<Real>();
      point += N[i] * node;
      along += N_eta[i] * node;
    }
    const auto [x, y] = std::pair(point.x(), point.y());
    const auto [x_eta, y_eta] = std::pair(along.x(), along.y());
    const Real J = x * y_eta - y * x_eta;
    if (!(J > 0)) refuse_element(ring, e);
    Strain b1, b2;  // times |J|
    b1 << y_eta, 0, 0, -x_eta, -x_eta, y_eta;
    b2 << -y, 0, 0, x, x, -y;
    const Eigen::Matrix<Real, 3, 3> weighted = D.cast<Real>() * (Real(basis.rule().weights[q]) * thickness / J);
    const Strain Db1 = weighted * b1, Db2 = weighted * b2;
    Block c0 = b1.transpose() * Db1, c2 = b2.transpose() * Db2;
    const Block c1 = b2.transpose() * Db1;
    c0(1, 0) = c0(0, 1), c2(1, 0) = c2(0, 1);  // exactly symmetric: they differ in the last digit
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = 0; j < count; ++j) {
        const auto at = static_cast<std::size_t>(i * count + j);
        blocks.e0[at] += (N[i] * N[j]) * c0;
        blocks.e1[at] += (N_eta[i] * N[j]) * c1;
        blocks.e2[at] += (N_eta[i] * N_eta[j]) * c2;
      }
  }
}

template <typename Real>
CoefficientMatricesOf<Real> integrated(const Ring& ring, const Elasticity& D, double thickness) {
  ensure(D.fits(ring), "a super-element has one elasticity, or one for each boundary element");
  if (!(thickness > 0.0)) throw IllPosed("the thickness is not positive");
  Assembly<Real> assembly(ring);
  ElementBlocks<Real> blocks;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    if (!D.of(e).allFinite() || Eigen::LLT<Mat3>(D.of(e)).info() != Eigen::Success)
      throw IllPosed("the elasticity of boundary element " + std::to_string(e) + " is not positive definite");
    integrate(ring, e, D.of(e), thickness, blocks);
    const auto& nodes = ring.elements[e].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const std::size_t at = i * nodes.size() + j;
        assembly.add(nodes[i], nodes[j], blocks.e0[at], blocks.e1[at], blocks.e2[at]);
      }
  }
  return assembly.take();
}

}  // namespace

CoefficientMatrices coefficient_matrices(const Ring& ring, const Elasticity& D, double thickness) {
  return integrated<double>(ring, D, thickness);
}

ExactCoefficientMatrices exact_coefficient_matrices(const Ring& ring, const Elasticity& D, double thickness) {
  return integrated<long double>(ring, D, thickness);
}

}  // namespace scabo::element
