#include "scabo/mesh/plane/many_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/approximate_nodes.hpp"
#include "scabo/mesh/plane/crack_net.hpp"
#include "scabo/mesh/plane/divide.hpp"
#include "scabo/mesh/plane/domain_triangles.hpp"
#include "scabo/mesh/plane/image.hpp"
#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/mesh/plane/polygons.hpp"
#include "scabo/mesh/plane/quadtree.hpp"
#include "scabo/mesh/plane/refusal.hpp"
#include "scabo/mesh/plane/sides_of_cells.hpp"
#include "scabo/mesh/plane/slit.hpp"
#include "scabo/mesh/plane/star_cells.hpp"
#include "scabo/mesh/plane/unit_free.hpp"

namespace scabo::mesh {

namespace {

/// A side on an arc turns by at most this, so that its chord is near it and cells beside it stay valid.
constexpr double largest_turn_of_side = std::numbers::pi / 12;

/// Part of an element by which the length of an edge, in elements of a size, may be rounded: its ends are (UnitFree).
double rounding_of(double size) {
  return std::min(1e-6 + 2.0 * rounding_of_points(model::MeshKind::polygons) / size, 0.1);
}

/// The wanted sizes of cells of a body.
struct Sizing {
  std::function<double(const Vec2&)> at;
  double largest = 0.0;
  bool uniform = true;  ///< the same everywhere
  double turn = largest_turn_of_side;
};

/// Fractions of the length of an edge at which it is divided, 0 and 1 included.
std::vector<double> breaks_of(const Sizing& sizing, const geometry::Edge& edge, int least_count = 1) {
  const double length = edge.length();
  const double by_turn = edge.arc ? std::abs(edge.arc->sweep) / sizing.turn : 1.0;
  const double rounding = rounding_of(sizing.largest);
  std::vector<double> breaks{0.0};
  if (sizing.uniform) {
    const double count =
        std::max<double>({static_cast<double>(least_count), std::ceil(length / sizing.largest - rounding),
                          std::ceil(by_turn - rounding)});
    for (int k = 1; k < count; ++k) breaks.push_back(k / count);
  } else {
    return graded_breaks(
        edge, {}, sizing.at,
        {static_cast<double>(least_count), sizing.turn, rounding, std::numeric_limits<double>::infinity()});
  }
  breaks.push_back(1.0);
  return breaks;
}

bool is_same(const geometry::Edge& a, const geometry::Edge& b) {
  const auto arc_of = [](const geometry::Edge& edge) {
    const geometry::Arc arc = edge.arc.value_or(geometry::Arc());
    return std::array<double, 5>{arc.centre.x(), arc.centre.y(), arc.radius, arc.start_angle, arc.sweep};
  };
  return a.start == b.start && a.end == b.end && a.points == b.points && arc_of(a) == arc_of(b);
}

/// As it was divided before, if it was; elements that are too coarse or too fine now are divided anew, where several
/// follow each other together.
std::vector<double> breaks_of(const Sizing& sizing, const geometry::Edge& edge, int least_count,
                              const std::vector<FormerLine>& former) {
  const auto before =
      std::find_if(former.begin(), former.end(), [&](const FormerLine& line) { return is_same(line.edge, edge); });
  if (before == former.end()) return breaks_of(sizing, edge, least_count);
  const std::vector<double>& old = before->breaks;
  const auto stays = [&](std::size_t k) {
    return is_near((old[k + 1] - old[k]) * edge.length(), sizing.at(edge.at(0.5 * (old[k] + old[k + 1]))));
  };
  std::vector<double> breaks{0.0};
  for (std::size_t k = 0, last; k + 1 < old.size(); k = last) {
    last = k + 1;
    if (stays(k)) {
      breaks.push_back(old[last]);
      continue;
    }
    while (last + 1 < old.size() && !stays(last)) ++last;
    const std::vector<double> anew =
        graded_breaks(edge, {old[k], old[last]}, sizing.at,
                      {1.0, sizing.turn, rounding_of(sizing.largest), std::numeric_limits<double>::infinity()});
    breaks.insert(breaks.end(), anew.begin() + 1, anew.end());
  }
  return breaks;
}

/// The part of an edge from fraction `from` to `to`.
DomainLine part_of(const geometry::Edge& edge, const std::vector<double>& breaks, std::size_t from, std::size_t to) {
  DomainLine line;
  for (std::size_t k = from; k <= to; ++k) line.points.push_back(edge.at(breaks[k]));
  if (edge.arc) {
    line.arc = edge.arc;
    line.arc->start_angle += breaks[from] * edge.arc->sweep;
    line.arc->sweep *= breaks[to] - breaks[from];
  }
  return line;
}

/// Lines of an edge: one, or two halves of a long arc.
std::vector<DomainLine> lines_of(const geometry::Edge& edge, const std::vector<double>& breaks) {
  const std::size_t last = breaks.size() - 1;
  if (!edge.arc || std::abs(edge.arc->sweep) < std::numbers::pi) return {part_of(edge, breaks, 0, last)};
  return {part_of(edge, breaks, 0, last / 2), part_of(edge, breaks, last / 2, last)};
}

/// Finite elements around the two tips of a crack become cells of their own (slit.hpp), between which some are left.
int least_elements(const model::Body& body, const NetLine& line) {
  return line.crack && body.mesh.kind == model::MeshKind::fem ? 4 : 1;
}

/// Whether the Jacobian of a triangle of six nodes is hardly positive, or not at all, at one of its corners.
bool is_folded(const Cell& triangle, const std::vector<Vec2>& nodes) {
  constexpr double least = 0.05;  // of the triangle with straight sides
  const auto at = [&](std::size_t side, std::size_t k) -> const Vec2& {
    return nodes[static_cast<std::size_t>(triangle.boundary[side % 3].nodes[k])];
  };
  const double straight = cross(at(0, 2) - at(0, 0), at(1, 2) - at(0, 0));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 &corner = at(i, 0), &before = at(i + 2, 0), &after = at(i, 2);
    const Vec2 forth = 4.0 * at(i, 1) - 3.0 * corner - after, back = 4.0 * at(i + 2, 1) - 3.0 * corner - before;
    if (cross(forth, back) < least * straight) return true;
  }
  return false;
}

/// `turn`, `curved_sides`: of a quadtree (QuadtreeOptions); `former`: of polygons.
PolygonMesh polygons_of(const Domain& domain, const model::Body& body, double turn, bool curved_sides,
                        FormerVertices& former) {
  const auto size_of_options = [&body](const Vec2& x) { return wanted_size(body, {}, x); };
  switch (body.mesh.kind) {
    case model::MeshKind::polygons:
      return polygon_mesh(domain, former);
    case model::MeshKind::quadtree:
      return quadtree_mesh(domain, {.min_size = body.mesh.min_size,
                                    .turn = turn,
                                    .curved_sides = curved_sides,
                                    .size_of_roots = size_of_options});
    case model::MeshKind::parts:
      return star_cells(domain);
    case model::MeshKind::fem:
      return triangle_mesh(domain);
    case model::MeshKind::superelement:
    case model::MeshKind::imported:
      break;
  }
  throw BrokenInvariant("one super-element, or a mesh of a file, is not made of polygons");
}

}  // namespace

