#include "scabo/system/joined_bodies.hpp"

#include <algorithm>
#include <map>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::system {

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

constexpr double eps_of_softness = 1e-4;

}  // namespace

TouchedPart touched_part(const Eigen::SparseMatrix<double>& motion) {
  TouchedPart touched;
  for (Eigen::Index column = 0; column < motion.cols(); ++column) {
    bool any = false;
    for (Eigen::SparseMatrix<double>::InnerIterator it(motion, column); it; ++it) {
      touched.rows.push_back(static_cast<int>(it.row()));
      any = true;
    }
    if (any) touched.dofs.push_back(static_cast<int>(column));
  }
  std::sort(touched.rows.begin(), touched.rows.end());
  touched.rows.erase(std::unique(touched.rows.begin(), touched.rows.end()), touched.rows.end());
  Entries entries;
  for (std::size_t k = 0; k < touched.dofs.size(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(motion, touched.dofs[k]); it; ++it) {
      const auto row = std::lower_bound(touched.rows.begin(), touched.rows.end(), it.row()) - touched.rows.begin();
      entries.emplace_back(static_cast<int>(row), static_cast<int>(k), it.value());
    }
  touched.motion.resize(static_cast<Eigen::Index>(touched.rows.size()), static_cast<Eigen::Index>(touched.dofs.size()));
  touched.motion.setFromTriplets(entries.begin(), entries.end());
  return touched;
}

PairProducts::PairProducts(const Structure& structure, const std::vector<Eigen::SparseMatrix<double>>& motion,
                           Vector softness)
    : size_(motion.empty() ? 0 : motion.front().rows()), softness_(std::move(softness)) {
  if (softness_.size() == 0) softness_ = Vector::Zero(size_);
  for (std::size_t p = 0; p < motion.size(); ++p) parts_.push_back({structure.parts[p].get(), touched_part(motion[p])});
}

Vector PairProducts::times(const Vector& p) const {
  Vector sum = softness_.cwiseProduct(p);
  for (const Part& part : parts_) {
    const TouchedPart& touched = part.touched;
    if (touched.rows.empty() || !part.body->is_flexible()) continue;
    const Vector of_part = p(touched.rows), forces = touched.motion.transpose() * of_part;
    const Vector motion = touched.motion * part.body->flexed(touched.dofs, forces);
    sum(touched.rows) += motion;
  }
  return sum;
}

Matrix PairProducts::diagonal_blocks_of(std::size_t p) const {
  constexpr int d = 2;
  constexpr std::size_t at_a_time = 128;  // rows
  const auto& [body, touched] = parts_[p];
  Matrix blocks = Matrix::Zero(d, size_);
  if (!body->is_flexible()) return blocks;
  for (std::size_t first = 0; first < touched.rows.size();) {
    std::size_t last = std::min(first + at_a_time, touched.rows.size());
    while (last < touched.rows.size() && touched.rows[last] / d == touched.rows[last - 1] / d) ++last;
    std::map<Eigen::Index, Eigen::Index> place;
    std::vector<int> dofs;
    for (std::size_t row = first; row < last; ++row)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(touched.motion,
                                                                          static_cast<Eigen::Index>(row));
           it; ++it)
        if (place.emplace(it.col(), static_cast<Eigen::Index>(dofs.size())).second)
          dofs.push_back(touched.dofs[static_cast<std::size_t>(it.col())]);
    const Matrix A = body->flexibility_by_factor(dofs);
    Matrix C = Matrix::Zero(static_cast<Eigen::Index>(last - first), A.rows());
    for (std::size_t row = first; row < last; ++row)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(touched.motion,
                                                                          static_cast<Eigen::Index>(row));
           it; ++it)
        C(static_cast<Eigen::Index>(row - first), place[it.col()]) = it.value();
    const Matrix W = C * A * C.transpose();
    for (std::size_t row = first; row < last; ++row)
      for (std::size_t column = first; column < last; ++column)
        if (touched.rows[row] / d == touched.rows[column] / d)
          blocks(touched.rows[row] % d, touched.rows[column]) =
              W(static_cast<Eigen::Index>(row - first), static_cast<Eigen::Index>(column - first));
    first = last;
  }
  return blocks;
}

