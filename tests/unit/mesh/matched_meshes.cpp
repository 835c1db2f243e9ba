#include "matched_meshes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace scabo::test {

using mesh::BodyMesh;
using mesh::Cell;
using mesh::CellKind;
using mesh::ContactPair;
using mesh::Interface;
using mesh::LineElement;

model::Model blocks(int m, int n, int order_a, int order_b, double gap) {
  return pair_of(elastic("lower", rectangle({0, -2}, {12, 2}), 12.0 / m, order_a), "top",
                 elastic("upper", rectangle({0, gap}, {12, 2}), 12.0 / n, order_b), "bottom");
}

std::vector<double> breaks_of(const BodyMesh& mesh, int edge) {
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(edge)];
  const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  std::vector<double> breaks{0.0};
  for (const LineElement& element : elements)
    breaks.push_back(breaks.back() + (at(element.nodes.back()) - at(element.nodes.front())).norm());
  return breaks;
}

std::vector<double> x_of(const Interface& joint) {
  std::vector<double> x;
  for (const ContactPair& pair : joint.pairs) x.push_back(pair.point_a.x());
  return x;
}

double area_of(const BodyMesh& mesh) {
  double twice = 0.0;
  for (const Cell& cell : mesh.cells) {
    const std::vector<int> nodes = cell.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      twice += cross(mesh.nodes[static_cast<std::size_t>(nodes[i])],
                     mesh.nodes[static_cast<std::size_t>(nodes[(i + 1) % nodes.size()])]);
  }
  return 0.5 * twice;
}

namespace {

void expect_sound(const model::Body& body, const BodyMesh& mesh) {
  std::set<int> used;
  std::set<std::vector<int>> elements;
  for (const Cell& cell : mesh.cells) {
    for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
      const std::vector<int>& nodes = cell.boundary[k].nodes;
      used.insert(nodes.begin(), nodes.end());
      elements.insert(nodes);
      elements.insert({nodes.rbegin(), nodes.rend()});
      const bool last = k + 1 == cell.boundary.size();
      if (!last || !cell.is_open()) {
        EXPECT_EQ(nodes.back(), cell.boundary[last ? 0 : k + 1].nodes.front());
      }
    }
    EXPECT_TRUE(cell.materials.size() == 1 || cell.materials.size() == cell.boundary.size());
  }
  EXPECT_EQ(used.size(), mesh.nodes.size());
  EXPECT_EQ(*used.rbegin() + 1, static_cast<int>(mesh.nodes.size()));
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    for (const LineElement& element : mesh.edges[e]) EXPECT_TRUE(elements.contains(element.nodes));
    for (std::size_t k = 0; k + 1 < mesh.edges[e].size(); ++k) {
      const Vec2 gap = mesh.nodes[static_cast<std::size_t>(mesh.edges[e][k].nodes.back())] -
                       mesh.nodes[static_cast<std::size_t>(mesh.edges[e][k + 1].nodes.front())];
      EXPECT_EQ(gap.norm(), 0.0);
    }
    if (mesh.corners[e] >= 0) {
      EXPECT_LT((mesh.nodes[static_cast<std::size_t>(mesh.corners[e])] - body.outline.edges[e].start).norm(), 1e-12);
    }
  }
  if (mesh.cells.size() == 1 && mesh.count(CellKind::superelement) == 1) {
    const std::vector<int> nodes = mesh.cells.front().nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_EQ(nodes[i], static_cast<int>(i));
  }
}

}  // namespace

mesh::Mesh sound_mesh(const model::Model& model) {
  mesh::Mesh mesh = mesh::make_mesh(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].rigid) expect_sound(model.bodies[b], mesh.bodies[b]);
  return mesh;
}

}  // namespace scabo::test
