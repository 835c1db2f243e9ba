#include "scabo/element/plane/stress_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/ordered_schur.hpp"

namespace scabo::element {

namespace {

using std::numbers::pi;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Angles from the first face at which the material changes.
std::vector<double> interfaces(const Corner& corner) {
  std::vector<double> angles;
  double angle = 0.0;
  for (std::size_t e = 0; e + 1 < corner.ring.elements.size(); ++e) {
    const auto& nodes = corner.ring.elements[e].nodes;
    const Vec2 &from = corner.ring.node(nodes.front()), &to = corner.ring.node(nodes.back());
    angle += std::atan2(cross(from, to), from.dot(to));
    if ((corner.D.of(e) - corner.D.of(e + 1)).norm() > 1e-12 * corner.D.of(e).norm()) angles.push_back(angle);
  }
  return angles;
}

CornerKind kind_of(const Corner& corner, const std::vector<double>& interfaces) {
  if (!is_crack(corner.ring)) return CornerKind::corner;
  if (interfaces.empty()) return CornerKind::crack;
  return interfaces.size() == 1 && std::abs(interfaces.front() - pi) < 1e-9 ? CornerKind::interface_crack
                                                                            : CornerKind::corner;
}

/// Distance of the boundary along a ray.
double boundary_distance(const Ring& ring, double angle) {
  const Vec2& face = ring.node(ring.first_node());
  const double absolute = std::atan2(face.y(), face.x()) + angle;
  const Vec2 along(std::cos(absolute), std::sin(absolute));
  // The first and the last ray of a crack coincide: start from a point well inside.
  const auto at = locate(ring, 1e-3 * face.norm() * along);
  ensure(at.has_value(), "a ray misses the boundary");
  return boundary_position(ring, at->element, at->eta).norm();
}

void add(Triplets& entries, const mesh::LineElement& element, const Matrix& local) {
  for (Eigen::Index i = 0; i < local.rows(); ++i)
    for (Eigen::Index j = 0; j < local.cols(); ++j)
      entries.emplace_back(place_of(element.nodes[static_cast<std::size_t>(i / 2)], static_cast<int>(i % 2)),
                           place_of(element.nodes[static_cast<std::size_t>(j / 2)], static_cast<int>(j % 2)),
                           local(i, j));
}

}  // namespace

CoefficientMatrices coefficient_derivatives(const Corner& corner, const Vec2& direction) {
  const Ring& ring = corner.ring;
  Triplets entries0, entries1, entries2;
  // Relative to the centre, the boundary moves by -direction: B1 |J| is constant, B2 |J| and |J| change.
  Eigen::Matrix<double, 3, 2> b2;
  b2 << direction.y(), 0.0, 0.0, -direction.x(), -direction.x(), direction.y();
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
    const Eigen::Index m = places_of(basis.nodes());
    Matrix e0 = Matrix::Zero(m, m), e1 = e0, e2 = e0;
    for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
      const auto row = static_cast<Eigen::Index>(q);
      const Vector N = basis.values_at_rule().row(row), N_eta = basis.derivatives_at_rule().row(row);
      const StrainMatrices strain = strain_matrices(ring, element, N, N_eta);
      Vec2 x_eta = Vec2::Zero();
      Eigen::Matrix<double, 3, Eigen::Dynamic> dB2(3, m);  // at constant |J|
      for (Eigen::Index i = 0; i < N.size(); ++i) {
        x_eta += N_eta[i] * ring.node(element.nodes[static_cast<std::size_t>(i)]);
        dB2.middleCols<2>(place_of(i)) = N_eta[i] / strain.J * b2;
      }
      const double dJ = cross(-direction, x_eta), weight = basis.rule().weights[q];
      const Mat3 law = weight * corner.D.of(e);
      const Matrix DB1 = law * strain.B1, DB2 = law * strain.B2;
      e0 -= dJ * strain.B1.transpose() * DB1;
      e1 += strain.J * dB2.transpose() * DB1 - dJ * strain.B2.transpose() * DB1;
      e2 += strain.J * (dB2.transpose() * DB2 + DB2.transpose() * dB2) - dJ * strain.B2.transpose() * DB2;
    }
    add(entries0, element, e0);
    add(entries1, element, e1);
    add(entries2, element, e2);
  }
  const auto n = places_of(ring.nodes.size());
  CoefficientMatrices derivatives{Eigen::SparseMatrix<double>(n, n), Eigen::SparseMatrix<double>(n, n),
                                  Eigen::SparseMatrix<double>(n, n)};
  derivatives.E0.setFromTriplets(entries0.begin(), entries0.end());
  derivatives.E1.setFromTriplets(entries1.begin(), entries1.end());
  derivatives.E2.setFromTriplets(entries2.begin(), entries2.end());
  return derivatives;
}

CornerAnalysis::CornerAnalysis(const Ring& ring, const Elasticity& D, const SuperElementSolution& solution,
                               std::optional<double> reference_length)
    : ring_(ring), D_(D), solution_(solution), modes_(singular_modes(solution)) {
  ensure(ring.is_open(), "stress intensity factors need an open super-element");
  ensure(D.fits(ring), "one plane law, or one for each boundary element");
  const Corner corner{ring_, D_};
  const std::vector<double> changes = interfaces(corner);
  kind_ = kind_of(corner, changes);
  mouth_ = ring_.node(ring_.first_node()).norm();
  if (kind_ != CornerKind::corner) {
    ray_ = pi;
    length_ = reference_length.value_or(mouth_);
    prepare_crack();
    prepare_energy();
    return;
  }
  ray_ = is_crack(ring_) ? pi : changes.size() == 1 ? changes.front() : 0.5 * opening_angle(ring_);
  length_ = reference_length.value_or(boundary_distance(ring_, ray_));
  for (const ModeGroup& group : modes_.singular) tractions_.push_back(ray_traction(corner, group, ray_));
}

