#include "scabo/mesh/plane/tip_rings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::mesh {

namespace {

/// What becomes of a tip's cell: the innermost copy, the cells of the rings, and their sides on the two side faces,
/// from the boundary towards the tip.
struct DividedTip {
  Cell innermost;
  std::vector<Cell> cells;
  std::vector<LineElement> first, last;
  int rings = 0;
};

/// Boundary elements that have one element in the copies.
struct Sector {
  std::size_t first = 0, count = 1;
  std::vector<Vec2> arms;  // from the tip to the points of that element at the size of the boundary
};

LineElement inverted(const LineElement& element) { return {{element.nodes.rbegin(), element.nodes.rend()}}; }

int polynomial_order(const LineElement& element) { return static_cast<int>(element.nodes.size()) - 1; }

/// The elements of the boundary from the tip, as one element of a higher order through their curve. Several elements
/// follow each other by the lengths of their chords.
std::vector<Vec2> raised_arms(const LineElement* elements, std::size_t count, const std::vector<Vec2>& nodes,
                              const Vec2& tip, int order) {
  const auto at = [&](int node) -> const Vec2& { return nodes[static_cast<std::size_t>(node)]; };
  std::vector<double> ends{0.0};
  for (std::size_t e = 0; e < count; ++e)
    ends.push_back(ends.back() + (at(elements[e].nodes.back()) - at(elements[e].nodes.front())).norm());
  const std::vector<double> points = geometry::lobatto_points(order);
  std::vector<Vec2> arms;
  for (const double point : points) {
    std::size_t e = 0;
    double eta = point;
    if (count > 1) {
      const double s = 0.5 * (1.0 + point) * ends.back();
      while (e + 1 < count && s > ends[e + 1]) ++e;
      eta = std::clamp(2.0 * (s - ends[e]) / (ends[e + 1] - ends[e]) - 1.0, -1.0, 1.0);
    }
    const Vector N = geometry::LineBasis::of_order(polynomial_order(elements[e])).values(eta);
    Vec2 arm = Vec2::Zero();
    for (std::size_t j = 0; j < elements[e].nodes.size(); ++j)
      arm += N[static_cast<Eigen::Index>(j)] * (at(elements[e].nodes[j]) - tip);
    arms.push_back(arm);
  }
  // Without rounding, because the two faces of a crack begin and end at the same places.
  arms.front() = at(elements[0].nodes.front()) - tip;
  arms.back() = at(elements[count - 1].nodes.back()) - tip;
  return arms;
}

/// Elements of an arc that together turn by more have elements of their own in the copies.
constexpr double largest_turn_of_sector = std::numbers::pi / 6;

/// `line`: of each boundary element, equal for those that may be joined; -1: none.
std::vector<Sector> sectors_of(const Cell& tip, const std::vector<Vec2>& nodes, const TipRings& rings,
                               const std::vector<int>& line) {
  const auto at = [&](int node) -> const Vec2& { return nodes[static_cast<std::size_t>(node)]; };
  const auto distance = [&](std::size_t e) {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : tip.boundary[e].nodes) least = std::min(least, (at(node) - tip.centre).norm());
    return least;
  };
  std::vector<Sector> sectors;
  double least = 0.0;
  for (std::size_t e = 0; e < tip.boundary.size(); ++e) {
    const bool may_join = e > 0 && rings.joined > 0.0 && line[e] >= 0 && line[e] == line[e - 1] &&
                          (tip.materials.size() < 2 || tip.materials[e] == tip.materials[e - 1]);
    if (may_join) {
      Sector& sector = sectors.back();
      const double nearer = std::min(least, distance(e));
      const std::vector<int>&first = tip.boundary[sector.first].nodes, &last = tip.boundary[e].nodes;
      const Vec2 chord = at(last.back()) - at(first.front());
      const Vec2 begins = at(first[1]) - at(first[0]), ends = at(last.back()) - at(last[last.size() - 2]);
      const bool turns = std::abs(std::atan2(cross(begins, ends), begins.dot(ends))) > largest_turn_of_sector;
      if (!turns && chord.norm() < std::min(rings.joined * nearer, rings.longest)) {
        ++sector.count;
        least = nearer;
        continue;
      }
    }
    sectors.push_back({e, 1, {}});
    least = distance(e);
  }
  for (Sector& sector : sectors) {
    int order = rings.order;
    for (std::size_t e = 0; e < sector.count; ++e)
      order = std::max(order, polynomial_order(tip.boundary[sector.first + e]));
    sector.arms = raised_arms(&tip.boundary[sector.first], sector.count, nodes, tip.centre, order);
  }
  return sectors;
}

