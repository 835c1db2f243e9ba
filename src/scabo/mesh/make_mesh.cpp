#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "scabo/base/components.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/approximate_nodes.hpp"
#include "scabo/mesh/plane/close_mouths.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/mesh/plane/divide.hpp"
#include "scabo/mesh/plane/division.hpp"
#include "scabo/mesh/plane/fan.hpp"
#include "scabo/mesh/plane/former_vertices.hpp"
#include "scabo/mesh/plane/grid.hpp"
#include "scabo/mesh/plane/imported_cells.hpp"
#include "scabo/mesh/plane/interface.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "scabo/mesh/plane/match.hpp"
#include "scabo/mesh/plane/matched_side.hpp"
#include "scabo/mesh/plane/tip_rings.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::mesh {

namespace {

/// Reason why a body that could be divided makes the model too large, found before memory is allocated. Bodies after it
/// are not looked at, which saves one message for each of many copies.
std::optional<Diagnostic> too_many_together(const model::Body& body, double nodes_before) {
  if (nodes_before == 0.0 || body.image || body.imported || body.mesh.kind == model::MeshKind::parts) return {};
  const bool cells = model::is_divided_inside(body);
  const double nodes = cells                                    ? approximate_nodes(body)
                       : body.mesh.kind == model::MeshKind::fem ? count_grid_nodes(body)
                                                                : count_boundary_nodes(body);
  if (nodes > model::limits::model_nodes || !(nodes_before + nodes > model::limits::model_nodes)) return {};
  return Diagnostic{body.mesh.source,
                    fmt::format("with body '{}' the model would have {}{} nodes, more than the {:.7g} allowed: use "
                                "larger mesh sizes or fewer bodies",
                                body.name, cells ? "about " : "",
                                text_of_count(nodes_before + nodes, model::limits::model_nodes, cells ? 2 : 3),
                                model::limits::model_nodes)};
}

/// Reason why the body cannot be divided, found before memory is allocated.
std::vector<Diagnostic> obstacles(const model::Body& body) {
  const bool fem = body.mesh.kind == model::MeshKind::fem;
  if (fem && body.mesh.order > 2) {
    return {{body.mesh.source,
             fmt::format("'kind: fem' uses elements of order 1 or 2, not {}: use one of these", body.mesh.order)}};
  }
  const double nodes = fem ? count_grid_nodes(body) : count_boundary_nodes(body);
  if (!(nodes <= model::limits::model_nodes)) {
    return {
        {body.mesh.source,
         fmt::format("size {:.6g} would give {} nodes, more than the {:.7g} allowed: use a larger 'size'",
                     body.mesh.size, text_of_count(nodes, model::limits::model_nodes, 3), model::limits::model_nodes)}};
  }
  if (!body.mesh.refine.empty() && 2.0 * nodes > model::limits::superelement_dofs) {
    return {{body.mesh.refine.front().source,
             fmt::format("the sizes of 'refine' give {:.6g} degrees of freedom, but one super-element may have at most "
                         "{:.6g}: use larger sizes, or kind: polygons or quadtree",
                         2.0 * nodes, model::limits::superelement_dofs)}};
  }
  return {};
}

/// A super-element too large to be solved among the few of a shape, as beside a narrow place.
std::vector<Diagnostic> too_large_parts(const model::Body& body, const BodyMesh& mesh) {
  std::size_t nodes = 0;
  for (const Cell& cell : mesh.cells) nodes = std::max(nodes, cell.nodes().size());
  if (2.0 * static_cast<double>(nodes) <= model::limits::superelement_dofs) return {};
  const std::string which =
      mesh.cells.size() > 1 ? fmt::format("one of the {} super-elements", mesh.cells.size()) : "the super-element";
  return {{body.mesh.source, fmt::format("{} of body '{}' would have {} degrees of freedom, more than the {:.6g} "
                                         "allowed: write kind: polygons, or use larger sizes",
                                         which, body.name, places_of(nodes), model::limits::superelement_dofs)}};
}

/// Places `near` the mouth of a crack, where two nodes are equally close.
std::vector<Diagnostic> ambiguous_points(const model::Model& model, const Mesh& mesh) {
  std::vector<Diagnostic> mistakes;
  const auto look = [&](const model::Place& place, const Source& source) {
    if (place.kind != model::Place::Kind::near) return;
    const auto b = static_cast<std::size_t>(place.body);
    const model::Body& body = model.bodies[b];
    if (body.cracks.empty() || !body.cracks.front().path.empty() || mesh.bodies[b].nodes.empty()) return;
    const int node = nodes_of(place, mesh).nodes.front();
    if (node != mesh.bodies[b].mouth[0] && node != mesh.bodies[b].mouth[1]) return;
    mistakes.push_back({source, fmt::format("the nearest node is the mouth of crack '{1}', where there are two nodes: "
                                            "write {0}.{1}.mouth_left or {0}.{1}.mouth_right",
                                            body.name, body.cracks.front().name)});
  };
  for (const model::Support& support : model.supports) look(support.on, support.on.source);
  for (const model::Spring& spring : model.springs) look(spring.on, spring.on.source);
  for (const model::Bar& bar : model.bars)
    for (const model::Bar::End& end : bar.between)
      if (end.on) look(*end.on, end.on->source);
  for (const model::Load& load : model.loads)
    if (load.on) look(*load.on, load.on->source);
  return mistakes;
}

/// Each message once: copies of a body have their part of the file in common.
std::vector<Diagnostic> without_repetitions(std::vector<Diagnostic> mistakes) {
  std::set<std::tuple<int, int, std::string, std::string>> before;
  std::erase_if(mistakes, [&](const Diagnostic& one) {
    return !before.emplace(one.at.line, one.at.column, one.at.path, one.message).second;
  });
  return mistakes;
}

}  // namespace

