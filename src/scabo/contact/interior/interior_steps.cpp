#include "scabo/contact/interior/interior_steps.hpp"

#include <algorithm>

#include "scabo/contact/constants.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using SparseMatrix = Eigen::SparseMatrix<double>;

const double root_half = std::sqrt(0.5);

/// Roots of the mean own W_ii of each pair, for each of its components; 1 where all bodies are rigid.
Vector scales_of_pairs(const Problem& problem) {
  const Index d = problem.dimension;
  const Vector diagonal = problem.W.diagonal();
  if (diagonal.isZero(0.0)) return Vector::Ones(diagonal.size());
  const double least = interior_constants.least_of_mean * diagonal.mean();
  Vector scales(diagonal.size());
  for (Index i = 0; i < problem.pairs(); ++i)
    scales.segment(d * i, d).setConstant(std::sqrt(std::max(diagonal.segment(d * i, d).mean(), least)));
  return scales;
}

/// With forces S p, motions S^-1 u. W forgets the motions of rigid bodies: by these D that falls to 0 loses digits.
Problem in_scales(const Problem& problem, const Vector& S) {
  Problem scaled = problem;
  if (problem.W.is_sparse()) {
    scaled.W =
        Delassus(SparseMatrix(S.cwiseInverse().asDiagonal() * problem.W.sparse() * S.cwiseInverse().asDiagonal()));
  } else {
    scaled.W = Delassus(Matrix(S.cwiseInverse().asDiagonal() * problem.W.dense() * S.cwiseInverse().asDiagonal()));
  }
  scaled.q = problem.q.cwiseQuotient(S);
  for (Index i = 0; i < problem.pairs(); ++i) {
    if (problem.cohesion.size() > 0) scaled.cohesion[i] *= S[problem.dimension * i];
    if (problem.tension.size() > 0) scaled.tension[i] *= S[problem.dimension * i];
  }
  return scaled;
}

/// Rigid motions of `problem`, whose pairs are already in scales `S`, as multiples `length` of unit motions.
void scale_motions(Problem& problem, const Vector& S, Vector& length) {
  const Index m = problem.G.cols();
  length.setOnes(m);
  if (m == 0) return;
  SparseMatrix G = S.cwiseInverse().asDiagonal() * problem.G.sparse();
  for (Index k = 0; k < m; ++k) {
    if (const double size = G.col(k).norm(); size > 0.0) length[k] = 1.0 / size;
    G.col(k) *= length[k];
  }
  problem.G = RigidMap(std::move(G));
  problem.f = problem.f.cwiseProduct(length);
}

}  // namespace

template <int d>
InteriorSteps<d>::InteriorSteps(const Problem& problem)
    : scale_(scales_of_pairs(problem)),
      problem_([&] {
        Problem scaled = in_scales(problem, scale_);
        scale_motions(scaled, scale_, length_);
        return scaled;
      }()),
      system_(problem_) {
  const Index N = problem_.pairs();
  std::size_t unknowns = 0;
  for (Index i = 0; i < N; ++i) {
    const bool slides = problem_.largest_mu(i) <= interior_constants.no_friction && problem_.cohesion_of(i) == 0.0;
    kind_.push_back(slides                                   ? Tangential::none
                    : std::isfinite(problem_.cohesion_of(i)) ? Tangential::cone
                                                             : Tangential::equation);
    first_.push_back(static_cast<int>(unknowns));
    unknowns += slides ? 1 : d;
    products_ += static_cast<int>(opens(i)) + static_cast<int>(has_cone(i));
  }
  rows_.resize(unknowns);
  rows_.E = interior_constants.held;
  for (Index i = 0; i < N; ++i) {
    const auto first = static_cast<std::size_t>(first_[static_cast<std::size_t>(i)]);
    const std::size_t next = i + 1 < N ? static_cast<std::size_t>(first_[static_cast<std::size_t>(i) + 1]) : unknowns;
    for (std::size_t j = first; j < next; ++j) {
      rows_.pair[j] = static_cast<int>(i);
      rows_.L(static_cast<Index>(j - first), static_cast<Index>(j)) = 1.0;
    }
  }
  rows_.C = rows_.L;
  rows_.D.setConstant(interior_constants.held);
  size_of_loads_ = std::hypot(problem_.q.norm(), problem_.f.norm());
  at_.p.setZero(d * N), at_.X.setZero(d * N), at_.Y.setZero(d * N);
  at_.a.setZero(problem_.G.cols());
  at_.x.setZero(N), at_.y.setZero(N);
}

