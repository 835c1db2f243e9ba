#include "scabo/analysis/adaptive/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace scabo::analysis {

namespace {

constexpr int highest_order = 10;
/// Fraction of the total error in the elements that are refined in a pass.
constexpr double bulk = 0.8;
/// Predicted reduction of the squared error by one more order; values of Melenk and Wohlmuth.
constexpr double after_raise = 0.4, after_divide = 4.0;
/// Length of the part at a corner relative to the whole, a value known to suit singularities.
constexpr double grading = 0.15;
/// Elements shorter than this, relative to their edge, are not divided: the stiffness loses about 1e-15 times the ratio
/// of the lengths of its elements (5e-10 measured for 1e-5), and energies lose as many digits.
constexpr double shortest_edge = 1e-4;

/// Cells whose share differs by less than this from one that is refined are refined as well.
constexpr double nearly_equal = 0.99;
/// Change of the size of a marked polygon in one pass.
constexpr double least_factor = 0.35, largest_factor = 0.7;
/// What all cells together should reach, as the sum of eq. (1) of adaptive.hpp; a little less than demanded there.
constexpr double aim_of_cells = 0.4;
/// Growth of sizes away from refined cells. Squares are halved without their neighbours (size_field.hpp); the
/// quadtree itself sees to it that sizes change gradually.
constexpr double growth_of_squares = 1.0;
/// Cells smaller than this part of their body are not divided: coordinates of their nodes relative to their centre
/// would lose too many digits.
constexpr double smallest_cell = 1e-8;

/// Whether the cells of a body are refined.
bool is_refined(const model::Body& body) {
  return !body.rigid && body.mesh.tolerance && model::is_divided_inside(body);
}

/// Whether a cell is divided by itself, into halves of its size. Otherwise the body gets a new mesh.
bool is_halved(const model::Body& body) { return body.mesh.kind == model::MeshKind::quadtree || body.imported; }

double growth_of(const model::Body& body) { return is_halved(body) ? growth_of_squares : model::mesh_growth; }

/// Sides around the tip of a crack beyond which they are not divided for its sake: the singular stress is resolved long
/// before, and the cell is solved with dense matrices.
constexpr std::size_t most_sides_around_tip = 40;

struct CellBox {
  Vec2 middle;
  double side = 0.0;   ///< the longer one
  bool filled = true;  ///< the cell is a rectangle
};
CellBox box_of(const mesh::BodyMesh& mesh, const mesh::Cell& cell) {
  Vec2 lower = Vec2::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  double area = 0.0;
  const auto at = [&](int node) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(node)]; };
  for (const mesh::LineElement& element : cell.boundary) {
    const Vec2 &from = at(element.nodes.front()), &to = at(element.nodes.back());
    area += 0.5 * cross(from - cell.centre, to - cell.centre);
    lower = lower.cwiseMin(from).cwiseMin(to);
    upper = upper.cwiseMax(from).cwiseMax(to);
  }
  const Vec2 extent = upper - lower;
  return {0.5 * (lower + upper), extent.maxCoeff(), area > (1.0 - 1e-6) * extent.prod()};
}

/// Size of a cell for the purpose of refining it. The cell at a crack tip is two squares wide. Of a square that a line
/// cuts, only the size that was wanted there is known, which is less than twice that of the square.
double size_of(const mesh::Cell& cell, const CellBox& box, const model::Body& body, const mesh::SizeField& sizes) {
  const double wanted = mesh::wanted_size(body, sizes, box.middle);
  if (body.imported) return box.side;
  if (body.mesh.kind != model::MeshKind::quadtree) return std::min(box.side, wanted);
  if (cell.is_open()) return 0.5 * box.side;
  return box.filled ? box.side : std::clamp(box.side, 0.5 * wanted, wanted);
}

/// Elements that face each other, of edges that are divided as `division` says.
using Partners = std::map<mesh::EdgeElement, mesh::EdgeElement>;
Partners partners_of(const model::Model& model, const mesh::Mesh& mesh, const mesh::Division& division) {
  const auto as_divided = [&](const mesh::EdgeElement& at) {
    const auto b = static_cast<std::size_t>(at.body), e = static_cast<std::size_t>(at.edge);
    return !division[b].empty() && mesh.bodies[b].edges[e].size() == division[b][e].orders.size();
  };
  Partners partner;
  for (const auto& [a, b] : mesh::paired_elements(model, mesh).alike)
    if (as_divided(a) && as_divided(b)) partner[a] = b, partner[b] = a;
  return partner;
}

