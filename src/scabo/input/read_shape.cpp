// `shape` of a body -> an outline, counter-clockwise if it is closed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr auto most_edges = static_cast<std::size_t>(limits::edges);

constexpr const char* shape_example = "{rectangle: {corner: [0, 0], size: [6, 1.5]}}";
constexpr const char* piece_example = "{line: {from: [0, 0], to: [1, 0]}, name: bottom}";

Arc make_arc(const Vec2& start, const Vec2& end, const Vec2& centre, bool counter_clockwise) {
  const Vec2 a = start - centre;
  const Vec2 b = end - centre;
  Arc arc;
  arc.centre = centre;
  arc.radius = 0.5 * (a.norm() + b.norm());
  arc.start_angle = std::atan2(a.y(), a.x());
  arc.sweep = std::atan2(cross(a, b), a.dot(b));
  if (counter_clockwise && arc.sweep <= 0.0) arc.sweep += 2.0 * std::numbers::pi;
  if (!counter_clockwise && arc.sweep >= 0.0) arc.sweep -= 2.0 * std::numbers::pi;
  return arc;
}

/// Gives every edge and corner its own name, `edge_1` and `vertex_1` from the first.
void number_names(Outline& outline) {
  for (std::size_t i = 0; i < outline.edges.size(); ++i) {
    outline.edges[i].names.insert(outline.edges[i].names.begin(), fmt::format("edge_{}", i + 1));
    outline.corners.push_back({{fmt::format("vertex_{}", i + 1)}, outline.edges[i].start});
  }
}

/// Makes a closed outline run counter-clockwise. One that crosses itself has no direction.
void turn_counter_clockwise(Outline& outline) {
  if (outline.area() < 0.0 && !find_crossing(outline)) turn_round(outline);
}

/// `names: {crest: edge_3}`: additional names for edges and corners.
void read_names(Reading& reading, const Value& value, Outline& outline) {
  std::unordered_map<std::string, std::vector<std::string>*> owners;
  std::vector<std::string> known;
  const auto collect = [&](std::vector<std::string>& names) {
    known.push_back(names.front());
    for (const std::string& name : names) owners.emplace(name, &names);
  };
  for (Edge& edge : outline.edges) collect(edge.names);
  for (Corner& corner : outline.corners) collect(corner.names);
  for (const Entry& entry : read_named(reading.report, value, "edges and corners", "{crest: edge_3}")) {
    const auto text = read_text(reading.report, entry.value);
    if (!text) continue;
    const auto owner = owners.find(*text);
    if (owner == owners.end()) {
      reading.report.error(entry.value, fmt::format("there is no edge or corner named {}{}", quoted_name(*text),
                                                    suggestion(*text, known)));
    } else if (owners.contains(entry.key)) {
      reading.report.error(entry.key_source, fmt::format("'{}' already names {}: choose another name", entry.key,
                                                         owners.at(entry.key)->front()));
    } else {
      owner->second->push_back(entry.key);
      owners.emplace(entry.key, owner->second);
    }
  }
}

std::optional<Outline> read_rectangle(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"corner", "size"}, "{corner: [0, 0], size: [6, 1.5]}");
  const auto corner_value = map.need("corner");
  const auto size_value = map.need("size");
  const auto corner = corner_value ? read_vector(reading.report, *corner_value) : std::nullopt;
  const auto size = size_value ? read_vector(reading.report, *size_value) : std::nullopt;
  if (size && !(size->x() > 0.0 && size->y() > 0.0)) {
    reading.report.error(*size_value, fmt::format("width and height must be greater than 0, not {} and {}",
                                                  number_text(size->x()), number_text(size->y())));
    return {};
  }
  if (!corner || !size) return {};
  return rectangle_outline(*corner, *size, value.source());
}

/// A full circle: one edge that ends where it starts.
std::optional<Outline> read_circle(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"centre", "radius"}, "{centre: [0, 0], radius: 0.5}");
  const auto centre_value = map.need("centre");
  const auto radius_value = map.need("radius");
  const auto centre = centre_value ? read_vector(reading.report, *centre_value) : std::nullopt;
  const auto radius = radius_value ? read_number(reading.report, *radius_value) : std::nullopt;
  if (radius && !(*radius > 0.0)) {
    reading.report.error(*radius_value, fmt::format("must be greater than 0, not {}", number_text(*radius)));
    return {};
  }
  if (!centre || !radius) return {};
  if (!(*radius > 0.0)) {
    reading.report.error(*radius_value, fmt::format("must be greater than 0, not {}", number_text(*radius)));
    return {};
  }
  Edge edge;
  edge.names = {"rim"};
  edge.start = edge.end = *centre + Vec2(*radius, 0.0);
  edge.arc = Arc{*centre, *radius, 0.0, 2.0 * std::numbers::pi};
  edge.source = value.source();
  Outline outline;
  outline.edges = {edge};
  outline.corners = {{{"rim_start"}, edge.start}};
  return outline;
}

