#include "scabo/analysis/space/solid_bars.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "scabo/analysis/space/prepared_solids.hpp"
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

/// The mean of some nodes.
SolidBarEnd mean_of_nodes(const mesh::SolidMesh& mesh, std::size_t body, const std::vector<int>& nodes) {
  SolidBarEnd end{{body, {}}, Eigen::Vector3d::Zero()};
  for (const int node : nodes) {
    end.side.nodes.push_back({node, 1.0 / static_cast<double>(nodes.size())});
    end.at += end.side.nodes.back().weight * mesh.nodes.col(node);
  }
  return end;
}

/// A point that moves with a rigid body: the mean of all nodes, with the least sum of squares of weights, that lies
/// there.
SolidBarEnd point_of_rigid(const mesh::SolidMesh& mesh, std::size_t body, const Eigen::Vector3d& at) {
  const Eigen::Vector3d centre = mesh.nodes.rowwise().mean();
  const Matrix arms = mesh.nodes.colwise() - centre;
  const Eigen::Vector3d turned = Eigen::Matrix3d(arms * arms.transpose()).ldlt().solve(at - centre);
  SolidBarEnd end{{body, {}}, at};
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    end.side.nodes.push_back(
        {static_cast<int>(i), 1.0 / static_cast<double>(mesh.nodes.cols()) + arms.col(i).dot(turned)});
  return end;
}

}  // namespace

SolidBarEnd end_of_bar(const SolidModel& model, const model::SpaceBar::End& end, const SolidPlaceOfAction& place) {
  if (!end.on && end.body < 0) return {{system::PairSide::ground, {}}, end.at};
  const auto b = static_cast<std::size_t>(end.on ? end.on->body : end.body);
  const SolidBody& of = model.bodies[b];
  if (!end.on && of.rigid_at) return point_of_rigid(of.mesh, b, end.at);
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
  return SolidBar{a.side, b.side, (b.at - a.at) / length,
                  given.stiffness ? 1.0 / *given.stiffness : length / (given.young * given.area), given.preload};
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

std::vector<char> waiting_bars(const SolidModel& model, const SolidFactors& before) {
  std::vector<char> waiting;
  for (std::size_t i = 0; i < model.bars.size(); ++i) {
    const bool tightened = before.bars.size() > 0 && before.bars[static_cast<Eigen::Index>(i)] >= 1.0;
    waiting.push_back(model.bars[i].preload != 0.0 && !tightened);
  }
  return waiting;
}

double given_tension(const SolidModel& model, const SolidFactors& factors, std::size_t bar) {
  return factors.bars.size() > 0 ? factors.bars[static_cast<Eigen::Index>(bar)] * model.bars[bar].preload : 0.0;
}

double elongation(const SolidBar& bar, const std::vector<Vector>& u) {
  double d = 0.0;
  for (const auto& [side, sign] : {std::pair(&bar.a, -1.0), std::pair(&bar.b, 1.0)}) {
    if (side->part == system::PairSide::ground) continue;
    for (const system::PairSide::Node& node : side->nodes)
      d += sign * node.weight * bar.direction.dot(u[side->part].segment<3>(in_space.of(node.node)));
  }
  return d;
}

WithoutWaiting::WithoutWaiting(const std::vector<system::ContactSystem::Pair>& pairs, std::size_t contact_pairs,
                               const std::vector<char>& waiting)
    : all_(static_cast<Eigen::Index>(pairs.size())) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (!pairs[k].is_bar() || !waiting[static_cast<std::size_t>(pairs[k].index) - contact_pairs])
      there_.push_back(static_cast<int>(k));
}

contact::Problem WithoutWaiting::of(const contact::Problem& problem) const {
  const auto kept = in_space.count(static_cast<Eigen::Index>(there_.size()));
  std::vector<int> place(static_cast<std::size_t>(in_space.count(all_)), -1);
  for (std::size_t i = 0; i < there_.size(); ++i)
    for (int k = 0; k < 3; ++k)
      place[static_cast<std::size_t>(in_space.of(there_[i], k))] = static_cast<int>(in_space.of(i, k));
  contact::Problem fewer = problem;
  fewer.W = system::block_of(problem.W, place);
  fewer.G = contact::RigidMap(system::block_of(problem.G.sparse(), place, {}, kept, problem.G.cols()));
  fewer.q = of(problem.q);
  return fewer;
}

contact::JointLaws WithoutWaiting::of(const contact::JointLaws& laws) const {
  contact::JointLaws fewer{{}, laws.area(there_)};
  for (const int i : there_) fewer.of_pair.push_back(laws.of_pair[static_cast<std::size_t>(i)]);
  return fewer;
}

contact::History WithoutWaiting::of(const contact::History& history) const {
  contact::History fewer;
  for (const int i : there_) fewer.push_back(history[static_cast<std::size_t>(i)]);
  return fewer;
}

Vector WithoutWaiting::of(const Vector& forces) const {
  Vector fewer(in_space.count(static_cast<Eigen::Index>(there_.size())));
  for (std::size_t i = 0; i < there_.size(); ++i)
    fewer.segment<3>(static_cast<Eigen::Index>(3 * i)) = forces.segment<3>(in_space.of(there_[i]));
  return fewer;
}

void WithoutWaiting::put_back(const contact::History& before, contact::Evolution& evolution) const {
  contact::Solution& solution = evolution.solution;
  const contact::Solution found = solution;
  const contact::History history = evolution.history;
  solution.p = Vector::Zero(in_space.count(all_));
  solution.slip_increment = Vector::Zero(2 * all_);
  solution.gap = Vector::Zero(all_);
  solution.states.assign(static_cast<std::size_t>(all_), contact::ContactState::open);
  evolution.history = before;
  for (std::size_t i = 0; i < there_.size(); ++i) {
    const auto from = static_cast<Eigen::Index>(i), to = static_cast<Eigen::Index>(there_[i]);
    solution.p.segment<3>(3 * to) = found.p.segment<3>(3 * from);
    solution.slip_increment.segment<2>(2 * to) = found.slip_increment.segment<2>(2 * from);
    solution.gap[to] = found.gap[from];
    solution.states[static_cast<std::size_t>(to)] = found.states[i];
    evolution.history[static_cast<std::size_t>(to)] = history[i];
  }
}

}  // namespace scabo::analysis