Matrix PairProducts::diagonal_blocks() const {
  Matrix sum = Matrix::Zero(2, size_);
  for (std::size_t p = 0; p < parts_.size(); ++p) sum += diagonal_blocks_of(p);
  for (Eigen::Index row = 0; row < size_; ++row) sum(plane_components.component_of(row), row) += softness_[row];
  return sum;
}

std::shared_ptr<const JoinedBodies> JoinedBodies::of(const Structure& structure,
                                                     std::vector<Eigen::SparseMatrix<double>> motion, Vector softness) {
  for (const auto& part : structure.parts)
    if (part->is_divided()) return nullptr;
  return std::make_shared<const JoinedBodies>(structure, std::move(motion), std::move(softness));
}

JoinedBodies::JoinedBodies(const Structure& structure, std::vector<Eigen::SparseMatrix<double>> motion, Vector softness)
    : motion_(std::move(motion)), of_springs_(std::move(softness)) {
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    parts_.push_back({structure.parts[p].get(), structure.dofs.nodes(p)});
    operations_ += 2.0 * parts_.back().body->operations();
  }
}

Matrix JoinedBodies::flexibility(const std::vector<int>& rows) const {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Matrix W = Matrix::Zero(n, n);
  std::vector<int> place(motion_.empty() ? 0 : static_cast<std::size_t>(motion_.front().rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[static_cast<std::size_t>(rows[k])] = static_cast<int>(k);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!parts_[p].body->is_flexible()) continue;
    std::vector<int> dofs;
    Entries entries;
    for (Eigen::Index column = 0; column < motion_[p].cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(motion_[p], column); it; ++it) {
        const int row = place[static_cast<std::size_t>(it.row())];
        if (row < 0) continue;
        if (dofs.empty() || dofs.back() != column) dofs.push_back(static_cast<int>(column));
        entries.emplace_back(row, static_cast<int>(dofs.size()) - 1, it.value());
      }
    Eigen::SparseMatrix<double> C(n, static_cast<Eigen::Index>(dofs.size()));
    C.setFromTriplets(entries.begin(), entries.end());
    const Matrix half = C * parts_[p].body->flexibility_by_factor(dofs);
    W += half * C.transpose();
  }
  if (of_springs_.size() > 0) W.diagonal() += Vector(of_springs_(rows));
  return 0.5 * (W + W.transpose());
}

void JoinedBodies::make() const {
  Matrices& made = matrices_;
  std::vector<FreeStiffness> free;
  Eigen::Index size = 0, entries = 0;
  for (const Part& part : parts_) {
    free.push_back(part.body->free_stiffness());
    size += free.back().K.cols();
    entries += free.back().K.nonZeros();
  }
  made.K.resize(size, size);
  made.K.reserve(entries);
  Entries of_C;
  Eigen::Index first = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const FreeStiffness& of_part = free[p];
    for (Eigen::Index j = 0; j < of_part.K.cols(); ++j) {
      made.K.startVec(first + j);
      for (linalg::SparseMatrix::InnerIterator it(of_part.K, j); it; ++it)
        made.K.insertBack(first + it.row(), first + j) = it.value();
    }
    const Eigen::SparseMatrix<double> C = motion_[p] * of_part.map;
    for (Eigen::Index j = 0; j < C.cols(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(C, j); it; ++it)
        if (it.value() != 0.0) of_C.emplace_back(static_cast<int>(it.row()), static_cast<int>(first + j), it.value());
    if (const auto m = static_cast<Eigen::Index>(of_part.further.size()); m > 0) {
      Floating floating{made.rigid_motions, {}, Eigen::PartialPivLU<Matrix>(of_part.motions)};
      for (const int dof : of_part.further) floating.further.push_back(static_cast<int>(first) + dof);
      made.floating.push_back(std::move(floating));
      made.rigid_motions += m;
    }
    for (const int dof : of_part.dofs)
      made.positions.push_back(parts_[p].nodes.empty()
                                   ? parts_[p].body->reference()
                                   : parts_[p].nodes[static_cast<std::size_t>(plane_components.node_of(dof))]);
    first += of_part.K.cols();
    free[p] = {};
  }
  made.K.finalize();
  const Eigen::Index rows = motion_.empty() ? 0 : motion_.front().rows();
  made.C.resize(rows, size);
  made.C.setFromTriplets(of_C.begin(), of_C.end());
  const Vector diagonal = made.K.diagonal();
  made.softness = Vector::Zero(rows);
  for (Eigen::Index row = 0; row < rows; ++row)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(made.C, row); it; ++it)
      if (diagonal[it.col()] > 0.0) made.softness[row] += it.value() * it.value() / diagonal[it.col()];
  const double mean = rows > 0 ? made.softness.mean() : 0.0;
  for (double& softness : made.softness)
    if (softness == 0.0) softness = mean;
  made.softness *= eps_of_softness;
  if (of_springs_.size() > 0) made.softness += of_springs_;
}

