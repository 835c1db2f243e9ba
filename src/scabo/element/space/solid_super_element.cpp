#include "scabo/element/space/solid_super_element.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scabo/base/cell_topology.hpp"
#include "scabo/base/components.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/sbfem/ring_doubling.hpp"
#include "scabo/geometry/facet_basis.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::element {

namespace {

constexpr Components in_space{3};

using NodesOfFacet = std::vector<Eigen::Index>;

struct BoundaryFacet {
  NodesOfFacet nodes;
  const geometry::FacetBasis* basis;
  Matrix x;  // 3 x nodes, relative to the centre
};

/// The boundary of a cell around its scaling centre.
struct SolidBoundary {
  Eigen::Vector3d centre;
  std::size_t corners;
  std::vector<BoundaryFacet> facets;
};
SolidBoundary solid_boundary(const Matrix& nodes) {
  const auto& topology = CellTopology::of(static_cast<std::size_t>(nodes.cols()));
  SolidBoundary boundary{
      nodes.leftCols(static_cast<Eigen::Index>(topology.corners)).rowwise().mean(), topology.corners, {}};
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    const std::vector<std::size_t> of_side = topology.nodes_of_side(side, true);
    const NodesOfFacet at(of_side.begin(), of_side.end());
    boundary.facets.push_back({at, &geometry::FacetBasis::of(static_cast<int>(at.size())),
                               nodes(Eigen::all, at).colwise() - boundary.centre});
  }
  return boundary;
}

/// The functions and the geometry at a place of a facet.
struct FacetPoint {
  Vector N;
  Matrix slopes;              // N by eta and zeta
  Eigen::Vector3d x, across;  // x_b, x,eta x x,zeta
  Eigen::Vector3d g1, g2, g3;
  double J;
};
FacetPoint facet_point(const BoundaryFacet& facet, const Vec2& place) {
  FacetPoint at{facet.basis->values(place), facet.basis->derivatives(place), {}, {}, {}, {}, {}, 0.0};
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * at.slopes;
  const Eigen::Vector3d along = tangents.col(0), up = tangents.col(1);
  at.x = facet.x * at.N;
  at.across = along.cross(up);
  at.J = at.x.dot(at.across);
  at.g1 = at.across / at.J, at.g2 = up.cross(at.x) / at.J, at.g3 = at.x.cross(along) / at.J;
  return at;
}

/// L(g).
Eigen::Matrix<double, 6, 3> strain_operator(const Eigen::Vector3d& g) {
  Eigen::Matrix<double, 6, 3> L = Eigen::Matrix<double, 6, 3>::Zero();
  for (int k = 0; k < 3; ++k) {
    L(k, k) = g[k];
    L(3 + k, k) = g[(k + 1) % 3];
    L(3 + k, (k + 1) % 3) = g[k];
  }
  return L;
}

using StrainOnFacet = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 24>;

struct StrainsOnFacet {
  StrainOnFacet B1, B2;
};
StrainsOnFacet strains_on_facet(const FacetPoint& at) {
  const Eigen::Matrix<double, 6, 3> L1 = strain_operator(at.g1), L2 = strain_operator(at.g2),
                                    L3 = strain_operator(at.g3);
  const Eigen::Index n = at.N.size();
  StrainsOnFacet of{StrainOnFacet(6, in_space.count(n)), StrainOnFacet(6, in_space.count(n))};
  for (Eigen::Index i = 0; i < n; ++i) {
    of.B1.middleCols<3>(in_space.of(i)) = at.N[i] * L1;
    of.B2.middleCols<3>(in_space.of(i)) = at.slopes(i, 0) * L2 + at.slopes(i, 1) * L3;
  }
  return of;
}

/// A plane facet with straight edges whose functions are polynomials of the coordinates: a triangle or parallelogram.
bool is_affine_facet(const BoundaryFacet& facet) {
  constexpr double rounding = 1e-12;
  const geometry::FacetBasis& basis = *facet.basis;
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * basis.derivatives(basis.middle());
  const Eigen::Vector3d middle = facet.x * basis.values(basis.middle());
  const Matrix places = basis.places().colwise() - basis.middle(), straight = (tangents * places).colwise() + middle;
  return (facet.x - straight).cwiseAbs().maxCoeff() <= rounding * tangents.cwiseAbs().maxCoeff();
}

