#include "scabo/analysis/space/posed_solids.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scabo/analysis/space/body_mesh.hpp"
#include "scabo/analysis/space/held_nodes.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_factors.hpp"
#include "scabo/analysis/space/solid_places.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/mesh/space/face_normals.hpp"
#include "scabo/system/rigid_solid.hpp"
#include "scabo/system/solid_edges.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

/// `x`, or `(0.866, 0.5, 0)`.
std::string text_of_direction(const Eigen::Vector3d& direction) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(direction[k]) == 1.0) return std::string(1, "xyz"[k]);
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", direction.x(), direction.y(), direction.z());
}

class Posing {
 public:
  explicit Posing(const model::SpaceModel& model) : model_(model) {}
  PosedSolids posed();

 private:
  void add_body(const model::SpaceBody& body);
  using Normals = std::map<int, std::vector<mesh::NodeNormal>>;
  std::vector<SupportedDirection> held_along(const model::SpaceSupport& support, int node, const Normals& normals);
  void add_support(std::size_t number);
  void add_rigid_support(std::size_t number);
  std::optional<double> displacement_at(const model::SpaceSupport& support, std::size_t axis, int node);
  void add_spring(const model::SpaceSpring& spring);
  void add_load(const model::SpaceLoad& load);
  Vector forces_at_rest(const model::SpaceLoad& load);
  void add_load_on_bodies(const model::SpaceLoad& load, std::vector<Vector>& forces);
  Vector load_on_face(const model::SpaceLoad& load);
  Eigen::Vector3d value_of(const model::SpaceLoad& load, const Eigen::Vector3d& x);
  Vector varying_load(const model::SpaceLoad& load, const std::vector<mesh::SolidFacet>& on);
  std::optional<Vector> load_on_line(const model::SpaceLoad& load);
  void add_contact(const model::SpaceContact& contact);
  void add_preload(std::size_t body);
  void add_resultant(const model::SpaceFaceResultant& of);
  SolidPlaceOfAction place_of_action(const model::SpaceBar::End& end);
  void add_bar(const model::SpaceBar& bar);
  SolidBody& body(int index) { return posed_.model.bodies[static_cast<std::size_t>(index)]; }

  const model::SpaceModel& model_;
  PosedSolids posed_;
  HeldNodes held_{model_, posed_.model};
  std::map<int, std::pair<std::size_t, Eigen::Vector3d>> first_on_;  // rigid body: its first support, and its centroid
  std::set<std::string> without_value_;                              // loads whose formula has none somewhere
  std::vector<Diagnostic> mistakes_;
  SolidPlaces places_{model_, posed_.model.bodies, mistakes_};
};

void Posing::add_body(const model::SpaceBody& of) {
  auto made = mesh_of_body(of);
  if (auto* mistake = std::get_if<std::string>(&made)) return mistakes_.push_back({of.source, std::move(*mistake)});
  auto& shaped = std::get<mesh::ShapedSolid>(made);
  SolidBody body{std::move(shaped.mesh)};
  body.name = of.name;
  body.stay = of.stay;
  if (of.rigid) {
    body.rigid_at = system::volume_of(body.mesh).centroid;
  } else {
    const auto& material = model_.materials[static_cast<std::size_t>(of.material)];
    body.young = material.young, body.poisson = material.poisson, body.expansion = material.expansion;
  }
  if (auto wrong = wrong_cell(of, body.mesh)) return mistakes_.push_back({of.source, *std::move(wrong)});
  try {
    if (!of.rigid) body = with_super_elements(std::move(body));
  } catch (const element::IllPosed&) {
    return mistakes_.push_back(
        {of.source, "a cell of it is too flat or distorted for a super-element: change its mesh, or leave out 'kind'"});
  }
  places_.add_body(body, std::move(shaped.faces));
  posed_.model.bodies.push_back(std::move(body));
}

