#include "scabo/system/contact_system.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/system/contact_laws.hpp"
#include "scabo/system/joined_bodies.hpp"
#include "scabo/system/pair_flexibility.hpp"
#include "scabo/system/tributary_lengths.hpp"

namespace scabo::system {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Rows of one side of a pair over the displacements of its part.
void add_side(Triplets& entries, int row, double sign, const BodySystem& part, const PairSide& side,
              const PairPoints::Directions& directions) {
  const Components components{static_cast<int>(directions.rows())};
  for (int k = 0; k < components.dimension; ++k) {
    if (side.nodes.empty()) {
      ensure(components.dimension == 2, "a part without nodes is rigid, and rigid parts are plane");
      const Vec2 direction = directions.col(k);
      const Eigen::RowVector3d map = direction.transpose() * rigid_point(side.point, part.reference(), part.lever());
      for (int j = 0; j < 3; ++j) entries.emplace_back(row + k, j, sign * map[j]);
    }
    for (const PairSide::Node& at : side.nodes)
      for (int j = 0; j < components.dimension; ++j)  // of a joint along an axis half of them are 0
        if (directions(j, k) != 0.0)
          entries.emplace_back(row + k, static_cast<int>(components.of(at.node, j)),
                               sign * (at.weight * directions(j, k)));
  }
}

/// Directly by columns: of thousands of parts each has few entries, but as many rows as all pairs together.
Eigen::SparseMatrix<double> by_columns(Eigen::Index rows, Eigen::Index columns, Triplets entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return std::pair(a.col(), a.row()) < std::pair(b.col(), b.row());
  });
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.reserve(static_cast<Eigen::Index>(entries.size()));
  std::size_t next = 0;
  for (Eigen::Index column = 0; column < columns; ++column) {
    matrix.startVec(column);
    while (next < entries.size() && entries[next].col() == column) {
      const Eigen::Index row = entries[next].row();
      double sum = 0.0;
      for (; next < entries.size() && entries[next].col() == column && entries[next].row() == row; ++next)
        sum += entries[next].value();
      matrix.insertBack(row, column) = sum;
    }
  }
  matrix.finalize();
  return matrix;
}

std::vector<Eigen::SparseMatrix<double>> motion_of(const std::vector<PairPoints>& pairs, const Structure& structure) {
  std::vector<Triplets> entries(structure.parts.size());
  int row = 0;
  for (const PairPoints& pair : pairs) {
    for (const auto& [side, sign] : {std::pair(&pair.a, -1.0), std::pair(&pair.b, 1.0)})
      if (side->part != PairSide::ground)
        add_side(entries[side->part], row, sign, *structure.parts[side->part], *side, pair.directions);
    row += static_cast<int>(pair.directions.cols());
  }
  std::vector<Eigen::SparseMatrix<double>> motion;
  for (std::size_t p = 0; p < structure.parts.size(); ++p)
    motion.push_back(by_columns(row, structure.parts[p]->size(), std::move(entries[p])));
  return motion;
}

/// Contribution of one part to W: B A B' on the rows of the pairs that touch it.
struct PartFlexibility {
  std::vector<int> rows;
  Matrix block;  // rows x rows, symmetric
};

PartFlexibility flexibility_of(const TouchedPart& touched, const BodySystem& part) {
  if (touched.dofs.empty()) return {};
  return {touched.rows, pair_flexibility(touched.motion, touched.dofs, part)};
}

/// Whether W has so few entries that it is sparse; `rows` of all pairs.
bool is_sparse(const std::vector<TouchedPart>& touched, const Structure& structure, Eigen::Index rows) {
  constexpr Eigen::Index least_sparse = 400;  // rows: below this, dense factors are as fast
  double entries = 0.0;
  for (std::size_t p = 0; p < touched.size(); ++p)
    if (structure.parts[p]->is_flexible()) entries += std::pow(static_cast<double>(touched[p].rows.size()), 2);
  return rows >= least_sparse && entries <= most_filled * static_cast<double>(rows) * static_cast<double>(rows);
}