/// Largest force of pairs that balance the rigid motions, bonded and as soft as their bodies: a tower of 200 blocks
/// presses on its foot with 200 times the weight of one.
template <int d>
double InteriorSteps<d>::balancing_force() {
  if (problem_.G.cols() == 0) return 0.0;
  SaddleRows bonded = rows_;
  bonded.D.setOnes();
  if (!system_.factorise(bonded)) return problem_.f.template lpNorm<Eigen::Infinity>();
  Vector right = Vector::Zero(bonded.size() + problem_.f.size());
  for (Index j = 0; j < bonded.size(); ++j)
    right[j] = -bonded.L.col(j).template head<d>().dot(part(problem_.q, bonded.pair[static_cast<std::size_t>(j)]));
  right.tail(problem_.f.size()) = -problem_.f;
  return system_.solve(right).head(bonded.size()).template lpNorm<Eigen::Infinity>();
}

template <int d>
void InteriorSteps<d>::start(double factor) {
  const double force =
      factor * std::max(problem_.q.size() > 0 ? problem_.q.template lpNorm<Eigen::Infinity>() : 0.0, balancing_force());
  const double m = force * force;
  for (Index i = 0; i < problem_.pairs(); ++i) {
    at_.p[d * i] = force;
    if (opens(i)) at_.x[i] = force + problem_.tension_of(i), at_.y[i] = m / at_.x[i];
    if (!has_cone(i)) continue;
    const double forth = problem_.friction_bound(i, force, -1.0), back = problem_.friction_bound(i, force, 1.0);
    T p_t = T::Zero();
    p_t[0] = 0.5 * (back - forth);
    at_.p.template segment<d - 1>(d * i + 1) = p_t;
    const V X = Cone::of_force(forth, back, p_t);
    at_.X.template segment<d>(d * i) = X;
    at_.Y.template segment<d>(d * i) = Cone::quotient(m * Cone::middle(), X);
  }
}

/// What of p_n presses, (p_n)+, and its derivative.
template <int d>
std::pair<double, double> InteriorSteps<d>::pressure(Index i, double p_n, double m) const {
  if (problem_.tension_of(i) == 0.0) return {p_n, 1.0};
  const double root = std::sqrt(p_n * p_n + 4.0 * m);
  const double pressure = p_n > 0.0 ? 0.5 * (p_n + root) : 2.0 * m / (root - p_n);
  return {pressure, root > 0.0 ? pressure / root : 0.5};
}

template <int d>
double InteriorSteps<d>::gap_of(const Point& at) const {
  double sum = at.X.dot(at.Y);
  for (Index i = 0; i < problem_.pairs(); ++i)
    if (opens(i)) sum += at.x[i] * at.y[i];
  return products_ > 0 ? sum / products_ : 0.0;
}

template <int d>
void InteriorSteps<d>::evaluate() {
  const Index N = problem_.pairs();
  Lacks& of = lacks_;
  of.gap = gap_of(at_);
  of.u = problem_.q + problem_.W * at_.p;
  of.balance = problem_.f;
  if (at_.a.size() > 0) {
    of.u += problem_.G * at_.a;
    of.balance += problem_.G.transpose() * at_.p;
  }
  of.x.setZero(N), of.y.setZero(N), of.X.setZero(d * N), of.Y.setZero(d * N);
  of.forward.setZero(N), of.backward.setZero(N);
  for (Index i = 0; i < N; ++i) {
    of.y[i] = of.u[d * i];
    if (kind_[static_cast<std::size_t>(i)] != Tangential::none)
      of.Y.template segment<d - 1>(d * i + 1) = tangents(of.u, i);
    if (opens(i)) {
      of.x[i] = at_.p[d * i] + problem_.tension_of(i) - at_.x[i];
      of.y[i] -= at_.y[i];
    }
    if (!has_cone(i)) continue;
    const auto [normal, slope] = pressure(i, at_.p[d * i], of.gap);
    const double mu_forward = problem_.mu_against(i, -1.0), mu_backward = problem_.mu_against(i, 1.0);
    const double c = problem_.cohesion_of(i);
    of.X.template segment<d>(d * i) =
        Cone::of_force(c + mu_forward * normal, c + mu_backward * normal, tangents(at_.p, i)) - part(at_.X, i);
    of.Y.template segment<d - 1>(d * i + 1) -= Cone::tangent(part(at_.Y, i));
    of.forward[i] = mu_forward * slope, of.backward[i] = mu_backward * slope;
    if (lifts_.size() > 0) of.y[i] += lifts_[i] - Cone::lift(of.forward[i], of.backward[i], part(at_.Y, i));
  }
}