BodyDomain domain_of(const model::Body& body, const SizeField& sizes, const NarrowOptions& options,
                     const std::vector<FormerLine>& former) {
  BodyDomain made;
  const CrackNet cracks(body);
  const std::vector<NetLine> net = line_net(body, cracks);
  const auto asked = [&body, &sizes](const Vec2& x) { return wanted_size(body, sizes, x); };
  made.narrow = narrow_places(net, cracks.tips(), asked, body.mesh.size, options);
  if (made.narrow.cells > options.most) return made;
  Sizing sizing{asked, body.mesh.size, body.mesh.refine.empty() && sizes.empty() && made.narrow.samples.empty(),
                largest_turn_of_side * options.finer_arcs};
  if (!made.narrow.samples.empty()) {
    const auto narrow = std::make_shared<SizeField>(made.narrow.samples, model::mesh_growth);
    sizing.at = [asked, narrow](const Vec2& x) { return std::min(asked(x), narrow->at(x)); };
  }
  made.lines_of_edge.resize(body.outline.edges.size());
  made.lines_of_crack.resize(cracks.paths().size());
  for (const NetLine& of : net) {
    made.divided.push_back({of.edge, breaks_of(sizing, of.edge, least_elements(body, of), former)});
    for (DomainLine& line : lines_of(of.edge, made.divided.back().breaks)) {
      line.left = of.left;
      line.right = of.right;
      line.crack = of.crack;
      if (of.of_edge >= 0) made.lines_of_edge[static_cast<std::size_t>(of.of_edge)].push_back(made.domain.lines.size());
      if (of.of_crack >= 0)
        made.lines_of_crack[static_cast<std::size_t>(of.of_crack)].push_back(made.domain.lines.size());
      made.domain.lines.push_back(std::move(line));
      made.sources.push_back(of);
    }
  }
  made.domain.centres = cracks.tips();
  made.domain.size = sizing.at;
  return made;
}