// Below, a dense LU takes less than a second, and the joined bodies are not used.
constexpr Eigen::Index least_joined = 2500;

/// W on the rows kept by `place` (-1: left out), with the springs between sides on its diagonal; `softness`: of each
/// row that is kept.
contact::Delassus sum_of(std::vector<PartFlexibility> parts, const std::vector<int>& place, const Vector& softness,
                         bool is_sparse) {
  const Eigen::Index rows = softness.size();
  Matrix dense;
  Triplets triplets;
  const auto all = [&](const PartFlexibility& part) {
    return static_cast<Eigen::Index>(part.rows.size()) == rows && static_cast<Eigen::Index>(place.size()) == rows;
  };
  const auto whole = std::find_if(parts.begin(), parts.end(), all);
  if (!is_sparse && whole != parts.end())  // no second matrix as large
    std::swap(dense, whole->block), whole->rows.clear();
  else if (!is_sparse)
    dense.setZero(rows, rows);
  if (is_sparse) {
    std::size_t entries = 0;
    for (const PartFlexibility& part : parts) entries += part.rows.size() * part.rows.size();
    triplets.reserve(entries);
  }
  for (PartFlexibility& part : parts) {
    if (!is_sparse && all(part)) {
      dense += part.block;
      part = {};
    }
    for (std::size_t j = 0; j < part.rows.size(); ++j) {
      const int column = place[static_cast<std::size_t>(part.rows[j])];
      for (std::size_t i = 0; column >= 0 && i < part.rows.size(); ++i) {
        const int row = place[static_cast<std::size_t>(part.rows[i])];
        const double value = part.block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (row < 0) continue;
        if (is_sparse)
          triplets.emplace_back(row, column, value);
        else
          dense(row, column) += value;
      }
    }
    part.block.resize(0, 0);
  }
  if (!is_sparse) {
    dense.diagonal() += softness;
    return {std::move(dense)};
  }
  for (Eigen::Index row = 0; row < rows; ++row)
    if (softness[row] > 0.0) triplets.emplace_back(row, row, softness[row]);
  Eigen::SparseMatrix<double> W(rows, rows);
  W.setFromTriplets(triplets.begin(), triplets.end());
  return contact::Delassus(std::move(W));
}

/// W with its bodies where all parts are rigid: W = Y'Y, Y = A^1/2 B' of each part, and a row for each spring.
contact::Delassus with_bodies(contact::Delassus W, const std::vector<TouchedPart>& touched, const Structure& structure,
                              const std::vector<int>& place, const Vector& softness) {
  constexpr Eigen::Index most = 6;  // degrees of freedom of a rigid body
  Triplets entries;
  int columns = 0;
  for (std::size_t p = 0; p < touched.size(); ++p) {
    if (touched[p].dofs.empty()) continue;
    if (structure.parts[p]->size() > most) return W;
    if (!structure.parts[p]->is_flexible()) continue;
    const Eigen::SelfAdjointEigenSolver<Matrix> A(structure.parts[p]->flexibility(touched[p].dofs));
    const Vector roots = A.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    const Matrix rows = touched[p].motion * Matrix(A.eigenvectors() * roots.asDiagonal());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      if (const int row = place[static_cast<std::size_t>(touched[p].rows[static_cast<std::size_t>(i)])]; row >= 0)
        for (int k = 0; k < rows.cols(); ++k) entries.emplace_back(row, columns + k, rows(i, k));
    columns += static_cast<int>(rows.cols());
  }
  for (Eigen::Index row = 0; row < softness.size(); ++row)
    if (softness[row] > 0.0) entries.emplace_back(static_cast<int>(row), columns++, std::sqrt(softness[row]));
  if (W.size() == 0) return W;
  Eigen::SparseMatrix<double> of_rows(W.size(), columns);
  of_rows.setFromTriplets(entries.begin(), entries.end());
  return W.with_bodies(of_rows.transpose());
}