template <int d>
double InteriorSteps<d>::distance() const {
  return std::sqrt(lacks_.y.squaredNorm() + lacks_.Y.squaredNorm() + lacks_.balance.squaredNorm());
}

template <int d>
Vector InteriorSteps<d>::lifts() const {
  Vector lifts = Vector::Zero(problem_.pairs());
  for (Index i = 0; i < problem_.pairs(); ++i)
    if (has_cone(i)) lifts[i] = problem_.mu_against(i, -lacks_.u[d * i + 1]) * tangents(lacks_.u, i).norm();
  return lifts;
}

template <int d>
Vector InteriorSteps<d>::at_the_boundary() const {
  Vector p = at_.p;
  for (Index i = 0; i < problem_.pairs(); ++i) {
    if (opens(i)) p[d * i] = std::max(at_.x[i] - at_.y[i], 0.0) - problem_.tension_of(i);
    if (!has_cone(i)) continue;
    const T p_t = tangents(p, i) - Cone::tangent(part(at_.Y, i));
    const double bound = problem_.friction_bound(i, p[d * i], p_t[0]), size = p_t.norm();
    p.template segment<d - 1>(d * i + 1) = size > bound ? T(bound / size * p_t) : p_t;
  }
  return p.cwiseQuotient(scale_);
}

/// Scalings of the cones; false where a point is not inside.
template <int d>
bool InteriorSteps<d>::scale_pairs() {
  const Index N = problem_.pairs();
  scaling_.phi.setOnes(d * N), scaling_.lambda.setZero(d * N);
  scaling_.Q.resize(static_cast<std::size_t>(N)), scaling_.directions.resize(static_cast<std::size_t>(N));
  for (Index i = 0; i < N; ++i) {
    if (opens(i) && !(at_.x[i] > 0.0 && at_.y[i] > 0.0)) return false;
    if (!has_cone(i)) continue;
    const V X = part(at_.X, i), Y = part(at_.Y, i);
    if (!(Cone::inside(X) && Cone::inside(Y))) return false;
    V phi;
    M& Q = scaling_.Q[static_cast<std::size_t>(i)];
    Cone::scaling(X, Y, Q, scaling_.directions[static_cast<std::size_t>(i)], phi);
    scaling_.phi.template segment<d>(d * i) = phi;
    scaling_.lambda.template segment<d>(d * i) = Q * phi.cwiseProduct(Q.transpose() * X);
  }
  return true;
}

/// D, and the rows and columns of the pairs with a cone.
template <int d>
void InteriorSteps<d>::lay_out() {
  for (Index i = 0; i < problem_.pairs(); ++i) {
    const Index row = first_[static_cast<std::size_t>(i)];
    if (opens(i)) rows_.D[row] = interior_constants.held + at_.y[i] / at_.x[i];
    if (!has_cone(i)) continue;
    const V h = part(scaling_.phi, i).cwiseAbs2();
    const TT& directions = scaling_.directions[static_cast<std::size_t>(i)];
    const double forward = lacks_.forward[i], backward = lacks_.backward[i];
    for (Index k = 0; k < d - 1; ++k)
      rows_.L.col(row + 1 + k).template segment<d - 1>(1) = rows_.C.col(row + 1 + k).template segment<d - 1>(1) =
          directions.col(k);
    const double follows = (forward * h[0] - backward * h[1]) / (h[0] + h[1]);  // mu'
    rows_.C.col(row).template segment<d - 1>(1) = -follows * directions.col(0);
    rows_.D[row + 1] = interior_constants.held + 0.5 * (h[0] + h[1]);
    if constexpr (d == 3) rows_.D[row + 2] = interior_constants.held + h[2];
    if (lifts_.size() == 0) continue;
    rows_.L.col(row) = rows_.C.col(row);
    const double both = forward + backward;
    rows_.D[row] += 0.5 * both * both * h[0] * h[1] / (h[0] + h[1]);
  }
}

