#include "scabo/system/body_system.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>

#include "scabo/base/components.hpp"
#include "scabo/base/error.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/linalg/sparse_factor.hpp"
#include "scabo/linalg/twofold.hpp"
#include "scabo/system/differences.hpp"
#include "scabo/system/inclined_nodes.hpp"
#include "scabo/system/ranks.hpp"

namespace scabo::system {

Eigen::Index Stiffness::size() const { return divided ? divided->size() : dense ? dense->rows() : sparse.rows(); }

double Stiffness::entries() const {
  return divided ? divided->entries() : static_cast<double>(dense ? dense->size() : sparse.nonZeros());
}

Vector Stiffness::times(const Vector& u) const {
  if (divided) return divided->times(u);
  return dense ? Vector(*dense * u) : Vector(sparse * u);
}

linalg::TwofoldVector Stiffness::times(const linalg::TwofoldVector& u) const {
  if (divided) return divided->times(u);
  return dense ? linalg::product(*dense, u) : linalg::product(sparse, u);
}

Vector Stiffness::times_squares(const Vector& u) const {
  if (divided) return divided->times_squares(u);
  if (dense) return dense->cwiseAbs2() * u;
  Vector product(u.size());  // K is symmetric: rows are columns
  for (Eigen::Index j = 0; j < sparse.cols(); ++j) {
    double sum = 0.0;
    for (linalg::SparseMatrix::InnerIterator it(sparse, j); it; ++it) sum += it.value() * it.value() * u[it.row()];
    product[j] = sum;
  }
  return product;
}

double Stiffness::largest_diagonal() const {
  if (size() == 0) return 0.0;
  if (divided) return divided->largest_diagonal();
  return dense ? dense->diagonal().maxCoeff() : Vector(sparse.diagonal()).maxCoeff();
}

namespace {

/// What equal bodies share.
struct Factored {
  Stiffness stiffness;
  double largest_diagonal = 0.0;  // of the stiffness: asked for often, and as long as a product with it
  linalg::SymmetricPositiveSolver solver;
};

/// Rows and columns `dofs` (ascending) of K; place[i]: position of i in `dofs`, or -1.
linalg::SparseMatrix principal_part(const linalg::SparseMatrix& K, const std::vector<int>& dofs,
                                    const std::vector<int>& place) {
  const auto n = static_cast<Eigen::Index>(dofs.size());
  linalg::SparseMatrix part(n, n);
  part.reserve(K.nonZeros());
  for (Eigen::Index j = 0; j < n; ++j) {
    part.startVec(j);
    for (linalg::SparseMatrix::InnerIterator it(K, dofs[static_cast<std::size_t>(j)]); it; ++it)
      if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0) part.insertBack(row, j) = it.value();
  }
  part.finalize();
  return part;
}

/// Bit for bit.
bool equal(const linalg::SparseMatrix& a, const linalg::SparseMatrix& b) {
  const auto same = [](const auto* first, const auto* second, Eigen::Index count) {
    return count == 0 || std::memcmp(first, second, static_cast<std::size_t>(count) * sizeof(*first)) == 0;
  };
  return a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         same(a.outerIndexPtr(), b.outerIndexPtr(), a.cols() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros()) && same(a.valuePtr(), b.valuePtr(), a.nonZeros());
}
bool equal(const Stiffness& a, const Stiffness& b) {
  if (a.unbounded != b.unbounded || !equal(a.springs.matrix, b.springs.matrix)) return false;
  if (a.divided || b.divided) return a.divided == b.divided;
  if (a.dense || b.dense) return a.dense == b.dense;
  return a.rounding == b.rounding && equal(a.sparse, b.sparse);
}

/// K + S, of a sparse K.
linalg::SparseMatrix with_springs(const Stiffness& stiffness) { return stiffness.sparse + stiffness.springs.matrix; }

/// Equal for equal ones.
std::size_t hash_of(const Stiffness& stiffness) {
  if (stiffness.divided) return std::hash<const void*>()(stiffness.divided.get());
  if (stiffness.dense) return std::hash<const void*>()(stiffness.dense.get());
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(stiffness.sparse.valuePtr()),
                                        static_cast<std::size_t>(stiffness.sparse.nonZeros()) * sizeof(double)});
}