/// Nothing where it is free, or where a formula has no number, which is reported once.
std::optional<double> Posing::displacement_at(const model::SpaceSupport& support, std::size_t axis, int node) {
  if (!support.displacement[axis]) return {};
  const double value = *support.displacement[axis];
  if (!support.shape[axis]) return value;
  const Eigen::Vector3d x = body(support.on.body).mesh.nodes.col(node);
  const auto shape = support.shape[axis](x);
  if (const double* number = std::get_if<double>(&shape)) return value * *number;
  mistakes_.push_back(
      {support.on.source,
       fmt::format("the formula of the displacement along {} has no value at ({:.6g}, {:.6g}, {:.6g}): {}", "xyz"[axis],
                   x.x(), x.y(), x.z(), std::get<std::string>(shape))});
  return {};
}

/// At a node; `normals`: those of the face, if it is held along them.
std::vector<SupportedDirection> Posing::held_along(const model::SpaceSupport& support, int node,
                                                   const Normals& normals) {
  using Axes = model::SpaceSupport::Axes;
  using Kind = SupportedDirection::Kind;
  std::vector<SupportedDirection> along;
  if (support.axes == Axes::normal)
    for (const mesh::NodeNormal& at : normals.at(node))
      along.push_back(
          {at.n, *support.displacement[0], at.curved ? Kind::normal_of_curved_face : Kind::normal_of_plane});
  if (support.axes == Axes::direction) along.push_back({support.along, *support.displacement[0]});
  for (std::size_t axis = 0; axis < 3 && support.axes == Axes::xyz; ++axis)
    if (const auto value = displacement_at(support, axis, node))
      along.push_back({Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis)), *value});
  return along;
}

void Posing::add_support(std::size_t number) {
  const model::SpaceSupport& support = model_.supports[number];
  if (support.on.is_body()) return add_rigid_support(number);
  const std::size_t before = mistakes_.size();
  const std::set<int> nodes = places_.held_nodes(support.on);
  if (mistakes_.size() > before) return;
  Normals normals;
  if (support.axes == model::SpaceSupport::Axes::normal) {
    const mesh::SolidMesh& mesh = body(support.on.body).mesh;
    normals = mesh::normals_of_face(mesh, places_.place_of_action(support.on).facets, mesh::boundary_facets(mesh));
    if (normals.size() < nodes.size())
      return mistakes_.push_back(
          {support.on.source, fmt::format("'{}' has nodes that no side of an element in it has, so that they have no "
                                          "normal: name a face, or give the direction by 'along'",
                                          support.on.text)});
  }
  for (const int node : nodes) {
    if (mistakes_.size() > before) return;
    for (const SupportedDirection& along : held_along(support, node, normals))
      if (const auto other = held_.hold(number, node, along)) {
        const Eigen::Vector3d x = body(support.on.body).mesh.nodes.col(node);
        return mistakes_.push_back(
            {support.on.source,
             fmt::format(
                 "support '{}' prescribes another displacement along {} of the node at ({:.6g}, {:.6g}, {:.6g}) "
                 "than support '{}': let only one of them hold it",
                 support.name, text_of_direction(along.direction), x.x(), x.y(), x.z(), model_.supports[*other].name)});
      }
  }
}

void Posing::add_rigid_support(std::size_t number) {
  const model::SpaceSupport& support = model_.supports[number];
  SolidBody& of = body(support.on.body);
  const auto [given, is_first] = first_on_.try_emplace(support.on.body, number, *of.rigid_at);
  const auto& [first, centroid] = given->second;
  const Eigen::Vector3d at = support.at.value_or(centroid);
  if (is_first)
    of.rigid_at = at;
  else if (*of.rigid_at != at)
    return mistakes_.push_back(
        {support.on.source,
         fmt::format("support '{}' and support '{}' hold body '{}' at two points: give both the same 'at'",
                     support.name, model_.supports[first].name, support.on.text)});
  for (int motion = 0; motion < 6; ++motion) {
    const auto& value = motion < 3 ? support.displacement[static_cast<std::size_t>(motion)]
                                   : support.rotation[static_cast<std::size_t>(motion - 3)];
    if (!value) continue;
    if (const auto other = held_.hold_motion(number, motion, *value))
      return mistakes_.push_back(
          {support.on.source,
           fmt::format("support '{}' holds the {} {} of body '{}', as does support '{}': let only one "
                       "of them hold it",
                       support.name, motion < 3 ? "displacement along" : "rotation about", "xyz"[motion % 3],
                       support.on.text, model_.supports[*other].name)});
  }
}

