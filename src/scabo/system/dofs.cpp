#include "scabo/system/dofs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/base/disjoint_sets.hpp"

namespace scabo::system {

Dofs::Dofs(const model::Model& model, const mesh::Mesh& mesh)
    : components_(mesh.components()),
      revolved_(model.analysis.revolved()),
      part_of_(model.bodies.size()),
      numbers_(model.bodies.size()) {
  DisjointSets bodies(model.bodies.size());
  for (const model::Tie& tie : model.ties)
    bodies.join(static_cast<std::size_t>(tie.a.body), static_cast<std::size_t>(tie.b.body));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const std::size_t first = bodies.root(b);
    if (first == b) parts_.push_back({});
    part_of_[b] = first == b ? parts_.size() - 1 : part_of_[first];
    Part& part = parts_[part_of_[b]];
    part.bodies.push_back(static_cast<int>(b));
    part.rigid = model.bodies[b].rigid;
    part.unbounded = part.unbounded || model.bodies[b].outside;
  }

  std::vector<std::size_t> first_node{0};  // of every body, among the nodes of all
  for (const mesh::BodyMesh& body : mesh.bodies) first_node.push_back(first_node.back() + body.nodes.size());
  DisjointSets nodes(first_node.back());
  const auto among_all = [&](int body, int node) {
    return first_node[static_cast<std::size_t>(body)] + static_cast<std::size_t>(node);
  };
  for (std::size_t t = 0; t < mesh.ties.size(); ++t)
    for (const mesh::ContactPair& pair : mesh.ties[t].pairs)
      nodes.join(among_all(model.ties[t].a.body, pair.node_a), among_all(model.ties[t].b.body, pair.node_b));

  std::vector<int> number(first_node.back(), -1);  // in its part, of every node of all
  for (Part& part : parts_)
    for (const int body : part.bodies) {
      const auto b = static_cast<std::size_t>(body);
      const std::vector<Vec2>& own = mesh.bodies[b].nodes;
      for (std::size_t i = 0; i < own.size(); ++i) {
        int& of_root = number[nodes.root(first_node[b] + i)];
        if (of_root < 0) {
          of_root = static_cast<int>(part.nodes.size());
          part.nodes.push_back(own[i]);
        }
        if (part.bodies.size() > 1) numbers_[b].push_back(of_root);
      }
    }
  for (Part& part : parts_)
    for (const Vec2& x : part.nodes) part.rounding = std::max(part.rounding, 1e-9 * x.lpNorm<Eigen::Infinity>());
}

std::string Dofs::name_of(std::size_t part, const model::Model& model) const {
  const std::vector<int>& bodies = parts_[part].bodies;
  constexpr std::size_t most = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i)
    names += fmt::format("{}'{}'", i > 0 ? ", " : "", model.bodies[static_cast<std::size_t>(bodies[i])].name);
  if (bodies.size() > most) names += fmt::format(" and {} more", bodies.size() - most);
  return (bodies.size() == 1 ? "body " : "the tied bodies ") + names;
}

Vector Dofs::translation(std::size_t part, int component) const {
  Vector u = Vector::Zero(size(part));
  const Eigen::Index nodes = parts_[part].rigid ? 1 : static_cast<Eigen::Index>(parts_[part].nodes.size());
  for (Eigen::Index node = 0; node < nodes; ++node) u[components_.of(node, component)] = 1.0;
  return u;
}

std::vector<int> Dofs::of(int body, std::span<const int> nodes) const {
  std::vector<int> numbers;
  numbers.reserve(static_cast<std::size_t>(components_.count(nodes.size())));
  for (const int node : nodes)
    for (int component = 0; component < components_.dimension; ++component)
      numbers.push_back(of(body, node, component));
  return numbers;
}

Vector Dofs::of_body(int body, const Vector& of_part) const {
  const std::vector<int>& number = numbers_[static_cast<std::size_t>(body)];
  if (number.empty()) return of_part;
  const int d = components_.dimension;
  Vector values(components_.count(number.size()));
  for (std::size_t i = 0; i < number.size(); ++i)
    values.segment(components_.of(i), d) = of_part.segment(components_.of(number[i]), d);
  return values;
}

void Dofs::add(int body, const Vector& values, Vector& to_part) const {
  if (values.size() == 0) return;
  if (to_part.size() == 0) to_part = Vector::Zero(size(part_of(body)));
  const std::vector<int>& number = numbers_[static_cast<std::size_t>(body)];
  if (number.empty()) {
    to_part += values;
    return;
  }
  const int d = components_.dimension;
  for (std::size_t i = 0; i < number.size(); ++i)
    to_part.segment(components_.of(number[i]), d) += values.segment(components_.of(i), d);
}

}  // namespace scabo::system
