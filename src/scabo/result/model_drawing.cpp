#include "scabo/result/model_drawing.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace scabo::result {

namespace {

using DrawingJson = nlohmann::ordered_json;

constexpr std::size_t most_cells = 20000;

DrawingJson json_of_vector(const Vec2& x) { return {x.x(), x.y()}; }

DrawingJson json_of_points(const std::vector<Vec2>& points) {
  DrawingJson json = DrawingJson::array();
  for (const Vec2& x : points) json.push_back(json_of_vector(x));
  return json;
}

/// From start to end, an arc by a chord for each three degrees or so.
std::vector<Vec2> points_along(const geometry::Edge& edge) {
  std::vector<Vec2> points{edge.start};
  points.insert(points.end(), edge.points.begin(), edge.points.end());
  constexpr int chords = 120;
  for (int k = 1; edge.arc && k < chords; ++k) points.push_back(edge.at(static_cast<double>(k) / chords));
  points.push_back(edge.end);
  return points;
}

/// Where a support, spring or load acts, in the model as it is drawn.
std::vector<Vec2> points_of(const model::Place& place, const model::Model& model, const mesh::Mesh& mesh) {
  const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
  const auto index = static_cast<std::size_t>(place.index);
  switch (place.kind) {
    case model::Place::Kind::body:
      return {body.outline.centroid()};
    case model::Place::Kind::edge:
      return points_along(body.outline.edges[index]);
    case model::Place::Kind::corner:
      return {body.outline.corners[index].position};
    case model::Place::Kind::near:
      if (body.rigid) return {place.near};
      break;
    case model::Place::Kind::face:
    case model::Place::Kind::mouth:
      break;
  }
  std::vector<Vec2> points;
  const mesh::BodyMesh& divided = mesh.bodies[static_cast<std::size_t>(place.body)];
  for (const int node : mesh::nodes_of(place, mesh).nodes)
    points.push_back(divided.nodes[static_cast<std::size_t>(node)]);
  return points;
}

/// Out of the material, in the middle of the points along an edge.
Vec2 normal_of(const std::vector<Vec2>& points) {
  if (points.size() < 2) return Vec2::Zero();
  const std::size_t middle = points.size() / 2;
  const Vec2 tangent = points[middle] - points[middle - 1];
  return Vec2(tangent.y(), -tangent.x()).normalized();
}

DrawingJson entry(const std::string& name, const std::vector<Vec2>& points, const std::vector<Vec2>& along) {
  return {{"name", name}, {"points", json_of_points(points)}, {"along", json_of_points(along)}};
}

/// Names of the steps in which a body or support begins and ends, where it does.
template <typename Staged>
void add_stages(const Staged& of, const std::vector<model::Step>& steps, DrawingJson& to) {
  if (of.added > 0) to["from"] = steps[static_cast<std::size_t>(of.added)].name;
  if (of.removed >= 0) to["until"] = steps[static_cast<std::size_t>(of.removed)].name;
}

DrawingJson support_drawing(const model::Support& support, const std::vector<Vec2>& points) {
  Vec2 first(1.0, 0.0);
  if (support.axes == model::SupportAxes::edge) first = normal_of(points);
  if (support.axes == model::SupportAxes::direction) first = support.along;
  std::vector<Vec2> along;
  if (support.displacement[0]) along.push_back(first);
  if (support.displacement[1]) along.emplace_back(-first.y(), first.x());
  return entry(support.name, points, along);
}

DrawingJson spring_drawing(const model::Spring& spring, const std::vector<Vec2>& points) {
  const Vec2 first = model::acts_along(spring) ? normal_of(points) : Vec2(1.0, 0.0);
  std::vector<Vec2> along;
  if (spring.stiffness[0] > 0.0) along.push_back(first);
  if (spring.stiffness[1] > 0.0) along.emplace_back(-first.y(), first.x());
  return entry(spring.name, points, along);
}

/// The direction in which a load acts at factor 1, in the middle of where it does, if it has one.
std::optional<Vec2> direction_of(const model::Load& load, const std::vector<Vec2>& points) {
  std::optional<Vec2> force;
  const Vec2 normal = normal_of(points);
  if (const auto* of = std::get_if<model::Force>(&load.kind)) force = of->value;
  if (const auto* of = std::get_if<model::Traction>(&load.kind)) force = of->value;
  if (const auto* of = std::get_if<model::Gravity>(&load.kind)) force = of->value;
  if (const auto* of = std::get_if<model::Pressure>(&load.kind)) force = -of->value * normal;
  if (std::holds_alternative<model::Water>(load.kind)) force = -normal;
  if (const auto* of = std::get_if<model::EdgeTable>(&load.kind)) {
    Vec2 sum = Vec2::Zero();
    for (const model::EdgeTable::Point& point : of->points) sum += point.value;
    force = of->pressure ? Vec2(-sum.x() * normal) : sum;
  }
  if (!force || force->isZero(0.0)) return std::nullopt;
  return force->normalized();
}

DrawingJson load_drawing(const model::Load& load, const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<Vec2> points;
  if (load.on) {
    points = points_of(*load.on, model, mesh);
  } else {
    for (const model::Body& body : model.bodies)
      if (!body.outside && !(body.rigid && !body.density)) points.push_back(body.outline.centroid());
  }
  const std::optional<Vec2> direction = direction_of(load, points);
  DrawingJson json = entry(load.name, points, direction ? std::vector<Vec2>{*direction} : std::vector<Vec2>{});
  json["on_edge"] = load.on && load.on->kind == model::Place::Kind::edge;
  return json;
}

DrawingJson body_drawing(const model::Body& body, const mesh::BodyMesh& divided, bool with_cells) {
  DrawingJson json = {{"name", body.name}, {"rigid", body.rigid}, {"unbounded", body.outside}};
  std::vector<std::size_t> firsts{0};
  firsts.insert(firsts.end(), body.outline.holes.begin(), body.outline.holes.end());
  firsts.push_back(body.outline.edges.size());
  json["loops"] = DrawingJson::array();
  for (std::size_t k = 0; k + 1 < firsts.size(); ++k) {
    std::vector<Vec2> loop;
    for (std::size_t e = firsts[k]; e < firsts[k + 1]; ++e) {
      const std::vector<Vec2> points = points_along(body.outline.edges[e]);
      loop.insert(loop.end(), points.begin(), points.end() - 1);
    }
    json["loops"].push_back(json_of_points(loop));
  }
  json["edges"] = DrawingJson::array();
  for (const geometry::Edge& edge : body.outline.edges) {
    const std::vector<Vec2> points = points_along(edge);
    json["edges"].push_back({{"name", edge.names.back()},
                             {"given", edge.names.size() > 1},
                             {"at", json_of_vector(edge.at(0.5))},
                             {"normal", json_of_vector(normal_of(points))}});
  }
  json["cells"] = DrawingJson::array();
  if (!with_cells) return json;
  for (const mesh::Cell& cell : divided.cells) {
    std::vector<Vec2> points;
    for (const int node : cell.nodes()) points.push_back(divided.nodes[static_cast<std::size_t>(node)]);
    if (cell.is_open()) points.push_back(cell.centre);
    json["cells"].push_back(json_of_points(points));
  }
  return json;
}

DrawingJson interface_drawing(const std::string& name, const mesh::Interface& interface) {
  std::vector<Vec2> points;
  for (const mesh::ContactPair& pair : interface.pairs) points.push_back(pair.point_a);
  return entry(name, points, {});
}

}  // namespace