/// Gravity and changes of temperature, on one body or all.
void Posing::add_load_on_bodies(const model::SpaceLoad& load, std::vector<Vector>& forces) {
  const bool heats = load.kind == model::SpaceLoad::Kind::temperature;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (load.on.body >= 0 && load.on.body != static_cast<int>(b)) continue;
    const model::SpaceBody& of = model_.bodies[b];
    const SolidBody& posed = posed_.model.bodies[b];
    if (heats && !of.rigid) {
      Vector change = (posed.mesh.nodes.transpose() * load.vector).array() + load.constant;
      forces[b] = system::thermal_forces(posed.mesh, element::elasticity_in_space(posed.young, posed.poisson),
                                         posed.expansion, change, posed.solved);
      posed_.model.temperatures.back()[b] = std::move(change);
    } else if (!heats) {
      const double density = of.rigid ? of.density : model_.materials[static_cast<std::size_t>(of.material)].density;
      forces[b] = system::volume_forces(posed.mesh, density * load.vector, posed.solved);
      posed_.model.per_volume.back()[b] = density * load.vector;
    }
  }
}

/// Of a formula; without a number there it is reported, once. A pressure is the first component.
Eigen::Vector3d Posing::value_of(const model::SpaceLoad& load, const Eigen::Vector3d& x) {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!load.formula[k]) continue;
    const auto found = load.formula[k](x);
    if (const double* number = std::get_if<double>(&found))
      value[static_cast<Eigen::Index>(k)] = *number;
    else if (without_value_.insert(load.name).second)
      mistakes_.push_back({load.on.source, fmt::format("the formula of load '{}' has no value at ({:.6g}, {:.6g}, "
                                                       "{:.6g}): {}",
                                                       load.name, x.x(), x.y(), x.z(), std::get<std::string>(found))});
  }
  return value;
}

/// A traction or pressure by formula.
Vector Posing::varying_load(const model::SpaceLoad& load, const std::vector<mesh::SolidFacet>& on) {
  return system::varying_traction_forces(
      body(load.on.body).mesh, on, [&](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) -> Eigen::Vector3d {
        const Eigen::Vector3d value = value_of(load, x);
        return load.kind == model::SpaceLoad::Kind::pressure ? Eigen::Vector3d(-value[0] * normal) : value;
      });
}

/// A line load, or a force along an edge or at a point; nothing if the place is a face.
std::optional<Vector> Posing::load_on_line(const model::SpaceLoad& load) {
  const mesh::SolidMesh& mesh = body(load.on.body).mesh;
  using Kind = model::SpaceLoad::Kind;
  const bool is_force = load.kind == Kind::force, is_line = load.kind == Kind::line_load;
  const bool is_set = load.on.is_set_of_nodes();
  const bool is_set_of_face = is_set && !places_.facets_of_set(load.on).empty();
  if (!is_line && !(is_force && (load.on.is_edge() || load.on.is_point() || (is_set && !is_set_of_face)))) return {};
  const auto refused = [&](std::string_view why) -> Vector {
    mistakes_.push_back({load.on.source, fmt::format("'{}' {}", load.on.text, why)});
    return Vector::Zero(3 * mesh.nodes.cols());
  };
  if (is_set_of_face)
    return refused(
        "has sides of elements, and a 'line_load' acts along an edge: name a set without them, or give a "
        "'traction'");
  if (is_set && load.at)
    return refused("has no side of an element, so that a force on it acts at its nodes: leave 'at' out");
  if (is_force && (load.on.is_point() || (is_set && places_.set_of_nodes(load.on).size() == 1))) {
    Vector forces = Vector::Zero(3 * mesh.nodes.cols());
    for (const int node : places_.single_nodes(load.on)) forces.segment<3>(3 * node) = load.vector;
    return forces;
  }
  const std::vector<mesh::SolidEdge> on = places_.edges(load.on);
  if (on.empty() && is_set)
    return refused(
        "has no edge of an element between two of its nodes: name a set with all nodes of an edge, or give a "
        "'nodal_force'");
  const double length = is_force ? system::length_of_edges(mesh, on) : 1.0;
  return system::line_load_forces(mesh, on, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return load.varies() ? value_of(load, x) : Eigen::Vector3d(load.vector / length);
  });
}