const geometry::FacetRule& rule_of_facet(const BoundaryFacet& facet) {
  return is_affine_facet(facet) ? facet.basis->finer_rule() : facet.basis->finest_rule();
}

std::vector<Eigen::Index> dofs_of_nodes(const NodesOfFacet& nodes) {
  std::vector<Eigen::Index> dofs;
  for (const Eigen::Index node : nodes)
    for (int k = 0; k < 3; ++k) dofs.push_back(in_space.of(node, k));
  return dofs;
}

/// The six rigid motions about a point, 3n x 6.
Matrix rigid_motions_about(const Matrix& nodes, const Eigen::Vector3d& centre) {
  Matrix R = Matrix::Zero(in_space.count(nodes.cols()), 6);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    R.block<3, 3>(in_space.of(i), 0).setIdentity();
    for (int k = 0; k < 3; ++k)
      R.block<3, 1>(in_space.of(i), 3 + k) = Eigen::Vector3d::Unit(k).cross(Eigen::Vector3d(nodes.col(i) - centre));
  }
  return R;
}

/// Rounding leaves forces under rigid motions, which are taken out of K: each degree of freedom by its own stiffness.
void impose_rigid_motions(const Matrix& R, Matrix& K) {
  const Matrix DR = K.diagonal().asDiagonal() * R;
  const Matrix W = DR * (R.transpose() * DR).inverse(), KR = K * R;
  K += W * (R.transpose() * KR) * W.transpose() - W * KR.transpose() - KR * W.transpose();
  K = Matrix(0.5 * (K + K.transpose()));
}

/// With the translations apart: u = E v + R a, a the displacement of the first node.
Block block_in_space(const Matrix& S, const Matrix& E0) {
  const auto n = static_cast<int>(S.rows());
  Block block;
  block.T.resize(n, n);
  block.T.setIdentity();
  for (int i = 0; i < n; ++i) (i < 3 ? block.J : block.I).push_back(i);
  block.R = Matrix::Identity(3, 3).replicate(n / 3, 1);
  block.E0 = E0;
  block.A = S(block.J, block.I);
  block.S = S(block.I, block.I) - block.R(block.I, Eigen::all) * block.A;
  return block;
}

/// S as of boundary displacements.
Vector slope_in_space(const SuperElementSolution& solution, const Vector& u) {
  const Block& block = solution.blocks.front();
  const Vector v = block.v_of(u);
  return block.join(block.S * v, block.A * v);
}

/// h of eq. (2), and the load that has it in the plane.
SolidCellLoads load_in_space(const SuperElementSolution& solution, double power, const Vector& g, const Vector& c) {
  const Vector h = equivalent_load(solution, {{power + 1.0, g, c}});
  return {{{power, g - h, c}}, h};
}

}  // namespace

SolidCoefficients solid_coefficients(const Matrix& nodes, const Mat6& D) {
  const Eigen::Index n = in_space.count(nodes.cols());
  SolidCoefficients E{Matrix::Zero(n, n), Matrix::Zero(n, n), Matrix::Zero(n, n)};
  for (const BoundaryFacet& facet : solid_boundary(nodes).facets) {
    const geometry::FacetRule& rule = rule_of_facet(facet);
    const Eigen::Index m = in_space.count(facet.x.cols());
    Matrix e0 = Matrix::Zero(m, m), e1 = e0, e2 = e0;
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const FacetPoint at = facet_point(facet, rule.places.col(i));
      if (!(at.J > 0.0)) throw IllPosed("part of the boundary is not seen from the centre");
      const auto [B1, B2] = strains_on_facet(at);
      const StrainOnFacet DB1 = rule.weights[i] * at.J * D * B1, DB2 = rule.weights[i] * at.J * D * B2;
      e0.noalias() += B1.transpose() * DB1;
      e1.noalias() += B2.transpose() * DB1;
      e2.noalias() += B2.transpose() * DB2;
    }
    const std::vector<Eigen::Index> dofs = dofs_of_nodes(facet.nodes);
    E.E0(dofs, dofs) += e0;
    E.E1(dofs, dofs) += e1;
    E.E2(dofs, dofs) += e2;
  }
  return E;
}

