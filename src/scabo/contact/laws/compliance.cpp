#include "scabo/contact/laws/compliance.hpp"

#include <algorithm>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

namespace {

constexpr double softness = 1e-11;  // of the columns of G, which depend on each other where a pair is a body's only one

}  // namespace

Compliance::Compliance(const Problem& problem) : problem_(problem), diagonal_(problem.W.diagonal()) {}

Compliance::~Compliance() = default;

double Compliance::of(Eigen::Index k) {
  const RigidMap::Sparse& G = problem_.G.sparse();
  if (G.cols() == 0) return diagonal_[k];
  const auto [at, is_new] = known_.try_emplace(k, diagonal_[k]);
  if (!is_new) return at->second;
  Vector v = Vector::Unit(G.rows(), k);
  Vector resultants = G.transpose() * v;
  if (resultants.isZero(0.0)) return at->second;
  if (!rigid_) {
    Eigen::SparseMatrix<double> B = G.transpose() * G;
    length_ = Vector(B.diagonal()).cwiseSqrt().cwiseMax(1e-300);
    const Vector inverse = length_.cwiseInverse();
    B = inverse.asDiagonal() * B * inverse.asDiagonal();
    Eigen::SparseMatrix<double> identity(B.rows(), B.cols());
    identity.setIdentity();
    B += softness * identity;
    rigid_ = std::make_unique<linalg::SymmetricPositiveSolver>(B);
  }
  for (int round = 0; round < 3; ++round) {
    const Vector y = rigid_->solve(Matrix(resultants.cwiseQuotient(length_))).col(0);
    v -= G * y.cwiseQuotient(length_);
    resultants = G.transpose() * v;
  }
  return at->second = std::max(v.dot(problem_.W.times(v)), 0.0);
}

}  // namespace scabo::contact