Mesh make_mesh(const model::Model& model) { return make_mesh(model, Division(model.bodies.size())); }

namespace {

/// Gives the side faces of a body that is one super-element nodes, or says why not.
std::vector<Diagnostic> divided_faces(const model::Model& model, int body, BodyMesh& mesh) {
  constexpr int least = 6;
  const model::Body& of = model.bodies[static_cast<std::size_t>(body)];
  const auto holds = [&](int face) {
    return std::any_of(model.supports.begin(), model.supports.end(), [&](const model::Support& support) {
      return support.on.body == body && support.on.kind == model::Place::Kind::face && support.on.index == face;
    });
  };
  TipRings rings;
  rings.joined = 0.8;
  // As many nodes on the faces as on the boundary, but no more than 16 elements at the beginning.
  const double length = std::max(model::side_face_arm(of, 0).norm(), model::side_face_arm(of, 1).norm());
  const double wanted = of.mesh.size * std::max(rings.order, of.mesh.order) / of.mesh.order;
  const double side = std::max(wanted, length / 16.0);
  rings.step = side / length;
  rings.longest = 2.0 * side;
  if (holds(0) && holds(1)) rings.count = 24;  // what holds both faces is not always in the innermost stiffness
  if (divide_side_faces(mesh, of, rings) < least)
    return {{of.source, fmt::format("'{}' is too far from the origin for its size to have nodes on its side faces: "
                                    "its coordinates do not have the digits; move the origin closer",
                                    of.name)}};
  hold_tips(mesh, model, body);
  return {};
}

/// Divides every body by itself, and adds what is wrong with them to `mistakes`. `former`: one for each, or null.
Mesh divide_bodies(const model::Model& model, const Division& division, const Sizes& sizes,
                   std::vector<FormerVertices>* former, std::vector<Diagnostic>& mistakes) {
  Mesh mesh;
  const auto add = [&](std::vector<Diagnostic> more) {
    std::move(more.begin(), more.end(), std::back_inserter(mistakes));
    return !more.empty();
  };

  const SizeField no_limit;
  mesh.bodies.resize(model.bodies.size());
  double nodes = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    if (body.rigid) continue;
    if (const auto too_many = too_many_together(body, nodes)) {
      mistakes.push_back(*too_many);
      break;
    }
    if (model::is_divided_inside(body)) {
      const SizeField& wanted = sizes.empty() ? no_limit : sizes[b];
      auto divided = body.imported ? cells_of_file(body, wanted, model::limits::model_nodes - nodes)
                                   : divide_into_cells(body, wanted, model::limits::model_nodes - nodes,
                                                       former ? &(*former)[b] : nullptr);
      if (const Diagnostic* wrong = std::get_if<Diagnostic>(&divided)) {
        mistakes.push_back(*wrong);
        continue;
      }
      mesh.bodies[b] = std::get<BodyMesh>(std::move(divided));
      if (body.mesh.kind == model::MeshKind::parts && add(too_large_parts(body, mesh.bodies[b]))) continue;
      divide_faces_alike(mesh.bodies[b], growing_cracks(model, static_cast<int>(b)));
      if (const std::vector<int> cracks = cracks_with_tractions(model, static_cast<int>(b)); !cracks.empty()) {
        divide_faces_alike(mesh.bodies[b], cracks);
        add_tip_rings(mesh.bodies[b], body, cracks);
        hold_tips(mesh.bodies[b], model, static_cast<int>(b));
      }
      nodes += static_cast<double>(mesh.bodies[b].nodes.size());
      continue;
    }
    if (add(obstacles(body))) continue;
    const bool fem = body.mesh.kind == model::MeshKind::fem;
    mesh.bodies[b] = fem                   ? divide_grid(body)
                     : division[b].empty() ? divide_boundary(body)
                                           : divide_boundary(body, division[b]);
    const bool seen = fem || !add(unseen_edges(body, mesh.bodies[b]));
    if (seen && body.open() && !cracks_with_tractions(model, static_cast<int>(b)).empty())
      add(divided_faces(model, static_cast<int>(b), mesh.bodies[b]));
    nodes += static_cast<double>(mesh.bodies[b].nodes.size());
  }
  return mesh;
}