std::string model_drawing(const model::Model& model, const mesh::Mesh& mesh) {
  std::size_t cells = 0;
  for (const mesh::BodyMesh& body : mesh.bodies) cells += body.cells.size();
  DrawingJson json = {{"title", model.title}};
  for (const char* list : {"bodies", "contacts", "ties", "supports", "springs", "bars", "loads"})
    json[list] = DrawingJson::array();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    json["bodies"].push_back(body_drawing(model.bodies[b], mesh.bodies[b], cells <= most_cells));
    add_stages(model.bodies[b], model.steps, json["bodies"].back());
  }
  for (const mesh::Interface& interface : mesh.interfaces)
    json["contacts"].push_back(
        interface_drawing(model.contacts[static_cast<std::size_t>(interface.contact)].name, interface));
  for (const mesh::Interface& interface : mesh.ties) json["ties"].push_back(interface_drawing("tie", interface));
  for (const model::Support& support : model.supports) {
    json["supports"].push_back(support_drawing(support, points_of(support.on, model, mesh)));
    add_stages(support, model.steps, json["supports"].back());
  }
  for (const model::Spring& spring : model.springs)
    json["springs"].push_back(spring_drawing(spring, points_of(spring.on, model, mesh)));
  for (const model::Bar& bar : model.bars) {
    std::vector<Vec2> ends;
    for (const model::Bar::End& end : bar.between) {
      const std::vector<Vec2> points = end.on ? points_of(*end.on, model, mesh) : std::vector<Vec2>{end.at};
      ends.push_back(0.5 * (points.front() + points.back()));
    }
    json["bars"].push_back(entry(bar.name, ends, {}));
  }
  for (const model::Load& load : model.loads) json["loads"].push_back(load_drawing(load, model, mesh));
  return json.dump();
}

}  // namespace scabo::result
