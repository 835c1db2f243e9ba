#include "scabo/system/contact_system.hpp"

#include <algorithm>

#include "scabo/system/contact_laws.hpp"

namespace scabo::system {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Rows [n, t] of one side of a pair over the displacements of its body.
void add_side(Triplets& entries, int row, double sign, const model::Body& body, const BodySystem& system, int node,
              const Vec2& point, const Vec2& normal) {
  const Vec2 directions[2] = {normal, tangent_of(normal)};
  for (int k = 0; k < 2; ++k) {
    if (body.rigid) {
      const Eigen::RowVector3d map = directions[k].transpose() * rigid_point(point, system.reference(), system.lever());
      for (int j = 0; j < 3; ++j) entries.emplace_back(row + k, j, sign * map[j]);
    } else {
      entries.emplace_back(row + k, 2 * node, sign * directions[k].x());
      entries.emplace_back(row + k, 2 * node + 1, sign * directions[k].y());
    }
  }
}

std::vector<Eigen::SparseMatrix<double>> motion_of(const std::vector<ContactSystem::Pair>& pairs,
                                                   const Structure& structure, const model::Model& model,
                                                   const mesh::Mesh& mesh) {
  std::vector<Triplets> entries(model.bodies.size());
  int row = 0;
  for (const ContactSystem::Pair& at : pairs) {
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(at.contact)];
    const mesh::ContactPair& pair =
        mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
    const auto a = static_cast<std::size_t>(contact.a.body), b = static_cast<std::size_t>(contact.b.body);
    add_side(entries[a], row, -1.0, model.bodies[a], *structure.bodies[a], pair.node_a, pair.point_a, pair.normal);
    add_side(entries[b], row, 1.0, model.bodies[b], *structure.bodies[b], pair.node_b, pair.point_b, pair.normal);
    row += 2;
  }
  std::vector<Eigen::SparseMatrix<double>> motion;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    motion.emplace_back(row, structure.bodies[b]->size());
    motion.back().setFromTriplets(entries[b].begin(), entries[b].end());
  }
  return motion;
}

/// B A B' of one body, through the flexibility of the few degrees of freedom that contact touches.
void add_flexibility(Matrix& W, const Eigen::SparseMatrix<double>& motion, const BodySystem& body) {
  std::vector<int> touched;
  for (Eigen::Index column = 0; column < motion.cols(); ++column)
    if (motion.outerIndexPtr()[column + 1] > motion.outerIndexPtr()[column])
      touched.push_back(static_cast<int>(column));
  if (touched.empty()) return;
  Eigen::SparseMatrix<double> narrow(motion.rows(), static_cast<Eigen::Index>(touched.size()));
  for (std::size_t k = 0; k < touched.size(); ++k) narrow.col(static_cast<Eigen::Index>(k)) = motion.col(touched[k]);
  const Matrix half = narrow * body.flexibility(touched);
  W += narrow * half.transpose();
}

template <typename T>
std::vector<T> selected(const std::vector<T>& all, const std::vector<int>& which) {
  std::vector<T> some;
  for (int i : which) some.push_back(all[static_cast<std::size_t>(i)]);
  return some;
}

}  // namespace

ContactSystem condense(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<ContactSystem::Pair> all;
  for (std::size_t c = 0; c < mesh.interfaces.size(); ++c)
    for (std::size_t i = 0; i < mesh.interfaces[c].pairs.size(); ++i)
      all.push_back({static_cast<int>(c), static_cast<int>(i), 0});

  const auto motion = motion_of(all, structure, model, mesh);
  const auto rows = static_cast<Eigen::Index>(2 * all.size());
  Matrix W = Matrix::Zero(rows, rows);
  ContactSystem system;
  Eigen::Index columns = 0;
  for (const auto& body : structure.bodies) {
    system.first_rigid.push_back(static_cast<int>(columns));
    columns += body->rigid_motions().cols();
  }
  Matrix G = Matrix::Zero(rows, columns);
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    const BodySystem& body = *structure.bodies[b];
    if (!model.bodies[b].rigid) add_flexibility(W, motion[b], body);
    if (body.rigid_motions().cols() > 0)
      G.middleCols(system.first_rigid[b], body.rigid_motions().cols()) = motion[b] * body.rigid_motions();
  }
  W = 0.5 * (W + W.transpose()).eval();

  // A pair whose gap no force and no rigid motion changes is held by supports on both sides.
  const double largest = rows > 0 ? W.diagonal().maxCoeff() : 0.0;
  std::vector<int> moving, held, moving_rows;
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    const bool moves = W(2 * i, 2 * i) > 1e-13 * largest || (columns > 0 && G.row(2 * i).cwiseAbs().maxCoeff() > 1e-12);
    (moves ? moving : held).push_back(i);
    if (moves) moving_rows.insert(moving_rows.end(), {2 * i, 2 * i + 1});
  }
  system.pairs = selected(all, moving);
  system.held = selected(all, held);
  std::vector<int> numbers(model.contacts.size(), 0);
  for (ContactSystem::Pair& pair : system.pairs) pair.number = ++numbers[static_cast<std::size_t>(pair.contact)];
  system.held_motion =
      held.empty() ? std::vector<Eigen::SparseMatrix<double>>{} : motion_of(system.held, structure, model, mesh);
  system.motion = held.empty() ? motion : motion_of(system.pairs, structure, model, mesh);
  system.W = held.empty() ? std::move(W) : Matrix(W(moving_rows, moving_rows));
  system.G = held.empty() ? std::move(G) : Matrix(G(moving_rows, Eigen::all));
  const auto N = static_cast<Eigen::Index>(system.pairs.size());
  system.gap.resize(N);
  system.laws = contact_laws(system.pairs, model, mesh);
  for (Eigen::Index i = 0; i < N; ++i) {
    const ContactSystem::Pair& at = system.pairs[static_cast<std::size_t>(i)];
    system.gap[i] =
        system.laws.of_pair[static_cast<std::size_t>(i)]->keeps_gap()
            ? 0.0
            : mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)].gap;
  }
  return system;
}

}  // namespace scabo::system