/// F (l \ R) of the cone of pair i, in the coordinates of Q.
template <int d>
typename InteriorSteps<d>::V InteriorSteps<d>::cone_right(Index i, const Vector& of_cones) const {
  const M& Q = scaling_.Q[static_cast<std::size_t>(i)];
  const V quotient = Cone::quotient(part(of_cones, i), part(scaling_.lambda, i));
  return part(scaling_.phi, i).cwiseProduct(Q.transpose() * quotient);
}

template <int d>
Vector InteriorSteps<d>::right_side(const Vector& of_normals, const Vector& of_cones) const {
  Vector right(rows_.size() + at_.a.size());
  for (Index i = 0; i < problem_.pairs(); ++i) {
    const Index row = first_[static_cast<std::size_t>(i)];
    right[row] = -lacks_.y[i];
    if (opens(i)) right[row] += (of_normals[i] - at_.y[i] * lacks_.x[i]) / at_.x[i];
    const Tangential kind = kind_[static_cast<std::size_t>(i)];
    if (kind == Tangential::equation) right.template segment<d - 1>(row + 1) = -tangents(lacks_.Y, i);
    if (kind != Tangential::cone) continue;
    const V h = part(scaling_.phi, i).cwiseAbs2();
    const V of = cone_right(i, of_cones) -
                 h.cwiseProduct(scaling_.Q[static_cast<std::size_t>(i)].transpose() * part(lacks_.X, i));
    const T lacks = scaling_.directions[static_cast<std::size_t>(i)].transpose() * tangents(lacks_.Y, i);
    right[row + 1] = root_half * (of[0] - of[1]) - lacks[0];
    if constexpr (d == 3) right[row + 2] = of[2] - lacks[1];
    if (lifts_.size() == 0) continue;
    const double forward = lacks_.forward[i], backward = lacks_.backward[i];
    right[row] += root_half * (forward + backward) * (h[1] * of[0] + h[0] * of[1]) / (h[0] + h[1]) +
                  (forward * h[0] - backward * h[1]) / (h[0] + h[1]) * lacks[0];
  }
  right.tail(at_.a.size()) = -lacks_.balance;
  return right;
}

template <int d>
typename InteriorSteps<d>::Point InteriorSteps<d>::direction(const Vector& of_normals, const Vector& of_cones) const {
  const Index N = problem_.pairs();
  const Vector z = system_.solve(right_side(of_normals, of_cones));
  Point change;
  change.p.setZero(d * N);
  rows_.add_forces(z, d, change.p);
  change.a = z.tail(at_.a.size());
  change.x.setZero(N), change.y.setZero(N), change.X.setZero(d * N), change.Y.setZero(d * N);
  Vector du = problem_.W * change.p;
  if (change.a.size() > 0) du += problem_.G * change.a;
  for (Index i = 0; i < N; ++i) {
    if (has_cone(i)) complete_cone(i, cone_right(i, of_cones), du, change);
    if (opens(i)) complete_normal(i, of_normals[i], du, change);
  }
  return change;
}

/// Through the product where y is small beside x, else through the motion.
template <int d>
void InteriorSteps<d>::complete_normal(Index i, double right, const Vector& du, Point& change) const {
  const double x = at_.x[i], y = at_.y[i];
  if (y < x) {
    change.x[i] = change.p[d * i] + lacks_.x[i];
    change.y[i] = (right - y * change.x[i]) / x;
  } else {
    change.y[i] = du[d * i] + lacks_.y[i];
    if (lifts_.size() > 0 && has_cone(i))
      change.y[i] -= Cone::lift(lacks_.forward[i], lacks_.backward[i], part(change.Y, i));
    change.x[i] = (right - x * change.y[i]) / y;
  }
}