/// Sides that could not be divided alike. What is refined alike is checked before it is refined.
std::vector<Diagnostic> unlike_sides(const model::Model& model, const Mesh& mesh,
                                     const std::vector<std::size_t>& unlike) {
  std::vector<Diagnostic> mistakes;
  const std::vector<Joint> joints = joints_of(model, mesh.placement);
  for (const std::size_t j : unlike) {
    const Joint& joint = joints[j];
    if (!sides_to_match(model, joint, mesh.bodies)) continue;
    mistakes.push_back({joint.source, fmt::format("the elements of {} and {} do not match, although their nodes do: "
                                                  "give both bodies the same mesh size and order along the contact",
                                                  joint.a.text, joint.b.text)});
  }
  return mistakes;
}

/// Divides the sides of contacts and ties alike, in the placement of the mesh, and adds their pairs.
std::vector<Diagnostic> match_and_pair(const model::Model& model, Mesh& mesh) {
  PairingFaults faults = add_interfaces(model, mesh);
  if (faults.mistakes.empty() && faults.unlike.empty()) return {};
  if (auto matched = match_sides(model, mesh.bodies, mesh.placement)) {
    mesh.bodies = *std::move(matched);
    faults = add_interfaces(model, mesh);
  }
  return faults.mistakes.empty() ? unlike_sides(model, mesh, faults.unlike) : faults.mistakes;
}

Mesh make_mesh(const model::Model& model, const Division& division, const Sizes& sizes,
               std::vector<FormerVertices>* former) {
  std::vector<Diagnostic> mistakes;
  Mesh mesh = divide_bodies(model, division, sizes, former, mistakes);
  const auto add = [&](std::vector<Diagnostic> more) {
    std::move(more.begin(), more.end(), std::back_inserter(mistakes));
  };
  add(close_mouths(model, mesh.bodies));
  add(match_and_pair(model, mesh));
  add(ambiguous_points(model, mesh));
  for (std::size_t b = 0; model.analysis.revolved() && b < mesh.bodies.size(); ++b)
    if (auto mistake = divide_into_triangles(mesh.bodies[b], model.bodies[b])) mistakes.push_back(std::move(*mistake));
  if (!mistakes.empty()) throw InputError(model.file, without_repetitions(std::move(mistakes)));
  return mesh;
}

}  // namespace

Mesh make_mesh(const model::Model& model, const Division& division, const Sizes& sizes) {
  return make_mesh(model, division, sizes, nullptr);
}

Mesh make_mesh(const model::Model& model, std::vector<FormerVertices>& former) {
  return make_mesh(model, Division(model.bodies.size()), {}, &former);
}

bool has_polygons(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const model::Body& body) { return body.mesh.kind == model::MeshKind::polygons; });
}

std::vector<BodyMesh> divided_bodies(const model::Model& model) {
  std::vector<Diagnostic> mistakes;
  Mesh mesh = divide_bodies(model, Division(model.bodies.size()), {}, nullptr, mistakes);
  if (!mistakes.empty()) throw InputError(model.file, without_repetitions(std::move(mistakes)));
  return std::move(mesh.bodies);
}

std::variant<Mesh, std::vector<Diagnostic>> pair_in(const model::Model& model, std::vector<BodyMesh> bodies,
                                                    Placement placement) {
  Mesh mesh;
  mesh.bodies = std::move(bodies);
  mesh.placement = std::move(placement);
  if (auto wrong = match_and_pair(model, mesh); !wrong.empty()) return wrong;
  return mesh;
}

std::vector<int> Cell::nodes() const {
  std::vector<int> numbers;
  for (const LineElement& element : boundary)
    numbers.insert(numbers.end(), element.nodes.begin(), element.nodes.end() - 1);
  if (is_open()) numbers.push_back(boundary.back().nodes.back());
  return numbers;
}

int BodyMesh::count(CellKind kind) const {
  return static_cast<int>(
      std::count_if(cells.begin(), cells.end(), [kind](const Cell& cell) { return cell.kind == kind; }));
}

Vec2 Mesh::point_of(int contact, const ContactPair& pair, int side) const {
  const Vec2& point = side == 0 ? pair.point_a : pair.point_b;
  if (placement.empty()) return point;
  return point - placement[static_cast<std::size_t>(contact)][static_cast<std::size_t>(side)];
}

int Mesh::nodes() const {
  std::size_t count = 0;
  for (const BodyMesh& body : bodies) count += body.nodes.size();
  return static_cast<int>(count);
}

}  // namespace scabo::mesh
