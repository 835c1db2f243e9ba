// Shape functions N(eta) of a boundary element on -1 <= eta <= 1: Lagrange polynomials of order p through the
// Gauss-Lobatto-Legendre points, and the Gauss rule by which they are integrated.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::element {

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
  /// N(eta), p + 1 values in the order of the nodes.
  Vector values(double eta) const;
  /// N,eta(eta).
  Vector derivatives(double eta) const;

  /// Rule used for coefficient matrices and loads: two points more than the p that linear displacement fields need,
  /// because elements may be curved.
  const GaussRule& rule() const { return rule_; }
  const Matrix& values_at_rule() const { return N_; }           ///< rule points x nodes
  const Matrix& derivatives_at_rule() const { return N_eta_; }  ///< rule points x nodes

  /// The basis of order p, which is computed once and kept.
  static const LineBasis& of_order(int order);

 private:
  int order_;
  std::vector<double> points_;
  std::vector<double> barycentric_;
  GaussRule rule_;
  Matrix N_, N_eta_;
};

}  // namespace scabo::element
