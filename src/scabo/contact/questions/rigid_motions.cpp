#include "scabo/contact/questions/rigid_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scabo/base/components.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/nonnegative_combination.hpp"
#include "scabo/linalg/nonnegative_least_squares.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

namespace {

/// Rigid motions up to which dense decompositions are as fast as sparse ones.
constexpr Eigen::Index most_dense_motions = 60;

/// The proof moves up the friction cones while it slides; the slide that changes no gap says the same more plainly. It
/// is taken where the proof is mostly that.
Vector slide_of(const Problem& problem, const Vector& motion) {
  if (problem.pairs() == 0 || has_many_motions(problem)) return motion;
  Matrix normals(problem.pairs(), motion.size());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) normals.row(i) = problem.G.dense().row(problem.dimension * i);
  const Eigen::JacobiSVD<Matrix> svd(normals, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (svd.singularValues()[k] > 1e-10 * svd.singularValues()[0]) ++rank;
  const Matrix slides = svd.matrixV().rightCols(motion.size() - rank);
  const Vector slide = slides * (slides.transpose() * motion);
  return slide.norm() > 0.7 ? Vector(slide.normalized()) : motion;
}

/// Of a pyramid around a friction cone in space, which is up to 2 % wider.
constexpr int fewest_sides = 16;

/// Effects on the rigid motions of rays whose non-negative combinations hold all friction forces: in the plane the
/// extreme rays n + mu_b t and n - mu_f t, in space those of a pyramid around the cone, so that a proof against it is
/// one against the cone; or, `inside`, of one that the cone holds.
Matrix rays_of(const Problem& problem, int sides = fewest_sides, bool inside = false) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const int count = d == 2 ? 2 : sides;
  Matrix rays(problem.G.cols(), count * N);
  rays.setZero();  // of pairs whose forces are unlimited: unlimited()
  for (Eigen::Index i = 0; i < N; ++i)
    for (int k = 0; k < count && !std::isinf(problem.tension_of(i)); ++k) {
      Vector ray = problem.G.dense().row(d * i).transpose();
      if (d == 2) {
        const double side = k == 0 ? 1.0 : -1.0;
        ray += side * problem.mu_against(i, side) * problem.G.dense().row(2 * i + 1).transpose();
      } else {
        const double angle = 2.0 * std::numbers::pi * k / sides,
                     reach = inside ? problem.mu[i] : problem.mu[i] / std::cos(std::numbers::pi / sides);
        ray += reach *
               (std::cos(angle) * problem.G.dense().row(3 * i + 1) + std::sin(angle) * problem.G.dense().row(3 * i + 2))
                   .transpose();
      }
      rays.col(count * i + k) = ray;
    }
  return rays;
}

/// The directions in which pairs carry any force, both ways: all of bonded ones, of bars the normal.
Matrix unlimited(const Problem& problem) {
  const Eigen::Index d = problem.dimension;
  std::vector<Vector> columns;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const bool normal = std::isinf(problem.tension_of(i)), tangent = std::isinf(problem.cohesion_of(i));
    for (Eigen::Index k = normal ? 0 : 1; k < (tangent ? d : 1); ++k)
      for (double sign : {-1.0, 1.0}) columns.emplace_back(sign * problem.G.dense().row(d * i + k).transpose());
  }
  Matrix result(problem.G.cols(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = columns[k];
  return result;
}

/// The extreme rays of plane friction cones, sparse: n + mu_b t in the even columns, n - mu_f t in the odd ones.
RigidMap::Sparse sparse_rays(const Problem& problem) {
  const RigidMap::Sparse& G = problem.G.sparse();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(2 * G.nonZeros()));
  for (Eigen::Index motion = 0; motion < G.cols(); ++motion)
    for (RigidMap::Sparse::InnerIterator it(G, motion); it; ++it) {
      const Eigen::Index pair = it.row() / 2;
      const bool normal = it.row() % 2 == 0;
      const double plus = problem.mu_against(pair, 1.0), minus = problem.mu_against(pair, -1.0);
      entries.emplace_back(motion, place_of(pair), normal ? it.value() : plus * it.value());
      entries.emplace_back(motion, place_of(pair, 1), normal ? it.value() : -minus * it.value());
    }
  RigidMap::Sparse rays(G.cols(), G.rows());
  rays.setFromTriplets(entries.begin(), entries.end());
  return rays;
}

