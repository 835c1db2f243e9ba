#include "scabo/system/loads.hpp"

#include "scabo/geometry/line_basis.hpp"

namespace scabo::system {

namespace {

/// Calls `visit(N, x, n, ds)` at the integration points of an element: shape functions, position, outward normal,
/// weighted length.
template <typename Visit>
void integrate(const mesh::LineElement& element, const std::vector<Vec2>& nodes, Visit visit) {
  const auto& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
    const auto row = static_cast<Eigen::Index>(q);
    Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const Vec2& node = nodes[static_cast<std::size_t>(element.nodes[i])];
      x += basis.values_at_rule()(row, static_cast<Eigen::Index>(i)) * node;
      x_eta += basis.derivatives_at_rule()(row, static_cast<Eigen::Index>(i)) * node;
    }
    const double length = x_eta.norm();
    visit(basis.values_at_rule().row(row), x, Vec2(Vec2(x_eta.y(), -x_eta.x()) / length),
          basis.rule().weights[q] * length);
  }
}

}  // namespace

Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes, double thickness,
                       const TractionField& traction) {
  Vector f = Vector::Zero(static_cast<Eigen::Index>(2 * nodes.size()));
  for (const mesh::LineElement& element : elements)
    integrate(element, nodes, [&](const auto& N, const Vec2& x, const Vec2& n, double ds) {
      const Vec2 force = traction(x, n) * (ds * thickness);
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        f.segment<2>(2 * element.nodes[i]) += N[static_cast<Eigen::Index>(i)] * force;
    });
  return f;
}

double length_of(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes) {
  double length = 0.0;
  for (const mesh::LineElement& element : elements)
    integrate(element, nodes, [&](const auto&, const Vec2&, const Vec2&, double ds) { length += ds; });
  return length;
}

}  // namespace scabo::system
