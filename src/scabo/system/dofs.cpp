#include "scabo/system/dofs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace scabo::system {

namespace {

/// Sets that are joined two by two; the representative of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    int& parent = parent_[static_cast<std::size_t>(i)];
    while (parent != i) {
      const int above = parent_[static_cast<std::size_t>(parent)];
      if (above == parent) return parent;
      parent = above;
    }
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

Dofs::Dofs(const model::Model& model, const mesh::Mesh& mesh)
    : part_of_(model.bodies.size()), numbers_(model.bodies.size()) {
  DisjointSets bodies(model.bodies.size());
  for (const model::Tie& tie : model.ties) bodies.join(tie.a.body, tie.b.body);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int first = bodies.root(static_cast<int>(b));
    if (first == static_cast<int>(b)) {
      part_of_[b] = parts_.size();
      parts_.push_back({});
    } else {
      part_of_[b] = part_of_[static_cast<std::size_t>(first)];
    }
    Part& part = parts_[part_of_[b]];
    part.bodies.push_back(static_cast<int>(b));
    part.rigid = model.bodies[b].rigid;
    part.unbounded = part.unbounded || model.bodies[b].outside;
  }

  std::vector<int> first_node{0};  // of every body, among the nodes of all
  for (const mesh::BodyMesh& body : mesh.bodies)
    first_node.push_back(first_node.back() + static_cast<int>(body.nodes.size()));
  DisjointSets nodes(static_cast<std::size_t>(first_node.back()));
  for (std::size_t t = 0; t < mesh.ties.size(); ++t)
    for (const mesh::ContactPair& pair : mesh.ties[t].pairs)
      nodes.join(first_node[static_cast<std::size_t>(model.ties[t].a.body)] + pair.node_a,
                 first_node[static_cast<std::size_t>(model.ties[t].b.body)] + pair.node_b);

  std::vector<int> number(static_cast<std::size_t>(first_node.back()), -1);  // in its part, of every node of all
  for (Part& part : parts_)
    for (const int body : part.bodies) {
      const auto b = static_cast<std::size_t>(body);
      const std::vector<Vec2>& own = mesh.bodies[b].nodes;
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto all = static_cast<std::size_t>(first_node[b]) + i;
        int& of_root = number[static_cast<std::size_t>(nodes.root(static_cast<int>(all)))];
        if (of_root < 0) {
          of_root = static_cast<int>(part.nodes.size());
          part.nodes.push_back(own[i]);
        }
        if (part.bodies.size() > 1) numbers_[b].push_back(of_root);
      }
    }
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

std::vector<int> Dofs::of(int body, std::span<const int> nodes) const {
  std::vector<int> numbers;
  numbers.reserve(2 * nodes.size());
  for (const int node : nodes)
    for (int component = 0; component < 2; ++component) numbers.push_back(of(body, node, component));
  return numbers;
}

Vector Dofs::of_body(int body, const Vector& of_part) const {
  const std::vector<int>& number = numbers_[static_cast<std::size_t>(body)];
  if (number.empty()) return of_part;
  Vector values(static_cast<Eigen::Index>(2 * number.size()));
  for (std::size_t i = 0; i < number.size(); ++i)
    values.segment<2>(static_cast<Eigen::Index>(2 * i)) = of_part.segment<2>(2 * number[i]);
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
  for (std::size_t i = 0; i < number.size(); ++i)
    to_part.segment<2>(2 * number[i]) += values.segment<2>(static_cast<Eigen::Index>(2 * i));
}

}  // namespace scabo::system