/// Effect of the strengths (p_n = -c_t, |p_t| = c) that resist the motion v most.
Vector resisting(const Problem& problem, const Vector& v) {
  const Eigen::Index d = problem.dimension;
  Vector p = Vector::Zero(problem.G.rows());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    if (std::isinf(problem.tension_of(i))) continue;
    p[d * i] = -problem.tension_of(i);
    const Vector slip = problem.G.dense().middleRows(d * i + 1, d - 1) * v;
    const double size = slip.norm();
    if (size > 0.0 && !std::isinf(problem.cohesion_of(i)))
      p.segment(d * i + 1, d - 1) = problem.cohesion_of(i) / size * slip;
  }
  return problem.G.transpose() * p;
}

/// Whether forces of up to ten times the loads along the rays work less on v than `work`, what the loads that they
/// leave unbalanced do: least squares end where no ray reduces the residual by more than rounding, and with hardly any
/// friction the rays that would reduce it are below that.
bool separates(const Matrix& rays, const Vector& v, double work, double loads) {
  constexpr double most_forces = 10.0;
  return rays.cols() == 0 || (rays.transpose() * v).maxCoeff() * most_forces * loads < work;
}

/// With cohesion and tension the forces of a pair are no cone. Their convex hull is p_0 + Coulomb's cone over p_0 =
/// [-c_t, at most c along the tangents]; what balances no point of the hull balances no force. Extreme points of the
/// sum of the p_0 are made as they are needed: with weights that sum to 1 they are columns like the rays.
std::optional<Vector> mechanism_against_strengths(const Problem& problem, const Matrix& cone) {
  const Eigen::Index m = problem.G.cols();
  const Matrix free = unlimited(problem);
  Matrix A = Matrix::Zero(m + 1, cone.cols() + free.cols() + 1);
  const double scale = problem.f.norm();
  const auto add = [&](Eigen::Index column, const Vector& v) {
    A.col(column).head(m) = resisting(problem, v);
    A(m, column) = scale;
  };
  A.topLeftCorner(m, cone.cols()) = cone;
  A.block(0, cone.cols(), m, free.cols()) = free;
  Vector b(m + 1);
  b << -problem.f, scale;
  add(A.cols() - 1, -problem.f);
  constexpr int most = 300;
  for (int round = 0; round < most; ++round) {
    const Vector residual = b - A * linalg::nonnegative_least_squares(A, b);
    const Vector v = residual.head(m);
    if (residual.norm() <= 3e-8 * scale) return std::nullopt;  // its square must stand out of rounding
    // Were there balance, |residual|^2 = residual'b would be at most this, the weights being 1 in all; half is for
    // rounding.
    const double most_of_hull = v.dot(resisting(problem, v)) + scale * residual[m];
    if (most_of_hull <= 0.5 * residual.squaredNorm())
      return separates(cone, v, residual.squaredNorm(), scale) ? std::optional(slide_of(problem, -v.normalized()))
                                                               : std::nullopt;
    A.conservativeResize(Eigen::NoChange, A.cols() + 1);
    add(A.cols() - 1, v);
  }
  return std::nullopt;
}

/// The same problem with coefficients and strengths no larger than loads usually ask for; what balances there balances
/// with more, and numbers far above the loads leave nothing of them but rounding.
Problem moderate(Problem problem) {
  const double force = problem.f.norm();
  problem.mu = problem.mu.cwiseMin(10.0);
  problem.mu_backward = problem.mu_backward.cwiseMin(10.0);
  for (Vector* strengths : {&problem.cohesion, &problem.tension})
    for (double& strength : *strengths)
      if (!std::isinf(strength)) strength = std::min(strength, force);
  return problem;
}

