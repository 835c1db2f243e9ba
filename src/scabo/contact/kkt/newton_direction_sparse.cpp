// Directions where W is sparse: of many bodies.
#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"

namespace scabo::contact {

void NewtonDirection::lay_out_sparse(double regularisation) {
  const Problem& problem = equations_.problem();
  const Eigen::SparseMatrix<double>& W = problem.W.sparse();
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols(), n = size + m;
  const int d = problem.dimension;
  Workspace& work = *work_;
  if (m > 0 && work.G.rows() != problem.G.rows()) work.G = problem.G.sparse();
  if (static_cast<Eigen::Index>(work.sum.size()) < n) work.sum.assign(static_cast<std::size_t>(n), 0.0);
  const auto add = [&](Eigen::Index row, double value) {
    double& sum = work.sum[static_cast<std::size_t>(row)];
    if (sum == 0.0) work.touched.push_back(static_cast<int>(row));
    sum += value == 0.0 ? 1e-300 : value;  // stays in the pattern
  };
  // Adds `value` of motion component `component` (a row of W or G) to the rows of the unknowns that it enters.
  const auto add_motion = [&](Eigen::Index component, double value) {
    const auto pair = static_cast<std::size_t>(component / d);
    for (int row = first_of_pair_[pair]; row < first_of_pair_[pair + 1]; ++row) {
      const Unknown& to = unknowns_[static_cast<std::size_t>(row)];
      if (to.row[component % d] != 0.0) add(row, to.scale * to.row[component % d] * value);
    }
  };
  Eigen::SparseMatrix<double>& A = work.sparse;
  A.resize(n, n);
  A.reserve(3 * W.nonZeros() / 2 + n + 3 * problem.G.sparse().nonZeros());
  const auto finish_column = [&](Eigen::Index column) {
    std::sort(work.touched.begin(), work.touched.end());
    work.touched.erase(std::unique(work.touched.begin(), work.touched.end()), work.touched.end());
    A.startVec(column);
    for (int row : work.touched) {
      A.insertBack(row, column) = work.sum[static_cast<std::size_t>(row)];
      work.sum[static_cast<std::size_t>(row)] = 0.0;
    }
    work.touched.clear();
  };
  work.touched.clear();
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& from = unknowns_[static_cast<std::size_t>(j)];
    add(j, regularisation * (1.0 - from.own) + from.own);
    for (int k = 0; k < d; ++k) {
      if (from.column[k] == 0.0) continue;
      const Eigen::Index force = d * static_cast<Eigen::Index>(from.pair) + k;
      for (Eigen::SparseMatrix<double>::InnerIterator it(W, force); it; ++it)
        add_motion(it.row(), it.value() * from.column[k]);
      if (m > 0)
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(work.G, force); it; ++it)
          add(size + it.col(), it.value() * from.column[k]);
    }
    finish_column(j);
  }
  for (Eigen::Index g = 0; g < m; ++g) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem.G.sparse(), g); it; ++it)
      add_motion(it.row(), it.value());
    if (regularisation > 0.0) add(size + g, -regularisation);
    finish_column(size + g);
  }
  A.finalize();
}

bool NewtonDirection::factorise_sparse(const Eigen::SparseMatrix<double>& A) {
  if (equations_.problem().G.cols() == 0) return work_->sparse_solver.factorise(A);
  return work_->sparse_solver.factorise(A, [&] {
    if (!work_->joint_order) work_->joint_order.emplace(equations_.problem());
    std::vector<int> pair_of;
    pair_of.reserve(unknowns_.size());
    for (const Unknown& unknown : unknowns_) pair_of.push_back(unknown.pair);
    return work_->joint_order->blocks(pair_of);
  });
}

bool NewtonDirection::solve_sparse(double regularisation) {
  lay_out_sparse(regularisation);
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  Workspace& work = *work_;
  const Eigen::SparseMatrix<double>& A = work.sparse;
  const Vector right = right_.head(A.rows());
  const double largest = right.lpNorm<Eigen::Infinity>() + 1e-300;
  if (!work.redundant && factorise_sparse(A) && work.sparse_solver.reciprocal_condition() > 1e-13) {
    work.sparse_solver.solve(right, y_);
    work.residual = right - A * y_;
    work.sparse_solver.solve(work.residual, work.image);
    y_ += work.image;  // one step of refinement: the certificate is judged at 1e-10
    work.residual = right - A * y_;
    if (y_.allFinite() && work.residual.lpNorm<Eigen::Infinity>() <= Workspace::exact * largest) return true;
  }
  work.redundant = true;
  work.raised = A;
  for (Eigen::Index j = 0; j < size; ++j)
    work.raised.coeffRef(j, j) += Workspace::raise * (1.0 - unknowns_[static_cast<std::size_t>(j)].own);
  if (!factorise_sparse(work.raised) || !(work.sparse_solver.reciprocal_condition() > 1e-16)) return false;
  const auto multiply = [&](const Vector& x, Vector& result) { result.noalias() = A * x; };
  const auto precondition = [&](const Vector& x, Vector& result) { work.sparse_solver.solve(x, result); };
  y_.setZero(A.rows());
  const double left = gmres(multiply, precondition, right, y_, Workspace::singular_gmres);
  return y_.allFinite() && left <= Workspace::descending;
}

/// Rigid bodies with many pairs a joint. Pairs are redundant there: the raised matrix preconditions GMRES.
template <int d>
bool NewtonDirection::solve_by_joints(double regularisation) {
  const Problem& problem = equations_.problem();
  Workspace& work = *work_;
  auto& joints = [&]() -> auto& {
    if constexpr (d == 2)
      return work.joints_in_plane;
    else
      return work.joints_in_space;
  }
  ();
  if (!work.joints_sought) {
    work.joints_sought = true;
    if (auto found = find_joints<d>(problem)) joints.emplace(std::move(*found));
  }
  if (!joints) return false;
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  joints->pair.resize(unknowns_.size());
  joints->L.resize(size, JointSystem<d>::R);
  joints->C.resize(size, JointSystem<d>::R);
  joints->D.resize(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    joints->pair[static_cast<std::size_t>(j)] = unknown.pair;
    const auto& A = joints->A(unknown.pair);
    joints->L.row(j) = unknown.scale * (unknown.row.head<d>().transpose() * A);
    joints->C.row(j) = unknown.column.head<d>().transpose() * A;
    joints->D[j] = std::max(regularisation, Workspace::raise) * (1.0 - unknown.own) + unknown.own;
  }
  if (!joints->factorise()) return false;
  for (Eigen::Index j = 0; j < size; ++j) {
    const double own = unknowns_[static_cast<std::size_t>(j)].own;
    joints->D[j] = regularisation * (1.0 - own) + own;
  }
  const auto multiply = [&](const Vector& x, Vector& result) { joints->apply(x, result); };
  const auto precondition = [&](const Vector& x, Vector& result) { joints->solve(x, result); };
  const Vector right = right_.head(size);
  y_.setZero(size);
  const double left = gmres(multiply, precondition, right, y_, Workspace::singular_gmres);
  return y_.allFinite() && left <= Workspace::descending;
}

template bool NewtonDirection::solve_by_joints<2>(double regularisation);
template bool NewtonDirection::solve_by_joints<3>(double regularisation);

}  // namespace scabo::contact
