// What a structure of elastic bodies offers a solver besides the entries of W: products with W, and solutions of
// problems whose pairs are held. Implemented by system/joined_bodies.
#pragma once

#include <memory>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::contact {

/// W by its products; never formed.
class PairOperator {
 public:
  virtual ~PairOperator() = default;
  virtual Eigen::Index size() const = 0;            ///< dN
  virtual Vector times(const Vector& p) const = 0;  ///< W p, dN
  virtual Matrix diagonal_blocks() const = 0;       ///< d x dN: the diagonal block of pair i in columns d i ...
};

/// Bodies with some pairs held along some directions, h: to working precision the solution of
///
///     W_hh p + G_h a = u     G_h'p = z                                             (W_hh + eps for W_hh, see
///     PairHolder)
class HeldPairs {
 public:
  virtual ~HeldPairs() = default;
  /// `u`: one for each held direction; `z`: m.
  virtual void solve(const Vector& u, const Vector& z, Vector& p, Vector& a) const = 0;
};

/// Holds pairs: of an elastic structure that is one factorisation of the bodies joined there, which costs about as much
/// as that of the single bodies, however many pairs there are. It is a preconditioner: eps is small beside the
/// flexibility of an element.
class PairHolder {
 public:
  virtual ~PairHolder() = default;
  /// `rows`: of W, those of the held directions. Null where a body is not held.
  virtual std::unique_ptr<HeldPairs> hold(const std::vector<int>& rows) const = 0;
  /// Floating point operations of one factorisation, roughly.
  virtual double operations() const = 0;
  /// Block of W of some rows and the same columns; 0 x 0 where it is not known.
  virtual Matrix flexibility(const std::vector<int>& /*rows*/) const { return {}; }
};

}  // namespace scabo::contact