namespace {

/// The centre of a polygon from which its sides are seen. A side on a hollow arc is seen from where its end tangents
/// are seen: the corner where they meet stands for it.
Vec2 seeing_centre(const PolygonCell& polygon, const CellSides& sides, const std::vector<Vec2>& nodes, bool straight) {
  if (straight || polygon.open) return polygon.centre;
  bool hollow = false;
  const std::size_t count = polygon.nodes.size();
  bool straight_sides = true;
  for (std::size_t i = 0; straight_sides && i < count; ++i)
    straight_sides = !sides.arc_of(polygon.nodes[i], polygon.nodes[(i + 1) % count]);
  if (straight_sides) return polygon.centre;
  std::vector<Vec2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int a = polygon.nodes[i], b = polygon.nodes[(i + 1) % count];
    const Vec2 &from = nodes[static_cast<std::size_t>(a)], &to = nodes[static_cast<std::size_t>(b)];
    points.push_back(from);
    const std::optional<geometry::Arc> arc = sides.arc_of(a, b);
    if (!arc) continue;
    const Vec2 &centre = arc->centre, middle = 0.5 * (from + to) - centre;
    if (cross(from - centre, to - centre) >= 0.0) continue;  // bulges outwards
    hollow = true;
    points.push_back(centre + (from - centre).squaredNorm() / middle.squaredNorm() * middle);
  }
  constexpr double well_seen = 0.1, hardly_seen = 1e-3;
  if (!hollow || visibility(points, polygon.centre) > well_seen) return polygon.centre;
  const KernelCentre better = kernel_centre(points, well_seen);
  if (better.visibility > hardly_seen) return better.centre;
  throw Refusal("a cell is too large for the arc beside it", polygon.centre);
}

/// Materials and sides of a cell.
Cell cell_of(const PolygonCell& polygon, const model::Body& body, CellSides& sides, const std::vector<Vec2>& nodes) {
  const bool fem = body.mesh.kind == model::MeshKind::fem;
  Cell cell;
  if (fem) cell.kind = CellKind::finite_element;
  cell.centre = seeing_centre(polygon, sides, nodes, body.mesh.order == 1 || fem);  // straight: sides are the chords
  const auto material_of = [&](int region) {
    if (body.image) return region;
    return region == 0 ? body.material : body.regions[static_cast<std::size_t>(region - 1)].material;
  };
  cell.materials = {material_of(polygon.region)};
  if (!polygon.side_regions.empty()) cell.materials.clear();
  const std::size_t count = polygon.nodes.size();
  cell.boundary.reserve(count);
  for (std::size_t i = 0; i + (polygon.open ? 1 : 0) < count; ++i) {
    sides.append(polygon.nodes[i], polygon.nodes[(i + 1) % count], cell.boundary);
    if (!polygon.side_regions.empty())
      cell.materials.resize(cell.boundary.size(), material_of(polygon.side_regions[i]));
  }
  return cell;
}