/// G without what rounding of normals leaves of motions along a side: a force of 1e12 times the load is no support.
RigidMap without_rounding(const RigidMap& G) {
  constexpr double none = 1e-12;  // of the largest entry; motions have size 1
  RigidMap::Sparse kept = G.sparse();
  double largest = 0.0;
  for (Eigen::Index k = 0; k < kept.outerSize(); ++k)
    for (RigidMap::Sparse::InnerIterator it(kept, k); it; ++it) largest = std::max(largest, std::abs(it.value()));
  kept.prune(largest, none);
  return RigidMap(std::move(kept));
}

std::optional<Vector> mechanism_of(const Problem& problem);

}  // namespace

bool has_many_motions(const Problem& problem) { return problem.G.cols() > most_dense_motions; }

std::optional<Vector> find_mechanism(const Problem& in_its_unit) {
  if (in_its_unit.G.cols() == 0 || in_its_unit.f.isZero(0.0)) return std::nullopt;
  Problem problem = in_its_unit;  // loads of size 1 beside the columns of G, by a power of two
  const double scale = std::exp2(-std::ilogb(problem.f.norm()));
  problem.f *= scale;
  problem.G = without_rounding(problem.G);
  problem.cohesion *= scale;
  problem.tension *= scale;
  const Problem less = moderate(problem);
  const bool same = less.mu == problem.mu && less.mu_backward == problem.mu_backward &&
                    less.cohesion == problem.cohesion && less.tension == problem.tension;
  if (!same && !mechanism_of(less)) return std::nullopt;
  return mechanism_of(problem);
}

namespace {

/// What rays leave of the loads f: f'unbalanced = |unbalanced|^2 > 0, rays'unbalanced >= 0.
Vector unbalanced_by(const Matrix& rays, const Vector& f) {
  return f + rays * linalg::nonnegative_least_squares(rays, -f);
}

/// The motion along what rays leave of the loads, if that proves that they hold nothing.
std::optional<Vector> motion_of_proof(const Problem& problem, const Matrix& rays, const Vector& unbalanced) {
  if (unbalanced.norm() <= 1e-9 * problem.f.norm() ||
      !separates(rays, -unbalanced, unbalanced.squaredNorm(), problem.f.norm()))
    return std::nullopt;
  return slide_of(problem, unbalanced.normalized());
}

std::optional<Vector> mechanism_of(const Problem& problem) {
  const bool strong = problem.cohesion.size() > 0 || problem.tension.size() > 0;
  if (has_many_motions(problem)) {
    // With strengths, or in space, it is not decided for so many bodies: what does not converge says just that.
    if (strong || problem.dimension != 2) return std::nullopt;
    const std::optional<Vector> y = linalg::separating_vector(sparse_rays(problem), -problem.f);
    return y ? std::optional<Vector>(-*y) : std::nullopt;
  }
  const Matrix rays = rays_of(problem);
  if (problem.cohesion.size() > 0 || problem.tension.size() > 0) return mechanism_against_strengths(problem, rays);
  Vector unbalanced = unbalanced_by(rays, problem.f);
  const auto balances = [&] { return unbalanced.norm() <= 1e-9 * problem.f.norm(); };
  if (problem.dimension == 2 || !balances()) return motion_of_proof(problem, rays, unbalanced);
  // In space the loads may be balanced by a pyramid and not by the cone.
  constexpr double most_directions = 3e5;
  for (int sides = 4 * fewest_sides; sides <= 16 * fewest_sides && sides * problem.pairs() <= most_directions;
       sides *= 4) {
    unbalanced = unbalanced_by(rays_of(problem, sides / 4, true), problem.f);
    if (balances()) break;
    const Matrix closer = rays_of(problem, sides);
    unbalanced = unbalanced_by(closer, problem.f);
    if (!balances()) return motion_of_proof(problem, closer, unbalanced);
  }
  return std::nullopt;
}

}  // namespace