Vector Posing::load_on_face(const model::SpaceLoad& load) {
  using Kind = model::SpaceLoad::Kind;
  const mesh::SolidMesh& mesh = body(load.on.body).mesh;
  if (load.on.is_body()) {
    if (load.kind == Kind::moment) return system::forces_on_rigid(mesh, Eigen::Vector3d::Zero(), load.vector);
    const Eigen::Vector3d centroid = system::volume_of(mesh).centroid;
    return system::forces_on_rigid(mesh, load.vector, (load.at.value_or(centroid) - centroid).cross(load.vector));
  }
  if (load.kind == Kind::nodal_force) {
    Vector forces = Vector::Zero(3 * mesh.nodes.cols());
    for (const int node : places_.set_of_nodes(load.on)) forces.segment<3>(3 * node) = load.vector;
    return forces;
  }
  if (auto on_line = load_on_line(load)) return *std::move(on_line);
  const std::vector<mesh::SolidFacet> on = places_.facets(load.on);
  if (on.empty()) return {};
  if (load.varies()) return varying_load(load, on);
  if (load.kind == Kind::pressure) return system::pressure_forces(mesh, on, load.pressure);
  if (load.kind == Kind::moment) return system::moment_forces(mesh, on, load.vector);
  if (load.kind == Kind::traction) return system::traction_forces(mesh, on, load.vector);
  Vector forces = system::traction_forces(mesh, on, load.vector / system::area_of_facets(mesh, on));
  if (load.at)
    forces += system::moment_forces(mesh, on, (*load.at - system::centroid_of_facets(mesh, on)).cross(load.vector));
  return forces;
}

void Posing::add_spring(const model::SpaceSpring& spring) {
  const mesh::SolidMesh& mesh = body(spring.on.body).mesh;
  posed_.model.springs.push_back(
      {spring.on.body,
       spring.along_face ? system::springs_on_facets(mesh, places_.facets(spring.on), spring.normal, spring.tangential)
       : spring.on.is_edge() ? system::springs_on_edges(mesh, places_.edges(spring.on), spring.stiffness)
       : spring.on.is_body() ? system::springs_at_centroid(mesh, spring.stiffness)
                             : system::springs_at_nodes(mesh, places_.single_nodes(spring.on), spring.stiffness)});
}

/// What springs that are at rest elsewhere exert on a body that stays where it is.
Vector Posing::forces_at_rest(const model::SpaceLoad& load) {
  const model::SpaceSpring& spring = model_.springs[static_cast<std::size_t>(load.spring)];
  SolidSpringOfBody& posed = posed_.model.springs[static_cast<std::size_t>(load.spring)];
  const mesh::SolidMesh& mesh = body(spring.on.body).mesh;
  posed.load = static_cast<int>(posed_.model.loads.size()) - 1;
  if (spring.along_face)
    return system::pressure_forces(mesh, places_.facets(spring.on), -spring.normal * spring.at_rest[0]);
  return posed.spring.times(spring.at_rest.replicate(mesh.nodes.cols(), 1));
}

void Posing::add_load(const model::SpaceLoad& load) {
  using Kind = model::SpaceLoad::Kind;
  std::vector<Vector>& forces = posed_.model.loads.emplace_back(model_.bodies.size());
  posed_.model.temperatures.emplace_back(model_.bodies.size());
  posed_.model.per_volume.emplace_back(model_.bodies.size(), Eigen::Vector3d::Zero());
  if (load.kind == Kind::gravity || load.kind == Kind::temperature)
    add_load_on_bodies(load, forces);
  else if (load.kind == Kind::at_rest)
    forces[static_cast<std::size_t>(load.on.body)] = forces_at_rest(load);
  else
    forces[static_cast<std::size_t>(load.on.body)] = load_on_face(load);
}