/// The mean of the four corners of a cell between two copies.
Vec2 mean_of_corners(const std::array<int, 4>& corners, const std::vector<Vec2>& nodes) {
  Vec2 mean = Vec2::Zero();
  for (const int corner : corners) mean += 0.25 * nodes[static_cast<std::size_t>(corner)];
  return mean;
}

bool is_curved(const Sector& sector) {
  const Vec2& first = sector.arms.front();
  const Vec2 along = sector.arms.back() - first;
  return std::any_of(sector.arms.begin(), sector.arms.end(),
                     [&](const Vec2& arm) { return std::abs(cross(along, arm - first)) > 1e-9 * along.squaredNorm(); });
}

/// Divides a tip's cell, ring after ring from the boundary inwards.
class TipDivision {
 public:
  TipDivision(const Cell& tip, std::vector<Vec2>& nodes, const TipRings& rings, const std::vector<int>& line)
      : tip_(tip), nodes_(nodes), rings_(rings), sectors_(sectors_of(tip, nodes, rings, line)) {
    made_.innermost = tip;
    for (const Sector& sector : sectors_) {
      const auto from = tip.boundary.begin() + static_cast<std::ptrdiff_t>(sector.first);
      outer_.emplace_back(from, from + static_cast<std::ptrdiff_t>(sector.count));
    }
  }

  /// `smallest`: the innermost copy is no smaller than this.
  DividedTip divided(double smallest) && {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Sector& sector : sectors_)
      for (const Vec2& arm : sector.arms) shortest = std::min(shortest, arm.norm());
    for (int graded = 0; graded < rings_.count;) {
      const bool by_step = xi_ - rings_.step > xi_ * rings_.ratio;
      if (!by_step) ++graded;
      const double next = by_step ? xi_ - rings_.step : xi_ * rings_.ratio;
      if (next * shortest < smallest) break;
      add_ring(next);
    }
    return std::move(made_);
  }

 private:
  /// The cells from the last copy to the next one.
  void add_ring(double next) {
    const std::vector<LineElement> inner = copy_at(next);
    LineElement before =
        side(outer_.front().front().nodes.front(), inner.front().nodes.front(), 0, sectors_.front().arms.front(), next);
    made_.first.push_back(before);
    for (std::size_t s = 0; s < sectors_.size(); ++s) {
      LineElement after = side(outer_[s].back().nodes.back(), inner[s].nodes.back(), s, sectors_[s].arms.back(), next);
      made_.cells.push_back(cell_between(s, inner[s], before, after));
      before = std::move(after);
    }
    made_.last.push_back(before);
    ++made_.rings;
    set_innermost(inner, next);
    for (std::size_t s = 0; s < sectors_.size(); ++s) outer_[s] = {inner[s]};
    xi_ = next;
  }

  /// One element for each sector, of the size `xi`.
  std::vector<LineElement> copy_at(double xi) {
    std::vector<LineElement> copy;
    for (const Sector& sector : sectors_) {
      LineElement element;
      for (std::size_t k = 0; k < sector.arms.size(); ++k)
        element.nodes.push_back(k == 0 && !copy.empty() ? copy.back().nodes.back() : add_node(sector.arms[k], xi));
      copy.push_back(std::move(element));
    }
    return copy;
  }

  /// From the last copy to the next one, along an arm of a sector.
  LineElement side(int from, int to, std::size_t s, const Vec2& arm, double next) {
    LineElement element{{from}};
    const std::size_t order = sectors_[s].arms.size() - 1;
    const std::vector<double> points = geometry::lobatto_points(static_cast<int>(order));
    for (std::size_t k = 1; k < order; ++k)
      element.nodes.push_back(add_node(arm, std::lerp(xi_, next, 0.5 * (1.0 + points[k]))));
    element.nodes.push_back(to);
    return element;
  }

  /// The cell of a sector, inside its elements on the last copy.
  Cell cell_between(std::size_t s, const LineElement& inner, const LineElement& before,
                    const LineElement& after) const {
    Cell cell;
    cell.boundary = outer_[s];
    cell.boundary.push_back(after);
    cell.boundary.push_back(inverted(inner));
    cell.boundary.push_back(inverted(before));
    cell.materials = {material_of(s)};
    const bool must_see = rings_.joined > 0.0 && is_curved(sectors_[s]);
    cell.centre = must_see ? seeing_centre(cell)
                           : mean_of_corners({outer_[s].front().nodes.front(), after.nodes.front(), after.nodes.back(),
                                              before.nodes.back()},
                                             nodes_);
    return cell;
  }

  /// A point that sees the curved sides of a cell; coordinates from the tip have more digits.
  Vec2 seeing_centre(const Cell& cell) const {
    std::vector<Vec2> points;
    for (const LineElement& element : cell.boundary)
      for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
        points.push_back((nodes_[static_cast<std::size_t>(element.nodes[i])] - tip_.centre) / xi_);
    return tip_.centre + xi_ * kernel_centre(points).centre;
  }

  void set_innermost(const std::vector<LineElement>& copy, double xi) {
    made_.innermost.scale = xi;
    made_.innermost.boundary = copy;
    if (tip_.materials.size() == 1) return;  // it has that of the tip
    made_.innermost.materials.clear();
    for (std::size_t s = 0; s < sectors_.size(); ++s) made_.innermost.materials.push_back(material_of(s));
  }

  int add_node(const Vec2& arm, double xi) {
    nodes_.push_back(tip_.centre + xi * arm);
    return static_cast<int>(nodes_.size()) - 1;
  }

  int material_of(std::size_t s) const {
    return tip_.materials.size() > 1 ? tip_.materials[sectors_[s].first] : tip_.materials.front();
  }

  const Cell& tip_;
  std::vector<Vec2>& nodes_;
  const TipRings& rings_;
  std::vector<Sector> sectors_;
  std::vector<std::vector<LineElement>> outer_;  // of every sector, the elements of the last copy
  double xi_ = 1.0;                              // size of the last copy
  DividedTip made_;
};