/// Elements on the edges of the outline, with the node at the beginning of each edge.
void add_sides_on_edges(const PolygonMesh& polygons, const BodyDomain& of, CellSides& sides, BodyMesh& mesh) {
  for (const std::vector<std::size_t>& lines : of.lines_of_edge) {
    std::vector<LineElement>& elements = mesh.edges.emplace_back();
    mesh.corners.push_back(polygons.left[lines.front()].empty() ? -1 : polygons.left[lines.front()].front());
    for (const std::size_t line : lines)
      for (std::size_t k = 0; k + 1 < polygons.left[line].size(); ++k)
        for (LineElement& element : sides.elements(polygons.left[line][k], polygons.left[line][k + 1]))
          elements.push_back(std::move(element));
  }
}

/// Elements on both faces of each crack.
void add_sides_on_cracks(const PolygonMesh& polygons, const BodyDomain& of, CellSides& sides, BodyMesh& mesh) {
  for (const std::vector<std::size_t>& lines : of.lines_of_crack) {
    std::vector<LineElement> left, right;
    for (const std::size_t line : lines) {
      const std::vector<int>&here = polygons.left[line], &there = polygons.right[line];
      for (std::size_t k = 0; k + 1 < here.size(); ++k)
        for (LineElement& element : sides.elements(here[k], here[k + 1])) left.push_back(std::move(element));
      for (std::size_t k = 0; k + 1 < there.size(); ++k) {
        std::vector<LineElement> elements = sides.elements(there[k + 1], there[k]);
        right.insert(right.end(), elements.rbegin(), elements.rend());
      }
    }
    std::reverse(right.begin(), right.end());
    mesh.faces.push_back(std::move(right));
    mesh.faces.push_back(std::move(left));
  }
}

}  // namespace

BodyMesh body_mesh_of(const PolygonMesh& polygons, const BodyDomain& of, const model::Body& body) {
  BodyMesh mesh;
  mesh.nodes = polygons.nodes;
  CellSides sides(polygons, of.domain, body.mesh.order, mesh.nodes);
  mesh.cells.reserve(polygons.cells.size());
  for (const PolygonCell& polygon : polygons.cells) mesh.cells.push_back(cell_of(polygon, body, sides, mesh.nodes));
  if (body.mesh.kind == model::MeshKind::fem && body.mesh.order == 2)
    for (const Cell& cell : mesh.cells)
      if (is_folded(cell, mesh.nodes)) throw Refusal("a triangle is too large for the arc beside it", cell.centre);
  add_sides_on_edges(polygons, of, sides, mesh);
  add_sides_on_cracks(polygons, of, sides, mesh);
  return mesh;
}

