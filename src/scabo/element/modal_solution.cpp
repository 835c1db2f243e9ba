#include "scabo/element/modal_solution.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// h of one block, eq. (4), in its coordinates: with u = E v + R a the transposed problem is triangular by blocks.
Vector equivalent_load(const Block& block, const Vector& F) {
  const Vector h_a = 0.5 * block.R.transpose() * F;
  const Matrix shifted = block.S.transpose() + 2.0 * Matrix::Identity(block.S.rows(), block.S.cols());
  const Vector h_v = shifted.partialPivLu().solve(Vector(F(block.I)) - block.A.transpose() * h_a);
  Vector h(F.size());
  h(block.I) = h_v;
  h(block.J) = h_a - Matrix(block.R(block.I, Eigen::all)).transpose() * h_v;
  return h;
}

}  // namespace

ModalSolution modal_solution(const SuperElementSolution& solution, int threads) {
  ModalSolution modal;
  modal.blocks.resize(solution.blocks.size());
  const auto solve = [&](int k) {
    const Block& block = solution.blocks[static_cast<std::size_t>(k)];
    ModalBlock& modal_block = modal.blocks[static_cast<std::size_t>(k)];
    modal_block.modes = linalg::SchurExponential(block.S);
    const auto& modes = modal_block.modes;
    // A U T^-1 by the LU factors of T': they fill no more than T itself.
    const Matrix moving = modes.T().transpose().partialPivLu().solve((block.A * modes.U()).transpose()).transpose();
    modal_block.Phi = block.R * moving;                                                         // eq. (2)
    modal_block.Phi(block.I, Eigen::all) += modes.U();
  };
  linalg::parallel_for(static_cast<int>(solution.blocks.size()), threads, solve);
  for (std::size_t k = 0; k < solution.blocks.size(); ++k) {
    const auto& eigenvalues = modal.blocks[k].modes.eigenvalues();
    modal.exponents.insert(modal.exponents.end(), eigenvalues.begin(), eigenvalues.end());
    modal.exponents.insert(modal.exponents.end(), solution.blocks[k].J.size(), 0.0);
  }
  std::sort(modal.exponents.begin(), modal.exponents.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  return modal;
}

Vector equivalent_body_load(const SuperElementSolution& solution, const Vector& F_b) {
  Vector h = Vector::Zero(F_b.size());
  for (const Block& block : solution.blocks) h += block.T * equivalent_load(block, block.T.transpose() * F_b);
  return h;
}

RadialField::RadialField(const SuperElementSolution& solution, const ModalSolution& modal, const Vector& u,
                         const Vector& F_b)
    : solution_(solution), modal_(modal) {
  for (std::size_t k = 0; k < solution.blocks.size(); ++k) {
    const Block& block = solution.blocks[k];
    const ModalBlock& modal_block = modal.blocks[k];
    const Vector u_k = block.T.transpose() * u;
    const Vector a = u_k(block.J);
    const Matrix R_I = block.R(block.I, Eigen::all);
    Part part;
    part.c = modal_block.modes.U().transpose() * (Vector(u_k(block.I)) - R_I * a);
    part.w = Vector::Zero(part.c.size());
    part.b = Vector::Zero(a.size());
    const Matrix a_of_psi = Matrix(modal_block.Phi(block.J, Eigen::all));  // A U T^-1, since R_J = 1
    if (F_b.size() > 0) {
      const Vector h = equivalent_load(block, block.T.transpose() * F_b);
      const Vector w = block.E0.llt().solve(h);
      const Vector w_a = w(block.J);
      part.w = modal_block.modes.U().transpose() * (Vector(w(block.I)) - R_I * w_a);
      part.b = 0.5 * (a_of_psi * part.w - w_a);
    }
    part.a0 = a - a_of_psi * part.c - part.b;
    parts_.push_back(std::move(part));
  }
}

RadialField::Values RadialField::at(double xi) const {
  xi = std::clamp(xi, 0.0, 1.0);
  const double s = std::log(std::max(xi, 1e-9));  // nearer to the centre psi / xi does not change any more
  const Eigen::Index n = solution_.K.rows();
  Values values{Vector::Zero(n), Vector::Zero(n), Vector::Zero(n)};
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    const Block& block = solution_.blocks[k];
    const auto& modes = modal_.blocks[k].modes;
    // psi / xi: strains near the centre are quotients of small numbers otherwise. No exponent is below 1.
    const Vector psi = modes.propagate(part.c, part.w, s, 1.0);
    const Vector slope = modes.T() * psi - xi * part.w;
    const Vector moving = modal_.blocks[k].Phi * psi;
    values.u += block.T * (xi * moving + block.R * (part.a0 + xi * xi * part.b));               // eq. (2)
    values.u_part += block.T * moving;
    values.u_xi += block.T * (modal_.blocks[k].Phi * slope + 2.0 * xi * block.R * part.b);       // eq. (3)
  }
  return values;
}

}  // namespace scabo::element