/// The smallest copy that coordinates have the digits for.
double smallest_copy(const BodyMesh& mesh) {
  double farthest = 0.0;
  for (const Vec2& x : mesh.nodes) farthest = std::max(farthest, x.lpNorm<Eigen::Infinity>());
  const double rounding = std::numeric_limits<double>::epsilon() * farthest;  // of coordinates
  return 1e5 * rounding;
}

/// For each boundary element of a body that is one super-element, the edge of the outline that it belongs to; -1 of
/// edges that may have corners of their own.
std::vector<int> edges_of(const BodyMesh& mesh, const model::Body& body) {
  std::map<std::vector<int>, int> edge_of;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const LineElement& element : mesh.edges[e])
      edge_of[element.nodes] = body.outline.edges[e].is_chain() ? -1 : static_cast<int>(e);
  std::vector<int> lines;
  for (const LineElement& element : mesh.cells.front().boundary) {
    const auto found = edge_of.find(element.nodes);
    lines.push_back(found == edge_of.end() ? -1 : found->second);
  }
  return lines;
}

}  // namespace

void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings) {
  std::vector<TipFace> tips = tip_faces(body, mesh);
  std::erase_if(tips, [&](const TipFace& tip) {
    return !tip.last || std::find(cracks.begin(), cracks.end(), tip.crack) == cracks.end();
  });
  const double smallest = smallest_copy(mesh);
  for (const TipFace& tip : tips) {
    DividedTip divided = TipDivision(mesh.cells[tip.cell], mesh.nodes, rings, {}).divided(smallest);
    divided.innermost.scale = 1.0;  // factors refer to the size of this cell
    mesh.cells[tip.cell] = divided.innermost;
    mesh.cells.insert(mesh.cells.end(), divided.cells.begin(), divided.cells.end());
    // The last side face is run towards the tip, the first one away from it.
    const auto face = [&](bool left) -> std::vector<LineElement>& {
      return mesh.faces[static_cast<std::size_t>(2 * tip.crack + (left ? 1 : 0))];
    };
    std::vector<LineElement>&of_last = face(tip.left), &of_first = face(!tip.left);
    of_last.insert(of_last.end(), divided.last.begin(), divided.last.end());
    for (const LineElement& element : divided.first) of_first.insert(of_first.begin(), inverted(element));
  }
}

int divide_side_faces(BodyMesh& mesh, const model::Body& body, const TipRings& rings) {
  ensure(mesh.cells.size() == 1 && mesh.cells.front().is_open(),
         "a body that is one open super-element has side faces");
  DividedTip divided =
      TipDivision(mesh.cells.front(), mesh.nodes, rings, edges_of(mesh, body)).divided(smallest_copy(mesh));
  mesh.cells = {divided.innermost};
  mesh.cells.insert(mesh.cells.end(), divided.cells.begin(), divided.cells.end());
  mesh.faces.assign(2, {});
  for (const LineElement& element : divided.first) mesh.faces[0].insert(mesh.faces[0].begin(), inverted(element));
  mesh.faces[1] = divided.last;
  return divided.rings;
}

