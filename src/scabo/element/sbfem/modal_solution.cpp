#include "scabo/element/sbfem/modal_solution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/base/error.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// h of one load in one block, eq. (4), in its coordinates: with u = E v + R a the transposed problem is triangular by
/// blocks.
Vector equivalent_load(const Block& block, const RadialLoad& load) {
  const auto of_block = [&](const Vector& F) { return Vector(block.T.transpose() * F); };
  const Vector g = of_block(load.g);
  const Vector h_a = block.on_a(g) / load.power;
  Vector right = block.on_v(g) - block.A.transpose() * h_a;
  if (load.c.size() > 0) {
    const Vector c = of_block(load.c);
    right += block.S.transpose() * block.on_v(c) + block.A.transpose() * block.on_a(c);
  }
  const Matrix shifted = block.S.transpose() + load.power * Matrix::Identity(block.S.rows(), block.S.cols());
  const Vector h_v = shifted.partialPivLu().solve(right);
  Vector h = block.from_v(h_v);
  h(block.J) += h_a;
  return h;
}

/// A B, by BLAS where that pays.
Matrix times_columns(const Matrix& A, const Matrix& B) { return B.cols() < 8 ? Matrix(A * B) : linalg::multiply(A, B); }

/// See ModalSolution::slowest.
double slowest_of(const ModalSolution& modal) {
  double slowest = 1.0;
  for (const ModalBlock& block : modal.blocks)
    for (const std::complex<double>& value : block.modes.eigenvalues())
      if (std::abs(value.real()) < 1.0 - 1e-9)  // rotation: 1 except for rounding
        slowest = std::min(slowest, std::abs(value.real()) - std::abs(value.imag()));
  return std::max(slowest, 0.0);
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
    // A U T^-1 by the LU factors of T', which have no more fill-in than T itself.
    const Matrix moving = modes.T().transpose().partialPivLu().solve((block.A * modes.U()).transpose()).transpose();
    modal_block.Phi = block.join(modes.U(), moving);  // eq. (2)
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
  modal.slowest = slowest_of(modal);
  return modal;
}

Vector equivalent_load(const SuperElementSolution& solution, const std::vector<RadialLoad>& loads) {
  Vector h = Vector::Zero(solution.K.rows());
  for (const RadialLoad& load : loads) {
    ensure(!solution.domain.unbounded && load.power > 0.0, "loads act inside bounded super-elements");
    for (const Block& block : solution.blocks) h += block.T * equivalent_load(block, load);
  }
  return h;
}

double work_inside(const SuperElementSolution& solution, const std::vector<RadialLoad>& one,
                   const std::vector<RadialLoad>& other) {
  double work = 0.0;
  for (const Block& block : solution.blocks) {
    const auto beyond = [&](const std::vector<RadialLoad>& loads) {  // h - c, a column for each load
      Matrix columns(block.E0.rows(), static_cast<Eigen::Index>(loads.size()));
      for (std::size_t k = 0; k < loads.size(); ++k) {
        Vector h = equivalent_load(block, loads[k]);
        if (loads[k].c.size() > 0) h -= block.T.transpose() * loads[k].c;
        columns.col(static_cast<Eigen::Index>(k)) = h;
      }
      return columns;
    };
    const Matrix of_one = beyond(one),
                 products = of_one.transpose() * block.E0.llt().solve(&one == &other ? of_one : beyond(other));
    for (Eigen::Index i = 0; i < products.rows(); ++i)
      for (Eigen::Index j = 0; j < products.cols(); ++j)
        work += products(i, j) / (one[static_cast<std::size_t>(i)].power + other[static_cast<std::size_t>(j)].power);
  }
  return work;
}

void RadialField::set_loads(const Block& block, const ModalBlock& modes, const std::vector<RadialLoad>& loads,
                            Part& part) const {
  if (loads.empty()) return;
  const Matrix a_of_psi = block.a_of(modes.Phi);
  const Eigen::LLT<Matrix> E0(block.E0);
  for (const RadialLoad& load : loads) {
    Vector remaining = -equivalent_load(block, load);
    if (load.c.size() > 0) remaining += block.T.transpose() * load.c;
    const Vector w = E0.solve(remaining);
    linalg::Forcing forcing{load.power, modes.modes.U().transpose() * block.v_of(w)};
    Translation translation{load.power, (block.a_of(w) - a_of_psi * forcing.w) / load.power};
    part.a0 -= translation.b;
    part.w.push_back(std::move(forcing));
    part.translations.push_back(std::move(translation));
  }
}

