#include "scabo/analysis/growth/path_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/growth/split.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

/// A crack meets what lies within so many steps ahead of it.
constexpr double reach_of_tip = 1.5;

std::string crack_of(const TipResult& tip) { return tip.name.substr(0, tip.name.rfind('.')); }

}  // namespace

GrownCracks cracks_of(const model::Model& model, const std::vector<Tip>& tips, std::string ended) {
  GrownCracks grown;
  grown.ended = std::move(ended);
  for (const Tip& tip : tips)
    if (const std::string name = name_of_crack(model, tip); grown.paths.empty() || grown.paths.back().crack != name)
      grown.paths.push_back({name, crack_of(model, tip).path});
  return grown;
}

std::string end_wanted(const model::GrowthStep& growth, const GrowthResult& at, int number) {
  constexpr double rounding = 1e-9;
  if (growth.steps && number > *growth.steps) return model::counted(*growth.steps, "growth step") + " done";
  if (growth.load_factor && at.load_factor > *growth.load_factor)
    return fmt::format("further growth needs the load factor {:.6g}, above {}", at.load_factor,
                       model::number_text(*growth.load_factor));
  for (const TipResult& tip : at.tips) {
    if (growth.length && tip.length >= (1.0 - rounding) * *growth.length)
      return fmt::format("the crack of '{}' has the length {:.6g}", tip.name, tip.length);
    if (growth.tip && (tip.position - *growth.tip).norm() <= 0.5 * growth.step)
      return fmt::format("'{}' is at {}", tip.name, model::point_text(tip.position));
    if (growth.cycles && tip.load_factor <= 1.0)
      return fmt::format("the body breaks at '{}' after {:.6g} cycles, where K* reaches what it resists", tip.name,
                         *at.cycles);
  }
  return {};
}

std::vector<double> shares(const model::GrowthStep& growth, const GrowthResult& at,
                           const std::vector<CycledTip>& cycled, double whole) {
  std::vector<double> lengths;
  double sum = 0.0;
  for (std::size_t t = 0; t < at.tips.size(); ++t) {
    lengths.push_back(!at.tips[t].grows ? 0.0 : cycled.empty() ? 1.0 : cycled[t].rate);
    sum += lengths.back();
  }
  for (std::size_t t = 0; growth.length && t < at.tips.size(); ++t) {
    double of_crack = 0.0;
    for (std::size_t other = 0; other < at.tips.size(); ++other)
      if (crack_of(at.tips[other]) == crack_of(at.tips[t])) of_crack += lengths[other] / sum;
    if (of_crack > 0.0) whole = std::min(whole, (*growth.length - at.tips[t].length) / of_crack);
  }
  for (double& length : lengths) length *= whole / sum;
  return lengths;
}

double grown_between(const GrowthResult& before, const GrowthResult& after) {
  double sum = 0.0;
  for (const TipResult& tip : after.tips)
    for (const TipResult& was : before.tips)
      if (was.name == tip.name) sum += (tip.position - was.position).norm();
  return sum;
}

Vec2 turned(const Vec2& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

std::optional<Meetings> meetings(const model::Model& model, const std::vector<Tip>& tips, const GrowthResult& at,
                                 const std::vector<Vec2>& directions, const std::vector<double>& lengths) {
  Meetings met;
  met.at.resize(tips.size());
  met.model = model;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    if (!at.tips[t].grows) continue;
    const auto one = meeting(model, tips[t], at.tips[t].position + reach_of_tip * lengths[t] * directions[t]);
    if (!one) continue;
    extend(met.model, tips[t], one->at);
    met.at[t] = one->at;
    met.told += fmt::format("{}'{}' meets {} at {}", met.told.empty() ? "" : ", ", at.tips[t].name, one->what,
                            model::point_text(one->at));
  }
  if (met.told.empty()) return {};
  met.broken = std::any_of(met.model.bodies.begin(), met.model.bodies.end(), is_split);
  if (met.broken) met.told += ", and the body is broken";
  return met;
}

std::vector<Tip> without_met(const std::vector<Tip>& tips, const std::vector<std::optional<Vec2>>& met) {
  std::vector<Tip> left;
  for (std::size_t t = 0; t < tips.size(); ++t)
    if (!met[t]) left.push_back(tips[t]);
  return left;
}

void follow(model::Model& model, std::vector<Tip>& tips, const GrowthResult& here, const GrowthResult& next) {
  std::vector<std::optional<Vec2>> met;
  for (const TipResult& tip : here.tips) met.push_back(tip.meets);
  const bool meets = std::any_of(met.begin(), met.end(), [](const auto& at) { return at.has_value(); });
  for (std::size_t t = 0; t < tips.size(); ++t) {
    if (met[t])
      extend(model, tips[t], *met[t]);
    else if (here.tips[t].grows && !meets)
      extend(model, tips[t], next.tips[t].position);
  }
  tips = without_met(tips, met);
}

double length_until(const Meetings& met, const GrowthResult& at) {
  double sum = 0.0;
  for (std::size_t t = 0; t < met.at.size(); ++t)
    if (met.at[t]) sum += (*met.at[t] - at.tips[t].position).norm();
  return sum;
}

}  // namespace scabo::analysis
