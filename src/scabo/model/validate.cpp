#include "scabo/model/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

constexpr std::string_view of_command_line = "--set ";

std::string joined(std::string_view path, std::string_view key) {
  if (path.empty() || key.empty()) return std::string(path.empty() ? key : path);
  return fmt::format("{}.{}", path, key);
}

}  // namespace

Checking::Checking(const Model& checked, const Gaps& reader_gaps)
    : model(checked),
      gaps(reader_gaps),
      shape(checked.bodies.size(), 0),
      faces(checked.bodies.size(), 0),
      held(reader_gaps.held),
      touched(reader_gaps.touched),
      sprung(checked.bodies.size(), 0),
      support(checked.supports.size(), 0),
      load(checked.loads.size(), 0) {
  held.resize(checked.bodies.size(), 0);
  touched.resize(checked.bodies.size(), 0);
}

void Checking::enter(const Source& source) { line_ = source.line, column_ = source.column; }

void Checking::error(std::string_view path, std::string_view key, std::string message, std::string given) {
  found.push_back({{line_, column_, joined(path, key)}, std::move(message), std::move(given), false});
}

void Checking::error_of_key(std::string_view path, std::string_view key, std::string message) {
  found.push_back({{line_, column_, joined(path, key)}, std::move(message), {}, true});
}

bool Checking::number(std::string_view path, std::string_view key, double value) {
  // The bounds are those of numbers in a model file: beyond them squares overflow.
  const double size = std::abs(value);
  if (std::isfinite(value) && size <= 1e100 && (size >= 1e-100 || size == 0.0)) return true;
  if (!std::isfinite(value))
    error(path, key, fmt::format("must be a finite number, not '{}'", value), number_text(value));
  else if (size > 1.0)
    error(path, key, fmt::format("'{}' is larger in size than 1e100: write a smaller number", value));
  else
    error(path, key, fmt::format("'{}' is smaller in size than 1e-100: write 0 or a larger number", value));
  return false;
}

bool Checking::positive(std::string_view path, std::string_view key, double value) {
  if (!number(path, key, value)) return false;
  if (value > 0.0) return true;
  error(path, key, fmt::format("must be greater than 0, not {}", number_text(value)), number_text(value));
  return false;
}

bool Checking::not_negative(std::string_view path, std::string_view key, double value) {
  if (!number(path, key, value)) return false;
  if (value >= 0.0) return true;
  error(path, key, fmt::format("must be 0 or more, not {}", number_text(value)), number_text(value));
  return false;
}

bool Checking::vector(std::string_view path, std::string_view key, const Vec2& value) {
  return number(path, joined(key, "0"), value.x()) && number(path, joined(key, "1"), value.y());
}

bool Checking::whole(std::string_view path, std::string_view key, long value, const limits::Range& range) {
  if (value >= range.least && value <= range.most) return true;
  error(path, key, fmt::format("must be a whole number from {} to {}, not {}", range.least, range.most, value));
  return false;
}

bool Checking::within(std::string_view path, std::string_view key, double value, const char* least, const char* most) {
  if (!number(path, key, value)) return false;
  if (value >= std::strtod(least, nullptr) && value <= std::strtod(most, nullptr)) return true;
  error(path, key, fmt::format("must be from {} to {}, not {}", least, most, number_text(value)), number_text(value));
  return false;
}

std::string path_of(std::string_view section, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{}.{}", section, index) : fmt::format("{}.{}", section, name);
}

std::string path_of(std::string_view section, const Source& source, std::size_t index) {
  std::string_view path = source.path;
  if (path.starts_with(of_command_line)) path.remove_prefix(of_command_line.size());
  // A part that was copied from elsewhere may have another path.
  return path.starts_with(section) ? std::string(path) : fmt::format("{}.{}", section, index);
}

std::string path_of_joint(std::string_view section, const Source& source, const std::string& name, std::size_t index) {
  const std::string path = path_of(section, source, index), by_number = fmt::format("{}.{}", section, index);
  return path == by_number ? path_of(section, name, index) : path;
}

std::string path_of_load(const Load& load, std::size_t index) {
  const auto* at_rest = std::get_if<AtRest>(&load.kind);
  return at_rest == nullptr ? path_of("loads", load.name, index)
                            : path_of("springs", load.source, static_cast<std::size_t>(std::max(at_rest->spring, 0)));
}

void check_name(Checking& checking, const std::string& path, const std::string& name, const char* what,
                std::unordered_set<std::string>& before) {
  if (!is_name(name))
    checking.error_of_key(path, "",
                          fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin "
                                      "with a letter or _",
                                      name));
  else if (!before.insert(name).second)
    checking.error_of_key(path, "", fmt::format("another {} is already named '{}': rename one of them", what, name));
}

void check_analysis(Checking& checking) {
  const Analysis& analysis = checking.model.analysis;
  checking.positive("analysis", "thickness", analysis.thickness);
  checking.whole("analysis", "modes", analysis.modes, limits::modes);
}

void check_solver(Checking& checking) {
  const SolverOptions& solver = checking.model.solver;
  checking.within("solver", "tolerance", solver.tolerance, "1e-14", "1e-3");
  checking.whole("solver", "iterations", solver.iterations, limits::iterations);
  checking.whole("solver", "halvings", solver.halvings, limits::halvings);
#ifndef SCABO_MUMPS
  if (solver.factorisation == Factorisation::mumps)
    checking.error("solver", "factorisation",
                   "this program was built without MUMPS: write cholmod, or install libmumps-seq-dev, configure and "
                   "build again");
#endif
}