template <typename T>
std::vector<T> selected(const std::vector<T>& all, const std::vector<int>& which) {
  std::vector<T> some;
  for (int i : which) some.push_back(all[static_cast<std::size_t>(i)]);
  return some;
}

/// What a part has to do for its flexibility, roughly.
double work_of(const BodySystem& part, const Eigen::SparseMatrix<double>& motion) {
  if (!part.is_flexible()) return 0.0;
  const auto entries = static_cast<double>(motion.nonZeros());
  return 20.0 * static_cast<double>(motion.cols()) * entries + std::pow(entries, 3.0);
}

/// The flexibilities of all parts, and the diagonal of what each adds to W, on its rows. With `products` only the
/// diagonals: W is not formed.
struct Flexibilities {
  std::vector<PartFlexibility> of_part;
  std::vector<Vector> diagonals;
};
Flexibilities flexibilities_of(const std::vector<TouchedPart>& touched, const Structure& structure,
                               const std::vector<Eigen::SparseMatrix<double>>& motion, const PairProducts* products,
                               const Components& components, int threads) {
  Flexibilities found{std::vector<PartFlexibility>(structure.parts.size()),
                      std::vector<Vector>(structure.parts.size())};
  std::vector<double> work;
  for (std::size_t p = 0; p < structure.parts.size(); ++p) work.push_back(work_of(*structure.parts[p], motion[p]));
  linalg::parallel_for(work, threads, [&](int k) {
    const auto p = static_cast<std::size_t>(k);
    if (!structure.parts[p]->is_flexible()) return;
    Vector& diagonal = found.diagonals[p];
    if (products != nullptr) {
      const Matrix blocks = products->diagonal_blocks_of(p);
      diagonal.resize(static_cast<Eigen::Index>(touched[p].rows.size()));
      for (std::size_t i = 0; i < touched[p].rows.size(); ++i)
        diagonal[static_cast<Eigen::Index>(i)] =
            blocks(components.component_of(touched[p].rows[i]), touched[p].rows[i]);
    } else {
      found.of_part[p] = flexibility_of(touched[p], *structure.parts[p]);
      diagonal = found.of_part[p].block.diagonal();
    }
  });
  return found;
}

/// G of all pairs; sets the first column of each part.
Eigen::SparseMatrix<double> rigid_map_of(const Structure& structure,
                                         const std::vector<Eigen::SparseMatrix<double>>& motion, Eigen::Index rows,
                                         std::vector<int>& first_rigid) {
  Triplets entries;
  Eigen::Index columns = 0;
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    first_rigid.push_back(static_cast<int>(columns));
    const Matrix& rigid = structure.parts[p]->rigid_motions();
    for (Eigen::Index column = 0; column < motion[p].cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(motion[p], column); it; ++it)
        for (Eigen::Index k = 0; k < rigid.cols(); ++k)
          if (rigid(column, k) != 0.0) entries.emplace_back(it.row(), columns + k, it.value() * rigid(column, k));
    columns += rigid.cols();
  }
  Eigen::SparseMatrix<double> G(rows, columns);
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

/// Which pairs move. A pair whose gap is changed by no force and no rigid motion is held by supports on both sides.
std::vector<char> moving_pairs(const std::vector<TouchedPart>& touched, const Structure& structure,
                               const std::vector<Vector>& diagonals, const Eigen::SparseMatrix<double>& G,
                               const std::vector<PairPoints>& points, const Components& components) {
  Vector diagonal = Vector::Zero(G.rows()), moved = Vector::Zero(G.rows());  // of W; by rigid motions, at most
  double largest = 0.0, largest_on_springs = 0.0;  // of the diagonal; a soft spring says nothing of stiff bodies
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    if (diagonals[p].size() == 0) continue;
    diagonal(touched[p].rows) += diagonals[p];
    double& of_kind = structure.parts[p]->has_springs() ? largest_on_springs : largest;
    of_kind = std::max(of_kind, diagonals[p].maxCoeff());
  }
  if (largest == 0.0) largest = largest_on_springs;
  for (Eigen::Index k = 0; k < G.cols(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(G, k); it; ++it)
      moved[it.row()] = std::max(moved[it.row()], std::abs(it.value()));
  std::vector<char> moves;
  for (Eigen::Index row = 0; row < G.rows(); row += components.dimension)
    moves.push_back(diagonal[row] > 1e-13 * largest || moved[row] > 1e-12 ||
                    points[static_cast<std::size_t>(row / components.dimension)].softness > 0.0);
  return moves;
}