namespace {

/// An orthonormal basis of the v with H v = 0, H sparse with many columns: inverse iteration on H'H, whose block is
/// made wider until it holds a vector that is not in the null space.
Matrix sparse_null_space(const RigidMap::Sparse& H) {
  const Eigen::Index m = H.cols();
  RigidMap::Sparse B = H.transpose() * H;
  const double mean = Vector(B.diagonal()).mean();
  RigidMap::Sparse identity(m, m);
  identity.setIdentity();
  B += 1e-12 * mean * identity;
  const linalg::SymmetricPositiveSolver solver(B);
  for (Eigen::Index width = std::min<Eigen::Index>(6, m);; width = std::min(4 * width, m)) {
    std::minstd_rand random(1);
    Matrix X(m, width);
    for (double& x : X.reshaped()) x = static_cast<double>(random()) / static_cast<double>(random.max()) - 0.5;
    const auto make_orthonormal = [&] {
      X = Eigen::HouseholderQR<Matrix>(X).householderQ() * Matrix::Identity(m, width);
    };
    for (int round = 0; round < 4; ++round) {
      X = solver.solve(X);
      make_orthonormal();
    }
    const Matrix moved = H * X;
    const Eigen::SelfAdjointEigenSolver<Matrix> modes(moved.transpose() * moved);  // smallest first
    const Matrix turned = X * modes.eigenvectors();
    Eigen::Index count = 0;
    while (count < width && (H * turned.col(count)).norm() <= 1e-9 * std::sqrt(mean)) ++count;
    if (count < width || width == m) return turned.leftCols(count);
  }
}

/// Of columns, those that A takes to 0: to `least`, and to rounding of the largest one.
Matrix null_space_of(const Matrix& A, double least) {
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (const double value : svd.singularValues())
    if (value > std::max(1e-10 * svd.singularValues()[0], least)) ++rank;
  return svd.matrixV().rightCols(A.cols() - rank);
}

}  // namespace

Matrix undetermined_motions(const Problem& problem, const std::vector<ContactState>& states) {
  const Eigen::Index m = problem.G.cols();
  if (m == 0) return Matrix(0, 0);
  std::vector<int> rows;
  for (int i = 0; i < problem.pairs(); ++i) {
    const ContactState state = states[static_cast<std::size_t>(i)];
    const int d = problem.dimension;
    if (state != ContactState::open) rows.push_back(d * i);
    if (state == ContactState::stick)
      for (int k = 1; k < d; ++k) rows.push_back(d * i + k);
  }
  if (rows.empty()) return Matrix::Identity(m, m);
  if (has_many_motions(problem)) {
    std::vector<int> place(static_cast<std::size_t>(problem.G.rows()), -1);
    for (std::size_t k = 0; k < rows.size(); ++k) place[static_cast<std::size_t>(rows[k])] = static_cast<int>(k);
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index motion = 0; motion < m; ++motion)
      for (RigidMap::Sparse::InnerIterator it(problem.G.sparse(), motion); it; ++it)
        if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0)
          entries.emplace_back(row, motion, it.value());
    RigidMap::Sparse H(static_cast<Eigen::Index>(rows.size()), m);
    H.setFromTriplets(entries.begin(), entries.end());
    return sparse_null_space(H);
  }
  return null_space_of(problem.G.dense()(rows, Eigen::all), 0.0);
}

Matrix undetermined_motions(const Problem& problem, const std::vector<ContactState>& states, const Vector& p) {
  const Matrix motions = undetermined_motions(problem, states);
  if (problem.dimension == 2 || motions.cols() == 0 || problem.pairs() == 0) return motions;
  const Matrix moved = problem.G.sparse() * motions;
  Matrix across = Matrix::Zero(problem.pairs(), motions.cols());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Eigen::Vector2d friction = p.segment<2>(3 * i + 1);
    if (states[static_cast<std::size_t>(i)] == ContactState::slip && !friction.isZero(0.0))
      across.row(i) =
          Eigen::Vector2d(-friction.y(), friction.x()).normalized().transpose() * moved.middleRows<2>(3 * i + 1);
  }
  constexpr double rounding = 1e-9;  // of the motions of pairs
  return motions * null_space_of(across, rounding * moved.cwiseAbs().maxCoeff());
}

}  // namespace scabo::contact
