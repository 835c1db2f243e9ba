// Validation of staged construction: bodies and supports that are added or removed in steps.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/model/checking.hpp"
#include "scabo/model/stay.hpp"

namespace scabo::model {

namespace {

template <typename Staged>
Stay stay_of(const Staged& of) {
  return {of.added, of.removed};
}

/// `what`: body or support.
template <typename Staged>
void check_named_steps(Checking& checking, const std::string& path, const Staged& of, const char* what) {
  const auto steps = static_cast<int>(checking.model.steps.size());
  if (of.added < 0 || of.added >= steps) checking.error(path, "added", "is not a step of the model");
  if (of.removed < -1 || of.removed >= steps) checking.error(path, "removed", "is not a step of the model");
  if (const auto wrong = wrong_removal(stay_of(of), checking.model.steps, checking.model.restart.has_value(), what))
    checking.error(path, "removed", *wrong);
}

void check_steps_of(Checking& checking, std::size_t index) {
  const Body& body = checking.model.bodies[index];
  const std::string path = path_of("bodies", body.name, index);
  checking.enter(body.source);
  check_named_steps(checking, path, body, "body");
  if (body.outside && body.is_staged())
    checking.error(path, body.added > 0 ? "added" : "removed",
                   "an unbounded body is always there: give the part that is added or removed a body of its own");
}

bool same_stages(const Body& a, const Body& b) { return a.added == b.added && a.removed == b.removed; }

/// Factors of loads before the first step; empty: 0.
std::vector<double> loads_at_start(const Model& model) {
  return model.restart ? model.restart->load_factors : std::vector<double>();
}

/// Whether a body is there from the start of a step to its end.
bool stays(const Body& body, std::size_t step) {
  const auto k = static_cast<int>(step);
  return body.is_there(k - 1) && body.is_there(k);
}

void check_loads_on_stages(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (!checking.load[i]) continue;
    const std::string path = path_of("loads", load.name, i);
    checking.enter(load.source);
    if (load.on) {
      const Body& body = checking.body(load.on->body);
      if (const auto never =
              load_never_acts(load.name, i, body.name, stay_of(body), model.steps, loads_at_start(model)))
        checking.error_of_key(path, "", *never);
      continue;
    }
    const auto* pores = std::get_if<PorePressure>(&load.kind);
    if (pores == nullptr) continue;
    for (const int c : pores->contacts)
      for (const Place Contact::*side : {&Contact::a, &Contact::b}) {
        const Contact& contact = model.contacts[static_cast<std::size_t>(c)];
        const Body& body = checking.body((contact.*side).body);
        for (std::size_t s = 0; s < model.steps.size(); ++s) {
          if (stays(body, s) || !acts_in(model.steps, loads_at_start(model), i, s)) continue;
          checking.error_of_key(path, "",
                                fmt::format("the pressure in contact '{}' acts in step '{}', in which body '{}' is not "
                                            "there from beginning to end: let its factor be 0 until the next step, or "
                                            "act on the edges by loads of their own",
                                            contact.name, model.steps[s].name, body.name));
          return;
        }
      }
  }
}

/// Whether a support can be pairs with the ground, and its body be there.
void check_staged_support(Checking& checking, std::size_t index) {
  const Model& model = checking.model;
  const Support& support = model.supports[index];
  const std::string path = path_of("supports", support.source, index);
  const char* key = support.added > 0 ? "added" : support.removed >= 0 ? "removed" : "";
  checking.enter(support.source);
  check_named_steps(checking, path, support, "support");
  const char* with = is_dynamic(model)                ? "steps in time"
                     : has_growth(model)              ? "cracks that grow"
                     : has_large_slip(model.contacts) ? "contacts with 'slip: large'"
                                                      : nullptr;
  if (with != nullptr)
    checking.error(path, key,
                   fmt::format("supports that begin or end are not available beside {}: leave one of them out", with));
  if (!checking.support[index]) return;
  const Body& body = checking.body(support.on.body);
  if (support.on.kind == Place::Kind::face || support.on.kind == Place::Kind::mouth)
    checking.error(path, key, "the face of a crack is held in all steps or in none: leave the key out");
  else if (body.outside)
    checking.error(path, key, "an unbounded body is held in all steps or in none: leave the key out");
  else if (const auto wrong = wrong_stay_on_body(stay_of(support), stay_of(body), body.name, model.steps))
    checking.error(path, support.added > 0 && support.added < body.added ? "added" : key, *wrong);
}

/// A displacement counts from where a body is placed, or its support begins.
void check_supports_of_stages(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    if (!checking.support[i]) continue;
    const Body& body = checking.body(support.on.body);
    const int added = std::max(body.added, support.added);
    const bool moves = support.displacement[0].value_or(0.0) != 0.0 || support.displacement[1].value_or(0.0) != 0.0 ||
                       support.rotation.value_or(0.0) != 0.0;
    if (!moves) continue;
    const std::string begins = support.added > body.added ? "it" : fmt::format("body '{}'", body.name);
    const auto early = displaced_too_early(support.name, i, added, begins, model.steps);
    if (!early) continue;
    checking.enter(support.source);
    checking.error(path_of("supports", support.source, i), "", *early);
  }
}

