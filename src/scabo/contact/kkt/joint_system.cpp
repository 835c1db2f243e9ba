#include "scabo/contact/kkt/joint_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scabo::contact {

using Index = Eigen::Index;

template <int d>
JointSystem<d>::JointSystem(Joints<d> joints) : joints_(std::move(joints)) {
  const int J = joints_.count();
  Vector size(R * J);
  for (int e = 0; e < J; ++e)
    for (int at = joints_.first[static_cast<std::size_t>(e)]; at < joints_.first[static_cast<std::size_t>(e) + 1]; ++at)
      if (joints_.neighbour[static_cast<std::size_t>(at)] == e)
        size.segment<R>(R * e) = joints_.K[static_cast<std::size_t>(at)].diagonal().cwiseAbs().cwiseSqrt();
  for (double& s : size)
    if (!(s > 0.0)) s = 1.0;  // beyond the rank of the joint
  for (int e = 0; e < J; ++e)
    for (int at = joints_.first[static_cast<std::size_t>(e)]; at < joints_.first[static_cast<std::size_t>(e) + 1];
         ++at) {
      auto& K = joints_.K[static_cast<std::size_t>(at)];
      K.array().colwise() /= size.segment<R>(R * joints_.neighbour[static_cast<std::size_t>(at)]).array();
      K.array().rowwise() /= size.segment<R>(R * e).transpose().array();
    }
  for (std::size_t i = 0; i < joints_.A.size(); ++i)
    joints_.A[i].array().rowwise() *= size.segment<R>(R * joints_.joint[i]).transpose().array();
}

template <int d>
Vector JointSystem<d>::spread(const Vector& s) const {
  Vector result = Vector::Zero(s.size());
  for (int e = 0; e < joints_.count(); ++e)
    for (int at = joints_.first[static_cast<std::size_t>(e)]; at < joints_.first[static_cast<std::size_t>(e) + 1]; ++at)
      result.segment<R>(R * joints_.neighbour[static_cast<std::size_t>(at)]).noalias() +=
          joints_.K[static_cast<std::size_t>(at)] * s.segment<R>(R * e);
  return result;
}

template <int d>
bool JointSystem<d>::factorise(const SaddleRows& rows, const Vector& D) {
  using Block = typename Joints<d>::Block;
  const int J = joints_.count();
  std::vector<Block> F(static_cast<std::size_t>(J), Block::Identity()), M(static_cast<std::size_t>(J), Block::Zero());
  eliminated_.resize(rows.pair.size());
  for (std::size_t j = 0; j < rows.pair.size(); ++j) {
    const auto row = static_cast<Index>(j);
    const auto pair = static_cast<std::size_t>(rows.pair[j]);
    const auto& A = joints_.A[pair];
    Eliminated& one = eliminated_[j];
    one.joint = joints_.joint[pair];
    Block &F_e = F[static_cast<std::size_t>(one.joint)], &M_e = M[static_cast<std::size_t>(one.joint)];
    one.scale = 1.0 / std::max(1.0, D[row]);
    one.c.noalias() = A.transpose() * rows.C.col(row).template head<d>();
    one.u.noalias() = -F_e * one.c;
    const double own = one.scale * D[row], size = std::sqrt(one.u.squaredNorm() + own * own);
    if (!(size > 0.0)) return false;
    one.alpha = -size;
    one.u_own = own + size;
    one.tau = 1.0 / (size * one.u_own);
    const Eigen::Matrix<double, 1, R> l = one.scale * (rows.L.col(row).template head<d>().transpose() * A);
    const Eigen::Matrix<double, 1, R> of_F = one.tau * (one.u.transpose() * F_e),
                                      of_M = one.tau * (one.u.transpose() * M_e + one.u_own * l);
    one.f = -one.u_own * of_F;
    one.m = l - one.u_own * of_M;
    F_e.noalias() -= one.u * of_F;
    M_e.noalias() -= one.u * of_M;
  }
  if (matrix_.cols() == 0) {  // the pattern stays
    matrix_.resize(R * J, R * J);
    matrix_.reserve(R * R * static_cast<Index>(joints_.K.size()));
    for (Index column = 0; column < R * J; ++column) {
      const auto e = static_cast<std::size_t>(column / R);
      matrix_.startVec(column);
      for (int at = joints_.first[e]; at < joints_.first[e + 1]; ++at)
        for (int k = 0; k < R; ++k)
          matrix_.insertBack(R * joints_.neighbour[static_cast<std::size_t>(at)] + k, column) = 1.0;
    }
    matrix_.finalize();
  }
  for (int f = 0; f < J; ++f) {
    const auto first = joints_.first[static_cast<std::size_t>(f)];
    const Index height = R * (joints_.first[static_cast<std::size_t>(f) + 1] - first);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, R>> column(matrix_.valuePtr() + matrix_.outerIndexPtr()[R * f],
                                                                height, R);
    for (Index k = 0; R * k < height; ++k) {
      const auto at = static_cast<std::size_t>(first + k);
      const int e = joints_.neighbour[at];
      column.template middleRows<R>(R * k).noalias() = M[static_cast<std::size_t>(e)] * joints_.K[at];
      if (e == f) column.template middleRows<R>(R * k) += F[static_cast<std::size_t>(e)];
    }
  }
  return lu_.factorise(matrix_);
}

template <int d>
void JointSystem<d>::solve(const Vector& b, Vector& z) const {
  Vector h = Vector::Zero(R * joints_.count()), own(b.size()), y;
  for (std::size_t j = 0; j < eliminated_.size(); ++j) {
    const auto row = static_cast<Index>(j);
    const Eliminated& one = eliminated_[j];
    auto h_e = h.segment<R>(R * one.joint);
    const double right = one.scale * b[row], part = one.tau * (one.u.dot(h_e) + one.u_own * right);
    h_e -= part * one.u;
    own[row] = right - part * one.u_own;
  }
  lu_.solve(h, y);
  const Vector w = spread(y);
  z.resize(b.size());
  for (std::size_t j = eliminated_.size(); j-- > 0;) {
    const auto row = static_cast<Index>(j);
    const Eliminated& one = eliminated_[j];
    const Index first = R * one.joint;
    z[row] = (own[row] - one.f.dot(y.segment<R>(first)) - one.m.dot(w.segment<R>(first))) / one.alpha;
    y.segment<R>(first) -= one.c * z[row];
  }
}

template class JointSystem<2>;
template class JointSystem<3>;

}  // namespace scabo::contact