/// The same for the components of the cone in the coordinates of Q; of the first two, whose difference alone is a
/// motion, the one with the smaller h comes through the product.
template <int d>
void InteriorSteps<d>::complete_cone(Index i, const V& right, const Vector& du, Point& change) const {
  const M& Q = scaling_.Q[static_cast<std::size_t>(i)];
  const V h = part(scaling_.phi, i).cwiseAbs2();
  const double normal = change.p[d * i];
  const V force = Cone::of_force(lacks_.forward[i] * normal, lacks_.backward[i] * normal, tangents(change.p, i));
  V dX = Q.transpose() * (force + part(lacks_.X, i)), dY = right - h.cwiseProduct(dX);
  const T motion =
      scaling_.directions[static_cast<std::size_t>(i)].transpose() * (tangents(du, i) + tangents(lacks_.Y, i));
  const auto through_motion = [&](int k, double moved) {
    dY[k] = moved;
    dX[k] = (right[k] - moved) / h[k];
  };
  const int large = h[0] > h[1] ? 0 : 1;
  if (h[large] > 1.0) through_motion(large, dY[1 - large] + (large == 0 ? motion[0] : -motion[0]) / root_half);
  if constexpr (d == 3)
    if (h[2] > 1.0) through_motion(2, motion[1]);
  change.X.template segment<d>(d * i) = Q * dX;
  change.Y.template segment<d>(d * i) = Q * dY;
}

template <int d>
double InteriorSteps<d>::reach(const Point& change) const {
  double most = HUGE_VAL;
  for (Index i = 0; i < problem_.pairs(); ++i) {
    if (has_cone(i))
      most = std::min(
          {most, Cone::reach(part(at_.X, i), part(change.X, i)), Cone::reach(part(at_.Y, i), part(change.Y, i))});
    if (!opens(i)) continue;
    if (change.x[i] < 0.0) most = std::min(most, -at_.x[i] / change.x[i]);
    if (change.y[i] < 0.0) most = std::min(most, -at_.y[i] / change.y[i]);
  }
  return most;
}

template <int d>
void InteriorSteps<d>::move(const Point& change, double step, Point& at) const {
  at.p += step * change.p, at.a += step * change.a;
  at.x += step * change.x, at.y += step * change.y;
  at.X += step * change.X, at.Y += step * change.Y;
}

template <int d>
bool InteriorSteps<d>::advance() {
  if (!scale_pairs()) return false;
  lay_out();
  if (!system_.factorise(rows_)) return false;
  const Index N = problem_.pairs();
  const InteriorConstants& c = interior_constants;
  const double gap = lacks_.gap;
  // Products for sigma, without the changes of `first`, a part of it.
  Vector of_normals(N), of_cones(d * N);
  const auto aim = [&](double sigma, const Point* first, double part_of_first) {
    for (Index i = 0; i < N; ++i) {
      of_normals[i] = sigma * gap - at_.x[i] * at_.y[i];
      of_cones.template segment<d>(d * i).setZero();
      if (first) of_normals[i] -= part_of_first * first->x[i] * first->y[i];
      if (!has_cone(i)) continue;
      const V lambda = part(scaling_.lambda, i);
      V of = sigma * gap * Cone::middle() - Cone::product(lambda, lambda);
      if (first) {
        const M& Q = scaling_.Q[static_cast<std::size_t>(i)];
        const V phi = part(scaling_.phi, i);
        const V dX = Q * phi.cwiseProduct(Q.transpose() * part(first->X, i)),
                dY = Q * (Q.transpose() * part(first->Y, i)).cwiseQuotient(phi);
        of -= part_of_first * Cone::product(dX, dY);
      }
      of_cones.template segment<d>(d * i) = of;
    }
  };
  aim(0.0, nullptr, 0.0);
  const Point first = direction(of_normals, of_cones);
  const double predicted = std::min(1.0, reach(first));
  Point reached = at_;
  move(first, predicted, reached);
  double sigma = gap > 0.0 ? std::pow(std::clamp(gap_of(reached) / gap, 0.0, 1.0), 3) : 0.0;
  const double lack = distance();
  if (lack * first_gap_ > c.distance_lag * gap * first_distance_ && lack > c.settled * size_of_loads_)
    sigma = std::max(sigma, c.lagging);
  aim(sigma, &first, predicted);
  Point change = direction(of_normals, of_cones);
  double most = reach(change);
  if (most < c.collapsed) {
    aim(c.centring, nullptr, 0.0);
    change = direction(of_normals, of_cones);
    most = reach(change);
  }
  step_ = std::min(1.0, c.part * most);
  move(change, step_, at_);
  return std::isfinite(step_) && at_.p.allFinite();
}

template class InteriorSteps<2>;
template class InteriorSteps<3>;

}  // namespace scabo::contact
