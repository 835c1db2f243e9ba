#include "scabo/system/springs.hpp"

#include <cmath>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Calls `visit(N, x, n, ds)` at the integration points of an element of an edge: shape functions, position, outward
/// normal, weighted length. Normals of arcs are those of the arc, so that the normal springs around a circle do not
/// resist its rotation. `edge`: null on the face of a crack.
template <typename Visit>
void integrate(const mesh::LineElement& element, const std::vector<Vec2>& nodes, const model::Edge* edge, Visit visit) {
  const int order = static_cast<int>(element.nodes.size()) - 1;
  const auto& basis = geometry::LineBasis::of_order(order);
  const geometry::GaussRule rule = geometry::gauss_rule(3 * order / 2 + 2);  // N, N and x,eta of curved elements
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Vector N = basis.values(rule.points[q]), N_eta = basis.derivatives(rule.points[q]);
    Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      x += N[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(element.nodes[i])];
      x_eta += N_eta[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(element.nodes[i])];
    }
    const double length = x_eta.norm();
    Vec2 n = Vec2(x_eta.y(), -x_eta.x()) / length;
    if (edge != nullptr && edge->arc)
      if (const auto foot = geometry::foot_on(*edge, x)) n = foot->normal;
    visit(N, x, n, rule.weights[q] * length);
  }
}

/// k_n n n' + k_t t t'.
Mat2 tensor_of(const model::Spring& spring, const Vec2& n) {
  const Vec2 t(-n.y(), n.x());
  return spring.stiffness[0] * n * n.transpose() + spring.stiffness[1] * t * t.transpose();
}

/// The displacement at which the springs are without force.
Vec2 at_rest_of(const model::Spring& spring, const Vec2& n) {
  return spring.at_rest[0] * n + spring.at_rest[1] * Vec2(-n.y(), n.x());
}

/// The directions with springs among two that are at right angles. `share`: of the length of the spring. At the tip of
/// a crack elements are so short that rounding of their nodes turns their normals by 1e-9, and so many that they must
/// not count as others do.
void hold(const model::Spring& spring, const Vec2& x, const Vec2& first, double share,
          std::vector<HeldDirection>& held) {
  const double weight = std::sqrt(share);
  if (spring.stiffness[0] > 0.0) held.push_back({x, weight * first});
  if (spring.stiffness[1] > 0.0) held.push_back({x, weight * Vec2(-first.y(), first.x())});
}

double length_of(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                 const model::Edge* edge) {
  double length = 0.0;
  for (const mesh::LineElement& element : elements)
    integrate(element, nodes, edge, [&](const Vector&, const Vec2&, const Vec2&, double ds) { length += ds; });
  return length;
}

class Assembly {
 public:
  Assembly(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs)
      : model_(model), mesh_(mesh), dofs_(dofs) {}

  /// S and f of one spring.
  struct OfSpring {
    linalg::SparseMatrix S;
    Vector f;
  };
  /// Adds the directions that it holds.
  OfSpring add(const model::Spring& spring, std::vector<HeldDirection>& held) const {
    Triplets entries;
    const auto b = static_cast<std::size_t>(spring.on.body);
    const Eigen::Index size = dofs_.size(dofs_.part_of(spring.on.body));
    OfSpring made{linalg::SparseMatrix(size, size), Vector::Zero(size)};
    if (model_.bodies[b].rigid)
      add_to_rigid(spring, model_.bodies[b], entries, made.f, held);
    else
      add_to_elastic(spring, mesh_.bodies[b], entries, made.f, held);
    made.S.setFromTriplets(entries.begin(), entries.end());
    return made;
  }

 private:
  const model::Edge* edge_of(const model::Spring& spring) const {
    if (spring.on.kind != model::Place::Kind::edge) return nullptr;
    return &model_.bodies[static_cast<std::size_t>(spring.on.body)]
                .outline.edges[static_cast<std::size_t>(spring.on.index)];
  }

