#include "scabo/element/space/edge.hpp"

#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

namespace {

/// Calls `add` with N and the length of every point of the rule.
template <typename Add>
void along_edge(const Eigen::Matrix3d& nodes, const Add& add) {
  static const geometry::GaussRule rule = geometry::gauss_rule(5);
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double s = rule.points[i];
    const Eigen::Vector3d N(0.5 * s * (s - 1.0), 0.5 * s * (s + 1.0), 1.0 - s * s), N_s(s - 0.5, s + 0.5, -2.0 * s);
    add(N, rule.weights[i] * (nodes * N_s).norm());
  }
}

}  // namespace

Eigen::Vector3d length_weights(const Eigen::Matrix3d& nodes) {
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  along_edge(nodes, [&](const Eigen::Vector3d& N, double length) { weights += length * N; });
  return weights;
}

Eigen::Matrix3d line_load_integrals(const Eigen::Matrix3d& nodes,
                                    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& load) {
  Eigen::Matrix3d forces = Eigen::Matrix3d::Zero();
  along_edge(nodes,
             [&](const Eigen::Vector3d& N, double length) { forces += length * load(nodes * N) * N.transpose(); });
  return forces;
}

Eigen::Matrix3d length_mass(const Eigen::Matrix3d& nodes) {
  Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
  along_edge(nodes, [&](const Eigen::Vector3d& N, double length) { mass += length * N * N.transpose(); });
  return mass;
}

}  // namespace scabo::element