void Posing::add_contact(const model::SpaceContact& contact) {
  SolidContact posed;
  posed.a = {contact.a.body, places_.facets(contact.a)};
  posed.b = {contact.b.body, places_.facets(contact.b)};
  posed.law = contact.law;
  posed.friction_axes = contact.friction_axes;
  posed.gap = contact.gap;
  if (posed.a.facets.empty() || posed.b.facets.empty()) return;
  const mesh::Face a{body(contact.a.body).mesh, posed.a.facets}, b{body(contact.b.body).mesh, posed.b.facets};
  if (const auto why = mesh::why_no_pairs(a, b))
    return mistakes_.push_back({contact.b.source, fmt::format("'{}' and '{}' form no contact pairs: {}", contact.a.text,
                                                              contact.b.text, *why)});
  const std::vector<mesh::FacetPair> pairs = pairs_of(posed_.model, posed).pairs;
  if (pairs.empty())
    mistakes_.push_back({contact.b.source, fmt::format("'{}' and '{}' have nothing in common, seen along their normal: "
                                                       "name faces that lie opposite each other",
                                                       contact.a.text, contact.b.text)});
  for (const mesh::FacetPair& pair : pairs)
    if (contact.friction_axes && pair.directions.col(0).cross(contact.friction_axes->direction).norm() < 0.1)
      return mistakes_.push_back(
          {contact.b.source, fmt::format("the 'direction' of the friction of contact '{}' is along the normal of its "
                                         "faces at ({:.6g}, {:.6g}, {:.6g}): give one along the faces",
                                         contact.name, pair.point.x(), pair.point.y(), pair.point.z())});
  posed_.model.contacts.push_back(std::move(posed));
}

void Posing::add_preload(std::size_t number) {
  const model::SpaceBody& of = model_.bodies[number];
  const SolidBody& at = posed_.model.bodies[number];
  const model::SpacePreload& given = *of.preload;
  const auto mistake = [&](const char* text) {
    mistakes_.push_back({given.source, fmt::format("the cut of the preload of body '{}' {}", of.name, text)});
  };
  SolidPreload preload{
      static_cast<int>(number),
      system::cut_of(at.mesh, element::elasticity_in_space(at.young, at.poisson), given.point, given.normal, at.solved),
      given.force, given.shortening};
  if (preload.cut.stiffness == 0.0) return mistake("has all of it on one side: move 'point', or make 'size' smaller");
  for (const model::SpaceSpring& spring : model_.springs)
    if (spring.on.body == static_cast<int>(number) && given.force)
      return mistake("is that of a body on springs, whose tension is not the force alone: give 'shortening'");
  std::array<bool, 2> held{};  // along the normal: the part below, that above
  for (std::size_t c = 0; c < at.mesh.cells.size(); ++c)
    for (const int node : at.mesh.cells[c])
      if (held_.resists(static_cast<int>(number), node, given.normal))
        held[static_cast<std::size_t>(preload.cut.above[c])] = true;
  if (held[0] && held[1] && given.force)
    return mistake(
        "lies between supports that hold it along the bolt, so that no force can be set: free one side, or "
        "give 'shortening'");
  posed_.model.preloads.push_back(std::move(preload));
}

