#include "scabo/analysis/growth/closed_growth.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "scabo/analysis/growth/closed_cracks.hpp"
#include "scabo/element/plane/point_operator.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::analysis {

namespace {

/// Degrees of freedom of a part, numbered as they are asked for.
class Numbered {
 public:
  Eigen::Index of(int dof) {
    const auto [found, added] = number_.emplace(dof, static_cast<Eigen::Index>(dofs_.size()));
    if (added) dofs_.push_back(dof);
    return found->second;
  }
  const std::vector<int>& dofs() const { return dofs_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(dofs_.size()); }

 private:
  std::map<int, Eigen::Index> number_;
  std::vector<int> dofs_;
};

/// Eq. (1) of one part.
class ClosedPart {
 public:
  ClosedPart(const Prepared& prepared, std::size_t part) : prepared_(prepared), part_(part) {}

  void add(int body, const ClosedCracks& cracks, const Vector& acting);
  bool is_empty() const { return open_.size() == 0; }
  /// Adds the part to `closed`. `acting`: not 0 where forces act.
  void solve(const State& open, const Vector& acting, ClosedGrowth& closed) const;

 private:
  struct Entry {
    Eigen::Index row, column;
    double value;
  };
  Matrix condensed(const std::vector<int>& kept) const;
  void add_on_faces(int body, const ClosedCracks& cracks, const Exchange& exchange,
                    const element::PointCondensation& field);
  int dof(int body, int node, int component) const { return prepared_.structure.dofs.of(body, node, component); }
  void add_stiffness(int body, const mesh::Cell& cell, const Matrix& K, Numbered& of, std::vector<Entry>& to) const;
  static Matrix matrix_of(const std::vector<Entry>& entries, Eigen::Index rows, Eigen::Index columns) {
    Matrix matrix = Matrix::Zero(rows, columns);
    for (const Entry& entry : entries) matrix(entry.row, entry.column) += entry.value;
    return matrix;
  }

  const Prepared& prepared_;
  std::size_t part_;
  std::set<int> inner_;     // degrees of freedom of S that are eliminated
  Numbered open_, closed_;  // S, and v by the numbers of the nodes that are left; w by -1 less those numbers
  std::vector<Entry> K_p_, K_c_, T_;
};

void ClosedPart::add_stiffness(int body, const mesh::Cell& cell, const Matrix& K, Numbered& of,
                               std::vector<Entry>& to) const {
  std::vector<Eigen::Index> places;
  for (const int node : cell.nodes())
    for (const int c : {0, 1}) places.push_back(of.of(dof(body, node, c)));
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      to.push_back({places[i], places[j], K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))});
}

void ClosedPart::add(int body, const ClosedCracks& cracks, const Vector& acting) {
  const mesh::BodyMesh& mesh = prepared_.mesh.bodies[static_cast<std::size_t>(body)];
  std::set<int> nodes, inside;
  for (const auto& [right, left] : cracks.joined()) nodes.insert({right, left});
  for (const Exchange& exchange : cracks.exchanges()) {
    for (const std::size_t c : exchange.cells) {
      const std::vector<int> of_cell = mesh.cells[c].nodes();
      nodes.insert(of_cell.begin(), of_cell.end());
      add_stiffness(body, mesh.cells[c], prepared_.discretisation.cells[static_cast<std::size_t>(body)][c]->K(), open_,
                    K_p_);
    }
    element::SolvedSuperElement closed;
    closed.ring = element::ring_of(exchange.closed, mesh.nodes);
    closed.sectors = element::sectors_of(prepared_.model, exchange.closed);
    closed.thickness = model::thickness_of(prepared_.model, body);
    add_stiffness(body, exchange.closed, closed.K(), closed_, K_c_);
    const auto follows = [&](int node) {
      inside.insert(node);
      for (const int c : {0, 1}) inner_.insert(dof(body, node, c));
    };
    for (const int node : exchange.between) follows(node);
    const bool is_loaded = std::any_of(exchange.on_faces.begin(), exchange.on_faces.end(), [&](const auto& at) {
      return acting[dof(body, at.first, 0)] != 0.0 || acting[dof(body, at.first, 1)] != 0.0;
    });
    for (const auto& [node, point] : exchange.on_faces) is_loaded ? void(inside.insert(node)) : follows(node);
    if (is_loaded) add_on_faces(body, cracks, exchange, element::PointCondensation(closed.ring, closed.solution()));
  }
  for (const int node : nodes)
    for (const int c : {0, 1})
      if (inside.count(node) == 0)
        T_.push_back({open_.of(dof(body, node, c)), closed_.of(dof(body, cracks.same(node), c)), 1.0});
}

/// Faces inside a cell of the closed body: they follow from its field by v, and move by w besides.
void ClosedPart::add_on_faces(int body, const ClosedCracks& cracks, const Exchange& exchange,
                              const element::PointCondensation& field) {
  const std::vector<int> boundary = exchange.closed.nodes();
  for (const auto& [node, point] : exchange.on_faces) {
    const element::PointOperator of_point = field.at(point);
    for (const int k : {0, 1}) {
      const Eigen::Index row = open_.of(dof(body, node, k));
      for (std::size_t i = 0; i < boundary.size(); ++i)
        for (const int c : {0, 1})
          T_.push_back({row, closed_.of(dof(body, boundary[i], c)), of_point.N(k, place_of(i, c))});
      T_.push_back({row, closed_.of(-1 - dof(body, cracks.tied(node), k)), 1.0});
    }
  }
}