/// The element of the division of an edge with the middle of an element of the mesh, in which a contact may have
/// inserted nodes (mesh/plane/match.hpp).
int divided_element(const geometry::Edge& edge, const mesh::EdgeDivision& division, const mesh::BodyMesh& mesh,
                    const mesh::LineElement& element) {
  double middle = 0.0;
  for (const int node : {element.nodes.front(), element.nodes.back()})
    middle += 0.5 * geometry::closest_position(edge, mesh.nodes[static_cast<std::size_t>(node)]);
  const auto after = std::upper_bound(division.breaks.begin() + 1, division.breaks.end() - 1, middle);
  return static_cast<int>(after - division.breaks.begin()) - 1;
}

}  // namespace

BoundaryRefinement::BoundaryRefinement(const model::Model& model)
    : model_(model), division_(mesh::initial_division(model)) {
  for (const mesh::BodyDivision& body : division_) {
    auto& of_body = predicted_.emplace_back();
    for (const mesh::EdgeDivision& edge : body)
      of_body.emplace_back(edge.orders.size(), std::numeric_limits<double>::infinity());
  }
}

BoundaryRefinement::Change BoundaryRefinement::change_for(const mesh::EdgeElement& at, double share) const {
  const mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  const auto k = static_cast<std::size_t>(at.element);
  const bool as_predicted =
      share <= predicted_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)][k];
  const bool can_raise = edge.orders[k] < highest_order;
  const bool can_divide = edge.breaks[k + 1] - edge.breaks[k] > shortest_edge;
  if (can_raise && (as_predicted || !can_divide)) return Change::raise;
  return can_divide ? Change::divide : Change::none;
}

bool BoundaryRefinement::at_corner(const mesh::EdgeElement& at, bool start) const {
  const mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  return start ? at.element == 0 : at.element + 1 == static_cast<int>(edge.orders.size());
}

/// Where an element is divided, 0 at its start and 1 at its end.
double BoundaryRefinement::cut_of(const mesh::EdgeElement& at) const {
  const bool start = at_corner(at, true), end = at_corner(at, false);
  return start == end ? 0.5 : start ? grading : 1.0 - grading;
}

void BoundaryRefinement::divide_at_corners(const mesh::Mesh& mesh, const std::vector<mesh::EdgeElement>& elements) {
  const Partners partner = partners_of(model_, mesh, division_);
  std::map<mesh::EdgeElement, double> cuts;
  for (const mesh::EdgeElement& at : elements) {
    if (!cuts.emplace(at, cut_of(at)).second) continue;
    if (const auto other = partner.find(at); other != partner.end()) cuts.emplace(other->second, 1.0 - cuts.at(at));
  }
  for (auto at = cuts.rbegin(); at != cuts.rend(); ++at)  // from the end: places before stay
    apply(at->first, Change::divide, at->second, std::numeric_limits<double>::infinity());
}

void BoundaryRefinement::apply(const mesh::EdgeElement& at, Change change, double cut, double share) {
  mesh::EdgeDivision& edge = division_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  std::vector<double>& predicted = predicted_[static_cast<std::size_t>(at.body)][static_cast<std::size_t>(at.edge)];
  const auto k = static_cast<std::size_t>(at.element);
  if (change == Change::raise) {
    ++edge.orders[k];
    predicted[k] = after_raise * share;
    return;
  }
  const auto place = static_cast<std::ptrdiff_t>(k);
  edge.breaks.insert(edge.breaks.begin() + place + 1, std::lerp(edge.breaks[k], edge.breaks[k + 1], cut));
  const int order = edge.orders[k];
  edge.orders.insert(edge.orders.begin() + place, order);
  const auto left_over = [&](double part) { return 0.5 * after_divide * std::pow(part, 2.0 * order) * share; };
  predicted[k] = left_over(cut);
  predicted.insert(predicted.begin() + place + 1, left_over(1.0 - cut));
}

