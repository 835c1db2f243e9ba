#include "scabo/mesh/plane/imported_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <unordered_map>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/approximate_nodes.hpp"
#include "scabo/mesh/plane/divided_file.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"
#include "scabo/mesh/plane/slit.hpp"

namespace scabo::mesh {

namespace {

/// The centroid is the scaling centre if the triangle over every side has at least this height over length.
constexpr double seen_well = 0.05;
/// Least cross product of the arm from the centre and the tangent of a curved side, relative to its length squared.
constexpr double seen_at_all = 1e-6;

/// Least (x - c) x x' along a side, relative to the square of its chord; positive where the centre sees all of it.
double least_sight(const Vec2& c, const Vec2& a, const Vec2& b, const Vec2* middle) {
  const double length2 = (b - a).squaredNorm();
  if (middle == nullptr) return cross(Vec2(a - c), Vec2(b - c)) / length2;
  // x = m + s d + s^2 e with -1 <= s <= 1, so that (x - c) x x' = f + 2 s g + s^2 h.
  const Vec2 d = 0.5 * (b - a), e = 0.5 * (a + b) - *middle, arm = *middle - c;
  const double f = cross(arm, d), g = cross(arm, e), h = cross(d, e);
  double least = std::min(f + h - 2.0 * g, f + h + 2.0 * g);
  if (h > 0.0 && std::abs(g) < h) least = std::min(least, f - g * g / h);
  return 2.0 * least / length2;  // as of a straight side, where d is half its length
}

std::uint64_t key_of(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
}

class FileCells {
 public:
  /// `file`: the mesh of the body, or a finer one.
  FileCells(const model::Body& body, const files::ImportedMesh& file)
      : body_(body), file_(file), fem_(body.mesh.kind == model::MeshKind::fem), divided_(&file != body.imported.get()) {
    made_.nodes = file_.nodes;
  }

  std::variant<BodyMesh, Diagnostic> run(double most_nodes) {
    if (const auto wrong = too_many(most_nodes)) return *wrong;
    made_.cells.reserve(file_.cells.size());
    for (const files::ImportedCell& cell : file_.cells)
      if (const auto wrong = add(cell)) return Diagnostic{body_.mesh.source, *wrong};
    for (const files::FacetSet& set : file_.facet_sets) {
      std::vector<LineElement>& edge = made_.edges.emplace_back();
      for (const files::Facet& facet : set.facets) edge.push_back(line_element(facet));
      made_.corners.push_back(edge.front().nodes.front());
    }
    // Middle nodes of raised sides are left over; a body of one super-element has its numbers.
    if (body_.mesh.order > 2 || made_.cells.size() == 1) return renumbered(made_);
    return std::move(made_);
  }

 private:
  std::optional<Diagnostic> too_many(double most_nodes) const {
    double sides = 0.0;
    for (const files::ImportedCell& cell : file_.cells) sides += 0.5 * cell.corners();
    const double nodes = static_cast<double>(file_.nodes.size()) + (fem_ ? 0.0 : (body_.mesh.order - 1) * sides);
    if (nodes <= most_nodes) return std::nullopt;
    return Diagnostic{body_.mesh.source,
                      fmt::format("the mesh would have about {} nodes, more than the {:.7g} allowed: use a coarser "
                                  "mesh{}",
                                  text_of_count(nodes, most_nodes, 2), most_nodes,
                                  body_.mesh.order > 2 ? " or a lower 'order'" : "")};
  }

  std::string label(const files::ImportedCell& cell) const {
    std::string name = std::filesystem::path(body_.mesh.file).filename().string();
    if (name.empty()) name = "the mesh";
    return fmt::format("cell {} of {} ({}{})", cell.number, name, files::name_of(cell.kind),
                       cell.line > 0 ? fmt::format(", line {}", cell.line) : "");
  }

  const Vec2& at(int node) const { return file_.nodes[static_cast<std::size_t>(node)]; }

  std::optional<std::string> add(const files::ImportedCell& from) {
    Cell cell;
    cell.materials = {body_.region_materials[static_cast<std::size_t>(from.region)]};
    const bool polygon = from.kind == files::CellKind::polygon || from.kind == files::CellKind::quadratic_polygon;
    if (fem_ && !(polygon && divided_)) {  // the points of finer neighbours are on the sides of super-elements
      cell.kind = CellKind::finite_element;
      if (polygon)
        return fmt::format("{} is no finite element, which has three or four sides: use elements: superelement",
                           label(from));
      for (int i = 0; i < from.corners(); ++i)
        cell.centre += at(from.nodes[static_cast<std::size_t>(i)]) / from.corners();
    } else if (const auto centre = centre_of(from)) {
      cell.centre = *centre;
    } else {
      return fmt::format(
          "{}: not all of its boundary is visible from one point, so that it cannot be a super-element: "
          "mesh again, or divide it",
          label(from));
    }
    for (int i = 0; i < from.corners(); ++i) cell.boundary.push_back(line_element(files::side_of(from, i)));
    made_.cells.push_back(std::move(cell));
    return std::nullopt;
  }

