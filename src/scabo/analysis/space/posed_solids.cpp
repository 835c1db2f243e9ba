#include "scabo/analysis/space/posed_solids.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "scabo/mesh/space/imported_solid.hpp"
#include "scabo/mesh/space/shaped_solid.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

class Posing {
 public:
  explicit Posing(const model::SpaceModel& model) : model_(model) {}
  PosedSolids posed();

 private:
  void add_body(const model::SpaceBody& body);
  std::vector<mesh::SolidFacet> facets(const model::SpaceFace& face);
  void add_support(std::size_t number);
  void add_load(const model::SpaceLoad& load);
  void add_contact(const model::SpaceContact& contact);
  void add_steps();
  SolidBody& body(int index) { return posed_.model.bodies[static_cast<std::size_t>(index)]; }

  const model::SpaceModel& model_;
  PosedSolids posed_;
  std::vector<std::vector<mesh::SolidFacet>> boundaries_;                        // of each body
  std::vector<std::map<std::string, std::vector<mesh::SolidFacet>>> of_shapes_;  // faces of each body with a shape
  std::map<std::pair<int, int>, std::size_t> held_;  // body and degree of freedom: its support
  std::vector<Diagnostic> mistakes_;
};

void Posing::add_body(const model::SpaceBody& of) {
  const auto& material = model_.materials[static_cast<std::size_t>(of.material)];
  mesh::ShapedSolid shaped;
  if (of.shape) {
    const double nodes = mesh::count_nodes(*of.shape, of.sizes);
    if (nodes > model::limits::model_nodes) {
      mistakes_.push_back({of.source, fmt::format("its mesh would have {:.2g} nodes, and at most {:.2g} are possible: "
                                                  "give it a larger 'size'",
                                                  nodes, model::limits::model_nodes)});
      return;
    }
    shaped = mesh::solid_of_shape(*of.shape, of.sizes);
  } else {
    shaped.mesh = mesh::solid_mesh_of(*of.mesh);
  }
  SolidBody body{std::move(shaped.mesh), material.young, material.poisson, {}};
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c)
    if (const double least = element::least_jacobian(mesh::nodes_of(body.mesh, body.mesh.cells[c])); !(least > 0.0)) {
      mistakes_.push_back(
          {of.source, of.mesh ? fmt::format("element {} of its mesh file has a Jacobian of {:.3g}, which must be "
                                            "positive everywhere: correct its nodes",
                                            of.mesh->cells[c].number, least)
                              : "its curved face folds elements of this size: give it a smaller 'size'"});
      break;
    }
  boundaries_.push_back(of.mesh ? mesh::boundary_facets(body.mesh) : std::vector<mesh::SolidFacet>{});
  of_shapes_.push_back(std::move(shaped.faces));
  posed_.model.bodies.push_back(std::move(body));
}

std::vector<mesh::SolidFacet> Posing::facets(const model::SpaceFace& face) {
  if (!face.of_shape.empty()) return of_shapes_[static_cast<std::size_t>(face.body)].at(face.of_shape);
  const files::ImportedSolidMesh& mesh = *model_.bodies[static_cast<std::size_t>(face.body)].mesh;
  std::vector<mesh::SolidFacet> found =
      face.side_set >= 0
          ? mesh::facets_of_sides(body(face.body).mesh, mesh.side_sets[static_cast<std::size_t>(face.side_set)].sides)
          : mesh::facets_among(boundaries_[static_cast<std::size_t>(face.body)],
                               mesh.node_sets[static_cast<std::size_t>(face.node_set)].nodes);
  if (found.empty())
    mistakes_.push_back({face.source, fmt::format("'{}' has no outer side of an element: name a surface, or a set "
                                                  "with all nodes of a face",
                                                  face.text)});
  return found;
}