void Posing::add_resultant(const model::SpaceFaceResultant& of) {
  FaceActions on_face(of.on.body, places_.facets(of.on), of.about);
  const auto share_of = [&](const SolidPlaceOfAction& place, const std::string& what) {
    auto share = on_face.share_of(place);
    if (!share)
      mistakes_.push_back(
          {of.on.source, fmt::format("'{}' has some of the sides on which {} acts, and not all of them: "
                                     "name a face that has all or none",
                                     of.on.text, what)});
    return share.value_or(FaceActions::Share());
  };
  const auto leaves = [&](int own, int other) {
    if (own == of.on.body && other >= 0 && body(other).stay.removed >= 0)
      mistakes_.push_back({of.on.source, fmt::format("body '{}', which touches '{}', is removed in a step: what it "
                                                     "exerts is released at nodes, and no face has it; ask for forces "
                                                     "of contacts and supports",
                                                     body(other).name, body(own).name)});
  };
  for (const model::SpaceContact& contact : model_.contacts)
    leaves(contact.a.body, contact.b.body), leaves(contact.b.body, contact.a.body);
  const auto b = static_cast<std::size_t>(of.on.body);
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    const model::SpaceLoad& load = model_.loads[l];
    if (load.kind != model::SpaceLoad::Kind::gravity && load.kind != model::SpaceLoad::Kind::temperature)
      on_face.add_load(l, body(of.on.body).mesh, posed_.model.loads[l][b],
                       share_of(places_.place_of_action(load.on), fmt::format("load '{}'", load.name)));
  }
  for (std::size_t s = 0; s < model_.supports.size(); ++s)
    on_face.add_reactions(
        posed_.model, static_cast<int>(s),
        share_of(places_.place_of_action(model_.supports[s].on), fmt::format("support '{}'", model_.supports[s].name)));
  for (std::size_t s = 0; s < model_.springs.size(); ++s)
    on_face.add_springs(
        s, share_of(places_.place_of_action(model_.springs[s].on), fmt::format("spring '{}'", model_.springs[s].name)));
  for (std::size_t c = 0; c < model_.contacts.size(); ++c)
    for (const bool on_b : {false, true}) {
      const model::SpaceContact& contact = model_.contacts[c];
      const auto share = share_of(places_.place_of_action(on_b ? contact.b : contact.a),
                                  fmt::format("{} '{}'", contact.tied ? "tie" : "contact", contact.name));
      if (share.all || !share.nodes.empty()) on_face.add_contact(c, on_b);
    }
  for (std::size_t i = 0; i < model_.bars.size(); ++i)
    for (const std::size_t end : {0, 1}) {
      const auto& ends = model_.bars[i].between;
      leaves(ends[end].of_body(), ends[1 - end].of_body());
      on_face.add_bar(i, end == 1, share_of(place_of_action(ends[end]), fmt::format("bar '{}'", model_.bars[i].name)));
    }
  posed_.resultants.push_back(std::move(on_face));
}

SolidPlaceOfAction Posing::place_of_action(const model::SpaceBar::End& end) {
  if (!end.on && (end.body < 0 || body(end.body).rigid_at)) return {};
  if (!end.on) return {end.body, {}, {node_nearest(body(end.body).mesh, end.at)}, {}};
  SolidPlaceOfAction place = places_.place_of_action(*end.on);
  if (!place.facets.empty()) place.nodes.clear();  // the mean of a set is that of its sides
  return place;
}

void Posing::add_bar(const model::SpaceBar& bar) {
  const auto end = [&](std::size_t k) {
    return end_of_bar(posed_.model, bar.between[k], place_of_action(bar.between[k]));
  };
  auto made = bar_between(end(0), end(1), bar);
  if (auto* mistake = std::get_if<std::string>(&made))
    mistakes_.push_back({bar.source, std::move(*mistake)});
  else
    posed_.model.bars.push_back(std::get<SolidBar>(std::move(made)));
}

PosedSolids Posing::posed() {
  for (const model::SpaceBody& of : model_.bodies) add_body(of);
  if (mistakes_.empty()) {
    for (const std::size_t s : order_of_supports(model_)) add_support(s);
    for (const model::SpaceSpring& spring : model_.springs) add_spring(spring);
    for (const model::SpaceLoad& load : model_.loads) add_load(load);
    for (const model::SpaceContact& contact : model_.contacts) add_contact(contact);
    for (std::size_t b = 0; b < model_.bodies.size(); ++b)
      if (model_.bodies[b].preload) add_preload(b);
    for (const model::SpaceBar& bar : model_.bars) add_bar(bar);
    if (mistakes_.empty())
      for (const model::SpaceFaceResultant& of : model_.resultants) add_resultant(of);
  }
  if (!mistakes_.empty()) throw InputError(model_.file, mistakes_);
  add_steps(model_, posed_);
  return std::move(posed_);
}

}  // namespace

PosedSolids pose_solids(const model::SpaceModel& model) { return Posing(model).posed(); }

}  // namespace scabo::analysis