double least_visibility(const Matrix& nodes) {
  double least = std::numeric_limits<double>::infinity();
  for (const BoundaryFacet& facet : solid_boundary(nodes).facets) {
    const auto look = [&](const Vec2& place) {
      const FacetPoint at = facet_point(facet, place);
      const double seen = at.J / (at.x.norm() * at.across.norm());
      least = seen < least || std::isnan(seen) ? seen : least;
    };
    for (const Vec2& place : facet.basis->finest_rule().places.colwise()) look(place);
    for (const Vec2& place : facet.basis->places().colwise()) look(place);
  }
  return least;
}

SolidSuperElement::SolidSuperElement(const Matrix& nodes, const Mat6& D) {
  const auto [E0, E1, E2] = solid_coefficients(nodes, D);
  const Matrix E1_hat = E1 - 0.5 * E0, E2_hat = E2 - 0.5 * (E1 + E1.transpose()) + 0.25 * E0;
  RingStiffness ring = ring_doubling(E0, E1_hat, E2_hat);
  constexpr double most_wrong = 1e-8;
  if (!(ring.residual < most_wrong)) throw IllPosed("its exponents are too far apart");
  impose_rigid_motions(rigid_motions_about(nodes, solid_boundary(nodes).centre), ring.K);
  solution_.K = std::move(ring.K);
  solution_.doublings = ring.doublings;
  solution_.residual = ring.residual;
  ring.S.diagonal().array() -= 0.5;
  solution_.blocks.push_back(block_in_space(ring.S, E0));
}

const ModalSolution& SolidSuperElement::modes() const {
  std::call_once(modes_flag_, [&] { modes_ = std::make_unique<const ModalSolution>(modal_solution(solution_)); });
  return *modes_;
}

void SolidCellLoads::add(const SolidCellLoads& others) {
  if (others.h.size() == 0) return;
  h = h.size() > 0 ? Vector(h + others.h) : others.h;
  inside.insert(inside.end(), others.inside.begin(), others.inside.end());
}

SolidCellLoads loads_of_volume_force(const Matrix& nodes, const SolidSuperElement& cell,
                                     const Eigen::Vector3d& per_volume) {
  Vector F = Vector::Zero(in_space.count(nodes.cols()));
  for (const BoundaryFacet& facet : solid_boundary(nodes).facets) {
    const geometry::FacetRule& rule = rule_of_facet(facet);
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const FacetPoint at = facet_point(facet, rule.places.col(i));
      for (std::size_t k = 0; k < facet.nodes.size(); ++k)
        F.segment<3>(in_space.of(facet.nodes[k])) +=
            (rule.weights[i] * at.J * at.N[static_cast<Eigen::Index>(k)]) * per_volume;
    }
  }
  return load_in_space(cell.solution(), 2.0, F, {});
}

SolidCellLoads loads_of_stress(const Matrix& nodes, const SolidSuperElement& cell, const Vec6& stress,
                               const Vector& T) {
  const SolidBoundary boundary = solid_boundary(nodes);
  const double T_centre = T.head(static_cast<Eigen::Index>(boundary.corners)).mean();
  const Eigen::Index n = in_space.count(nodes.cols());
  Matrix c = Matrix::Zero(n, 2), g = c;  // of the temperature of the centre, and of what the boundary has above it
  for (const BoundaryFacet& facet : boundary.facets) {
    const geometry::FacetRule& rule = rule_of_facet(facet);
    const Vector T_facet = T(facet.nodes);
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const FacetPoint at = facet_point(facet, rule.places.col(i));
      const double weight = rule.weights[i] * at.J;
      const Eigen::RowVector2d temperatures(T_centre, T_facet.dot(at.N) - T_centre);
      const auto [B1, B2] = strains_on_facet(at);
      const std::vector<Eigen::Index> dofs = dofs_of_nodes(facet.nodes);
      c(dofs, Eigen::all) += weight * (B1.transpose() * stress) * temperatures;
      g(dofs, Eigen::all) += weight * (B2.transpose() * stress) * temperatures;
    }
  }
  SolidCellLoads loads;
  for (Eigen::Index k = 0; k < 2; ++k)
    loads.add(load_in_space(cell.solution(), 1.0 + static_cast<double>(k), g.col(k), c.col(k)));
  return loads;
}