  void add_to_elastic(const model::Spring& spring, const mesh::BodyMesh& mesh, Triplets& entries, Vector& f,
                      std::vector<HeldDirection>& held) const {
    const mesh::PlaceNodes at = mesh::nodes_of(spring.on, mesh_);
    if (!model::acts_along(spring)) {
      for (int k = 0; k < 2; ++k) {
        const int dof = dofs_.of(spring.on.body, at.nodes.front(), k);
        const auto axis = static_cast<std::size_t>(k);
        entries.emplace_back(dof, dof, spring.stiffness[axis]);
        f[dof] += spring.stiffness[axis] * spring.at_rest[axis];
      }
      hold(spring, mesh.nodes[static_cast<std::size_t>(at.nodes.front())], Vec2::UnitX(), 1.0, held);
      return;
    }
    const double length = length_of(at.elements, mesh.nodes, edge_of(spring));
    for (const mesh::LineElement& element : at.elements)
      integrate(element, mesh.nodes, edge_of(spring), [&](const Vector& N, const Vec2& x, const Vec2& n, double ds) {
        const Mat2 k = tensor_of(spring, n) * (ds * model::extent_of(model_, spring.on.body).at(x.x()));
        const Vec2 force = k * at_rest_of(spring, n);
        hold(spring, x, n, ds / length, held);
        for (std::size_t i = 0; i < element.nodes.size(); ++i)
          for (int row = 0; row < 2; ++row)
            f[dofs_.of(spring.on.body, element.nodes[i], row)] += N[static_cast<Eigen::Index>(i)] * force[row];
        for (std::size_t i = 0; i < element.nodes.size(); ++i)
          for (std::size_t j = 0; j < element.nodes.size(); ++j)
            for (int row = 0; row < 2; ++row)
              for (int column = 0; column < 2; ++column)
                entries.emplace_back(
                    dofs_.of(spring.on.body, element.nodes[i], row), dofs_.of(spring.on.body, element.nodes[j], column),
                    N[static_cast<Eigen::Index>(i)] * N[static_cast<Eigen::Index>(j)] * k(row, column));
      });
  }

  void add_to_rigid(const model::Spring& spring, const model::Body& body, Triplets& entries, Vector& f,
                    std::vector<HeldDirection>& held) const {
    const Vec2 reference = body.outline.centroid();
    const double lever = half_size(body.outline);
    Matrix S = Matrix::Zero(3, 3);
    const auto add = [&](const Vec2& x, const Mat2& k, const Vec2& at_rest) {
      const Eigen::Matrix<double, 2, 3> R = rigid_point(x, reference, lever);
      S += R.transpose() * k * R;
      f += R.transpose() * k * at_rest;
    };
    if (!model::acts_along(spring)) {
      const Vec2 x = rigid_points(spring.on, body).front();
      add(x, Vec2(spring.stiffness[0], spring.stiffness[1]).asDiagonal(), Vec2(spring.at_rest[0], spring.at_rest[1]));
      hold(spring, x, Vec2::UnitX(), 1.0, held);
    } else {
      const EdgeElements edge = elements_of(*edge_of(spring));
      const double length = length_of(edge.elements, edge.nodes, edge_of(spring));
      for (const mesh::LineElement& element : edge.elements)
        integrate(element, edge.nodes, edge_of(spring), [&](const Vector&, const Vec2& x, const Vec2& n, double ds) {
          add(x, tensor_of(spring, n) * (ds * model::extent_of(model_, spring.on.body).at(x.x())),
              at_rest_of(spring, n));
          hold(spring, x, n, ds / length, held);
        });
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entries.emplace_back(i, j, S(i, j));
  }

  const model::Model& model_;
  const mesh::Mesh& mesh_;
  const Dofs& dofs_;
};

}  // namespace

ModelSprings springs_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  ModelSprings springs;
  springs.of_part.resize(dofs.parts());
  const Assembly assembly(model, mesh, dofs);
  for (const model::Spring& spring : model.springs) {
    Springs& of_part = springs.of_part[dofs.part_of(spring.on.body)];
    Assembly::OfSpring made = assembly.add(spring, of_part.directions);
    springs.of_spring.push_back(std::move(made.S));
    springs.at_rest.push_back(std::move(made.f));
    const linalg::SparseMatrix& S = springs.of_spring.back();
    of_part.matrix = of_part.none() ? S : linalg::SparseMatrix(of_part.matrix + S);
  }
  return springs;
}

std::vector<Vec2> spring_resultants(const ModelSprings& springs, const model::Model& model, const Dofs& dofs,
                                    const std::vector<Vector>& u, const std::vector<double>& factors) {
  std::vector<double> of_rest(springs.of_spring.size(), 0.0);
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (const auto* at_rest = std::get_if<model::AtRest>(&model.loads[l].kind))
      of_rest[static_cast<std::size_t>(at_rest->spring)] = factors[l];
  std::vector<Vec2> resultants;
  for (std::size_t s = 0; s < springs.of_spring.size(); ++s) {
    const std::size_t part = dofs.part_of(model.springs[s].on.body);
    Vector forces = -(springs.of_spring[s] * u[part]);
    if (of_rest[s] != 0.0) forces += of_rest[s] * springs.at_rest[s];
    resultants.emplace_back(dofs.is_rigid(part) ? Vec2(forces.head<2>())
                                                : Vec2(forces.reshaped(2, forces.size() / 2).rowwise().sum()));
  }
  return resultants;
}

}  // namespace scabo::system