/// Of every row: springs act along the normal.
Vector softness_of(const std::vector<PairPoints>& points, const Components& components) {
  Vector softness = Vector::Zero(components.count(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) softness[components.of(i)] = points[i].softness;
  return softness;
}

/// All but the laws; `joints`: number of contacts among which the pairs are.
ContactSystem condensed(const Structure& structure, const std::vector<PairPoints>& points,
                        const std::vector<ContactSystem::Pair>& all, std::size_t joints, int threads) {
  ContactSystem system;
  if (!points.empty()) system.components = {static_cast<int>(points.front().directions.rows())};
  const Components components = system.components;
  const auto motion = motion_of(points, structure);
  const Eigen::Index rows = components.count(all.size());
  std::vector<TouchedPart> touched;
  for (const Eigen::SparseMatrix<double>& of_part : motion) touched.push_back(touched_part(of_part));
  const bool sparse = is_sparse(touched, structure, rows);
  // Bodies are joined by the positions of their nodes, in the plane.
  const bool has_positions = components.dimension == 2 && structure.dofs.parts() == structure.parts.size();
  std::shared_ptr<const JoinedBodies> joined;
  const bool is_joined = has_positions && !sparse && rows > least_joined;
  if (is_joined) joined = JoinedBodies::of(structure, motion, softness_of(points, components));
  const bool by_products = joined && rows > most_formed;
  const auto products = by_products ? std::make_unique<const PairProducts>(structure, motion) : nullptr;
  Flexibilities flexibilities = flexibilities_of(touched, structure, motion, products.get(), components, threads);

  Eigen::SparseMatrix<double> G = rigid_map_of(structure, motion, rows, system.first_rigid);
  const std::vector<char> moves = moving_pairs(touched, structure, flexibilities.diagonals, G, points, components);
  std::vector<int> moving, held, place(static_cast<std::size_t>(rows), -1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int k = 0; moves[i] && k < components.dimension; ++k)
      place[static_cast<std::size_t>(components.of(i, k))] = static_cast<int>(components.of(moving.size(), k));
    if (moves[i] || !all[i].is_bar()) (moves[i] ? moving : held).push_back(static_cast<int>(i));
  }
  system.pairs = selected(all, moving);
  system.held = selected(all, held);
  std::vector<int> numbers(joints, 0);
  for (ContactSystem::Pair& pair : system.pairs)
    pair.number = pair.is_bar() ? pair.index + 1 : ++numbers[static_cast<std::size_t>(pair.contact)];
  const Eigen::Index kept = components.count(moving.size());
  const bool all_move = moving.size() == all.size();
  system.motion = all_move ? motion : motion_of(selected(points, moving), structure);
  if (!all_move) {
    if (!held.empty()) system.held_motion = motion_of(selected(points, held), structure);
    if (joined) joined = JoinedBodies::of(structure, system.motion, softness_of(selected(points, moving), components));
    G = block_of(G, place, {}, kept, G.cols());
  }
  const Vector softness = softness_of(selected(points, moving), components);
  system.W = by_products ? contact::Delassus(std::make_shared<const PairProducts>(structure, system.motion, softness))
                         : sum_of(std::move(flexibilities.of_part), place, softness, sparse);
  if (joined) system.W = system.W.with_holder(joined);
  system.W = with_bodies(std::move(system.W), touched, structure, place, softness);
  system.G = contact::RigidMap(std::move(G));
  system.gap.resize(static_cast<Eigen::Index>(moving.size()));
  system.softness.resize(system.gap.size());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    system.gap[static_cast<Eigen::Index>(i)] = points[static_cast<std::size_t>(moving[i])].gap;
    system.softness[static_cast<Eigen::Index>(i)] = points[static_cast<std::size_t>(moving[i])].softness;
  }
  return system;
}