void CornerAnalysis::prepare_crack() {
  const Corner corner{ring_, D_};
  const Vec2 x1 = -ring_.node(ring_.first_node()) / mouth_;
  frame_ << x1.x(), x1.y(), -x1.y(), x1.x();
  const double angle = std::atan2(x1.y(), x1.x());
  const Mat3 right = rotated_elasticity(corner.D.of(0), angle),
             left = rotated_elasticity(corner.D.of(ring_.elements.size() - 1), angle);
  bimaterial_ = cracked_bimaterial(left, right);
  softness_left_ = left.inverse()(0, 0);
  softness_right_ = right.inverse()(0, 0);
}

void CornerAnalysis::prepare_energy() {
  const SuperElementSolution& solution = solution_;
  const CoefficientMatrices dE = coefficient_derivatives({ring_, D_}, frame_.row(0).transpose());
  const ModalSolution modal = modal_solution(solution);
  const Eigen::Index n = solution.K.rows();
  Eigen::Index count = 0;
  for (const ModalBlock& block : modal.blocks) count += block.modes.T().rows();
  Matrix Phi(n, count), T = Matrix::Zero(count, count), Q = Matrix::Zero(count, n);  // c = Q u
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < modal.blocks.size(); ++k) {
    const Block& block = solution.blocks[k];
    const auto& modes = modal.blocks[k].modes;
    const Eigen::Index m = modes.T().rows();
    Phi.middleCols(at, m) = block.T * modal.blocks[k].Phi;
    T.block(at, at, m, m) = modes.T();
    Q.middleRows(at, m) = (block.T * block.from_v(modes.U())).transpose();
    at += m;
  }
  const Matrix slope = linalg::multiply(Phi, T), mixed = linalg::multiply_transposed(Phi, Matrix(dE.E1 * slope));
  const Matrix P = linalg::multiply_transposed(slope, Matrix(dE.E0 * slope)) + mixed + mixed.transpose() +
                   linalg::multiply_transposed(Phi, Matrix(dE.E2 * Phi));  // eq. (3)
  energy_ = linalg::multiply_transposed(Q, linalg::multiply(linalg::solve_lyapunov(T, P), Q));
}

std::vector<CornerAnalysis::Forced> CornerAnalysis::forced(const std::vector<RadialLoad>& loads) const {
  std::vector<Forced> all;
  for (const RadialLoad& load : loads) {
    Vector remaining = -equivalent_load(solution_, {load});
    if (load.c.size() > 0) remaining += load.c;
    Vector f = Vector::Zero(remaining.size());
    for (const Block& block : solution_.blocks)
      f += block.T * Vector(block.E0.llt().solve(Vector(block.T.transpose() * remaining)));
    all.push_back({load.power, std::move(f)});
  }
  return all;
}

Vector CornerAnalysis::coordinates(const ModeGroup& group, const Vector& u, const std::vector<Forced>& loads) const {
  Vector c = group.Q * u;
  const Matrix identity = Matrix::Identity(group.size(), group.size());
  for (const Forced& load : loads)
    c -= (load.power * identity - group.T).partialPivLu().solve(Vector(group.Q * load.f));  // eq. (5)
  return c;
}

StressIntensity CornerAnalysis::of(const Vector& u, const std::vector<RadialLoad>& loads) const {
  const std::vector<Forced> inside = forced(loads);
  StressIntensity result;
  result.kind = kind_;
  result.reference_length = length_;
  result.ray = ray_;
  for (const ModeGroup& group : modes_.singular)
    result.exponents.insert(result.exponents.end(), group.exponents.begin(), group.exponents.end());
  if (kind_ == CornerKind::corner) {
    for (std::size_t k = 0; k < modes_.singular.size(); ++k) {
      const ModeGroup& group = modes_.singular[k];
      CornerTerm term{group.exponents,
                      generalised_factors(tractions_[k], group, coordinates(group, u, inside), length_), std::nullopt,
                      group.defective()};
      if (group.size() == 1) term.limit = term.factors * std::pow(length_, 0.5 - group.exponents.front().real());
      result.K_I += term.factors[0];
      result.K_II += term.factors[1];
      result.terms.push_back(std::move(term));
    }
    return result;
  }
  const auto along = [&](const Vector& field, int at) { return Vec2(frame_ * field.segment<2>(place_of(at))); };
  Vector singular = Vector::Zero(u.size());
  for (const ModeGroup& group : modes_.singular) singular += group.Phi * coordinates(group, u, inside);
  const Vec2 opening = along(singular, ring_.last_node()) - along(singular, ring_.first_node());
  const Vec2 k = bimaterial_.intensity(opening, mouth_, length_);  // eq. (1)
  result.K_I = k[1];
  result.K_II = k[0];
  result.epsilon = bimaterial_.epsilon;
  result.G = bimaterial_.energy_release_rate(k);
  if (inside.empty()) result.J = -0.5 * u.dot(energy_ * u);
  if (std::any_of(inside.begin(), inside.end(), [](const Forced& load) { return std::abs(load.power - 1.0) < 1e-9; }))
    return result;
  const Vector linear = modes_.linear.Phi * coordinates(modes_.linear, u, inside);
  const double strain = -0.5 * (along(linear, ring_.last_node())[0] + along(linear, ring_.first_node())[0]) / mouth_;
  result.T_left = strain / softness_left_;  // eq. (2)
  result.T_right = strain / softness_right_;
  return result;
}

}  // namespace scabo::element