namespace {

/// A body that an image shows. Its regions are its materials.
std::variant<BodyMesh, Diagnostic> divide_image(const model::Body& body, double most_nodes) {
  const model::ImageShape& shape = *body.image;
  ImageOptions options;
  options.pixel = shape.pixel;
  options.size = body.mesh.size;
  options.regions = shape.materials;
  ImageMesh polygons = image_mesh(*shape.image, options);
  const auto corners = static_cast<double>(polygons.nodes.size()), cells = static_cast<double>(polygons.cells.size());
  const double nodes = corners + (body.mesh.order - 1) * (corners + cells - 1.0);  // sides by Euler's formula
  if (nodes > most_nodes)
    return Diagnostic{
        body.mesh.source,
        fmt::format("the image has {:.7g} cells with about {} nodes, more than the {:.7g} allowed: use an "
                    "image of fewer pixels{}",
                    cells, text_of_count(nodes, most_nodes, 2), std::max(most_nodes, 0.0),
                    body.mesh.order > 1 ? " or a lower 'order'" : "")};
  for (Vec2& node : polygons.nodes) node += shape.corner;
  for (PolygonCell& cell : polygons.cells) cell.centre += shape.corner;
  BodyDomain of;
  of.domain.lines.resize(polygons.left.size());
  of.lines_of_edge.assign(polygons.lines_of_side.begin(), polygons.lines_of_side.end());
  BodyMesh mesh = body_mesh_of(polygons, of, body);
  mesh.corners.assign(polygons.corners.begin(), polygons.corners.end());
  return mesh;
}

/// Number of pieces that share no side with each other.
std::size_t pieces_of(const BodyMesh& mesh) {
  DisjointSets pieces(mesh.cells.size());
  SideNumbers cell_of_side(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const LineElement& element : mesh.cells[c].boundary) {
      const int other = cell_of_side.add(element.nodes.front(), element.nodes.back(), static_cast<int>(c)).first;
      pieces.join(c, static_cast<std::size_t>(other));
    }
  return pieces.sets();
}

/// Why a body would have too many nodes, by an estimate; nothing if it would not.
std::optional<Diagnostic> too_many_nodes(const model::Body& body, double most_nodes) {
  // Few parts have nodes on their sides alone, of which those on the outline are counted.
  const double nodes = body.mesh.kind == model::MeshKind::parts ? count_boundary_nodes(body) : approximate_nodes(body);
  if (nodes <= most_nodes) return std::nullopt;
  const geometry::Box box = geometry::box_of(body.outline);
  const double thickness = (box.high - box.low).minCoeff();
  if (body.mesh.kind == model::MeshKind::quadtree && thickness < body.mesh.size)
    return Diagnostic{
        body.mesh.source,
        fmt::format("the squares of a quadtree are not larger than the body is thick, {:.3g}, which "
                    "makes about {} nodes, more than the {:.7g} allowed: make the body thicker or shorter",
                    thickness, text_of_count(nodes, most_nodes, 2), most_nodes)};
  return Diagnostic{body.mesh.source,
                    fmt::format("size {:.6g} would give about {} nodes, more than the {:.7g} allowed: use a larger "
                                "'size'",
                                body.mesh.size, text_of_count(nodes, most_nodes, 2), most_nodes)};
}

/// One way to divide a body. `turn`, `curved_sides`: of a quadtree.
struct Attempt {
  double turn = 0.5, sizes_per_width = 2.0, finer_arcs = 1.0;
  bool narrow = false, curved_sides = false;
};

/// Where a mesher finds no room for its cells, they become smaller beside arcs and in narrow places. Few parts that do
/// not see an arc well, from far along a slab with a hole, get shorter sides on it. A quadtree unites cells that do
/// not see a hollow arc, as between the arc and a line of the tree that is nearly its tangent, with others: smaller
/// cells are there again.
std::vector<Attempt> attempts_for(const model::MeshOptions& options) {
  std::vector<Attempt> attempts{{},
                                {.turn = 0.25, .sizes_per_width = 1.4, .narrow = true},
                                {.turn = 0.125, .sizes_per_width = 1.0, .narrow = true}};
  if (options.kind == model::MeshKind::quadtree && options.order > 1)
    for (const double turn : {0.5, 0.25}) attempts.push_back({.turn = turn, .curved_sides = true});
  if (options.kind == model::MeshKind::parts)
    for (const double finer : {0.5, 0.25})
      attempts.push_back({.turn = 0.125, .sizes_per_width = 1.0, .finer_arcs = finer, .narrow = true});
  return attempts;
}

BodyDomain domain_for(const Attempt& attempt, const UnitFree& own, double most_nodes,
                      const std::vector<FormerLine>& former) {
  return domain_of(own.body(), own.sizes(),
                   {.sizes_per_width = attempt.sizes_per_width,
                    .gaps = attempt.narrow,
                    .arcs = attempt.narrow && own.body().mesh.kind == model::MeshKind::quadtree,
                    .most = most_nodes,
                    .finer_arcs = attempt.finer_arcs},
                   former);
}

/// The cells of a domain in the units of the model; of finite elements with open cracks. Throws Refusal. `former`: as
/// of divide_into_cells().
std::variant<BodyMesh, Diagnostic> cells_in(const BodyDomain& of, const Attempt& attempt, const UnitFree& own,
                                            const model::Body& body, FormerVertices& former) {
  const PolygonMesh polygons = polygons_of(of.domain, own.body(), attempt.turn, attempt.curved_sides, former);
  std::vector<BorderNodes> borders;
  for (std::size_t l = 0; l < of.sources.size(); ++l)
    if (of.sources[l].region >= 0)
      borders.push_back({of.sources[l].region, of.sources[l].region_edge, polygons.left[l]});
  BodyMesh mesh = own.real(body_mesh_of(polygons, of, own.body()), borders);
  if (body.mesh.kind == model::MeshKind::fem && !body.cracks.empty()) {
    auto slitted = slit(std::move(mesh), body);
    if (const Diagnostic* wrong = std::get_if<Diagnostic>(&slitted)) return *wrong;
    mesh = std::get<BodyMesh>(std::move(slitted));
  }
  const std::size_t pieces = body.cracks.empty() ? 1 : pieces_of(mesh);
  if (pieces > 1)
    return Diagnostic{body.cracks.front().source,
                      fmt::format("the cracks divide body '{}' into {} pieces: let them end inside, or make the "
                                  "pieces bodies of their own, with a contact between them",
                                  body.name, pieces)};
  return mesh;
}

/// What is said of the narrowest place of a domain.
struct Narrowest {
  Narrowest(const BodyDomain& of, const UnitFree& own)
      : width(own.scale() * of.narrow.width), at(own.real(of.narrow.narrowest)) {}
  std::string place() const { return fmt::format("({:.6g}, {:.6g})", at.x(), at.y()); }
  double width;
  Vec2 at;
};

Diagnostic too_narrow(const model::Body& body, const Narrowest& narrowest, double most_nodes) {
  return {body.mesh.source,
          fmt::format("body '{}' is only {:.3g} wide near {}: cells that fit there make more than the {:.7g} nodes "
                      "allowed; make it wider there, or leave the narrow part out",
                      body.name, narrowest.width, narrowest.place(), most_nodes)};
}

Diagnostic not_divided(const model::Body& body, const Refusal& refusal, const UnitFree& own,
                       const Narrowest& narrowest) {
  std::optional<Vec2> place;
  if (refusal.near()) place = own.real(*refusal.near());
  const std::string narrow =
      narrowest.width > 0.0 ? fmt::format("; its lines are {:.3g} apart near {}", narrowest.width, narrowest.place())
                            : "";
  if (body.mesh.kind == model::MeshKind::parts)
    return {body.mesh.source,
            fmt::format("this shape could not be divided into a few super-elements ({}{}): write kind: polygons, with "
                        "a 'size' below its width",
                        refusal_text(refusal.reason(), place), narrow)};
  return {body.mesh.source,
          fmt::format("this shape could not be divided ({}{}): use a smaller 'size' there, with 'refine', or another "
                      "kind",
                      refusal_text(refusal.reason(), place), narrow)};
}

}  // namespace

