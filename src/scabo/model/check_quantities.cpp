// Validation of numbers with an error bar, and of the tolerance of one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/model/checking.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::model {

namespace {

/// Whether meshes of the body can be refined for a tolerance.
bool can_be_refined(const Body& body) { return !body.rigid && !body.image; }

bool check_number_of(Checking& checking, const std::string& path, const char* what, int index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return true;
  checking.error(path, "",
                 fmt::format("there is no {} number {}: the model has {}, counted from 0", what, index, count));
  return false;
}

void check_crack_of(Checking& checking, const std::string& path, const Quantity& quantity, bool with_bar) {
  if (!check_number_of(checking, path, "body", quantity.index, checking.model.bodies.size())) return;
  const Body& body = checking.body(quantity.index);
  if (body.rigid) {
    checking.error(path, "", fmt::format("body '{}' is rigid, and has no stress intensity factors", body.name));
    return;
  }
  if (body.mesh.centre_corner >= 0 && quantity.crack == name_of_centre_corner(body)) {
    if (body.outside)
      checking.error(path, "",
                     fmt::format("body '{}' reaches to infinity: only bodies of finite size have factors", body.name));
    else if (with_bar)
      checking.error(path, "",
                     "the factors of a corner at the scaling centre have a history, but no error bar: ask for them "
                     "under output.history, or give the body a crack");
    return;
  }
  const std::string crack = quantity.crack.substr(0, quantity.crack.find('.')),
                    end = quantity.crack.substr(crack.size());
  const auto found =
      std::find_if(body.cracks.begin(), body.cracks.end(), [&](const Crack& of) { return of.name == crack; });
  if (found == body.cracks.end())
    checking.error(path, "", fmt::format("body '{}' has no crack named '{}'", body.name, crack));
  else if (!end.empty() && (found->path.empty() || (end != ".start" && end != ".end")))
    checking.error(path, "",
                   fmt::format("crack '{}' has no '{}': {}", crack, end.substr(1),
                               found->path.empty() ? fmt::format("write {}.{}.K_I", body.name, crack)
                                                   : "its ends are start and end"));
}

void check_broken_of(Checking& checking, const std::string& path, const Quantity& quantity) {
  if (!check_number_of(checking, path, "contact", quantity.index, checking.model.contacts.size())) return;
  const Contact& contact = checking.model.contacts[static_cast<std::size_t>(quantity.index)];
  if (contact.cohesion == 0.0 && contact.tension == 0.0)
    checking.error(path, "",
                   fmt::format("contact '{}' has no cohesion, so that none of its pairs breaks", contact.name));
}

void check_pores_of(Checking& checking, const std::string& path, const Quantity& quantity) {
  if (!check_number_of(checking, path, "contact", quantity.index, checking.model.contacts.size())) return;
  const auto is_in = [&](const Load& load) {
    const auto* pores = std::get_if<PorePressure>(&load.kind);
    return pores && std::find(pores->contacts.begin(), pores->contacts.end(), quantity.index) != pores->contacts.end();
  };
  const std::vector<Load>& loads = checking.model.loads;
  if (checking.gaps.conditions || std::any_of(loads.begin(), loads.end(), is_in)) return;
  const std::string& name = checking.model.contacts[static_cast<std::size_t>(quantity.index)].name;
  checking.error(path, "",
                 fmt::format("no pressure or water is in contact '{0}': ask for {0}.normal_force, or give a load "
                             "{{in: {0}, pressure: ...}}",
                             name));
}

void check_moment_of(Checking& checking, const std::string& path, const Quantity& quantity) {
  if (!check_number_of(checking, path, "support", quantity.index, checking.model.supports.size())) return;
  const Support& support = checking.model.supports[static_cast<std::size_t>(quantity.index)];
  if (!support.rotation)
    checking.error(path, "",
                   fmt::format("support '{}' prescribes no rotation and has no moment: ask for that of an edge, "
                               "{{edge: wall.bottom}}",
                               support.name));
}

/// What loads inside a super-element store inside it is in no energy of the results.
void check_energy(Checking& checking, const std::string& path) {
  const auto acts_inside = [](const Load& load) {
    return std::holds_alternative<Gravity>(load.kind) || std::holds_alternative<Spin>(load.kind) ||
           std::holds_alternative<BodyForce>(load.kind) || std::holds_alternative<Temperature>(load.kind);
  };
  const std::vector<Load>& loads = checking.model.loads;
  const std::vector<Body>& bodies = checking.model.bodies;
  const auto load = std::find_if(loads.begin(), loads.end(), acts_inside);
  if (load == loads.end()) return;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& of) {
    const bool acts = !load->on || &of == &bodies[static_cast<std::size_t>(load->on->body)];
    return acts && !of.rigid && of.mesh.kind != MeshKind::fem;
  });
  if (body == bodies.end()) return;
  checking.error(path, "",
                 fmt::format("the elastic energy does not contain what load '{}' stores inside the super-elements of "
                             "body '{}', so that its bar would be wrong: ask for another number, or give the body a "
                             "mesh of kind fem",
                             load->name, body->name));
}

