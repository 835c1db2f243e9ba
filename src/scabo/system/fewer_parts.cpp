#include "scabo/system/fewer_parts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "scabo/contact/pair_operator.hpp"

namespace scabo::system {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

template <typename T>
std::vector<T> kept_of(const std::vector<T>& all, const std::vector<int>& which) {
  std::vector<T> some;
  for (int i : which) some.push_back(all[static_cast<std::size_t>(i)]);
  return some;
}
/// What is not there: parts, and bars whose stiffness does not act yet.
struct Missing {
  const std::vector<char>&parts, &bars;
};

bool is_there(const ContactSystem::Pair& pair, const Structure& structure, const model::Model& model,
              const Missing& missing) {
  if (!pair.is_bar()) {
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(pair.contact)];
    return !missing.parts[structure.dofs.part_of(contact.a.body)] &&
           !missing.parts[structure.dofs.part_of(contact.b.body)];
  }
  const auto number = static_cast<std::size_t>(pair.index);
  if (!missing.bars.empty() && missing.bars[number]) return false;
  const BarSystem& bar = structure.bars[number];
  const auto has_end = [&](const PairSide& side) { return side.part == PairSide::ground || !missing.parts[side.part]; };
  return has_end(bar.a) && has_end(bar.b);
}

/// Which pairs are there, and the new number of each of their rows, -1 of the others.
std::vector<int> pairs_there(const std::vector<ContactSystem::Pair>& pairs, const Components& components,
                             const std::function<bool(const ContactSystem::Pair&)>& is_there,
                             std::vector<int>& row_place) {
  std::vector<int> there;
  row_place.assign(static_cast<std::size_t>(components.count(pairs.size())), -1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!is_there(pairs[i])) continue;
    for (int k = 0; k < components.dimension; ++k)
      row_place[static_cast<std::size_t>(components.of(i, k))] = static_cast<int>(components.of(there.size(), k));
    there.push_back(static_cast<int>(i));
  }
  return there;
}
}  // namespace

Eigen::SparseMatrix<double> block_of(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& row_place,
                                     const std::vector<int>& column_place, Eigen::Index rows, Eigen::Index columns) {
  Triplets entries;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    const int to = column_place.empty() ? static_cast<int>(column) : column_place[static_cast<std::size_t>(column)];
    if (to < 0) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
      if (const int row = row_place[static_cast<std::size_t>(it.row())]; row >= 0)
        entries.emplace_back(row, to, it.value());
  }
  Eigen::SparseMatrix<double> block(rows, columns);
  block.setFromTriplets(entries.begin(), entries.end());
  return block;
}

contact::Delassus block_of(const contact::Delassus& W, const std::vector<int>& place) {
  std::vector<int> rows;
  for (std::size_t row = 0; row < place.size(); ++row)
    if (place[row] >= 0) rows.push_back(static_cast<int>(row));
  const auto kept = static_cast<Eigen::Index>(rows.size());
  if (rows.empty()) return {};
  if (const Eigen::SparseMatrix<double>* Y = W.bodies()) {
    Eigen::SparseMatrix<double> of_rows = block_of(Y->transpose(), place, {}, kept, Y->rows());
    contact::Delassus block = W.is_sparse() ? contact::Delassus(block_of(W.sparse(), place, place, kept, kept))
                                            : contact::Delassus(Matrix(W.dense()(rows, rows)));
    return block.with_bodies(of_rows.transpose());
  }
  if (W.is_sparse()) return contact::Delassus(block_of(W.sparse(), place, place, kept, kept));
  if (const contact::PairHolder* holder = W.is_dense() ? nullptr : W.holder())
    if (Matrix block = holder->flexibility(rows); block.rows() == kept) return block;
  return Matrix(W.dense()(rows, rows));
}

ContactSystem with_pairs(const ContactSystem& whole, const Structure& structure, const std::vector<char>& absent,
                         const std::function<bool(const ContactSystem::Pair&)>& is_there) {
  ContactSystem system;
  std::vector<int> place, held_place, rigid_place(static_cast<std::size_t>(whole.rigid_motions()), -1);
  system.components = whole.components;
  const std::vector<int> there = pairs_there(whole.pairs, whole.components, is_there, place),
                         held = pairs_there(whole.held, whole.components, is_there, held_place);
  system.pairs = kept_of(whole.pairs, there);
  system.held = kept_of(whole.held, held);
  const auto kept = whole.components.count(there.size());
  int columns = 0;
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    system.motion.push_back(block_of(whole.motion[p], place, {}, kept, whole.motion[p].cols()));
    if (!whole.held_motion.empty())
      system.held_motion.push_back(block_of(whole.held_motion[p], held_place, {}, whole.components.count(held.size()),
                                            whole.held_motion[p].cols()));
    system.first_rigid.push_back(columns);
    for (Eigen::Index k = 0; !absent[p] && k < structure.parts[p]->rigid_motions().cols(); ++k)
      rigid_place[static_cast<std::size_t>(whole.first_rigid[p] + k)] = columns++;
  }
  system.W = block_of(whole.W, place);
  system.G = contact::RigidMap(block_of(whole.G.sparse(), place, rigid_place, kept, columns));
  system.gap.resize(static_cast<Eigen::Index>(there.size()));
  system.laws.of_pair = kept_of(whole.laws.of_pair, there);
  system.laws.area = Vector(whole.laws.area(there));
  system.softness = Vector(whole.softness(there));
  for (std::size_t i = 0; i < there.size(); ++i) system.gap[static_cast<Eigen::Index>(i)] = whole.gap[there[i]];
  return system;
}

std::vector<Eigen::Index> places_in(const std::vector<ContactSystem::Pair>& before,
                                    const std::vector<ContactSystem::Pair>& pairs) {
  std::map<std::pair<int, int>, Eigen::Index> numbers;  // by contact and index
  for (std::size_t i = 0; i < before.size(); ++i)
    numbers.emplace(std::pair(before[i].contact, before[i].index), static_cast<Eigen::Index>(i));
  std::vector<Eigen::Index> places;
  for (const ContactSystem::Pair& pair : pairs) {
    const auto known = numbers.find({pair.contact, pair.index});
    places.push_back(known == numbers.end() ? -1 : known->second);
  }
  return places;
}

ContactSystem without_parts(const ContactSystem& whole, const Structure& structure, const model::Model& model,
                            const std::vector<char>& absent, const std::vector<char>& waiting) {
  const Missing missing{absent, waiting};
  return with_pairs(whole, structure, absent,
                    [&](const ContactSystem::Pair& pair) { return is_there(pair, structure, model, missing); });
}

}  // namespace scabo::system