std::vector<Part> BoundaryRefinement::parts(const MeshErrors& errors) const {
  std::vector<Part> parts;
  for (int b = 0; b < static_cast<int>(division_.size()); ++b) {
    const auto body = static_cast<std::size_t>(b);
    if (!model_.bodies[body].mesh.tolerance) continue;
    const mesh::BodyMesh& mesh = errors.mesh.bodies[body];
    for (int e = 0; e < static_cast<int>(division_[body].size()); ++e) {
      const mesh::EdgeDivision& division = division_[body][static_cast<std::size_t>(e)];
      const auto& elements = mesh.edges[static_cast<std::size_t>(e)];
      const bool as_divided = elements.size() == division.orders.size();
      std::vector<double> shares(division.orders.size(), 0.0);
      std::vector<bool> frozen(shares.size(), elements.empty());
      for (std::size_t k = 0; k < elements.size(); ++k) {
        const auto place = static_cast<std::size_t>(mesh::boundary_element(mesh, e, static_cast<int>(k)));
        const geometry::Edge& edge = model_.bodies[body].outline.edges[static_cast<std::size_t>(e)];
        const std::size_t of =
            as_divided ? k : static_cast<std::size_t>(divided_element(edge, division, mesh, elements[k]));
        shares[of] += errors.shares[body][place];
        if (errors.frozen[body][place]) frozen[of] = true;
      }
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (!frozen[k]) parts.push_back({{b, e, static_cast<int>(k)}, shares[k]});
    }
  }
  return parts;
}

RefinementPass BoundaryRefinement::refine(const MeshErrors& errors, const std::vector<Part>& marked) {
  // The requested changes, with equal changes for facing elements: division takes precedence over a higher order.
  const Partners partner = partners_of(model_, errors.mesh, division_);
  struct Wanted {
    Change change = Change::none;
    double share = 0.0, cut = 0.5;
  };
  std::map<mesh::EdgeElement, Wanted> wanted;
  std::map<mesh::EdgeElement, double> share_of;
  for (const Part& part : parts(errors)) share_of[part.at] = part.share;
  for (const Part& element : marked) {
    if (element.at.edge < 0) continue;
    const Change change = change_for(element.at, element.share);
    if (change == Change::none) continue;
    const double cut = cut_of(element.at);
    const auto want = [&](const mesh::EdgeElement& at, double where) {
      Wanted& here = wanted[at];
      if (here.change == Change::divide || (here.change == Change::raise && change == Change::raise)) return;
      here = {change, share_of.contains(at) ? share_of.at(at) : element.share, where};
    };
    const auto other = partner.find(element.at);
    // An element that has already been divided because of its partner keeps that division.
    if (other != partner.end() && wanted.contains(other->second) && wanted[other->second].change == Change::divide)
      continue;
    want(element.at, cut);
    if (other != partner.end()) want(other->second, 1.0 - cut);
  }
  RefinementPass pass;
  for (auto at = wanted.rbegin(); at != wanted.rend(); ++at) {  // from the end: places before stay
    apply(at->first, at->second.change, at->second.cut, at->second.share);
    ++(at->second.change == Change::raise ? pass.raised : pass.divided);
  }
  return pass;
}

int BoundaryRefinement::largest_body() const {
  int nodes = 0;
  for (const mesh::BodyDivision& body : division_) {
    int of_body = 0;
    for (const mesh::EdgeDivision& edge : body)
      for (const int order : edge.orders) of_body += order;
    nodes = std::max(nodes, of_body);
  }
  return static_cast<int>(places_of(nodes));
}

CellRefinement::CellRefinement(const model::Model& model) : model_(model), sizes_(model.bodies.size()) {}

mesh::Sizes CellRefinement::scaled_sizes(double factor) const {
  mesh::Sizes scaled = sizes_;
  for (std::size_t b = 0; b < scaled.size(); ++b) {
    if (scaled[b].empty()) continue;
    std::vector<mesh::SizeField::Sample> samples = scaled[b].samples();
    for (mesh::SizeField::Sample& sample : samples) sample.size *= factor;
    scaled[b] = mesh::SizeField(samples, growth_of(model_.bodies[b]));
  }
  return scaled;
}

std::vector<Part> CellRefinement::parts(const MeshErrors& errors) const {
  std::vector<Part> parts;
  for (int b = 0; b < static_cast<int>(model_.bodies.size()); ++b) {
    const auto body = static_cast<std::size_t>(b);
    if (!is_refined(model_.bodies[body])) continue;
    for (std::size_t c = 0; c < errors.shares[body].size(); ++c)
      parts.push_back({{b, -1, static_cast<int>(c)}, errors.shares[body][c]});
  }
  return parts;
}

void CellRefinement::divide_at(const mesh::Mesh& mesh, const model::Place& point, double part) {
  const auto b = static_cast<std::size_t>(point.body);
  const model::Body& body = model_.bodies[b];
  if (!is_refined(body) || body.imported) return;  // a mesh of a file has no size
  std::vector<mesh::SizeField::Sample> samples = sizes_[b].samples();
  for (const int node : mesh::nodes_of(point, mesh).nodes)
    samples.push_back({mesh.bodies[b].nodes[static_cast<std::size_t>(node)], part * body.mesh.size});
  sizes_[b] = mesh::SizeField(samples, growth_of(body));
}