namespace {

/// Edges that coincide everywhere, or lie on one straight line, have neither gap nor interference.
bool coincide(const Edge& a, const Edge& b, double tolerance) {
  const auto is_on = [&](const Vec2& point) {
    return (point - geometry::foot_on(a, point)->point).norm() <= tolerance;
  };
  if (runs_straight(a) && runs_straight(b) && is_on(b.start) && is_on(b.end)) return true;
  return (a.start - b.end).norm() <= tolerance && (a.end - b.start).norm() <= tolerance &&
         (a.at(0.5) - b.at(0.5)).norm() <= tolerance;
}

/// Whether a contact alone may press its bodies together.
bool may_interfere(const Checking& checking, const Contact& contact) {
  if (contact.gap < 0.0) return true;
  if (contact.a.kind == Place::Kind::face) return false;  // faces of a crack lie on each other
  const Outline& a = checking.body(contact.a.body).outline;
  const Outline& b = checking.body(contact.b.body).outline;
  const double tolerance = 1e-9 * std::max(outline_size(a), outline_size(b));
  return !coincide(a.edges[static_cast<std::size_t>(contact.a.index)],
                   b.edges[static_cast<std::size_t>(contact.b.index)], tolerance);
}

}  // namespace

void check_fits(Checking& checking) {
  if (checking.gaps.conditions) return;
  for (std::size_t c = 0; c < checking.model.contacts.size(); ++c) {
    const Contact& contact = checking.model.contacts[c];
    if (contact.fit_in < 0) continue;
    const std::string path = path_of_joint("contacts", contact.source, contact.name, c);
    checking.enter(contact.source);
    if (contact.fit_in >= static_cast<int>(checking.model.steps.size()))
      checking.error(path, "fit_in", "is not a step of the model");
    else if (contact.bond)
      checking.error(path, "fit_in", "a bonded contact has no interference: leave 'fit_in' or 'bond' out");
    else if (!may_interfere(checking, contact))
      checking.error(path, "fit_in",
                     "this contact has no interference that could grow: give a negative 'gap', or bodies that overlap");
  }
}

void check_something_loads(Checking& checking) {
  const Model& model = checking.model;
  if (checking.gaps.conditions || !model.loads.empty() || model.bodies.empty()) return;
  for (const Support& support : model.supports) {
    if (support.rotation.value_or(0.0) != 0.0) return;
    for (const auto& displacement : support.displacement)
      if (displacement.value_or(0.0) != 0.0) return;
  }
  for (const Bar& bar : model.bars)
    if (bar.preload != 0.0) return;
  for (const Contact& contact : model.contacts)
    if (may_interfere(checking, contact)) return;
  if (model.restart) return;
  checking.enter({});
  checking.error_of_key("loads", "",
                        "the model has no loading: give a load, a prescribed displacement or an interference fit");
}

void check_bodies_held(Checking& checking) {
  if (checking.gaps.places) return;
  for (std::size_t i = 0; i < checking.model.bodies.size(); ++i) {
    const Body& body = checking.model.bodies[i];
    if (checking.touched[i]) continue;
    checking.enter(body.source);
    if (body.rigid) {
      if (checking.sprung[i]) continue;
      checking.error_of_key(
          path_of("bodies", body.name, i), "",
          fmt::format("rigid body '{}' is in no contact and has no effect: add a contact, or remove the body",
                      body.name));
      checking.of_whole();
    } else if (!checking.held[i] && !body.outside) {
      checking.error_of_key(
          path_of("bodies", body.name, i), "",
          fmt::format("body '{}' is insufficiently supported: it has no support, springs, contact or tie", body.name));
      checking.of_whole();
    }
  }
}

std::vector<Mistake> validate(const Model& model, const Gaps& gaps) {
  Checking checking(model, gaps);
  check_analysis(checking);
  check_solver(checking);
  check_materials(checking);
  check_bodies(checking);
  check_supports(checking);
  check_springs(checking);
  check_bars(checking);
  check_loads(checking);
  check_contacts_and_ties(checking);
  check_steps(checking);
  check_output(checking);
  check_quantities(checking);
  check_revolution(checking);

  check_density(checking);
  check_expansion(checking);
  const bool modal = model.analysis.type == AnalysisType::modal;
  if (!modal) {
    if (!is_all_dynamic(model)) check_bodies_held(checking);
    const bool may_be_shaken = is_shaken(model) || (is_dynamic(model) && checking.gaps.steps);
    if (model.initial.empty() && !may_be_shaken) check_something_loads(checking);
    check_initial(checking);
  }
  check_added_masses(checking);
  check_point_masses(checking);
  if (!checking.gaps.steps) {
    if (!modal) check_never_applied(checking);
    if (!modal) check_fits(checking);
    if (!modal) check_bars_in_steps(checking);
    if (!modal) check_entering(checking);
    if (!modal) check_stages(checking);
    check_growth_steps(checking);
    check_limit_steps(checking);
    check_conflicting_supports(checking);
  }
  return std::move(checking.found);
}

void require_valid(const Model& model) {
  std::vector<Mistake> mistakes = validate(model);
  if (mistakes.empty()) return;
  constexpr std::size_t most = 200;
  std::vector<Diagnostic> diagnostics;
  for (std::size_t i = 0; i < std::min(most, mistakes.size()); ++i)
    diagnostics.push_back({std::move(mistakes[i].at), std::move(mistakes[i].message)});
  if (mistakes.size() > most) diagnostics.push_back({{}, fmt::format("and {} more mistakes", mistakes.size() - most)});
  throw InputError(model.file.empty() ? "model" : model.file, std::move(diagnostics));
}

}  // namespace scabo::model