/// K_p of the degrees of freedom `kept`, the others eliminated.
Matrix ClosedPart::condensed(const std::vector<int>& kept) const {
  std::vector<int> place(static_cast<std::size_t>(open_.size()), -1), inner(place);
  for (std::size_t i = 0; i < kept.size(); ++i) place[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  int left = 0;
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (place[i] < 0) inner[i] = left++;
  const auto n = static_cast<Eigen::Index>(kept.size());
  Matrix K = Matrix::Zero(n, n), between = Matrix::Zero(left, n);
  std::vector<Eigen::Triplet<double>> inside;
  for (const Entry& entry : K_p_) {
    const auto row = static_cast<std::size_t>(entry.row), column = static_cast<std::size_t>(entry.column);
    if (place[row] >= 0 && place[column] >= 0) K(place[row], place[column]) += entry.value;
    if (inner[row] >= 0 && place[column] >= 0) between(inner[row], place[column]) += entry.value;
    if (inner[row] >= 0 && inner[column] >= 0) inside.emplace_back(inner[row], inner[column], entry.value);
  }
  if (left == 0) return K;
  linalg::SparseMatrix of_inner(left, left);
  of_inner.setFromTriplets(inside.begin(), inside.end());
  return K - between.transpose() * linalg::SymmetricPositiveSolver(of_inner).solve(between);
}

void ClosedPart::solve(const State& open, const Vector& acting, ClosedGrowth& closed) const {
  const system::BodySystem& part = *prepared_.structure.parts[part_];
  std::vector<int> kept, dofs;
  for (std::size_t i = 0; i < open_.dofs().size(); ++i)
    if (inner_.count(open_.dofs()[i]) == 0) kept.push_back(static_cast<int>(i)), dofs.push_back(open_.dofs()[i]);
  const auto n = static_cast<Eigen::Index>(kept.size()), m = closed_.size();
  const Matrix K_p = condensed(kept), T = matrix_of(T_, open_.size(), m)(kept, Eigen::all);
  Matrix less = T.transpose() * K_p * T;
  std::vector<Eigen::Index> of_w;
  for (Eigen::Index i = 0; i < m; ++i)
    if (closed_.dofs()[static_cast<std::size_t>(i)] < 0) of_w.push_back(i);
  less(of_w, of_w).setZero();
  less -= matrix_of(K_c_, m, m);
  const double scale = K_p.diagonal().maxCoeff();  // forces over displacements
  Matrix system(n + m, n + m);
  system << scale * part.flexibility_by_factor(dofs), -T, T.transpose(), -less / scale;
  const Vector u_0 = open.u[part_](dofs), right = (Vector(n + m) << -u_0, Vector::Zero(m)).finished();
  const Vector found = system.partialPivLu().solve(right);  // eq. (1)
  const Vector q = scale * found.head(n), v = found.tail(m);
  closed.released -= 0.5 * q.dot(u_0);  // eq. (2)
  Vector forces = Vector::Zero(part.size());
  forces(dofs) = q;
  for (int dof = 0; dof < static_cast<int>(acting.size()); ++dof)
    if (acting[dof] != 0.0) dofs.push_back(dof);
  Vector& d = closed.moved[part_];
  d = part.displacement_at(forces, Vector::Zero(static_cast<Eigen::Index>(part.constraints().size())), dofs);
  closed.elastic += open.forces[part_].dot(d) + 0.5 * forces.dot(d) - 0.5 * v.dot(less * v);  // eq. (3)
  if (open.p.size() > 0) closed.elastic += open.p.dot(prepared_.contact.motion[part_] * d);
}

/// Not 0 where forces act on a part, and where a support or springs hold it.
Vector acting_on(const Prepared& prepared, const State& state, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  Vector acting = state.forces[p].cwiseAbs();
  if (state.p.size() > 0) acting += prepared.contact.motion[p].cwiseAbs().transpose() * state.p.cwiseAbs();
  for (const system::Constraint& constraint : part.constraints()) acting[constraint.dof] = 1.0;
  if (part.has_springs()) acting.setOnes();
  return acting;
}

}  // namespace

std::optional<ClosedGrowth> closed_growth(const Prepared& prepared, const State& open, const std::vector<Tip>& tips,
                                          const std::vector<std::optional<Vec2>>& before) {
  std::map<int, ClosedCracks> bodies;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    if (!before[t]) continue;
    ClosedCracks& cracks = bodies.try_emplace(tips[t].body, prepared, tips[t].body).first->second;
    if (!cracks.close(prepared.model, tips[t], *before[t])) return {};
  }
  ClosedGrowth closed;
  for (std::size_t p = 0; p < open.u.size(); ++p) {
    closed.moved.push_back(Vector::Zero(open.u[p].size()));
    ClosedPart part(prepared, p);
    const Vector acting = acting_on(prepared, open, p);
    for (const auto& [body, cracks] : bodies)
      if (prepared.structure.dofs.part_of(body) == p) part.add(body, cracks, acting);
    if (!part.is_empty()) part.solve(open, acting, closed);
  }
  return closed;
}

}  // namespace scabo::analysis
