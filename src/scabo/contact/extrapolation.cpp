#include "scabo/contact/extrapolation.hpp"

#include "scabo/linalg/decompositions.hpp"

namespace scabo::contact {

void Extrapolation::remember(const Vector& f, const Vector& S) {
  f_.push_back(f);
  S_.push_back(S);
  if (f_.size() <= depth_ + 1) return;
  f_.erase(f_.begin());
  S_.erase(S_.begin());
}

bool Extrapolation::apply(Vector& x, std::size_t least) const {
  if (f_.size() < least + 1) return false;
  const auto changes = static_cast<Eigen::Index>(f_.size()) - 1;
  Matrix of_f(x.size(), changes), of_S(x.size(), changes);
  for (std::size_t k = 1; k < f_.size(); ++k) {
    of_f.col(static_cast<Eigen::Index>(k) - 1) = f_[k] - f_[k - 1];
    of_S.col(static_cast<Eigen::Index>(k) - 1) = S_[k] - S_[k - 1];
  }
  const Vector gamma = of_f.colPivHouseholderQr().solve(f_.back());
  if (!gamma.allFinite()) return false;
  x -= of_S * gamma;
  return true;
}

}  // namespace scabo::contact