/// Factor of the joined bodies.
class JoinedPairs final : public contact::HeldPairs {
 public:
  JoinedPairs(const JoinedBodies::Matrices& bodies, const std::vector<int>& rows) : bodies_(bodies) {
    Entries entries;
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(bodies.C, rows[k]); it; ++it)
        entries.emplace_back(static_cast<int>(k), static_cast<int>(it.col()), it.value());
    C_.resize(static_cast<Eigen::Index>(rows.size()), bodies.K.cols());
    C_.setFromTriplets(entries.begin(), entries.end());
    hold_ = Vector(bodies.softness(rows)).cwiseInverse();
    const linalg::SparseMatrix held = hold_.asDiagonal() * C_, transposed = C_.transpose();
    const linalg::SparseMatrix springs = transposed * held;
    linalg::SparseMatrix joined = bodies.K + springs;
    joined.makeCompressed();
    linalg::SparseOptions options;
    options.positions = bodies.positions;
    solver_ = linalg::SymmetricPositiveSolver(joined, options);
  }

  void solve(const Vector& u, const Vector& z, Vector& p, Vector& a) const override {
    Vector right = C_.transpose() * hold_.cwiseProduct(u);
    for (const JoinedBodies::Floating& floating : bodies_.floating) {
      const Vector resultant = z.segment(floating.first, floating.map.rows());
      const Vector r = floating.map.transpose().solve(resultant);
      for (std::size_t k = 0; k < floating.further.size(); ++k)
        right[floating.further[k]] -= r[static_cast<Eigen::Index>(k)];
    }
    const Vector v = solver_.solve(right).col(0);
    p = hold_.cwiseProduct(u - C_ * v);
    a.resize(bodies_.rigid_motions);
    for (const JoinedBodies::Floating& floating : bodies_.floating) {
      const Vector further = v(floating.further);
      a.segment(floating.first, floating.map.rows()) = floating.map.solve(further);
    }
  }

 private:
  const JoinedBodies::Matrices& bodies_;
  linalg::SparseMatrix C_;  // of the held directions
  Vector hold_;             // 1 / eps
  linalg::SymmetricPositiveSolver solver_;
};

std::unique_ptr<contact::HeldPairs> JoinedBodies::hold(const std::vector<int>& rows) const {
  std::call_once(made_, [this] { make(); });
  if (matrices_.softness.size() == 0 || !(matrices_.softness.minCoeff() > 0.0)) return nullptr;  // nothing is elastic
  try {
    return std::make_unique<JoinedPairs>(matrices_, rows);
  } catch (const linalg::NotPositiveDefinite&) {
    return nullptr;
  }
}

}  // namespace scabo::system
