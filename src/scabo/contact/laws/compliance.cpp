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
  if (problem_.G.cols() == 0) return diagonal_[k];
  const auto [at, is_new] = known_.try_emplace(k, 0.0);
  if (is_new) at->second = std::max(in_balance(k), 0.0);
  return at->second;
}

double Compliance::in_balance(Eigen::Index k) {
  const RigidMap::Sparse& G = problem_.G.sparse();
  Vector v = Vector::Unit(G.rows(), k), a = Vector::Zero(G.cols());  // v = e_k - G a
  Vector resultants = G.transpose() * v;
  if (resultants.isZero(0.0)) return diagonal_[k];
  if (!rigid_) factorise();
  for (int round = 0; round < 3; ++round) {
    a += rigid_->solve(Matrix(resultants.cwiseQuotient(length_))).col(0).cwiseQuotient(length_);
    v = Vector::Unit(G.rows(), k) - G * a;
    resultants = G.transpose() * v;
  }
  if (problem_.W.is_sparse()) return v.dot(problem_.W.times(v));
  if (of_motions_.size() == 0) {  // few bodies: a product for each motion, not for each pair
    of_motions_ = problem_.W.times(Matrix(G));
    between_motions_ = G.transpose() * of_motions_;
  }
  return diagonal_[k] - 2.0 * of_motions_.row(k).dot(a) + a.dot(between_motions_ * a);
}

void Compliance::factorise() {
  const RigidMap::Sparse& G = problem_.G.sparse();
  Eigen::SparseMatrix<double> B = G.transpose() * G;
  length_ = Vector(B.diagonal()).cwiseSqrt().cwiseMax(1e-300);
  const Vector inverse = length_.cwiseInverse();
  B = inverse.asDiagonal() * B * inverse.asDiagonal();
  Eigen::SparseMatrix<double> identity(B.rows(), B.cols());
  identity.setIdentity();
  B += softness * identity;
  rigid_ = std::make_unique<linalg::SymmetricPositiveSolver>(B);
}

}  // namespace scabo::contact