Vector super_element_volume_weights(const Matrix& nodes) {
  const SolidBoundary boundary = solid_boundary(nodes);
  Vector weights = Vector::Zero(nodes.cols());
  double at_centre = 0.0;
  for (const BoundaryFacet& facet : boundary.facets) {
    const geometry::FacetRule& rule = rule_of_facet(facet);
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const FacetPoint at = facet_point(facet, rule.places.col(i));
      weights(facet.nodes) += 0.25 * rule.weights[i] * at.J * at.N;  // int xi^3, int xi^2 (1 - xi)
      at_centre += rule.weights[i] * at.J / 12.0;
    }
  }
  weights.head(static_cast<Eigen::Index>(boundary.corners)).array() +=
      at_centre / static_cast<double>(boundary.corners);
  return weights;
}

double super_element_integral_of_square(const Matrix& nodes, const Vector& T) {
  const SolidBoundary boundary = solid_boundary(nodes);
  const double T_centre = T.head(static_cast<Eigen::Index>(boundary.corners)).mean();
  double sum = 0.0;
  for (const BoundaryFacet& facet : boundary.facets) {
    const geometry::FacetRule& rule = rule_of_facet(facet);
    const Vector T_facet = T(facet.nodes);
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const FacetPoint at = facet_point(facet, rule.places.col(i));
      const double above = T_facet.dot(at.N) - T_centre;
      sum += rule.weights[i] * at.J * (T_centre * T_centre / 3.0 + T_centre * above / 2.0 + above * above / 5.0);
    }
  }
  return sum;
}

double work_inside(const SolidSuperElement& cell, const SolidCellLoads& loads) {
  // xi u,xi = xi^j w of every load, whose strain energies are those of the rings_of_interior.
  double work = 0.0;
  const Matrix& E0 = cell.solution().blocks.front().E0;
  const Eigen::LLT<Matrix> factor(E0);
  std::vector<Vector> beyond;
  for (const RadialLoad& load : loads.inside) {
    const Vector h = equivalent_load(cell.solution(), {load});
    beyond.push_back(load.c.size() > 0 ? Vector(load.c - h) : Vector(-h));
  }
  for (std::size_t i = 0; i < beyond.size(); ++i)
    for (std::size_t j = 0; j < beyond.size(); ++j)
      work += beyond[i].dot(factor.solve(beyond[j])) / (loads.inside[i].power + loads.inside[j].power + 1.0);
  return work;
}

std::optional<PyramidPlace> place_in_super_element(const Matrix& nodes, const Eigen::Vector3d& point, double allowed) {
  const SolidBoundary boundary = solid_boundary(nodes);
  const Eigen::Vector3d from_centre = point - boundary.centre;
  constexpr int steps = 30;
  constexpr double exact = 1e-12, far = 3.0, near_centre = 1e-9;
  std::optional<PyramidPlace> best;
  double deepest = -allowed;
  for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
    const BoundaryFacet& facet = boundary.facets[f];
    Vec2 place = facet.basis->middle();
    double xi = 1.0;
    bool found = from_centre.norm() < near_centre * facet.x.norm();
    if (found) xi = 0.0;
    for (int step = 0; step < steps && !found; ++step) {  // xi x_b = point - centre, by Newton's method
      const FacetPoint at = facet_point(facet, place);
      Eigen::Matrix3d by;
      by << xi * (facet.x * at.slopes), at.x;
      const Eigen::Vector3d change = by.partialPivLu().solve(from_centre - xi * at.x);
      place += change.head<2>();
      xi += change.z();
      if (!(place.lpNorm<Eigen::Infinity>() < far) || !(xi > 0.0)) break;
      found = change.lpNorm<Eigen::Infinity>() < exact;
    }
    if (!found) continue;
    const double inside = std::min(facet.basis->inside(place), 1.0 - xi);
    if (inside < deepest || (best && inside == deepest)) continue;
    deepest = inside;
    best = PyramidPlace{static_cast<int>(f), {xi * place.x(), xi * place.y(), xi}};
  }
  return best;
}

