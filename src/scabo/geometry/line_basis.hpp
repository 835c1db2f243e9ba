// Shape functions N(eta) of a boundary element on -1 <= eta <= 1: Lagrange polynomials of order p through the
// Gauss-Lobatto-Legendre points, and the rules by which they are integrated.
//
// The points eta_0 = -1 < ... < eta_p = 1 are the ends and the zeros of P_p', the derivative of Legendre's polynomial.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::geometry {

/// Gauss-Lobatto-Legendre points of order p on [-1, 1], p + 1 of them, ascending, exactly symmetric.
std::vector<double> lobatto_points(int order);

struct GaussRule {
  std::vector<double> points;   ///< on [-1, 1], ascending
  std::vector<double> weights;  ///< sum 2
};

/// Gauss-Legendre rule with `count` points, exact for polynomials of degree 2 count - 1.
GaussRule gauss_rule(int count);

class LineBasis {
 public:
  explicit LineBasis(int order);

  int order() const { return order_; }
  int nodes() const { return order_ + 1; }
  const std::vector<double>& points() const { return points_; }
  /// Weights of the quadrature at the nodes, exact for polynomials of degree 2 p - 1; sum 2.
  const std::vector<double>& weights() const { return weights_; }
  /// N(eta), p + 1 values in the order of the nodes.
  Vector values(double eta) const;
  /// N,eta(eta).
  Vector derivatives(double eta) const;
  /// N at several points: at.size() x nodes.
  Matrix values_at(const std::vector<double>& at) const;
  /// N,eta at the nodes: row i holds the derivatives at node i.
  const Matrix& derivatives_at_nodes() const { return at_nodes_; }

  /// Rule used for coefficient matrices and loads: two points more than the p that linear displacement fields need,
  /// because elements may be curved.
  const GaussRule& rule() const { return rule_; }
  const Matrix& values_at_rule() const { return N_; }           ///< rule points x nodes
  const Matrix& derivatives_at_rule() const { return N_eta_; }  ///< rule points x nodes

  /// The basis of order p, which is computed once and kept.
  static const LineBasis& of_order(int order);

 private:
  int order_;
  std::vector<double> points_, weights_;
  std::vector<double> barycentric_;
  GaussRule rule_;
  Matrix N_, N_eta_, at_nodes_;
};

}  // namespace scabo::geometry