std::optional<Outline> read_polygon(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"vertices", "names"}, "{vertices: [[0, 0], [4, 0], [0, 3]]}");
  const auto vertices_value = map.need("vertices");
  if (!vertices_value) return {};
  const auto items = read_list(reading.report, *vertices_value, "[[0, 0], [4, 0], [0, 3]]");
  if (!items) return {};
  if (items->size() < 3 || items->size() > most_edges) {
    reading.report.error(
        *vertices_value,
        items->size() < 3 ? fmt::format("a polygon needs at least three vertices, not {}", items->size())
                          : fmt::format("{} vertices are too many: at most {} are allowed", items->size(), most_edges));
    return {};
  }
  Outline outline;
  for (const Value& item : *items) {
    const auto vertex = read_vector(reading.report, item);
    if (!vertex) continue;
    Edge edge;
    edge.start = *vertex;
    edge.source = item.source();
    outline.edges.push_back(edge);
  }
  if (outline.edges.size() < items->size()) return {};
  for (std::size_t i = 0; i < outline.edges.size(); ++i) {
    outline.edges[i].end = outline.edges[(i + 1) % outline.edges.size()].start;
  }
  number_names(outline);
  if (const auto names = map.get("names")) read_names(reading, *names, outline);
  turn_counter_clockwise(outline);
  return outline;
}

/// A piece of an outline before omitted points are filled in.
struct Piece {
  Value at;
  std::optional<Vec2> from;
  Vec2 to = Vec2::Zero();
  bool is_arc = false;
  Vec2 centre = Vec2::Zero();
  bool counter_clockwise = true;
  std::vector<std::string> names;
};

std::optional<Piece> read_piece(Reading& reading, const Value& value) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"line", "arc", "name"}, piece_example);
  if (!map.is_map()) return {};
  if (map.has("line") == map.has("arc")) {
    if (report.count() == before) {
      report.error(value, map.has("arc") ? "needs either line or arc, not both" : "needs line or arc");
    }
    return {};
  }
  Piece piece{value, {}, Vec2::Zero(), map.has("arc"), Vec2::Zero(), true, {}};
  std::vector<std::string> keys{"from", "to"};
  if (piece.is_arc) keys.insert(keys.end(), {"centre", "direction"});
  const MapReader ends(report, *map.get(piece.is_arc ? "arc" : "line"), keys,
                       piece.is_arc ? "{from: [1, 0], to: [0, 1], centre: [0, 0]}" : "{from: [0, 0], to: [1, 0]}");
  if (const auto from = ends.get("from")) piece.from = read_vector(report, *from);
  if (const auto to = ends.need("to")) piece.to = read_vector(report, *to).value_or(Vec2::Zero());
  if (piece.is_arc) {
    if (const auto centre = ends.need("centre")) {
      piece.centre = read_vector(report, *centre).value_or(Vec2::Zero());
    }
    if (const auto direction = ends.get("direction")) {
      const auto choice = read_choice(report, *direction, {"counter_clockwise", "clockwise"});
      piece.counter_clockwise = choice.value_or("counter_clockwise") == "counter_clockwise";
    }
  }
  if (const auto name = map.get("name")) {
    const auto text = read_text(report, *name);
    if (text && check_name(report, name->source(), *text)) piece.names = {*text};
  }
  if (report.count() > before) return {};
  return piece;
}

/// The edge of a piece that starts at `start`.
Edge make_edge(const Piece& piece, const Vec2& start) {
  Edge edge;
  edge.names = piece.names;
  edge.start = start;
  edge.end = piece.to;
  edge.source = piece.at.source();
  if (piece.is_arc) edge.arc = make_arc(start, piece.to, piece.centre, piece.counter_clockwise);
  return edge;
}

std::optional<Outline> read_outline(Reading& reading, const Value& value, const std::optional<Value>& names) {
  const auto items = read_list(reading.report, value, "[{line: {to: [1, 0]}}, ...]");
  if (!items) return {};
  if (items->size() < 2 || items->size() > most_edges) {
    reading.report.error(
        value, items->size() < 2
                   ? fmt::format("an outline needs at least two pieces, not {}", items->size())
                   : fmt::format("{} pieces are too many: at most {} are allowed", items->size(), most_edges));
    return {};
  }
  std::vector<Piece> pieces;
  for (const Value& item : *items) {
    if (auto piece = read_piece(reading, item)) pieces.push_back(std::move(*piece));
  }
  if (pieces.size() < items->size()) return {};
  double size = 0.0;
  for (const Piece& piece : pieces) size = std::max(size, (piece.to - pieces.front().to).norm());
  Outline outline;
  bool closed = true;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec2 before = pieces[(i + pieces.size() - 1) % pieces.size()].to;
    const Vec2 start = pieces[i].from.value_or(before);
    const bool joined = (start - before).norm() <= 1e-9 * size;
    closed = closed && joined;
    // Exactly the same point, so that neighbouring edges share their corner.
    outline.edges.push_back(make_edge(pieces[i], joined ? before : start));
  }
  number_names(outline);
  if (names) read_names(reading, *names, outline);
  if (closed) turn_counter_clockwise(outline);
  return outline;
}

}  // namespace

