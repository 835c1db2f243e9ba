#include "scabo/mesh/plane/replace_elements.hpp"

#include <algorithm>
#include <set>

#include "scabo/geometry/line_basis.hpp"

namespace scabo::mesh {

namespace {

LineElement turned_round(const LineElement& element) { return {{element.nodes.rbegin(), element.nodes.rend()}}; }

/// Appends what takes the place of `element`; the number of elements appended.
std::size_t append(const LineElement& element, const Replacements& replacements, std::vector<LineElement>& line) {
  if (const auto found = replacements.find(element.nodes); found != replacements.end()) {
    line.insert(line.end(), found->second.begin(), found->second.end());
    return found->second.size();
  }
  if (const auto found = replacements.find(turned_round(element).nodes); found != replacements.end()) {
    for (auto part = found->second.rbegin(); part != found->second.rend(); ++part) line.push_back(turned_round(*part));
    return found->second.size();
  }
  line.push_back(element);
  return 1;
}

/// Centroid of the polygon of all nodes of a closed boundary.
Vec2 centroid(const Cell& cell, const std::vector<Vec2>& nodes) {
  const std::vector<int> numbers = cell.nodes();
  const Vec2 origin = nodes[static_cast<std::size_t>(numbers.front())];
  double twice_area = 0.0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Vec2 from = nodes[static_cast<std::size_t>(numbers[i])] - origin;
    const Vec2 to = nodes[static_cast<std::size_t>(numbers[(i + 1) % numbers.size()])] - origin;
    twice_area += cross(from, to);
    moment += cross(from, to) * (from + to);
  }
  return origin + moment / (3.0 * twice_area);
}

}  // namespace

void become_superelement(Cell& cell, const std::vector<Vec2>& nodes) {
  cell.kind = CellKind::superelement;
  cell.centre = centroid(cell, nodes);
}

namespace {

void replace_in_cell(Cell& cell, const Replacements& replacements, const std::vector<Vec2>& nodes) {
  std::vector<LineElement> boundary;
  std::vector<int> materials;
  bool alike = true;
  for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
    const std::size_t parts = append(cell.boundary[k], replacements, boundary);
    alike &= parts == 1 && boundary.back().nodes.size() == cell.boundary[k].nodes.size();
    if (cell.materials.size() > 1) materials.insert(materials.end(), parts, cell.materials[k]);
  }
  cell.boundary = std::move(boundary);
  if (cell.materials.size() > 1) cell.materials = std::move(materials);
  if (cell.kind == CellKind::superelement || alike) return;
  become_superelement(cell, nodes);
}

}  // namespace

void replace_elements(BodyMesh& mesh, const Replacements& replacements) {
  for (auto* lines : {&mesh.edges, &mesh.faces})
    for (std::vector<LineElement>& edge : *lines) {
      std::vector<LineElement> line;
      for (const LineElement& element : edge) append(element, replacements, line);
      edge = std::move(line);
    }
  for (Cell& cell : mesh.cells) {
    const bool concerned = std::any_of(cell.boundary.begin(), cell.boundary.end(), [&](const LineElement& element) {
      return replacements.contains(element.nodes) || replacements.contains(turned_round(element).nodes);
    });
    if (concerned) replace_in_cell(cell, replacements, mesh.nodes);
  }
}

void move_nodes(BodyMesh& mesh, const std::map<int, Vec2>& moved, const Replacements& replaced) {
  std::map<int, Vec2> positions = moved;  // of inner nodes too; a line element of two cells is displaced once
  const auto follow = [&](const LineElement& element, bool from_end) {
    const int end = from_end ? element.nodes.back() : element.nodes.front();
    const auto found = moved.find(end);
    if (found == moved.end()) return;
    const Vec2 displacement = found->second - mesh.nodes[static_cast<std::size_t>(end)];
    const std::vector<double> points = geometry::lobatto_points(static_cast<int>(element.nodes.size()) - 1);
    for (std::size_t i = 1; i + 1 < element.nodes.size(); ++i) {
      const double share = 0.5 * (1.0 + (from_end ? points[i] : -points[i]));
      const int node = element.nodes[i];
      const auto place = positions.emplace(node, mesh.nodes[static_cast<std::size_t>(node)]).first;
      place->second += share * displacement;
    }
  };
  std::set<std::vector<int>> done;
  for (const Cell& cell : mesh.cells)
    for (const LineElement& element : cell.boundary) {
      if (!moved.contains(element.nodes.front()) && !moved.contains(element.nodes.back())) continue;
      const std::vector<int> turned = turned_round(element).nodes;
      if (replaced.contains(element.nodes) || replaced.contains(turned)) continue;
      if (!done.insert(std::min(element.nodes, turned)).second) continue;
      follow(element, false);
      follow(element, true);
    }
  for (const auto& [node, position] : positions) mesh.nodes[static_cast<std::size_t>(node)] = position;
}

BodyMesh renumbered(const BodyMesh& mesh) {
  std::vector<int> number(mesh.nodes.size(), -1);
  int count = 0;
  const auto add = [&](int node) {
    int& here = number[static_cast<std::size_t>(node)];
    if (here < 0) here = count++;
  };
  if (mesh.cells.size() == 1 && mesh.cells.front().kind == CellKind::superelement) {
    for (const int node : mesh.cells.front().nodes()) add(node);
  } else {
    std::vector<bool> used(mesh.nodes.size(), false);
    for (const Cell& cell : mesh.cells)
      for (const int node : cell.nodes()) used[static_cast<std::size_t>(node)] = true;
    for (std::size_t node = 0; node < used.size(); ++node)
      if (used[node]) add(static_cast<int>(node));
  }
  BodyMesh made = mesh;
  made.nodes.resize(static_cast<std::size_t>(count));
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0) made.nodes[static_cast<std::size_t>(number[node])] = mesh.nodes[node];
  const auto renumber = [&](int& node) {
    if (node >= 0) node = number[static_cast<std::size_t>(node)];
  };
  const auto renumber_elements = [&](std::vector<LineElement>& elements) {
    for (LineElement& element : elements)
      for (int& node : element.nodes) renumber(node);
  };
  for (Cell& cell : made.cells) renumber_elements(cell.boundary);
  for (auto* lines : {&made.edges, &made.faces})
    for (std::vector<LineElement>& edge : *lines) renumber_elements(edge);
  for (int& corner : made.corners) renumber(corner);
  for (int& node : made.mouth) renumber(node);
  return made;
}

}  // namespace scabo::mesh