namespace {

/// Of a place, in the coordinates of its facet.
struct OnFacet {
  BoundaryFacet facet;
  Vec2 place;
  double xi;
};
OnFacet on_facet(const Matrix& nodes, const PyramidPlace& place) {
  SolidBoundary boundary = solid_boundary(nodes);
  OnFacet on{std::move(boundary.facets[static_cast<std::size_t>(place.facet)]), {}, std::max(place.xi(), 0.0)};
  on.place = on.xi > 0.0 ? Vec2(place.at.head<2>() / on.xi) : on.facet.basis->middle();
  return on;
}

constexpr int rings_of_interior = 12;

/// The square roots of the values of xi, from 0 to 1.
double root_of_ring(int k) { return 0.5 * (1.0 - std::cos(std::numbers::pi * k / (rings_of_interior - 1))); }

/// Of the values at the rings_of_interior, so that their sum is that at xi (barycentric interpolation).
Vector weights_of_rings(double xi) {
  const double root = std::sqrt(xi);
  Vector weights(rings_of_interior);
  for (int k = 0; k < rings_of_interior; ++k) {
    const double apart = root - root_of_ring(k);
    if (apart == 0.0) return Vector::Unit(rings_of_interior, k);
    weights[k] = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k + 1 == rings_of_interior ? 0.5 : 1.0) / apart;
  }
  return weights / weights.sum();
}

}  // namespace

double value_in_super_element(const Matrix& nodes, const Vector& values, const PyramidPlace& place) {
  const OnFacet on = on_facet(nodes, place);
  const auto corners = static_cast<Eigen::Index>(CellTopology::of(static_cast<std::size_t>(nodes.cols())).corners);
  const Vector of_facet = values(on.facet.nodes);
  return on.xi * of_facet.dot(on.facet.basis->values(on.place)) + (1.0 - on.xi) * values.head(corners).mean();
}

SolidInterior::SolidInterior(const Matrix& nodes, const SolidSuperElement& cell, const Vector& u,
                             const SolidCellLoads& loads)
    : nodes_(nodes),
      u_(u.size(), rings_of_interior),
      u_xi_(u.size(), rings_of_interior),
      u_part_(u.size(), rings_of_interior) {
  const RadialField field(cell.solution(), cell.modes(), u, loads.inside);
  for (int k = 0; k < rings_of_interior; ++k) {
    const RadialField::Values values = field.at(root_of_ring(k) * root_of_ring(k));
    u_.col(k) = values.u;
    u_xi_.col(k) = values.u_xi;
    u_part_.col(k) = values.u_part;
  }
}

Eigen::Vector3d SolidInterior::displacement_at(const PyramidPlace& place) const {
  const OnFacet on = on_facet(nodes_, place);
  const Vector u = u_ * weights_of_rings(on.xi), N = on.facet.basis->values(on.place);
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < on.facet.nodes.size(); ++k)
    at += N[static_cast<Eigen::Index>(k)] * u.segment<3>(in_space.of(on.facet.nodes[k]));
  return at;
}

Vec6 SolidInterior::strain_at(const PyramidPlace& place) const {
  const OnFacet on = on_facet(nodes_, place);
  const Vector weights = weights_of_rings(on.xi);
  const auto [B1, B2] = strains_on_facet(facet_point(on.facet, on.place));
  const std::vector<Eigen::Index> dofs = dofs_of_nodes(on.facet.nodes);
  return B1 * (u_xi_(dofs, Eigen::all) * weights) + B2 * (u_part_(dofs, Eigen::all) * weights);
}

Matrix strains_at_nodes(const Matrix& nodes, const SolidSuperElement& cell, const Vector& u,
                        const SolidCellLoads& loads) {
  const SuperElementSolution& solution = cell.solution();
  Vector slope = slope_in_space(solution, u);
  if (!loads.inside.empty()) {
    Vector beyond = -loads.h;
    for (const RadialLoad& load : loads.inside)
      if (load.c.size() > 0) beyond += load.c;
    slope += solution.blocks.front().E0.llt().solve(beyond);
  }
  Matrix sum = Matrix::Zero(6, nodes.cols());
  Vector count = Vector::Zero(nodes.cols());
  for (const BoundaryFacet& facet : solid_boundary(nodes).facets) {
    const std::vector<Eigen::Index> dofs = dofs_of_nodes(facet.nodes);
    const Vector u_facet = u(dofs), slope_facet = slope(dofs);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k) {
      const auto [B1, B2] =
          strains_on_facet(facet_point(facet, facet.basis->places().col(static_cast<Eigen::Index>(k))));
      sum.col(facet.nodes[k]) += B1 * slope_facet + B2 * u_facet;
      count[facet.nodes[k]] += 1.0;
    }
  }
  return sum * count.cwiseInverse().asDiagonal();
}

}  // namespace scabo::element
