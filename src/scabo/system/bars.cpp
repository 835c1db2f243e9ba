#include "scabo/system/bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

/// An end, and where it is drawn.
struct End {
  PairSide side;
  Vec2 at = Vec2::Zero();
};

/// Sets the weights N of the mean along some elements, and their middle.
void take_mean(const std::vector<mesh::LineElement>& elements, const mesh::BodyMesh& mesh, int body, const Dofs& dofs,
               End& end) {
  std::map<int, double> weight;  // by node of the body
  double length = 0.0;
  for (const mesh::LineElement& element : elements) {
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const auto& basis = geometry::LineBasis::of_order(order);
    const geometry::GaussRule rule = geometry::gauss_rule(order + 2);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Vector N = basis.values(rule.points[q]), N_eta = basis.derivatives(rule.points[q]);
      Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
      for (std::size_t i = 0; i < element.nodes.size(); ++i) {
        const Vec2& node = mesh.nodes[static_cast<std::size_t>(element.nodes[i])];
        x += N[static_cast<Eigen::Index>(i)] * node;
        x_eta += N_eta[static_cast<Eigen::Index>(i)] * node;
      }
      const double ds = rule.weights[q] * x_eta.norm();
      length += ds;
      end.at += ds * x;
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        weight[element.nodes[i]] += ds * N[static_cast<Eigen::Index>(i)];
    }
  }
  end.at /= length;
  for (const auto& [node, of_node] : weight)
    if (of_node != 0.0) end.side.nodes.push_back({dofs.node_in_part(body, node), of_node / length});
}

End end_of(const model::Bar::End& given, const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  End end;
  if (!given.on) {
    end.side.part = PairSide::ground;
    end.at = given.at;
    return end;
  }
  const model::Place& on = *given.on;
  const model::Body& body = model.bodies[static_cast<std::size_t>(on.body)];
  end.side.part = dofs.part_of(on.body);
  if (body.rigid) {
    const std::vector<Vec2> points = rigid_points(on, body);
    for (const Vec2& point : points) end.at += point / static_cast<double>(points.size());
    end.side.point = end.at;
    return end;
  }
  const mesh::BodyMesh& of_body = mesh.bodies[static_cast<std::size_t>(on.body)];
  const mesh::PlaceNodes at = mesh::nodes_of(on, mesh);
  if (on.kind == model::Place::Kind::edge) {
    take_mean(at.elements, of_body, on.body, dofs, end);
    return end;
  }
  end.at = of_body.nodes[static_cast<std::size_t>(at.nodes.front())];
  end.side.nodes.push_back({dofs.node_in_part(on.body, at.nodes.front()), 1.0});
  return end;
}

/// Adds the forces on a part of a force on one of its ends.
void add_force(const PairSide& side, const Vec2& force, const model::Model& model, const Dofs& dofs,
               std::vector<Vector>& forces) {
  if (side.part == PairSide::ground) return;
  Vector& of_part = forces[side.part];
  if (of_part.size() == 0) of_part = Vector::Zero(dofs.size(side.part));
  if (dofs.is_rigid(side.part)) {
    const model::Outline& outline = model.bodies[static_cast<std::size_t>(dofs.bodies_of(side.part).front())].outline;
    of_part += rigid_point(side.point, outline.centroid(), half_size(outline)).transpose() * force;
    return;
  }
  for (const PairSide::Node& node : side.nodes)
    of_part.segment<2>(plane_components.of(node.node, 0)) += node.weight * force;
}

}  // namespace

std::vector<BarSystem> bars_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  std::vector<BarSystem> bars;
  for (const model::Bar& bar : model.bars) {
    const End a = end_of(bar.between[0], model, mesh, dofs), b = end_of(bar.between[1], model, mesh, dofs);
    const double length = (b.at - a.at).norm(), size = std::max(a.at.norm(), b.at.norm());
    if (!(length > 1e-9 * size))
      throw InputError(model.file, {{bar.source, fmt::format("both ends of bar '{}' are at ({:.6g}, {:.6g}), so that "
                                                             "it has no direction: move one of them",
                                                             bar.name, a.at.x(), a.at.y())}});
    BarSystem made{a.side, b.side, (b.at - a.at) / length, 0.0, std::vector<Vector>(dofs.parts())};
    made.softness = bar.stiffness ? 1.0 / *bar.stiffness : length / (bar.young * bar.area);
    add_force(made.a, made.direction, model, dofs, made.pull);
    add_force(made.b, -made.direction, model, dofs, made.pull);
    bars.push_back(std::move(made));
  }
  return bars;
}

}  // namespace scabo::system
