#include "scabo/analysis/space/face_resultants.hpp"

#include <algorithm>

namespace scabo::analysis {

namespace {

mesh::SolidFacet sorted(mesh::SolidFacet facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

/// With the moment about the origin.
FaceResultant sum_over(const mesh::SolidMesh& mesh, const Vector& forces, const FaceActions::Share& share) {
  FaceResultant sum;
  const auto add = [&](Eigen::Index node) { sum.add(mesh.nodes.col(node), forces.segment<3>(3 * node)); };
  for (Eigen::Index node = 0; share.all && node < mesh.nodes.cols(); ++node) add(node);
  for (const int node : share.nodes) add(node);
  return sum;
}

}  // namespace

FaceActions::FaceActions(int body, const std::vector<mesh::SolidFacet>& facets, const Eigen::Vector3d& about)
    : body_(body), about_(about) {
  for (const mesh::SolidFacet& facet : facets) {
    facets_.insert(sorted(facet));
    nodes_.insert(facet.begin(), facet.end());
  }
}

std::optional<FaceActions::Share> FaceActions::share_of(const SolidPlaceOfAction& place) const {
  if (place.body != body_) return Share{};
  const auto here = std::count_if(place.facets.begin(), place.facets.end(),
                                  [&](const mesh::SolidFacet& facet) { return facets_.count(sorted(facet)) > 0; });
  const bool has_all = here == static_cast<std::ptrdiff_t>(place.facets.size());
  if (here > 0 && !has_all) return std::nullopt;
  if (has_all && here > 0 && place.nodes.empty()) return Share{true, {}};
  std::set<int> of_facets;
  for (const mesh::SolidFacet& facet : place.facets) of_facets.insert(facet.begin(), facet.end());
  Share share;
  if (has_all) share.nodes.assign(of_facets.begin(), of_facets.end());
  for (const int node : place.nodes)
    if (of_facets.count(node) == 0 && nodes_.count(node) > 0) share.nodes.push_back(node);
  return share;
}

void FaceActions::add_load(std::size_t load, const mesh::SolidMesh& mesh, const Vector& forces, const Share& share) {
  if (forces.size() > 0 && (share.all || !share.nodes.empty()))
    loads_.emplace_back(load, sum_over(mesh, forces, share));
}

void FaceActions::add_reactions(const SolidModel& model, int support, const Share& share) {
  const std::set<int> nodes(share.nodes.begin(), share.nodes.end());
  const auto counts = [&](const system::Constraint& held) {
    return held.support == support && (share.all || nodes.count(held.dof / 3) > 0);
  };
  const std::vector<system::Constraint>& constraints = model.bodies[static_cast<std::size_t>(body_)].supports;
  for (std::size_t c = 0; c < constraints.size(); ++c)
    if (counts(constraints[c])) constraints_.push_back(c);
  for (std::size_t k = 0; k < model.held_points.size(); ++k)
    if (model.held_points[k].body == body_ && counts(model.held_points[k].held)) held_points_.push_back(k);
}

void FaceActions::add_springs(std::size_t springs, Share share) {
  if (share.all || !share.nodes.empty()) springs_.emplace_back(springs, std::move(share));
}

void FaceActions::add_contact(std::size_t contact, bool on_b) { contacts_.emplace_back(contact, on_b); }

void FaceActions::add_bar(std::size_t bar, bool on_b, Share share) {
  if (share.all || !share.nodes.empty()) bars_.push_back({bar, on_b, std::move(share)});
}

FaceResultant FaceActions::resultant(const SolidModel& model, const SolidIncrement& increment) const {
  const auto b = static_cast<std::size_t>(body_);
  const mesh::SolidMesh& mesh = model.bodies[b].mesh;
  FaceResultant sum;
  if (!increment.absent.empty() && increment.absent[b] != 0) return sum;
  for (const auto& [load, at_one] : loads_) {
    const double factor = increment.factors.presence_of(b) * increment.factors.loads[static_cast<Eigen::Index>(load)];
    sum.force += factor * at_one.force;
    sum.moment += factor * at_one.moment;
  }
  const auto add_reaction = [&](const system::Constraint& held, double reaction) {
    sum.add(mesh.nodes.col(held.dof / 3), reaction * held.direction_in_space());
  };
  for (const std::size_t c : constraints_)
    add_reaction(model.bodies[b].supports[c], increment.reactions[b][static_cast<Eigen::Index>(c)]);
  for (const std::size_t k : held_points_)
    add_reaction(model.held_points[k].held, increment.held[static_cast<Eigen::Index>(k)]);
  for (const auto& [springs, share] : springs_) {
    const FaceResultant of = sum_over(mesh, -model.springs[springs].spring.times(increment.u[b]), share);
    sum.force += of.force;
    sum.moment += of.moment;
  }
  for (const auto& [contact, on_b] : contacts_) {
    for (const SolidPair& pair : increment.pairs)
      if (pair.contact == static_cast<int>(contact)) sum.force += (on_b ? 1.0 : -1.0) * pair.force;
    sum.moment += increment.moments_of_sides[contact][on_b ? 1 : 0];
  }
  for (const auto& [number, on_b, share] : bars_) {
    const SolidBar& bar = model.bars[number];
    const Eigen::Vector3d pull = (on_b ? -1.0 : 1.0) * increment.bars[number] * bar.direction;
    const std::set<int> counts(share.nodes.begin(), share.nodes.end());
    for (const system::PairSide::Node& node : (on_b ? bar.b : bar.a).nodes)
      if (share.all || counts.count(node.node) > 0) sum.add(mesh.nodes.col(node.node), node.weight * pull);
  }
  sum.moment -= about_.cross(sum.force);
  return sum;
}

}  // namespace scabo::analysis