std::variant<BodyMesh, Diagnostic> divide_into_cells(const model::Body& body, const SizeField& sizes, double most_nodes,
                                                     FormerVertices* former) {
  if (body.image) {
    try {
      return divide_image(body, most_nodes);
    } catch (const InputError& error) {
      return Diagnostic{body.source, error.diagnostics().front().message};
    }
  }
  if (std::optional<Diagnostic> wrong = too_many_nodes(body, most_nodes)) return *std::move(wrong);
  const UnitFree own(body, sizes);
  const std::vector<Attempt> attempts = attempts_for(body.mesh);
  for (std::size_t a = 0;; ++a) {
    FormerVertices kept;
    if (former && former->attempt == static_cast<int>(a)) kept = *former;
    const BodyDomain of = domain_for(attempts[a], own, most_nodes, kept.lines);
    const Narrowest narrowest(of, own);
    if (of.narrow.cells > most_nodes) return too_narrow(body, narrowest, most_nodes);
    try {
      auto made = cells_in(of, attempts[a], own, body, kept);
      if (former && body.mesh.kind == model::MeshKind::polygons)
        *former = {static_cast<int>(a), of.divided, std::move(kept.segments), std::move(kept.inside)};
      return made;
    } catch (const Refusal& refusal) {
      if (a + 1 == attempts.size()) return not_divided(body, refusal, own, narrowest);
    }
  }
}

}  // namespace scabo::mesh
