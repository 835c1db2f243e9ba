// Validation of bars, and of beds of springs in contacts.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

/// An end on a body; the body is then held as a contact holds it.
void check_end(Checking& checking, const std::string& path, const Place& on) {
  bool good = check_place(checking, path, on);
  if (checking.is_body(on.body)) checking.touched[static_cast<std::size_t>(on.body)] = 1;
  if (good && (on.kind == Place::Kind::body || on.kind == Place::Kind::face)) {
    checking.error(path, "",
                   fmt::format("'{}' is {}: a bar ends at a corner, a point or an edge of a body, or at a point [x, y] "
                               "of the ground",
                               text_of(checking.model, on),
                               on.kind == Place::Kind::body ? "a whole body" : "the face of a crack"));
    good = false;
  }
  if (!good) checking.gaps.conditions = true;
}

/// Where an end is drawn, if that does not depend on the mesh.
std::optional<Vec2> drawn_at(const Checking& checking, const Bar::End& end) {
  if (!end.on) return end.at;
  if (end.on->kind != Place::Kind::corner || !checking.is_body(end.on->body)) return std::nullopt;
  const auto& corners = checking.body(end.on->body).outline.corners;
  const auto index = static_cast<std::size_t>(end.on->index);
  return index < corners.size() ? std::optional(corners[index].position) : std::nullopt;
}

/// A bar has a direction.
void check_direction(Checking& checking, const std::string& path, const Bar& bar) {
  const std::optional<Vec2> a = drawn_at(checking, bar.between[0]), b = drawn_at(checking, bar.between[1]);
  if (a && b && (*b - *a).norm() <= 1e-9 * std::max(a->norm(), b->norm()))
    checking.error(path, "between",
                   fmt::format("has both ends at {}, and so no direction: move one of them", point_text(*a)));
}

/// What holds the length of a bar: k, or its area and its Young's modulus.
void check_stiffness(Checking& checking, const std::string& path, const Bar& bar) {
  const bool good = bar.stiffness
                        ? checking.positive(path, "k", *bar.stiffness)
                        : checking.positive(path, "area", bar.area) && checking.positive(path, "young", bar.young);
  if (!good || !checking.number(path, "preload", bar.preload)) checking.gaps.conditions = true;
}

/// The first thing of the model that does not go with what the places of pairs have `of`.
void refuse_beside(Checking& checking, const std::string& path, const char* key, const char* what) {
  const Model& model = checking.model;
  const char* with = is_dynamic(model)                ? "steps in time"
                     : has_growth(model)              ? "cracks that grow"
                     : has_large_slip(model.contacts) ? "contacts with 'slip: large'"
                                                      : nullptr;
  if (with != nullptr)
    checking.error(path, key, fmt::format("{} not available beside {}: leave one of them out", what, with));
}

/// Bars that are tightened join bodies that are there from then on.
void check_tightened(Checking& checking, const std::string& path, const Bar& bar) {
  const Model& model = checking.model;
  if ((bar.tightened < 0 && !model.restart) || bar.tightened >= static_cast<int>(model.steps.size())) {
    checking.error(path, "tightened", "is not a step of the model");
    return;
  }
  for (const Bar::End& end : bar.between) {
    if (!end.on || !checking.is_body(end.on->body)) continue;
    const Body& body = checking.body(end.on->body);
    if (body.added <= std::max(bar.tightened, 0) && body.removed < 0) continue;
    checking.error(path, "preload",
                   fmt::format("is applied in step '{}', from which on body '{}' is not always there: tighten the bar "
                               "later, or leave its preload out",
                               model.steps[static_cast<std::size_t>(bar.tightened)].name, body.name));
    return;
  }
}

}  // namespace

void check_bars(Checking& checking) {
  const Model& model = checking.model;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < model.bars.size(); ++i) {
    const Bar& bar = model.bars[i];
    const std::string path = path_of("bars", bar.name, i);
    checking.enter(bar.source);
    check_name(checking, path, bar.name, "bar", names);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string key = fmt::format("between.{}", k);
      if (const auto& on = bar.between[k].on)
        check_end(checking, path + "." + key, *on);
      else
        checking.vector(path, key, bar.between[k].at);
    }
    check_stiffness(checking, path, bar);
    check_direction(checking, path, bar);
    if (!bar.between[0].on && !bar.between[1].on)
      checking.error(path, "between", "has both ends in the ground, which does not move: put one of them on a body");
    if (model.analysis.revolved())
      checking.error(path, "",
                     "a bar between two points is that of a plane body; around an axis give an edge 'springs', or draw "
                     "the bar as a body");
  }
}

void check_bars_in_steps(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.bars.size(); ++i) {
    const Bar& bar = model.bars[i];
    const std::string path = path_of("bars", bar.name, i);
    checking.enter(bar.source);
    refuse_beside(checking, path, "", "bars are");
    if (bar.preload != 0.0) check_tightened(checking, path, bar);
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (!contact.modulus) continue;
    const std::string path = path_of_joint("contacts", contact.source, contact.name, c);
    checking.enter(contact.source);
    refuse_beside(checking, path, "modulus", "a bed of springs is");
  }
}

}  // namespace scabo::model