namespace {

constexpr double pi = std::numbers::pi;

bool are_parallel(const Vec2& a, const Vec2& b) { return std::abs(cross(a, b)) < 1e-9; }

/// Directions in which the supports hold a face with the outward normal n. `at_zero`: all of them at 0.
std::vector<Vec2> held_along(const model::Model& model, int body, int face, const Vec2& n, bool& at_zero) {
  std::vector<Vec2> along;
  at_zero = true;
  for (const model::Support& support : model.supports) {
    if (support.on.body != body || support.on.kind != model::Place::Kind::face || support.on.index != face) continue;
    const Vec2 first = support.axes == model::SupportAxes::xy     ? Vec2(1.0, 0.0)
                       : support.axes == model::SupportAxes::edge ? n
                                                                  : support.along;
    for (std::size_t c = 0; c < 2; ++c) {
      if (!support.displacement[c]) continue;
      at_zero = at_zero && *support.displacement[c] == 0.0;
      const Vec2 direction = c == 0 ? first : Vec2(-first.y(), first.x());
      if (along.empty())
        along.push_back(direction);
      else if (along.size() == 1 && !are_parallel(along.front(), direction))
        along.emplace_back(-along.front().y(), along.front().x());
    }
  }
  return along;
}

/// Whether anything but supports acts on a face that resists slip or draws along it.
bool anything_else_acts(const model::Model& model, int body, int face) {
  const auto is_there = [&](const model::Place& place) {
    return place.body == body && place.kind == model::Place::Kind::face && place.index == face;
  };
  return std::any_of(model.springs.begin(), model.springs.end(),
                     [&](const model::Spring& spring) { return is_there(spring.on); }) ||
         std::any_of(model.loads.begin(), model.loads.end(),
                     [&](const model::Load& load) { return load.on && is_there(*load.on); }) ||
         std::any_of(model.contacts.begin(), model.contacts.end(),
                     [&](const model::Contact& contact) { return is_there(contact.a) || is_there(contact.b); });
}

/// From the first side face to the last, radians.
double opening_angle(const Cell& cell, const std::vector<Vec2>& nodes) {
  double angle = 0.0;
  for (const LineElement& element : cell.boundary)
    for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i) {
      const Vec2 from = nodes[static_cast<std::size_t>(element.nodes[i])] - cell.centre,
                 to = nodes[static_cast<std::size_t>(element.nodes[i + 1])] - cell.centre;
      angle += std::atan2(cross(from, to), from.dot(to));
    }
  return angle;
}

}  // namespace

void hold_tips(BodyMesh& mesh, const model::Model& model, int body) {
  const model::Body& of = model.bodies[static_cast<std::size_t>(body)];
  std::map<std::size_t, HeldFaces> held;
  std::map<std::size_t, std::array<bool, 2>> symmetric;
  for (const TipFace& tip : tip_faces(of, mesh)) {
    const Cell& cell = mesh.cells[tip.cell];
    const int face = 2 * tip.crack + (tip.left ? 1 : 0);
    Vec2 normal;
    if (model::has_divided_faces(of)) {
      const int end = tip.last ? cell.boundary.back().nodes.back() : cell.boundary.front().nodes.front();
      const Vec2 arm = (mesh.nodes[static_cast<std::size_t>(end)] - cell.centre).stableNormalized();
      normal = tip.last ? Vec2(-arm.y(), arm.x()) : Vec2(arm.y(), -arm.x());
    } else {
      normal = model::side_face_normal(of, face);
    }
    bool at_zero = false;
    const std::size_t k = tip.last ? 1 : 0;
    std::vector<Vec2>& along = held[tip.cell].along[k] = held_along(model, body, face, normal, at_zero);
    symmetric[tip.cell][k] =
        along.size() == 1 && are_parallel(along.front(), normal) && at_zero && !anything_else_acts(model, body, face);
  }
  for (auto& [cell, faces] : held) {
    if (faces.along[0].empty() && faces.along[1].empty()) continue;
    const bool has_room = opening_angle(mesh.cells[cell], mesh.nodes) < pi * (1.0 + 1e-9);  // for its image
    for (const std::size_t k : {0u, 1u})
      if (has_room && symmetric[cell][k] && faces.along[1 - k].empty()) faces.mirror = static_cast<int>(k);
    mesh.cells[cell].held = std::make_shared<const HeldFaces>(faces);
  }
}

}  // namespace scabo::mesh