class ElasticBody final : public BodySystem {
 public:
  ElasticBody(std::shared_ptr<Factored> factored, const std::vector<Vec2>& nodes, std::vector<Constraint> constraints)
      : factored_(std::move(factored)), free_(static_cast<std::size_t>(2 * nodes.size()), true) {
    constraints_ = std::move(constraints);
    inclined_ = InclinedNodes(constraints_);
    find_rigid_motions(nodes);
    find_turn(nodes);
    for (const Constraint& constraint : constraints_) free_[static_cast<std::size_t>(constraint.dof)] = false;
    solved_ = free_;
    further_ = further_dofs();
    for (int dof : further_) solved_[static_cast<std::size_t>(dof)] = false;
    find_forces_on_further();
    place_.assign(solved_.size(), -1);
    for (std::size_t i = 0; i < solved_.size(); ++i)
      if (solved_[i]) place_[i] = static_cast<int>(dofs_.size()), dofs_.push_back(static_cast<int>(i));
  }

  const std::vector<int>& solved_dofs() const { return dofs_; }
  const InclinedNodes& inclined() const { return inclined_; }
  const std::shared_ptr<Factored>& factored() const { return factored_; }
  void share(std::shared_ptr<Factored> other) { factored_ = std::move(other); }
  const void* factor() const override { return factored_.get(); }

  void factorise(linalg::SparseOptions options, const std::vector<Vec2>& nodes, const std::vector<int>& contact_dofs) {
    // Many of them are condensed fast in a balanced tree only, that of dissection: of a layer of 1,500 x 54 eight-node
    // elements with 3,001 pairs in 1.6 s instead of 9.1 s, while the factorisation takes as long.
    constexpr std::size_t many = 1000;
    if (contact_dofs.size() >= many && options.ordering == linalg::Ordering::automatic)
      options.ordering = linalg::Ordering::dissection_by_position;
    for (const int dof : dofs_) options.positions.push_back(nodes[static_cast<std::size_t>(dof / 2)]);
    const bool alone = inclined_.none() && stiffness().springs.none();
    if (stiffness().divided) {
      linalg::FactorisationCosts costs;
      auto factor = stiffness().divided->factorise(dofs_, inclined_, stiffness().springs.matrix, contact_dofs, costs);
      factored_->solver = linalg::SymmetricPositiveSolver(static_cast<int>(dofs_.size()), std::move(factor), costs);
    } else if (stiffness().dense) {
      factored_->solver = linalg::SymmetricPositiveSolver(alone ? Matrix((*stiffness().dense)(dofs_, dofs_))
                                                                : Matrix(whole_dense()(dofs_, dofs_)));
    } else {
      factored_->solver = linalg::SymmetricPositiveSolver(
          principal_part(alone ? stiffness().sparse : whole_sparse(), dofs_, place_), options);
    }
  }

  Vector spring_forces(const Vector& u) const override { return -stiffness().springs.times(u); }
  bool is_flexible() const override { return true; }
  bool has_springs() const override { return !stiffness().springs.none(); }

  Eigen::Index size() const override { return stiffness().size(); }