Outline rectangle_outline(const Vec2& a, const Vec2& size, const Source& source) {
  const Vec2 b = a + size;
  const std::array<Vec2, 4> points{a, Vec2(b.x(), a.y()), b, Vec2(a.x(), b.y())};
  const std::array<const char*, 4> edge_names{"bottom", "right", "top", "left"};
  const std::array<const char*, 4> corner_names{"bottom_left", "bottom_right", "top_right", "top_left"};
  Outline outline;
  outline.rectangle = true;
  for (std::size_t i = 0; i < 4; ++i) {
    Edge edge;
    edge.names = {edge_names[i]};
    edge.start = points[i];
    edge.end = points[(i + 1) % 4];
    edge.source = source;
    outline.edges.push_back(edge);
    outline.corners.push_back({{corner_names[i]}, points[i]});
  }
  return outline;
}

std::optional<Outline> read_shape(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"rectangle", "circle", "polygon", "outline", "names", "holes"},
                      shape_example);
  if (!map.is_map()) return {};
  map.refuse("holes",
             "is a key of the body: write holes: {bore: {circle: {centre: [1, 1], radius: 0.2}}} beside "
             "'shape'");
  const int kinds =
      int(map.has("rectangle")) + int(map.has("circle")) + int(map.has("polygon")) + int(map.has("outline"));
  if (kinds != 1) {
    if (kinds > 1 || reading.report.count() == before) {
      reading.report.error(value, fmt::format("needs exactly one of rectangle, circle, polygon and outline, not {}",
                                              kinds == 0 ? "none" : std::to_string(kinds)));
    }
    return {};
  }
  if (!map.has("outline")) {
    map.refuse("names", map.has("polygon")
                            ? "belongs inside polygon: {vertices: [...], names: {crest: edge_3}}"
                            : "the edges of a rectangle or circle have fixed names: use an outline for other names");
  }
  if (const auto rectangle = map.get("rectangle")) return read_rectangle(reading, *rectangle);
  if (const auto circle = map.get("circle")) return read_circle(reading, *circle);
  if (const auto polygon = map.get("polygon")) return read_polygon(reading, *polygon);
  return read_outline(reading, *map.get("outline"), map.get("names"));
}

namespace {

/// The name in front of those of the edges and corners; alone for a shape of one edge.
void prefix_names(Outline& outline, const std::string& name) {
  const bool alone = outline.edges.size() == 1;
  for (Edge& edge : outline.edges) edge.names.front() = alone ? name : name + "_" + edge.names.front();
  for (Corner& corner : outline.corners) corner.names.front() = name + "_" + corner.names.front();
}

}  // namespace

bool read_holes(Reading& reading, const Value& value, Outline& outline) {
  const std::size_t before = reading.report.count();
  for (const Entry& entry :
       read_named(reading.report, value, "holes", "{bore: {circle: {centre: [1, 1], radius: 0.2}}}")) {
    auto hole = read_shape(reading, entry.value);
    if (!hole) continue;
    prefix_names(*hole, entry.key);
    turn_round(*hole);  // its material is on the left
    outline.holes.push_back(static_cast<int>(outline.edges.size()));
    outline.edges.insert(outline.edges.end(), hole->edges.begin(), hole->edges.end());
    outline.corners.insert(outline.corners.end(), hole->corners.begin(), hole->corners.end());
    outline.rectangle = false;
  }
  return reading.report.count() == before;
}

void read_regions(Reading& reading, const Value& value, Body& body) {
  const char* example = "{inclusion: {material: steel, shape: {circle: {centre: [1, 1], radius: 0.2}}}}";
  for (const Entry& entry : read_named(reading.report, value, "regions", example)) {
    const MapReader map(reading.report, entry.value, {"material", "shape"}, example);
    Region region;
    region.name = entry.key;
    region.source = entry.key_source;
    if (const auto material = map.need("material"))
      region.material = read_material_name(reading, *material).value_or(-1);
    const auto shape = map.need("shape");
    if (auto outline = shape ? read_shape(reading, *shape) : std::nullopt) {
      region.outline = std::move(*outline);
      prefix_names(region.outline, entry.key);
    }
    body.regions.push_back(std::move(region));
  }
}

}  // namespace scabo::input