void check_time(Checking& checking, const std::string& path) {
  if (!is_dynamic(checking.model)) checking.error(path, "", "belongs to steps in time, and the model has none");
}

void check_point_of(Checking& checking, const std::string& path, const Quantity& quantity) {
  if (quantity.kind == Quantity::Kind::velocity) check_time(checking, path);
  checking.vector(path, "at", quantity.at);
  if (quantity.index == -1 || !check_number_of(checking, path, "body", quantity.index, checking.model.bodies.size()) ||
      quantity.kind != Quantity::Kind::stress || !checking.body(quantity.index).rigid)
    return;
  checking.error(path, "", fmt::format("body '{}' is rigid and has no stress", checking.body(quantity.index).name));
}

void check_quantity(Checking& checking, const std::string& path, const Quantity& quantity, bool with_bar) {
  const Model& model = checking.model;
  switch (quantity.kind) {
    case Quantity::Kind::normal_force:
    case Quantity::Kind::tangential_force:
    case Quantity::Kind::max_gap:
    case Quantity::Kind::contact_force:
    case Quantity::Kind::contact_moment:
    case Quantity::Kind::centre_of_pressure:
    case Quantity::Kind::max_pressure:
    case Quantity::Kind::pairs_in_state:
    case Quantity::Kind::end_pair:
      check_number_of(checking, path, "contact", quantity.index, model.contacts.size());
      break;
    case Quantity::Kind::reaction:
      check_number_of(checking, path, "support", quantity.index, model.supports.size());
      break;
    case Quantity::Kind::spring_force:
      check_number_of(checking, path, "spring", quantity.index, model.springs.size());
      break;
    case Quantity::Kind::bar_tension:
      check_number_of(checking, path, "bar", quantity.index, model.bars.size());
      break;
    case Quantity::Kind::displacement:
    case Quantity::Kind::velocity:
    case Quantity::Kind::stress:
      check_point_of(checking, path, quantity);
      break;
    case Quantity::Kind::stress_intensity:
    case Quantity::Kind::t_stress:
    case Quantity::Kind::energy_release:
    case Quantity::Kind::corner_stress:
      check_crack_of(checking, path, quantity, with_bar);
      break;
    case Quantity::Kind::elastic_energy:
      if (with_bar) check_energy(checking, path);
      break;
    case Quantity::Kind::broken_pairs:
      check_broken_of(checking, path, quantity);
      break;
    case Quantity::Kind::pore_force:
    case Quantity::Kind::total_normal_force:
      check_pores_of(checking, path, quantity);
      break;
    case Quantity::Kind::support_moment:
      check_moment_of(checking, path, quantity);
      break;
    case Quantity::Kind::external_energy:
    case Quantity::Kind::friction_energy:
      break;
    case Quantity::Kind::ground_velocity:
    case Quantity::Kind::energy_in_time:
      check_time(checking, path);
      break;
  }
  if (with_bar && !quantity.has_bar())
    checking.error(path, "", "has a history, but no error bar: ask for it under output.history");
}

void check_section(Checking& checking, const std::string& path, const Section& section) {
  const bool good =
      checking.vector(path, "section.from", section.from) && checking.vector(path, "section.to", section.to);
  if (good && section.from == section.to)
    checking.error(path, "section", "the line ends where it starts: give two different points");
  if (section.body == -1) return;
  if (!check_number_of(checking, path, "body", section.body, checking.model.bodies.size())) return;
  if (checking.body(section.body).rigid)
    checking.error(path, "section.body",
                   fmt::format("body '{}' is rigid and has no stress", checking.body(section.body).name));
}

void check_result_axes(Checking& checking, const std::string& path, const ResultAxes& axes) {
  if (checking.vector(path, "axes", axes.first) && std::abs(axes.first.norm() - 1.0) > 1e-9)
    checking.error(path, "axes", "the first direction must have the length 1");
}

/// Whether a face has nodes up to the tip or scaling centre, because supports, springs or a contact act on it or on the
/// one opposite to it.
bool has_nodes(const Model& model, const Place& face) {
  const auto is_there = [&](const Place& place) {
    return place.kind == Place::Kind::face && place.body == face.body && place.index / 2 == face.index / 2;
  };
  return std::any_of(model.supports.begin(), model.supports.end(), [&](const auto& one) { return is_there(one.on); }) ||
         std::any_of(model.springs.begin(), model.springs.end(), [&](const auto& one) { return is_there(one.on); }) ||
         std::any_of(model.contacts.begin(), model.contacts.end(), [&](const auto& one) { return is_there(one.a); });
}

