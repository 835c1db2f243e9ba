#include "scabo/analysis/free_motions.hpp"

#include <map>

#include "scabo/analysis/increment.hpp"
#include "scabo/analysis/large_slip.hpp"

namespace scabo::analysis {

namespace {

/// What determines a factor in every step: its value at the end, and the curve it follows. A restart comes first.
using Course = std::vector<std::pair<double, int>>;

Course course_of(const model::Model& model, bool support, std::size_t index) {
  Course course;
  if (model.restart)
    course.emplace_back((support ? model.restart->support_factors : model.restart->load_factors)[index], -1);
  for (const model::Step& step : model.steps)
    course.emplace_back((support ? step.support_factors : step.load_factors)[index],
                        support ? model::support_curve(step, index) : model::load_curve(step, index));
  return course;
}

bool moves(const model::Support& support) {
  return support.displacement[0].value_or(0.0) != 0.0 || support.displacement[1].value_or(0.0) != 0.0 ||
         support.rotation.value_or(0.0) != 0.0;
}

}  // namespace

FreeMotions::FreeMotions(const model::Model& model) {
  std::map<Course, std::size_t> group_of;
  const auto group = [&](bool support, std::size_t index) -> Group& {
    const auto [at, added] = group_of.emplace(course_of(model, support, index), groups_.size());
    if (added) groups_.emplace_back();
    return groups_[at->second];
  };
  for (std::size_t load = 0; load < model.loads.size(); ++load) group(false, load).loads.push_back(load);
  for (std::size_t support = 0; support < model.supports.size(); ++support)
    if (moves(model.supports[support])) group(true, support).supports.push_back(support);
}

double FreeMotions::Group::factor(const Factors& factors) const {
  return loads.empty() ? factors.supports[supports.front()] : factors.loads[loads.front()];
}

void FreeMotions::find(const Prepared& prepared, Group& group) const {
  const system::ContactSystem& contact = prepared.contact;
  group.motions = {Vector::Zero(static_cast<Eigen::Index>(2 * contact.pairs.size())),
                   Vector::Zero(static_cast<Eigen::Index>(2 * contact.held.size()))};
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    Vector forces = Vector::Zero(part.size());
    for (const std::size_t load : group.loads)
      if (prepared.structure.loads[load][p].size() > 0) forces += prepared.structure.loads[load][p];
    std::vector<char> moved(prepared.model.supports.size(), 0);
    for (const std::size_t support : group.supports) moved[support] = 1;
    Vector prescribed = Vector::Zero(static_cast<Eigen::Index>(part.constraints().size()));
    for (std::size_t c = 0; c < part.constraints().size(); ++c)
      if (moved[static_cast<std::size_t>(part.constraints()[c].support)])
        prescribed[static_cast<Eigen::Index>(c)] = part.constraints()[c].value;
    if (forces.isZero(0.0) && prescribed.isZero(0.0)) continue;
    const Vector u = part.displacement(forces, prescribed);
    group.motions.moving.noalias() += contact.motion[p] * u;
    if (!contact.held.empty()) group.motions.held.noalias() += contact.held_motion[p] * u;
  }
  group.known = true;
}

FreeMotions::OfPairs FreeMotions::at(const Prepared& prepared, const Factors& factors) {
  OfPairs motions{Vector::Zero(static_cast<Eigen::Index>(2 * prepared.contact.pairs.size())),
                  Vector::Zero(static_cast<Eigen::Index>(2 * prepared.contact.held.size()))};
  for (Group& group : groups_) {
    const double factor = group.factor(factors);
    if (factor == 0.0) continue;
    if (!group.known) find(prepared, group);
    motions.moving += factor * group.motions.moving;
    motions.held += factor * group.motions.held;
  }
  return motions;
}

std::shared_ptr<FreeMotions> free_motions_worth_keeping(const model::Model& model) {
  if (model::has_stages(model.bodies) || has_large_slip(model) || model.contacts.empty()) return nullptr;
  int increments = 0;
  for (const model::Step& step : model.steps) increments += model::expected_increments(step);
  auto motions = std::make_shared<FreeMotions>(model);
  return motions->groups() < static_cast<std::size_t>(increments) ? motions : nullptr;
}

}  // namespace scabo::analysis