RadialField::RadialField(const SuperElementSolution& solution, const ModalSolution& modal, const Vector& u,
                         const std::vector<RadialLoad>& loads, const InternalMotion& inside)
    : solution_(solution), inside_(inside.modes), slowest_(modal.slowest) {
  for (const RadialLoad& load : loads) slowest_ = std::min(slowest_, load.power);
  ensure(loads.empty() || !solution.domain.unbounded, "loads act inside bounded super-elements");
  for (std::size_t k = 0; k < solution.blocks.size(); ++k) {
    const Block& block = solution.blocks[k];
    const ModalBlock& modal_block = modal.blocks[k];
    const Vector u_k = block.T.transpose() * u;
    const Vector a = block.a_of(u_k);
    Vector v = block.v_of(u_k);
    Part part{&block.T, &block.R, &modal_block, {}, {}, {}, {}, {}, {}};
    const Matrix a_of_psi = block.a_of(modal_block.Phi);  // A U T^-1, since R_J = 1
    if (solution.domain.unbounded && a.size() > 0) {
      // F from f = K u: plane/stiffness.hpp, R'q = F.
      const Vector F = -block.on_a(block.T.transpose() * (solution.K * u));
      part.constant = block.V * F;
      part.growth = block.C * F;
      v -= part.constant;
    }
    part.c = modal_block.modes.U().transpose() * v;
    part.a0 = a - a_of_psi * part.c;
    set_loads(block, modal_block, loads, part);
    parts_.push_back(std::move(part));
  }
  if (!inside_) return;
  for (const InternalModes::Group& group : inside_->groups) {
    const Vector w = group.T.transpose() * inside.w;
    parts_.push_back({&group.T, &group.R, &group.modal, group.start * w, {}, group.still * w, {}, {}, {}});
  }
}

/// Where strains there are infinite.
RadialField::Values RadialField::centre() const {
  const Eigen::Index n = solution_.K.rows();
  Values values{Vector::Zero(n), Vector::Constant(n, std::nan("")), Vector::Constant(n, std::nan(""))};
  for (const Part& part : parts_) values.u += *part.T * (*part.R * part.a0);
  return values;
}

void RadialField::add(std::size_t block, const Vector& moving, const Vector& slope, double xi, double s, double shift,
                      Values& values) const {
  const Part& part = parts_[block];
  const double scale = std::pow(xi, shift), strain_scale = std::pow(xi, shift - 1.0);
  Vector a = part.a0, a_xi = Vector::Zero(part.a0.size());
  for (const Translation& translation : part.translations) {
    a += std::pow(xi, translation.power) * translation.b;
    a_xi += translation.power * std::pow(xi, translation.power - 1.0) * translation.b;
  }
  if (part.growth.size() > 0) {
    a += part.growth * s;
    a_xi += part.growth / xi;
  }
  Vector u = scale * moving + *part.R * a, u_part = strain_scale * moving;
  if (part.constant.size() > 0) {
    const std::vector<int>& I = solution_.blocks[block].I;
    u(I) += part.constant;
    u_part(I) += part.constant / xi;
  }
  values.u += *part.T * u;  // eq. (2)
  values.u_part += *part.T * u_part;
  values.u_xi += *part.T * (strain_scale * slope + *part.R * a_xi);  // eq. (3)
}

RadialField::Values RadialField::at(double xi) const { return std::move(at(std::vector{xi}).front()); }

std::vector<RadialField::Values> RadialField::at(const std::vector<double>& xis) const {
  const linalg::OneBlasThread one_thread;
  const bool unbounded = solution_.domain.unbounded, finite = slowest_ == 1.0;
  // psi / xi^shift, because strains near the centre would otherwise be quotients of small numbers. Nothing decays more
  // slowly; constant terms no longer change below 1e-9.
  const double shift = unbounded ? -slowest_ : slowest_;
  const auto clamped = [&](double xi) { return unbounded ? std::max(xi, 1.0) : std::clamp(xi, 0.0, 1.0); };
  std::vector<double> s;
  for (const double at : xis) {
    const double xi = clamped(at);
    s.push_back(finite ? std::log(std::max(xi, 1e-9)) : xi > 0.0 ? std::log(xi) : 0.0);
  }
  const linalg::Times times(s);
  const Vector zero = Vector::Zero(solution_.K.rows());
  std::vector<Values> values(xis.size(), Values{zero, zero, zero});
  for (std::size_t block = 0; block < parts_.size(); ++block) {
    const Part& part = parts_[block];
    const Matrix psi = part.modal->modes.propagate(part.c, part.w, times, shift);
    Matrix psi_xi = times_columns(part.modal->modes.T(), psi);  // times xi
    for (const linalg::Forcing& forcing : part.w)
      for (Eigen::Index i = 0; i < psi_xi.cols(); ++i)
        psi_xi.col(i) += std::pow(clamped(xis[static_cast<std::size_t>(i)]), forcing.power - shift) * forcing.w;
    const Matrix moving = times_columns(part.modal->Phi, psi), slope = times_columns(part.modal->Phi, psi_xi);
    for (std::size_t i = 0; i < xis.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      add(block, moving.col(column), slope.col(column), clamped(xis[i]), s[i], shift, values[i]);
    }
  }
  for (std::size_t i = 0; i < xis.size(); ++i)
    if (clamped(xis[i]) == 0.0 && !finite) values[i] = centre();
  return values;
}

}  // namespace scabo::element