  Displaced displaced(const Vector& f, const Vector& prescribed, const Balanced& wanted) const override {
    Displaced to{held_displacement(prescribed), {}};
    const bool at_rest = to.u.isZero(0.0);
    if (at_rest && f.isZero(0.0)) return {std::move(to.u), Vector::Zero(size())};
    to.u += solved(at_rest ? f : Vector(f - internal_forces(to.u)));
    to.unbalanced = internal_forces(to.u) - f;
    const double acting = largest_acting(to.unbalanced, f);
    if (is_large()) {
      const double largest = std::max(acting, wanted.at_least), allowed = wanted.part * largest;
      const Goal reached = goal(f, largest);
      if (largest_left(to.unbalanced, reached) <= allowed) return to;
      Refined exact = refined(to.u, f, allowed, reached);
      return {linalg::rounded(exact.u), std::move(exact.left)};
    }
    to.u -= solved(to.unbalanced);  // another solve of a small body costs nothing
    to.unbalanced.resize(0);
    if (!rounding_matters(to.u, acting, wanted)) return to;
    Refined exact = refined(to.u, f, wanted);
    return {linalg::rounded(exact.u), std::move(exact.left)};
  }

  Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>& dofs) const override {
    Vector u = held_displacement(prescribed);
    const bool at_rest = u.isZero(0.0);
    if (dofs.empty() || (at_rest && f.isZero(0.0))) return u;
    if (!at_rest || !is_large()) return displacement(f, prescribed);
    // A few others tell how far the body bends, and so whether rounding matters.
    constexpr std::size_t samples = 64;
    std::vector<int> wanted;
    std::vector<char> chosen(place_.size(), 0);
    const auto want = [&](int dof) {
      for (const int component : both_if_inclined(dof)) {
        const auto i = static_cast<std::size_t>(component);
        if (place_[i] >= 0 && !chosen[i]) chosen[i] = 1, wanted.push_back(component);
      }
    };
    for (const int dof : dofs) want(dof);
    for (std::size_t k = 0; k < samples; ++k) want(dofs_[k * dofs_.size() / samples]);
    std::vector<int> places;
    for (const int dof : wanted) places.push_back(place_[static_cast<std::size_t>(dof)]);
    Vector v = Vector::Zero(size());
    v(wanted) = solver().solve_at(inclined_.components(f)(dofs_), places);
    u = inclined_.displacements(std::move(v));
    double acting = f.lpNorm<Eigen::Infinity>();  // and what holds a body without supports against its loads
    if (rigid_motions_.cols() > 0)
      acting = std::max(acting, (rigid_motions_.transpose() * f).lpNorm<Eigen::Infinity>());
    return rounding_matters(u, acting) ? displacement(f, prescribed) : u;
  }

  Matrix flexibility(const std::vector<int>& dofs) const override { return flexibility(dofs, true); }
  Matrix flexibility_by_factor(const std::vector<int>& dofs) const override { return flexibility(dofs, false); }

  Matrix flexibility(const std::vector<int>& dofs, bool refines) const {
    const bool any = !inclined_.none() &&
                     std::any_of(dofs.begin(), dofs.end(), [&](int dof) { return inclined_.of(dof / 2) != nullptr; });
    if (!any) return flexibility_along(dofs, refines);
    // u = T v on these degrees of freedom, with both of every inclined node.
    std::vector<int> both;
    std::vector<Eigen::Triplet<double>> entries;
    std::map<int, int> column_of;
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const auto row = static_cast<int>(i);
      const int node = dofs[i] / 2;
      const Mat2* M = inclined_.of(node);
      if (!M) {
        entries.emplace_back(row, static_cast<int>(both.size()), 1.0);
        both.push_back(dofs[i]);
        continue;
      }
      const auto [at, added] = column_of.emplace(node, static_cast<int>(both.size()));
      if (added) both.insert(both.end(), {static_cast<int>(place_of(node)), static_cast<int>(place_of(node, 1))});
      for (int k = 0; k < 2; ++k) entries.emplace_back(row, at->second + k, (*M)(dofs[i] % 2, k));
    }
    Eigen::SparseMatrix<double> T(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(both.size()));
    T.setFromTriplets(entries.begin(), entries.end());
    const Matrix half = T * flexibility_along(both, refines), A = T * half.transpose();
    return 0.5 * (A + A.transpose());
  }

  Vector flexed(const std::vector<int>& dofs, const Vector& forces) const override {
    Vector load = Vector::Zero(size());
    load(dofs) = forces;
    load = inclined_.components(std::move(load));
    std::vector<int> wanted, places;
    for (const int dof : dofs)
      for (const int component : both_if_inclined(dof))
        if (const int place = place_[static_cast<std::size_t>(component)]; place >= 0)
          wanted.push_back(component), places.push_back(place);
    Vector v = Vector::Zero(size());
    v(wanted) = solver().solve_at(load(dofs_), places);
    return inclined_.displacements(std::move(v))(dofs);
  }

  bool is_divided() const override { return stiffness().divided != nullptr; }

  FreeStiffness free_stiffness() const override {
    ensure(!is_divided(), "the stiffness of a divided body is not here");
    FreeStiffness free;
    std::vector<int> place(free_.size(), -1);
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i]) place[i] = static_cast<int>(free.dofs.size()), free.dofs.push_back(static_cast<int>(i));
    if (stiffness().dense)
      free.K = Matrix(whole_dense()(free.dofs, free.dofs)).sparseView();
    else
      free.K = principal_part(whole_sparse(), free.dofs, place);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < free.dofs.size(); ++k) {
      const int dof = free.dofs[k], column = static_cast<int>(k);
      const Mat2* const M = inclined_.of(dof / 2);
      if (!M)
        entries.emplace_back(dof, column, 1.0);
      else
        for (int row = 0; row < 2; ++row) entries.emplace_back(dof / 2 * 2 + row, column, (*M)(row, dof % 2));
    }
    free.map.resize(size(), static_cast<Eigen::Index>(free.dofs.size()));
    free.map.setFromTriplets(entries.begin(), entries.end());
    free.motions.resize(static_cast<Eigen::Index>(further_.size()), rigid_motions_.cols());
    for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k)
      free.motions.col(k) = inclined_.along(rigid_motions_.col(k))(further_);
    for (const int dof : further_) free.further.push_back(place[static_cast<std::size_t>(dof)]);
    return free;
  }

  double operations() const override {
    const double dense = std::pow(static_cast<double>(dofs_.size()), 3.0) / 3.0;
    return stiffness().dense ? dense : solver().costs().operations;
  }

  /// Where rounding u matters, of the displacement that u is the rounded value of, if it is one: u must not differ from
  /// it in more than its last digits.
  Vector unbalanced(const Vector& u, const Vector& f) const override {
    Vector plain = internal_forces(u) - f;
    if (!u.allFinite()) return plain;
    const double acting = largest_acting(plain, f), allowed = Balanced().part * acting;
    const Goal reached = goal(f, acting);
    if (is_large() ? largest_left(plain, reached) <= allowed : !rounding_matters(u, acting)) return plain;
    Refined exact = is_large() ? refined(u, f, allowed, reached) : refined(u, f, {});
    constexpr double last_digits = 256 * std::numeric_limits<double>::epsilon();
    if (!((linalg::rounded(exact.u) - u).lpNorm<Eigen::Infinity>() <= last_digits * u.lpNorm<Eigen::Infinity>()))
      return plain;
    return std::move(exact.left);
  }

  Vector reactions_of(const Vector& unbalanced) const override {
    const Vector remaining = inclined_.components(unbalanced);
    Vector forces(static_cast<Eigen::Index>(constraints_.size()));
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      forces[static_cast<Eigen::Index>(c)] = remaining[constraints_[c].dof];
    return forces;
  }

  double imbalance_of(const Vector& unbalanced) const override {
    const Vector remaining = inclined_.components(unbalanced);
    double largest = 0.0;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i]) largest = std::max(largest, std::abs(remaining[static_cast<Eigen::Index>(i)]));
    return largest;
  }

  double elastic_energy(const Vector& u) const override {
    const Vector resisting = internal_forces(u);
    return !by_differences() && energy_needs_digits(u, resisting) ? exact_energy(u) : 0.5 * u.dot(resisting);
  }
  double elastic_energy(const Vector& u, const Vector& f, const Vector& unbalanced) const override {
    const Vector resisting = f + unbalanced;
    // By differences, forces are known more exactly than rounding of u leaves them.
    const bool exact = by_differences();
    if (!exact && rounding_matters(u, resisting.lpNorm<Eigen::Infinity>())) return exact_energy(u);  // u is refined
    Vector acting = Vector::Zero(size());
    const Vector left = inclined_.components(unbalanced);
    for (const Constraint& constraint : constraints_) acting[constraint.dof] = left[constraint.dof];
    const double work = u.dot(f) + inclined_.along(u).dot(acting);
    return work - (!exact && energy_needs_digits(u, resisting) ? exact_energy(u) : 0.5 * u.dot(resisting));
  }
  double energy_lost(const Vector& u) const override {
    Vector strained = u;  // an estimate: digits that the rigid motions take from it do not count
    if (!stiffness().unbounded) {
      auto by_node = strained.reshaped(2, size() / 2);
      const Vec2 mean = by_node.rowwise().mean();
      by_node.colwise() -= mean;
      double product = 0.0, square = 0.0;
      for (Eigen::Index i = 0; i < size(); ++i) {
        const double turn = turn_[static_cast<std::size_t>(i)].high;
        product += strained[i] * turn;
        square += turn * turn;
      }
      const double angle = product / square;
      for (Eigen::Index i = 0; i < size(); ++i) strained[i] -= angle * turn_[static_cast<std::size_t>(i)].high;
    }
    const Vector square = strained.cwiseAbs2();
    const double sum = square.dot(stiffness().times_squares(square));
    return 0.5 * stiffness().rounding * std::sqrt(sum);  // errors of single entries, independent of each other
  }
  double stiff_force(const Vector& u) const override {
    return factored_->largest_diagonal * u.lpNorm<Eigen::Infinity>();
  }

 private:
  /// A along the directions of the constraints, on degrees of freedom of v.
  Matrix flexibility_along(const std::vector<int>& dofs, bool refines) const {
    std::vector<int> places, at;
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const int place = place_[static_cast<std::size_t>(dofs[i])];
      if (place >= 0) places.push_back(place), at.push_back(static_cast<int>(i));
    }
    Matrix A = solver().inverse_block(places);
    if (at.size() < dofs.size()) {
      const Matrix of_solved = std::move(A);
      A = Matrix::Zero(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(dofs.size()));
      A(at, at) = of_solved;
    }
    // The factor alone gives it to about this condition times the unit of rounding.
    constexpr double most_entries = 1e9;  // some seconds
    const double entries = stiffness().entries() * static_cast<double>(at.size());
    if (refines && !at.empty() && factored_->largest_diagonal * A.diagonal().maxCoeff() > 1e7 &&
        entries < most_entries) {
      const Vector none = Vector::Zero(size());
      for (std::size_t j = 0; j < at.size(); ++j) {
        Vector force = none;
        force[dofs[static_cast<std::size_t>(at[j])]] = 1.0;
        force = inclined_.forces(std::move(force));
        const Vector u = inclined_.along(linalg::rounded(refined(solved(force), force, {}).u));
        for (std::size_t i = 0; i < at.size(); ++i) A(at[i], at[j]) = u[dofs[static_cast<std::size_t>(at[i])]];
      }
      A = 0.5 * (A + A.transpose()).eval();
    }
    return A;
  }

  /// K + S along the directions of the constraints.
  Matrix whole_dense() const {
    Matrix K = *stiffness().dense;
    if (has_springs()) K += stiffness().springs.matrix;
    return inclined_.none() ? K : inclined_.stiffness(std::move(K));
  }
  linalg::SparseMatrix whole_sparse() const {
    const linalg::SparseMatrix K = has_springs() ? with_springs(stiffness()) : stiffness().sparse;
    return inclined_.none() ? K : inclined_.stiffness(K);
  }

  /// The degree of freedom, or both of its node, if that is inclined.
  std::vector<int> both_if_inclined(int dof) const {
    if (!inclined_.of(dof / 2)) return {dof};
    return {dof / 2 * 2, dof / 2 * 2 + 1};
  }

  /// A solve takes so long that one less counts.
  bool is_large() const { return size() >= 20000; }

  /// Displacements of the constraints; 0 of everything else.
  Vector held_displacement(const Vector& prescribed) const {
    Vector u = Vector::Zero(size());
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      u[constraints_[c].dof] = prescribed[static_cast<Eigen::Index>(c)];
    return inclined_.displacements(std::move(u));
  }

  /// What of the forces that are left another solve can make smaller.
  struct Goal {
    Vector held;          // m: on the degrees of freedom that hold the body in u_p, against the resultants of f
    double spread = 1.0;  // all forces over the largest: resultants may be larger than forces by this factor
  };
  Goal goal(const Vector& f, double largest_force) const {
    const Vector held = on_further_ * (rigid_motions_.transpose() * f);
    return {held, is_large() ? std::max(1.0, f.lpNorm<1>() / largest_force) : HUGE_VAL};
  }
  /// Largest of the forces on degrees of freedom that are solved for, of what these add up to on those that hold the
  /// body, and of their resultants over `spread`: each is small, but there are many, and rounding of equal elements is
  /// equal.
  double largest_left(const Vector& unbalanced, const Goal& of) const {
    const Vector left = inclined_.components(unbalanced);
    double largest = 0.0;
    for (const int dof : dofs_) largest = std::max(largest, std::abs(left[dof]));
    for (std::size_t k = 0; k < further_.size(); ++k)
      largest = std::max(largest, std::abs(left[further_[k]] + of.held[static_cast<Eigen::Index>(k)]));
    Vector free = left;  // without reactions, which at an inclined node have both components
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (!free_[i]) free[static_cast<Eigen::Index>(i)] = 0.0;
    free = inclined_.forces(std::move(free));
    double sums[2] = {0.0, 0.0}, moment = 0.0;
    for (std::size_t i = 0; i < turn_.size(); ++i) {
      const double force = free[static_cast<Eigen::Index>(i)];
      sums[i % 2] += force;
      moment += force * turn_[i].high;
    }
    return std::max({largest, std::abs(sums[0]) / of.spread, std::abs(sums[1]) / of.spread,
                     std::abs(moment) / (lever_ * of.spread)});
  }

  /// 1/2 u'(K + S) u in twice the working precision.
  double exact_energy(const Vector& u) const {
    return 0.5 * u.dot(forces_left(linalg::twofold(u), Vector::Zero(size())));
  }

  /// The displacement under f, by the factor alone.
  Vector solved(const Vector& f) const {
    const Vector load = inclined_.components(f);
    Vector v = Vector::Zero(size());
    v(dofs_) = solver().solve(load(dofs_)).col(0);
    return inclined_.displacements(std::move(v));
  }

  /// Whether K u comes from differences of displacements: in working precision it is then exact but for the rounding of
  /// u.
  bool by_differences() const {
    return is_large() && !stiffness().unbounded && !stiffness().divided && !stiffness().dense;
  }

  /// (K + S) u, without the part that a translation of the whole body would add to K u by rounding.
  Vector internal_forces(Vector u) const {
    if (by_differences()) return forces_left(linalg::twofold(u), Vector::Zero(size()), Product::by_differences);
    const Vector springs = has_springs() ? stiffness().springs.times(u) : Vector();
    if (!stiffness().unbounded) {
      const Eigen::Index nodes = size() / 2;
      auto by_node = u.reshaped(2, nodes);
      const Vec2 mean = by_node.rowwise().mean();
      by_node.colwise() -= mean;
    }
    Vector forces = stiffness().times(u);
    if (has_springs()) forces += springs;
    return forces;
  }

  /// Whether rounding u can leave forces that are not small beside those that act: in slender bodies K u is a small
  /// difference of large numbers.
  bool rounding_matters(const Vector& u, double acting, const Balanced& wanted = {}) const {
    // Of a small body K u leaves some four units of rounding.
    constexpr double unit = std::numeric_limits<double>::epsilon(), small = 1e-12, small_enough = 1e-11;
    const double part = is_large() ? small_enough : std::min(small, 0.25 * wanted.part);
    return unit * stiff_force(u) > part * acting;
  }
  /// Differences of energies between meshes are 1e-13 of them: here rounding counts sooner.
  bool energy_needs_digits(const Vector& u, const Vector& resisting) const {
    return std::numeric_limits<double>::epsilon() * stiff_force(u) > 1e-12 * resisting.lpNorm<Eigen::Infinity>();
  }
  /// Largest force that acts on the body: of f, and of the constraints where that saves large bodies, which supports
  /// move, the refinement in twice the working precision.
  double largest_acting(const Vector& unbalanced, const Vector& f) const {
    double largest = f.lpNorm<Eigen::Infinity>();
    if (is_large() && !constraints_.empty())
      largest = std::max(largest, reactions_of(unbalanced).lpNorm<Eigen::Infinity>());
    return largest;
  }

  enum class Product { twofold, by_differences };
  /// (K + S) u - f, in twice the working precision or by differences. Bounded bodies: P K P for K, where P takes rigid
  /// motions out (translations and the turn, orthogonal); K itself resists them by what rounding its entries left,
  /// which is the same in all of many equal elements, and forces that come from rounding have no resultant this way.
  Vector forces_left(linalg::TwofoldVector u, const Vector& f, Product product = Product::twofold,
                     double* rounding = nullptr) const {
    linalg::TwofoldVector springs;
    if (has_springs()) springs = linalg::product(stiffness().springs.matrix, u);
    if (!stiffness().unbounded) take_out_rigid_motions(u);
    linalg::TwofoldVector forces;
    if (product == Product::by_differences) {
      const ForcesByDifferences found = forces_by_differences(stiffness().sparse, u);
      forces = linalg::twofold(found.forces);
      if (rounding) *rounding = found.rounding;
    } else {
      forces = stiffness().times(u);
    }
    if (!stiffness().unbounded) take_out_rigid_motions(forces);
    for (std::size_t i = 0; i < springs.size(); ++i) forces[i] = forces[i] + springs[i];
    Vector left(size());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      left[row] = (forces[i] - linalg::Twofold{f[row], 0.0}).high;
    }
    return left;
  }

  /// By sums in twice the working precision: those of half a million forces of weight lose 1e-10 of the largest
  /// otherwise.
  void take_out_rigid_motions(linalg::TwofoldVector& v) const {
    const std::size_t nodes = v.size() / 2;
    const linalg::Twofold count{static_cast<double>(nodes), 0.0};
    linalg::Twofold x, y, turned;
    for (std::size_t i = 0; i < nodes; ++i) {
      x = x + v[2 * i];
      y = y + v[2 * i + 1];
    }
    const linalg::Twofold mean_x = x / count, mean_y = y / count;
    for (std::size_t i = 0; i < nodes; ++i) {
      v[2 * i] = v[2 * i] - mean_x;
      v[2 * i + 1] = v[2 * i + 1] - mean_y;
      turned = turned + v[2 * i] * turn_[2 * i] + v[2 * i + 1] * turn_[2 * i + 1];
    }
    const linalg::Twofold angle = turned / turn_square_;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] - angle * turn_[i];
  }

  /// The displacement under f in twice the working precision, refined from u, and the forces that are left with it.
  struct Refined {
    linalg::TwofoldVector u;
    Vector left;
  };
  Refined refined(const Vector& u, const Vector& f, const Balanced& wanted) const {
    const double largest = f.lpNorm<Eigen::Infinity>();
    return refined(u, f, std::min(1e-14, wanted.part) * largest, goal(f, largest));
  }
  /// By conjugate gradients, whose preconditioner is the factor of K + S: exact but for few directions, the bending of
  /// a slender body or its motion on soft springs, in which rounding of the factor counts. Plain refinement is their
  /// first step. Until at most `allowed` (a force) is left at a node, or rounding allows no less; and in
  /// a large body until u hardly changes: in bending, few forces change it much.
  Refined refined(const Vector& u, const Vector& f, double allowed, const Goal& of) const {
    Refined best{linalg::twofold(u), {}};
    // One product for all: to rounding, they are those of two matrices.
    Product product = Product::twofold;
    if (by_differences()) {
      double rounding = 0.0;
      best.left = forces_left(best.u, f, Product::by_differences, &rounding);
      if (rounding <= 0.1 * allowed) product = Product::by_differences;
    }
    if (product == Product::twofold) best.left = forces_left(best.u, f);
    if (dofs_.empty()) return best;
    const auto solved_part = [&](const Vector& forces) { return Vector(inclined_.components(forces)(dofs_)); };
    const Vector nothing = Vector::Zero(size());
    Refined now = best;
    Vector along = nothing;  // the direction, in the components of `solved_part`
    double before = 0.0, least = largest_left(best.left, of);
    constexpr int most = 40;
    const int patience = is_large() ? 2 : 5;  // its solves take long
    constexpr double hardly = 1e-9;
    int since_best = 0;
    bool changes = false;
    for (int k = 0; k < most && since_best < patience && (least > allowed || changes); ++k) {
      const Vector remaining = solved_part(now.left), correction = solver().solve(remaining).col(0);
      const double decrease = remaining.dot(correction);
      along *= before > 0.0 ? decrease / before : 0.0;
      along(dofs_) -= correction;
      before = decrease;
      const Vector direction = inclined_.displacements(along);
      const double curvature = direction.dot(forces_left(linalg::twofold(direction), nothing, product));
      if (!(curvature > 0.0)) break;
      const linalg::Twofold step{-remaining.dot(Vector(along(dofs_))) / curvature, 0.0};
      changes = is_large() && direction.lpNorm<Eigen::Infinity>() * step.high > hardly * u.lpNorm<Eigen::Infinity>();
      for (Eigen::Index dof = 0; dof < direction.size(); ++dof) {
        if (direction[dof] == 0.0) continue;
        linalg::Twofold& component = now.u[static_cast<std::size_t>(dof)];
        component = component + step * linalg::Twofold{direction[dof], 0.0};
      }
      now.left = forces_left(now.u, f, product);
      ++since_best;
      if (const double size = largest_left(now.left, of); size < least) best = now, least = size, since_best = 0;
    }
    return best;
  }

  void find_turn(const std::vector<Vec2>& nodes) {
    for (const Vec2& x : nodes) {
      turn_.push_back({-x.y(), 0.0});
      turn_.push_back({x.x(), 0.0});
    }
    const linalg::Twofold count{static_cast<double>(nodes.size()), 0.0};
    for (std::size_t k = 0; k < 2; ++k) {  // about the mean of the nodes: orthogonal to translations
      linalg::Twofold sum;
      for (std::size_t i = k; i < turn_.size(); i += 2) sum = sum + turn_[i];
      const linalg::Twofold mean = sum / count;
      for (std::size_t i = k; i < turn_.size(); i += 2) turn_[i] = turn_[i] - mean;
    }
    for (const linalg::Twofold& turn : turn_) turn_square_ = turn_square_ + turn * turn;
  }

  void find_rigid_motions(const std::vector<Vec2>& nodes) {
    rigid_coordinates_ = free_motions(nodes, constraints_, stiffness().springs.directions, reference_, lever_);
    if (stiffness().unbounded) rigid_coordinates_ = Matrix::Zero(3, 0);
    rigid_motions_.resize(size(), rigid_coordinates_.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      rigid_motions_.middleRows<2>(place_of(i)) = rigid_point(nodes[i], reference_, lever_) * rigid_coordinates_;
    for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k) {
      Vector along = inclined_.along(rigid_motions_.col(k));
      for (const Constraint& constraint : constraints_) along[constraint.dof] = 0.0;
      rigid_motions_.col(k) = inclined_.displacements(std::move(along));
    }
  }

  /// Of Goal::held: B' x = z for forces x on these degrees of freedom along which the motions are B, and resultants z.
  void find_forces_on_further() {
    const Eigen::Index m = rigid_motions_.cols();
    Matrix B(m, m);
    for (Eigen::Index k = 0; k < m; ++k) B.col(k) = inclined_.along(rigid_motions_.col(k))(further_);
    on_further_ = m > 0 ? Matrix(B.transpose().inverse()) : Matrix(0, 0);
  }

  /// As many degrees of freedom as there are rigid motions, chosen so that holding them stops every motion.
  std::vector<int> further_dofs() const {
    std::vector<int> chosen;
    if (rigid_motions_.cols() == 0) return chosen;
    // Equal pivots are common, of equal corners for one. Rounded, they are equal in every unit of length, and the
    // choice, on which W and the iterations depend, is the same.
    Matrix along = rigid_motions_;
    for (Eigen::Index k = 0; k < along.cols(); ++k) along.col(k) = inclined_.along(along.col(k));
    const Matrix rounded = (along.transpose().array() * 0x1p30).round() * 0x1p-30;
    const Eigen::ColPivHouseholderQR<Matrix> qr(rounded);
    for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k) chosen.push_back(qr.colsPermutation().indices()[k]);
    return chosen;
  }

  const Stiffness& stiffness() const { return factored_->stiffness; }
  const linalg::SymmetricPositiveSolver& solver() const { return factored_->solver; }

  std::shared_ptr<Factored> factored_;
  InclinedNodes inclined_;
  linalg::TwofoldVector turn_;   // the rotation about the mean of the nodes
  linalg::Twofold turn_square_;  // its square
  std::vector<bool> free_;       // by supports
  std::vector<bool> solved_;     // free, and not among the further dofs
  std::vector<int> dofs_, place_;
  std::vector<int> further_;  // hold the body in u_p along its rigid motions
  Matrix on_further_;         // m x m
};

}  // namespace

