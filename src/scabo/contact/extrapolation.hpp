// Anderson's extrapolation of a fixed-point iteration x -> S(x) (J. ACM 12 (1965) 547; type II): with the last changes
// of S and of f = S(x) - x
//
//     x+ = S(x) - sum_j gamma_j dS_j,   gamma = argmin | f - sum_j gamma_j df_j |
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::contact {

class Extrapolation {
 public:
  /// `depth`: changes remembered.
  explicit Extrapolation(std::size_t depth) : depth_(depth) {}
  void remember(const Vector& f, const Vector& S);
  void forget() { f_.clear(), S_.clear(); }
  /// `x` = S(x) becomes x+; false where fewer than `least` changes are known.
  bool apply(Vector& x, std::size_t least = 1) const;

 private:
  std::size_t depth_;
  std::vector<Vector> f_, S_;
};

}  // namespace scabo::contact