/// The system with these laws, some of which keep the gap of their pairs.
ContactSystem with_laws(ContactSystem system, contact::JointLaws laws) {
  system.laws = std::move(laws);
  for (std::size_t i = 0; i < system.laws.of_pair.size(); ++i)
    if (system.laws.of_pair[i]->keeps_gap()) system.gap[static_cast<Eigen::Index>(i)] = 0.0;
  return system;
}

/// A side of a pair that is a node of an elastic body, or a point of a rigid one.
PairSide side_of(const Dofs& dofs, int body, int node, const Vec2& point) {
  PairSide side{dofs.part_of(body), {}, point};
  if (node >= 0) side.nodes.push_back({dofs.node_in_part(body, node), 1.0});
  return side;
}

/// Adds a pair for each bar, whose normal is its direction.
void add_bars(const std::vector<BarSystem>& bars, std::vector<ContactSystem::Pair>& all,
              std::vector<PairPoints>& points) {
  for (std::size_t i = 0; i < bars.size(); ++i) {
    all.push_back({-1, static_cast<int>(i), 0});
    PairPoints made{bars[i].a, bars[i].b, {}, 0.0, bars[i].softness};
    made.directions.resize(2, 2);
    made.directions << bars[i].direction, tangent_of(bars[i].direction);
    points.push_back(std::move(made));
  }
}

}  // namespace

ContactSystem condense(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh, int threads) {
  std::vector<ContactSystem::Pair> all;
  std::vector<PairPoints> points;
  for (std::size_t c = 0; c < mesh.interfaces.size(); ++c) {
    const auto contact = static_cast<int>(c);
    const std::optional<double>& modulus = model.contacts[c].modulus;
    const std::vector<double> areas = modulus ? tributary_areas(contact, model, mesh) : std::vector<double>();
    for (std::size_t i = 0; i < mesh.interfaces[c].pairs.size(); ++i) {
      const mesh::ContactPair& pair = mesh.interfaces[c].pairs[i];
      all.push_back({contact, static_cast<int>(i), 0});
      points.push_back({side_of(structure.dofs, model.contacts[c].a.body, pair.node_a, mesh.point_of(contact, pair, 0)),
                        side_of(structure.dofs, model.contacts[c].b.body, pair.node_b, mesh.point_of(contact, pair, 1)),
                        {},
                        pair.gap,
                        modulus ? 1.0 / (*modulus * areas[i]) : 0.0});
      points.back().directions.resize(2, 2);
      points.back().directions << pair.normal, tangent_of(pair.normal);
    }
  }
  add_bars(structure.bars, all, points);
  ContactSystem system = condensed(structure, points, all, model.contacts.size(), threads);
  contact::JointLaws laws = contact_laws(system.pairs, model, mesh);
  return with_laws(std::move(system), std::move(laws));
}

ContactSystem condense(const Structure& structure, const std::vector<PairPoints>& pairs, const contact::JointLaws& laws,
                       int threads) {
  std::vector<ContactSystem::Pair> all;
  for (std::size_t i = 0; i < pairs.size(); ++i) all.push_back({0, static_cast<int>(i), 0});
  ContactSystem system = condensed(structure, pairs, all, 1, threads);
  std::vector<int> kept;
  for (const ContactSystem::Pair& pair : system.pairs) kept.push_back(pair.index);
  contact::JointLaws of_kept{selected(laws.of_pair, kept), Vector(laws.area(kept))};
  return with_laws(std::move(system), std::move(of_kept));
}

}  // namespace scabo::system