std::unique_ptr<BodySystem> elastic_body(Stiffness stiffness, const std::vector<Vec2>& nodes,
                                         std::vector<Constraint> constraints) {
  std::vector<ElasticPart> parts;
  parts.push_back({std::move(stiffness), nodes, std::move(constraints)});
  return std::move(elastic_bodies(std::move(parts), 1).front());
}

std::vector<std::unique_ptr<BodySystem>> elastic_bodies(std::vector<ElasticPart> parts, int threads,
                                                        const linalg::SparseOptions& options) {
  std::vector<std::unique_ptr<ElasticBody>> bodies;
  std::vector<std::size_t> distinct;
  std::vector<double> work;
  std::unordered_multimap<std::size_t, std::size_t> known;  // hash, distinct body
  for (ElasticPart& part : parts) {
    auto factored = std::make_shared<Factored>();
    factored->stiffness = std::move(part.stiffness);
    factored->largest_diagonal = factored->stiffness.largest_diagonal();
    auto body = std::make_unique<ElasticBody>(factored, part.nodes, std::move(part.constraints));
    const std::size_t hash = hash_of(factored->stiffness);
    const auto [begin, end] = known.equal_range(hash);
    const auto same = std::find_if(begin, end, [&](const auto& entry) {
      const ElasticBody& other = *bodies[entry.second];
      return other.solved_dofs() == body->solved_dofs() && other.inclined() == body->inclined() &&
             equal(other.factored()->stiffness, factored->stiffness);
    });
    if (same != end) {
      body->share(bodies[same->second]->factored());
    } else {
      known.emplace(hash, bodies.size());
      distinct.push_back(bodies.size());
      work.push_back(std::pow(static_cast<double>(factored->stiffness.size()), factored->stiffness.dense ? 3.0 : 1.5));
    }
    bodies.push_back(std::move(body));
  }
  std::vector<char> failed(distinct.size(), 0);
  linalg::parallel_for(work, threads, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    try {
      bodies[distinct[i]]->factorise(options, parts[distinct[i]].nodes, parts[distinct[i]].contact_dofs);
    } catch (const linalg::NotPositiveDefinite&) {
      failed[i] = 1;
    }
  });
  if (const auto first = std::find(failed.begin(), failed.end(), 1); first != failed.end())
    throw NotPositiveDefinitePart(distinct[static_cast<std::size_t>(first - failed.begin())]);
  std::vector<std::unique_ptr<BodySystem>> result;
  for (auto& body : bodies) result.push_back(std::move(body));
  return result;
}

}  // namespace scabo::system