void check_edge_resultant(Checking& checking, const std::string& path, const EdgeResultant& edge) {
  checking.vector(path, "about", edge.about);
  check_result_axes(checking, path, edge.axes);
  if (!check_place(checking, path + ".edge", edge.on)) return;
  if (edge.on.kind == Place::Kind::face && !checking.body(edge.on.body).outside) {
    if (!has_nodes(checking.model, edge.on))
      checking.error(path, "edge",
                     fmt::format("'{}' is a face that nothing holds: only its own loads act through it; leave it out",
                                 text_of(checking.model, edge.on)));
  } else if (edge.on.kind != Place::Kind::edge) {
    checking.error(path, "edge",
                   fmt::format("'{}' is no edge between two corners: name one, as in wall.bottom",
                               text_of(checking.model, edge.on)));
  } else if (checking.body(edge.on.body).rigid) {
    checking.error(path, "edge",
                   fmt::format("body '{}' is rigid: ask for the forces of its contacts or supports",
                               checking.body(edge.on.body).name));
  }
}

void check_history(Checking& checking) {
  std::unordered_set<std::string> names;
  const std::vector<HistoryItem>& items = checking.model.output.history;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const HistoryItem& item = items[i];
    const std::string path = path_of("output.history", item.name, i);
    checking.enter(item.source);
    check_name(checking, path, item.name, "history", names);
    if (const auto* quantity = std::get_if<Quantity>(&item.of)) check_quantity(checking, path, *quantity, false);
    if (const auto* section = std::get_if<Section>(&item.of)) check_section(checking, path, *section);
    if (const auto* edge = std::get_if<EdgeResultant>(&item.of)) check_edge_resultant(checking, path, *edge);
    if (const auto* place = std::get_if<PlaceDisplacement>(&item.of)) {
      check_quantity(checking, path, place->of, false);
      if (place->relative_to) check_quantity(checking, path, *place->relative_to, false);
      check_result_axes(checking, path, place->axes);
    }
  }
}

void check_tolerance(Checking& checking, const QuantityTolerance& tolerance) {
  checking.enter(tolerance.source);
  if (checking.number("tolerance", "relative", tolerance.relative) &&
      !(tolerance.relative > 0.0 && tolerance.relative < 1.0)) {
    const std::string given = number_text(tolerance.relative);
    checking.error("tolerance", "relative", fmt::format("must be greater than 0 and less than 1, not {}", given),
                   given);
  }
  const auto& bodies = checking.model.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].mesh.tolerance) {
      checking.error_of_key("tolerance", "",
                            fmt::format("refines all bodies for one number, but body '{}' has a "
                                        "tolerance of its own: remove one of the two",
                                        bodies[b].name));
      return;
    }
  if (!checking.gaps.bodies && std::none_of(bodies.begin(), bodies.end(), can_be_refined))
    checking.error_of_key("tolerance", "",
                          "no body of this model can be refined: give one a mesh of a shape or of a file, or ask for "
                          "the bar alone with output: {error_of: [...]}");
}

/// Finite elements, and all cells in a temperature about a centre, take the nearest linear temperature each, on the
/// mesh and on that of one order more: what this leaves out is in no estimate.
void check_tables_with_bars(Checking& checking) {
  const Model& model = checking.model;
  const bool all = model.tolerance || model.output.error || !model.output.error_of.empty();
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const auto* temperature = std::get_if<Temperature>(&load.kind);
    if (!temperature || !temperature->table || !checking.load[i]) continue;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Body& body = model.bodies[b];
      if (body.rigid || body.outside || !checking.sound_shape(static_cast<int>(b))) continue;
      if (load.on && load.on->body != static_cast<int>(b)) continue;
      const bool radial = temperature->table->centre.has_value();
      if (body.mesh.kind != MeshKind::fem && !radial) continue;
      if (!(all || body.mesh.tolerance) || is_linear_over(*temperature->table, body.outline)) continue;
      checking.enter(load.source);
      if (radial)
        checking.error(path_of_load(load, i), "temperature",
                       fmt::format("changes with the radius inside body '{}', in each of whose cells it is taken as "
                                   "linear, an error that no estimate contains: ask for no error",
                                   body.name));
      else
        checking.error(
            path_of_load(load, i), "temperature",
            fmt::format("changes its slope inside body '{}', in each of whose finite elements it is taken as "
                        "linear, an error that no estimate contains: give the body a mesh of kind polygons or "
                        "quadtree, or ask for no error",
                        body.name));
      return;
    }
  }
}

}  // namespace

void check_quantities(Checking& checking) {
  const Model& model = checking.model;
  check_history(checking);
  for (std::size_t i = 0; i < model.output.error_of.size(); ++i) {
    const Quantity& quantity = model.output.error_of[i];
    checking.enter(quantity.source);
    check_quantity(checking, path_of("output.error_of", quantity.source, i), quantity, true);
  }
  if (model.tolerance) {
    checking.enter(model.tolerance->of.source);
    check_quantity(checking, "tolerance.of", model.tolerance->of, true);
    check_tolerance(checking, *model.tolerance);
  }
  check_tables_with_bars(checking);
}

}  // namespace scabo::model
