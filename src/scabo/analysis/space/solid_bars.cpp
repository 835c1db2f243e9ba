#include "scabo/analysis/space/solid_bars.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/system/solid_edges.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

void SolidBar::pull(double tension, std::vector<Vector>& forces) const {
  for (const auto& [side, sign] : {std::pair(&a, 1.0), std::pair(&b, -1.0)}) {
    if (side->part == system::PairSide::ground) continue;
    for (const system::PairSide::Node& node : side->nodes)
      forces[side->part].segment<3>(in_space.of(node.node)) += sign * tension * node.weight * direction;
  }
}

namespace {

/// The mean of facets of body `body`.
SolidBarEnd mean_of_facets(const mesh::SolidMesh& mesh, std::size_t body, const std::vector<mesh::SolidFacet>& facets) {
  SolidBarEnd end{{body, {}}, Eigen::Vector3d::Zero()};
  const Vector along_x = system::traction_forces(mesh, facets, Eigen::Vector3d::UnitX());  // int N dA
  const double area = system::area_of_facets(mesh, facets);
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const double weight = along_x[in_space.of(i)] / area;
    if (weight == 0.0) continue;
    end.side.nodes.push_back({static_cast<int>(i), weight});
    end.at += weight * mesh.nodes.col(i);
  }
  return end;
}

/// The mean of edges.
SolidBarEnd mean_of_edges(const mesh::SolidMesh& mesh, std::size_t body, const std::vector<mesh::SolidEdge>& edges) {
  SolidBarEnd end{{body, {}}, Eigen::Vector3d::Zero()};
  const Vector weights = system::length_weights_of(mesh, edges) / system::length_of_edges(mesh, edges);
  for (const int node : mesh::nodes_of_edges(edges)) {
    end.side.nodes.push_back({node, weights[node]});
    end.at += weights[node] * mesh.nodes.col(node);
  }
  return end;
}

/// The mean of some nodes.
SolidBarEnd mean_of_nodes(const mesh::SolidMesh& mesh, std::size_t body, const std::vector<int>& nodes) {
  SolidBarEnd end{{body, {}}, Eigen::Vector3d::Zero()};
  for (const int node : nodes) {
    end.side.nodes.push_back({node, 1.0 / static_cast<double>(nodes.size())});
    end.at += end.side.nodes.back().weight * mesh.nodes.col(node);
  }
  return end;
}

}  // namespace

SolidBarEnd end_of_bar(const SolidModel& model, const model::SpaceBar::End& end, const SolidPlaceOfAction& place) {
  if (end.of_body() < 0) return {{system::PairSide::ground, {}}, end.at};
  const auto b = static_cast<std::size_t>(end.of_body());
  const SolidBody& of = model.bodies[b];
  if (!end.on && of.rigid_at) return {side_at(model, end.body, end.at), end.at};
  if (!place.edges.empty()) return mean_of_edges(of.mesh, b, place.edges);
  return place.facets.empty() ? mean_of_nodes(of.mesh, b, place.nodes) : mean_of_facets(of.mesh, b, place.facets);
}

std::variant<SolidBar, std::string> bar_between(const SolidBarEnd& a, const SolidBarEnd& b,
                                                const model::SpaceBar& given) {
  const double length = (b.at - a.at).norm();
  if (!(length > 1e-9 * std::max(a.at.norm(), b.at.norm())))
    return fmt::format(
        "both ends of bar '{}' are at ({:.6g}, {:.6g}, {:.6g}), so that it has no direction: move one of "
        "them",
        given.name, a.at.x(), a.at.y(), a.at.z());
  model::Stay stay;
  if (given.preload != 0.0) stay.added = given.tightened + 1;
  return SolidBar{a.side,
                  b.side,
                  (b.at - a.at) / length,
                  given.stiffness ? 1.0 / *given.stiffness : length / (given.young * given.area),
                  given.preload,
                  stay};
}

int node_nearest(const mesh::SolidMesh& mesh, const Eigen::Vector3d& at) {
  Eigen::Index nearest = 0;
  (mesh.nodes.colwise() - at).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

system::PairPoints points_of(const SolidBar& bar) {
  system::PairPoints points{bar.a, bar.b, {}, 0.0, bar.softness};
  points.directions.resize(3, 3);
  const Eigen::Vector3d t = bar.direction.unitOrthogonal();
  points.directions << bar.direction, t, bar.direction.cross(t);
  return points;
}

bool has_both_ends(const PreparedSolids& prepared, const SolidBar& bar) {
  const auto is_there = [&](const system::PairSide& side) {
    return side.part == system::PairSide::ground || !prepared.is_absent(side.part);
  };
  return is_there(bar.a) && is_there(bar.b);
}

double given_tension(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t bar) {
  const SolidBar& of = prepared.model.bars[bar];
  return has_both_ends(prepared, of) && factors.bars.size() > 0
             ? factors.bars[static_cast<Eigen::Index>(bar)] * of.preload
             : 0.0;
}

std::vector<double> tensions_of_bars(const PreparedSolids& prepared, const SolidFactors& factors, const Vector& p) {
  std::vector<double> tensions;
  for (std::size_t i = 0; i < prepared.model.bars.size(); ++i) tensions.push_back(given_tension(prepared, factors, i));
  const std::vector<system::ContactSystem::Pair>& pairs = prepared.contact().pairs;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (prepared.is_bar(pairs[k])) tensions[prepared.bar(pairs[k])] -= p[in_space.of(static_cast<Eigen::Index>(k))];
  return tensions;
}

}  // namespace scabo::analysis