void Posing::add_support(std::size_t number) {
  const model::SpaceSupport& support = model_.supports[number];
  std::set<int> nodes;
  for (const mesh::SolidFacet& facet : facets(support.on)) nodes.insert(facet.begin(), facet.end());
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) {
      const auto& value = support.displacement[static_cast<std::size_t>(axis)];
      if (!value) continue;
      const auto [held, is_new] = held_.try_emplace({support.on.body, 3 * node + axis}, number);
      if (is_new) {
        body(support.on.body).supports.push_back(system::held_along_axis(node, axis, *value));
        body(support.on.body).supports.back().support = static_cast<int>(number);
      } else if (const auto& other = model_.supports[held->second];
                 other.displacement[static_cast<std::size_t>(axis)] != value ||
                 (*value != 0.0 && (other.named || support.named))) {
        mistakes_.push_back(
            {support.on.source, fmt::format("support '{}' prescribes another displacement along {} of a node than "
                                            "support '{}': let only one of them hold it",
                                            support.name, "xyz"[axis], other.name)});
        return;
      }
    }
}

void Posing::add_load(const model::SpaceLoad& load) {
  std::vector<Vector>& forces = posed_.model.loads.emplace_back(model_.bodies.size());
  using Kind = model::SpaceLoad::Kind;
  if (load.kind == Kind::gravity) {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const double density = model_.materials[static_cast<std::size_t>(model_.bodies[b].material)].density;
      forces[b] = system::volume_forces(posed_.model.bodies[b].mesh, density * load.vector);
    }
    return;
  }
  const mesh::SolidMesh& mesh = body(load.on.body).mesh;
  const std::vector<mesh::SolidFacet> on = facets(load.on);
  forces[static_cast<std::size_t>(load.on.body)] = load.kind == Kind::pressure
                                                       ? system::pressure_forces(mesh, on, load.pressure)
                                                       : system::traction_forces(mesh, on, load.vector);
}

void Posing::add_contact(const model::SpaceContact& contact) {
  SolidContact posed;
  posed.a = {contact.a.body, facets(contact.a)};
  posed.b = {contact.b.body, facets(contact.b)};
  posed.friction = contact.friction;
  posed.gap = contact.gap;
  if (posed.a.facets.empty() || posed.b.facets.empty()) return;
  const mesh::Face a{body(contact.a.body).mesh, posed.a.facets}, b{body(contact.b.body).mesh, posed.b.facets};
  if (const auto why = mesh::why_no_pairs(a, b))
    mistakes_.push_back({contact.b.source,
                         fmt::format("'{}' and '{}' form no contact pairs: {}", contact.a.text, contact.b.text, *why)});
  else if (mesh::facet_pairs(a, b).empty())
    mistakes_.push_back({contact.b.source, fmt::format("'{}' and '{}' have nothing in common, seen along their normal: "
                                                       "name faces that lie opposite each other",
                                                       contact.a.text, contact.b.text)});
  posed_.model.contacts.push_back(std::move(posed));
}

void Posing::add_steps() {
  const auto vector = [](const std::vector<double>& of) {
    return Vector(Eigen::Map<const Vector>(of.data(), static_cast<Eigen::Index>(of.size())));
  };
  Vector loads = Vector::Zero(static_cast<Eigen::Index>(model_.loads.size())),
         supports = Vector::Zero(static_cast<Eigen::Index>(model_.supports.size()));
  for (std::size_t s = 0; s < model_.steps.size(); ++s) {
    const model::SpaceStep& step = model_.steps[s];
    const Vector last_loads = vector(step.load_factors), last_supports = vector(step.support_factors);
    for (int k = 1; k <= step.increments; ++k) {
      const double t = static_cast<double>(k) / step.increments;
      posed_.increments.push_back({(1.0 - t) * loads + t * last_loads, (1.0 - t) * supports + t * last_supports});
      posed_.step_and_number.emplace_back(s, k);
    }
    loads = last_loads;
    supports = last_supports;
  }
}

PosedSolids Posing::posed() {
  for (const model::SpaceBody& of : model_.bodies) add_body(of);
  if (mistakes_.empty()) {
    for (std::size_t s = 0; s < model_.supports.size(); ++s) add_support(s);
    for (const model::SpaceLoad& load : model_.loads) add_load(load);
    for (const model::SpaceContact& contact : model_.contacts) add_contact(contact);
  }
  if (!mistakes_.empty()) throw InputError(model_.file, mistakes_);
  add_steps();
  return std::move(posed_);
}

}  // namespace

PosedSolids pose_solids(const model::SpaceModel& model) { return Posing(model).posed(); }

}  // namespace scabo::analysis