  bool sees_all(const files::ImportedCell& cell, const Vec2& centre) const {
    for (int i = 0; i < cell.corners(); ++i) {
      const files::Facet side = files::side_of(cell, i);
      const Vec2* middle = side.middle < 0 ? nullptr : &at(side.middle);
      if (!(least_sight(centre, at(side.start), at(side.end), middle) > seen_at_all)) return false;
    }
    return true;
  }

  std::optional<Vec2> centre_of(const files::ImportedCell& cell) const {
    std::vector<Vec2> polygon, outer;  // through all nodes; through the ends and where the tangents there meet
    for (int i = 0; i < cell.corners(); ++i) {
      const files::Facet side = files::side_of(cell, i);
      polygon.push_back(at(side.start));
      outer.push_back(at(side.start));
      if (side.middle < 0) continue;
      polygon.push_back(at(side.middle));
      outer.push_back(2.0 * at(side.middle) - 0.5 * (at(side.start) + at(side.end)));
    }
    const KernelCentre first = kernel_centre(polygon, seen_well);
    if (first.visibility > 0.0 && sees_all(cell, first.centre)) return first.centre;
    for (const std::vector<Vec2>& chain : {polygon, outer}) {
      const KernelCentre best = kernel_centre(chain, std::numeric_limits<double>::infinity());
      if (best.visibility > 0.0 && sees_all(cell, best.centre)) return best.centre;
    }
    return std::nullopt;
  }

  LineElement line_element(const files::Facet& side) {
    const int own = side.middle < 0 ? 1 : 2, order = fem_ ? own : std::max(own, body_.mesh.order);
    if (order == 1) return {{side.start, side.end}};
    if (order == own) return {{side.start, side.middle, side.end}};
    const auto [found, is_new] = inner_.try_emplace(key_of(side.start, side.end));
    const bool forwards = side.start < side.end;
    if (is_new)
      add_inner_nodes(forwards ? side : files::Facet{side.end, side.start, side.middle}, order, found->second);
    const std::vector<int>& inner = found->second;
    LineElement element{{side.start}};
    if (forwards)
      element.nodes.insert(element.nodes.end(), inner.begin(), inner.end());
    else
      element.nodes.insert(element.nodes.end(), inner.rbegin(), inner.rend());
    element.nodes.push_back(side.end);
    return element;
  }

  void add_inner_nodes(const files::Facet& side, int order, std::vector<int>& inner) {
    const std::vector<double> points = geometry::lobatto_points(order);
    const Vec2 &a = at(side.start), &b = at(side.end), m = side.middle < 0 ? Vec2(0.5 * (a + b)) : at(side.middle);
    for (int i = 1; i < order; ++i) {
      const double s = points[static_cast<std::size_t>(i)];
      inner.push_back(static_cast<int>(made_.nodes.size()));
      made_.nodes.push_back(0.5 * s * (s - 1.0) * a + (1.0 - s) * (1.0 + s) * m + 0.5 * s * (s + 1.0) * b);
    }
  }

  const model::Body& body_;
  const files::ImportedMesh& file_;
  bool fem_, divided_;
  std::unordered_map<std::uint64_t, std::vector<int>> inner_;  // of raised sides, from the end with the lower number
  BodyMesh made_;
};

}  // namespace

std::variant<BodyMesh, Diagnostic> cells_of_file(const model::Body& body, const SizeField& sizes, double most_nodes) {
  ensure(body.imported && body.region_materials.size() == body.imported->regions.size(),
         "every region of an imported body has a material");
  const files::ImportedMesh* mesh = body.imported.get();
  files::ImportedMesh as_asked, as_estimated;
  if (!body.mesh.refine.empty()) {
    const SizeField no_limit;
    as_asked = divided_mesh(
        *mesh, [&](const Vec2& x) { return wanted_size(body, no_limit, x); }, most_nodes);
    mesh = &as_asked;
  }
  if (!sizes.empty()) {
    // Cells around tips of cracks become one, whose accuracy does not depend on its size but on the points along its
    // boundary: only what is around them is divided.
    std::vector<Vec2> ends;
    for (const model::Crack& crack : body.cracks) ends.insert(ends.end(), {crack.path.front(), crack.path.back()});
    const std::vector<bool> kept =
        cells_around(*mesh, ends, SlitOptions{}.layers, 1e-7 * geometry::outline_size(body.outline));
    as_estimated = divided_mesh(
        *mesh, [&](const Vec2& x) { return sizes.at(x); }, most_nodes, kept);
    mesh = &as_estimated;
  }
  std::variant<BodyMesh, Diagnostic> made = FileCells(body, *mesh).run(most_nodes);
  if (body.cracks.empty() || std::holds_alternative<Diagnostic>(made)) return made;
  return slit(std::get<BodyMesh>(std::move(made)), body);
}

}  // namespace scabo::mesh