RefinementPass CellRefinement::refine(const MeshErrors& errors, const std::vector<Part>& marked) {
  RefinementPass pass;
  std::vector<std::vector<mesh::SizeField::Sample>> samples(model_.bodies.size());
  std::vector<double> cells(model_.bodies.size(), 0.0);  // expected
  std::size_t all = 0;
  for (std::size_t b = 0; b < samples.size(); ++b) {
    if (!is_refined(model_.bodies[b])) continue;
    samples[b] = sizes_[b].samples();
    cells[b] = static_cast<double>(errors.mesh.bodies[b].cells.size());
    all += errors.mesh.bodies[b].cells.size();
  }
  for (const Part& part : marked) {
    if (part.at.edge >= 0) continue;
    const auto b = static_cast<std::size_t>(part.at.body);
    const model::Body& body = model_.bodies[b];
    const mesh::BodyMesh& mesh = errors.mesh.bodies[b];
    const mesh::Cell& cell = mesh.cells[static_cast<std::size_t>(part.at.element)];
    const CellBox box = box_of(mesh, cell);
    if (body.imported && cell.is_open()) {  // it keeps its size, and gets more points along its boundary
      if (cell.boundary.size() >= most_sides_around_tip) continue;
      for (const mesh::LineElement& element : cell.boundary) {
        const Vec2 &from = mesh.nodes[static_cast<std::size_t>(element.nodes.front())],
                   &to = mesh.nodes[static_cast<std::size_t>(element.nodes.back())];
        const double next = 0.5 * (to - from).norm();
        if (next > smallest_cell * geometry::outline_size(body.outline))
          samples[b].push_back({0.5 * (from + to), next});
      }
      cells[b] += static_cast<double>(cell.boundary.size());
      ++pass.divided;
      continue;
    }
    const double size = size_of(cell, box, body, sizes_[b]);
    const bool square = is_halved(body);
    const double target = aim_of_cells / static_cast<double>(all);
    const double factor =
        square ? 0.5
               : std::clamp(std::pow(target / part.share, 0.5 / (body.mesh.order + 1)), least_factor, largest_factor);
    const double next = factor * size;
    if (next < smallest_cell * geometry::outline_size(body.outline)) continue;
    samples[b].push_back({box.middle, next});
    cells[b] += size * size / (next * next) - 1.0;
    ++pass.divided;
  }
  largest_body_ = 0;
  for (std::size_t b = 0; b < samples.size(); ++b) {
    if (!is_refined(model_.bodies[b])) continue;
    sizes_[b] = mesh::SizeField(samples[b], growth_of(model_.bodies[b]));
    const mesh::BodyMesh& mesh = errors.mesh.bodies[b];
    const double nodes = static_cast<double>(mesh.nodes.size()) * cells[b] / static_cast<double>(mesh.cells.size());
    largest_body_ = std::max(largest_body_, static_cast<int>(std::min(2.0 * nodes, 1e9)));
  }
  return pass;
}

std::vector<Part> ModelRefinement::parts(const MeshErrors& errors) const {
  std::vector<Part> parts = boundaries.parts(errors);
  for (const Part& cell : cells.parts(errors)) parts.push_back(cell);
  return parts;
}

RefinementPass ModelRefinement::refine(const MeshErrors& errors, const std::vector<Part>& marked) {
  RefinementPass pass = boundaries.refine(errors, marked);
  const RefinementPass of_cells = cells.refine(errors, marked);
  pass.raised += of_cells.raised;
  pass.divided += of_cells.divided;
  return pass;
}

std::vector<Part> mark(std::vector<Part> parts) {
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.share > b.share; });
  double sum = 0.0, held = 0.0;
  for (const Part& part : parts) sum += part.share;
  std::size_t count = 0;
  for (; count < parts.size() && held < bulk * sum && parts[count].share > 0.0; ++count) held += parts[count].share;
  const double last = count > 0 ? parts[count - 1].share : 0.0;
  const auto as_the_last = [&](const Part& part) { return part.at.edge < 0 && part.share > nearly_equal * last; };
  while (count > 0 && count < parts.size() && as_the_last(parts[count])) ++count;
  parts.resize(count);
  return parts;
}

}  // namespace scabo::analysis
