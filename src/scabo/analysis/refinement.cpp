#include "scabo/analysis/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace scabo::analysis {

namespace {

constexpr int highest_order = 10;
/// Fraction of the total error in the elements that are refined in a pass.
constexpr double bulk = 0.8;
/// Predicted reduction of the squared error by one more order; values of Melenk and Wohlmuth.
constexpr double after_raise = 0.4, after_divide = 4.0;
/// Length of the part at a corner relative to the whole, a value known to suit singularities.
constexpr double grading = 0.15;
/// Elements shorter than this, relative to their edge, are not divided: the stiffness loses about 1e-15 times the ratio
/// of the lengths of its elements (5e-10 measured for 1e-5), and energies lose as many digits.
constexpr double shortest = 1e-4;

using Partners = std::map<mesh::EdgeElement, mesh::EdgeElement>;
Partners partners_of(const model::Model& model, const mesh::Mesh& mesh) {
  Partners partner;
  for (const auto& [a, b] : mesh::paired_elements(model, mesh).alike) partner[a] = b, partner[b] = a;
  return partner;
}

}  // namespace

Refinement::Refinement(const model::Model& model) : model_(model), division_(mesh::uniform_division(model)) {
  for (const mesh::BodyDivision& body : division_) {
    auto& of_body = predicted_.emplace_back();
    for (const mesh::EdgeDivision& edge : body)
      of_body.emplace_back(edge.orders.size(), std::numeric_limits<double>::infinity());
  }
}

Refinement::Change Refinement::change_for(const mesh::EdgeElement& at, double share) const {
  const mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  const auto k = static_cast<std::size_t>(at.element);
  const bool as_predicted =
      share <= predicted_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)][k];
  const bool can_raise = edge.orders[k] < highest_order;
  const bool can_divide = edge.breaks[k + 1] - edge.breaks[k] > shortest;
  if (can_raise && (as_predicted || !can_divide)) return Change::raise;
  return can_divide ? Change::divide : Change::none;
}

bool Refinement::at_corner(const mesh::EdgeElement& at, bool start) const {
  const mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  return start ? at.element == 0 : at.element + 1 == static_cast<int>(edge.orders.size());
}

/// Where an element is divided, 0 at its start and 1 at its end.
double Refinement::cut_of(const mesh::EdgeElement& at) const {
  const bool start = at_corner(at, true), end = at_corner(at, false);
  return start == end ? 0.5 : start ? grading : 1.0 - grading;
}

void Refinement::divide_at_corners(const mesh::Mesh& mesh, const std::vector<mesh::EdgeElement>& elements) {
  const Partners partner = partners_of(model_, mesh);
  std::map<mesh::EdgeElement, double> cuts;
  for (const mesh::EdgeElement& at : elements) {
    if (!cuts.emplace(at, cut_of(at)).second) continue;
    if (const auto other = partner.find(at); other != partner.end()) cuts.emplace(other->second, 1.0 - cuts.at(at));
  }
  for (auto at = cuts.rbegin(); at != cuts.rend(); ++at)  // from the end: places before stay
    apply(at->first, Change::divide, at->second, std::numeric_limits<double>::infinity());
}

void Refinement::apply(const mesh::EdgeElement& at, Change change, double cut, double share) {
  mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  std::vector<double>& predicted = predicted_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  const auto k = static_cast<std::size_t>(at.element);
  if (change == Change::raise) {
    ++edge.orders[k];
    predicted[k] = after_raise * share;
    return;
  }
  const auto place = static_cast<std::ptrdiff_t>(k);
  edge.breaks.insert(edge.breaks.begin() + place + 1, std::lerp(edge.breaks[k], edge.breaks[k + 1], cut));
  const int order = edge.orders[k];
  edge.orders.insert(edge.orders.begin() + place, order);
  const auto left_over = [&](double part) { return 0.5 * after_divide * std::pow(part, 2.0 * order) * share; };
  predicted[k] = left_over(cut);
  predicted.insert(predicted.begin() + place + 1, left_over(1.0 - cut));
}

RefinementPass Refinement::refine(const mesh::Mesh& mesh, const std::vector<std::vector<double>>& shares,
                                  const std::vector<std::vector<bool>>& frozen) {
  struct Element {
    mesh::EdgeElement at;
    double share = 0.0;
  };
  std::vector<Element> elements;
  double sum = 0.0;
  for (int b = 0; b < static_cast<int>(division_.size()); ++b) {
    const auto body = static_cast<std::size_t>(b);
    if (!model_.bodies[body].mesh.tolerance) continue;
    for (int e = 0; e < static_cast<int>(division_[body].size()); ++e)
      for (int k = 0; k < static_cast<int>(division_[body][static_cast<std::size_t>(e)].orders.size()); ++k) {
        const int place = mesh::boundary_element(mesh.bodies[body], e, k);
        if (place < 0 || frozen[body][static_cast<std::size_t>(place)]) continue;
        const double share = shares[body][static_cast<std::size_t>(place)];
        elements.push_back({{b, e, k}, share});
        sum += share;
      }
  }
  std::stable_sort(elements.begin(), elements.end(), [](const auto& a, const auto& b) { return a.share > b.share; });

  // The requested changes, with equal changes for facing elements: division takes precedence over a higher order.
  const Partners partner = partners_of(model_, mesh);
  struct Wanted {
    Change change = Change::none;
    double share = 0.0, cut = 0.5;
  };
  std::map<mesh::EdgeElement, Wanted> wanted;
  std::map<mesh::EdgeElement, double> share_of;
  for (const Element& element : elements) share_of[element.at] = element.share;
  double held = 0.0;
  for (const Element& element : elements) {
    if (held >= bulk * sum || element.share <= 0.0) break;
    held += element.share;
    const Change change = change_for(element.at, element.share);
    if (change == Change::none) continue;
    const double cut = cut_of(element.at);
    const auto want = [&](const mesh::EdgeElement& at, double where) {
      Wanted& here = wanted[at];
      if (here.change == Change::divide || (here.change == Change::raise && change == Change::raise)) return;
      here = {change, share_of.contains(at) ? share_of.at(at) : element.share, where};
    };
    const auto other = partner.find(element.at);
    // An element that has already been divided because of its partner keeps that division.
    if (other != partner.end() && wanted.contains(other->second) && wanted[other->second].change == Change::divide)
      continue;
    want(element.at, cut);
    if (other != partner.end()) want(other->second, 1.0 - cut);
  }
  RefinementPass pass;
  for (auto at = wanted.rbegin(); at != wanted.rend(); ++at) {  // from the end: places before stay
    apply(at->first, at->second.change, at->second.cut, at->second.share);
    ++(at->second.change == Change::raise ? pass.raised : pass.divided);
  }
  return pass;
}

}  // namespace scabo::analysis
