#include "scabo/contact/kkt/gmres.hpp"

#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <vector>

namespace scabo::contact {

double gmres(const std::function<void(const Vector&, Vector&)>& multiply,
             const std::function<void(const Vector&, Vector&)>& precondition, const Vector& b, Vector& x,
             const GmresOptions& options) {
  const double size = b.norm();
  if (size == 0.0) {
    x.setZero();
    return 0.0;
  }
  const int most = options.restart;
  Matrix basis(b.size(), most + 1), hessenberg(most + 1, most);
  std::vector<Eigen::JacobiRotation<double>> rotations(static_cast<std::size_t>(most));
  Vector product, preconditioned, residual, g(most + 1);
  int products = 0;
  while (true) {
    multiply(x, product);
    residual = b - product;
    const double norm = residual.norm();
    if (!std::isfinite(norm)) return HUGE_VAL;
    if (norm <= options.tolerance * size || products >= options.iterations) return norm / size;
    basis.col(0) = residual / norm;
    g.setZero();
    g[0] = norm;
    int k = 0;
    while (k < most && products < options.iterations && std::abs(g[k]) > options.tolerance * size) {
      precondition(basis.col(k), preconditioned);
      multiply(preconditioned, product);
      ++products;
      for (int pass = 0; pass < 2; ++pass) {  // repeated Gram-Schmidt orthogonalisation
        const Vector part = basis.leftCols(k + 1).transpose() * product;
        product.noalias() -= basis.leftCols(k + 1) * part;
        if (pass == 0)
          hessenberg.col(k).head(k + 1) = part;
        else
          hessenberg.col(k).head(k + 1) += part;
      }
      const double next = product.norm(), image = std::hypot(next, hessenberg.col(k).head(k + 1).norm());
      hessenberg(k + 1, k) = next;
      for (int j = 0; j < k; ++j)
        hessenberg.col(k).applyOnTheLeft(j, j + 1, rotations[static_cast<std::size_t>(j)].adjoint());
      double length = 0.0;
      auto& rotation = rotations[static_cast<std::size_t>(k)];
      rotation.makeGivens(hessenberg(k, k), hessenberg(k + 1, k), &length);
      hessenberg(k, k) = length;
      hessenberg(k + 1, k) = 0.0;
      g.applyOnTheLeft(k, k + 1, rotation.adjoint());
      ++k;
      if (next <= 1e-14 * image) break;  // of directions without length: b may be in any units
      basis.col(k) = product / next;
    }
    const Vector y = hessenberg.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g.head(k));
    precondition(basis.leftCols(k) * y, preconditioned);
    x += preconditioned;
  }
}

}  // namespace scabo::contact