/// Error bars and tolerances solve a model on several meshes, which `with` does not allow.
void refuse_several_meshes(Checking& checking, const char* with) {
  const Model& model = checking.model;
  const auto refuse = [&](bool given, const std::string& section, const char* key) {
    if (!given) return;
    checking.enter({});
    checking.error_of_key(section, key,
                          fmt::format("cannot be combined with {}: compare runs with smaller elements instead", with));
  };
  refuse(model.tolerance.has_value(), "tolerance", "");
  refuse(model.output.error, "output", "error");
  refuse(!model.output.error_of.empty(), "output", "error_of");
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    refuse(model.bodies[b].mesh.tolerance.has_value(), path_of("bodies", model.bodies[b].name, b) + ".mesh",
           "tolerance");
}

}  // namespace

bool has_stages(const std::vector<Body>& bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.is_staged(); });
}

bool has_stages(const std::vector<Support>& supports) {
  return std::any_of(supports.begin(), supports.end(), [](const Support& support) { return support.is_staged(); });
}

void check_stages(Checking& checking) {
  const Model& model = checking.model;
  if (model.restart) refuse_several_meshes(checking, "a restart");
  if (has_stages(model.supports)) refuse_several_meshes(checking, "supports that begin or end in steps");
  const std::size_t before = checking.found.size();
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    if (model.supports[i].is_staged()) check_staged_support(checking, i);
  if (!has_stages(model.bodies)) {
    if (checking.found.size() == before && !checking.gaps.places) check_supports_of_stages(checking);
    return;
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) check_steps_of(checking, b);
  if (checking.gaps.bodies || checking.gaps.places || checking.gaps.conditions || checking.found.size() > before)
    return;
  for (std::size_t i = 0; i < model.ties.size(); ++i) {
    const Tie& tie = model.ties[i];
    const Body &a = checking.body(tie.a.body), &b = checking.body(tie.b.body);
    if (same_stages(a, b)) continue;
    checking.enter(tie.source);
    checking.error_of_key(path_of_joint("ties", tie.source, tie.name, i), "",
                          fmt::format("bodies '{}' and '{}' are tied, but are not added and removed in the same steps: "
                                      "use a contact with bond: true instead of the tie",
                                      a.name, b.name));
  }
  for (std::size_t s = 0; s < model.steps.size(); ++s) {
    const bool any = std::any_of(model.bodies.begin(), model.bodies.end(), [&](const Body& body) {
      return (!body.rigid || body.density) && body.is_there(static_cast<int>(s));
    });
    if (any) continue;
    checking.enter(model.steps[s].source);
    checking.error(path_of("steps", model.steps[s].source, s), "",
                   fmt::format("no elastic body is there in step '{}': at least one is needed", model.steps[s].name));
    break;
  }
  refuse_several_meshes(checking, "bodies that are added or removed in steps");
  check_loads_on_stages(checking);
  check_supports_of_stages(checking);
}

}  // namespace scabo::model
