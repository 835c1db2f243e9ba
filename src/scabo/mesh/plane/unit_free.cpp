#include "scabo/mesh/plane/unit_free.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

constexpr int digits_of_lengths = 40;  // binary

double rounded_length(double length) {
  int exponent = 0;
  const double fraction = std::frexp(length, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(fraction, digits_of_lengths)), exponent - digits_of_lengths);
}

/// Of an arc from its rounded points, nearest to the given one.
geometry::Arc arc_through(const geometry::Arc& given, const Vec2& centre, const Vec2& start, const Vec2& end) {
  const Vec2 from = start - centre, to = end - centre;
  const double full = 2.0 * std::numbers::pi;
  geometry::Arc arc{centre, from.norm(), std::atan2(from.y(), from.x()), std::atan2(cross(from, to), from.dot(to))};
  arc.sweep += full * std::round((given.sweep - arc.sweep) / full);
  return arc;
}

}  // namespace

UnitFree::UnitFree(const model::Body& body, const SizeField& sizes) : given_(body), made_(body) {
  const geometry::Box box = geometry::box_of(body.outline);
  origin_ = box.low;
  scale_ = (box.high - box.low).maxCoeff();
  const double epsilon = rounding_of_points(body.mesh.kind);
  const auto point = [this, epsilon](const Vec2& x) {
    const Vec2 own = (x - origin_) / scale_;
    return Vec2(epsilon * Vec2(own / epsilon).array().round());
  };
  // The box as given belongs to the rounded one, so that cells in rows along its sides stay equal to rounding.
  const Vec2 high = point(box.high);
  for (int axis = 0; axis < 2; ++axis)
    stretch_[axis] = high[axis] > 0.0 ? (box.high - box.low)[axis] / high[axis] : scale_;
  const auto length = [this](double given) { return rounded_length(given / scale_); };
  const auto convert = [&](geometry::Outline& outline) {
    for (geometry::Corner& corner : outline.corners) corner.position = point(corner.position);
    for (geometry::Edge& edge : outline.edges) edge.start = point(edge.start);
    for (std::size_t e = 0; e < outline.edges.size(); ++e) {
      geometry::Edge& edge = outline.edges[e];
      edge.end = outline.edges[static_cast<std::size_t>(outline.next(static_cast<int>(e)))].start;
      for (Vec2& x : edge.points) x = point(x);
      if (edge.arc) edge.arc = arc_through(*edge.arc, point(edge.arc->centre), edge.start, edge.end);
    }
  };
  convert(made_.outline);
  for (model::Region& region : made_.regions) convert(region.outline);
  for (model::Crack& crack : made_.cracks) {
    crack.tip = point(crack.tip);
    crack.mouth = point(crack.mouth);
    for (Vec2& x : crack.path) x = point(x);
  }
  made_.mesh.size = length(body.mesh.size);
  made_.mesh.min_size = length(body.mesh.min_size);
  made_.mesh.centre = point(body.mesh.centre);
  for (model::LocalSize& local : made_.mesh.refine) {
    local.size = length(local.size);
    if (local.near) local.near = point(*local.near);
  }
  std::vector<SizeField::Sample> samples;
  for (const SizeField::Sample& sample : sizes.samples()) samples.push_back({point(sample.at), length(sample.size)});
  sizes_ = SizeField(samples, sizes.growth());
}

BodyMesh UnitFree::real(BodyMesh mesh, const std::vector<BorderNodes>& borders) const {
  constexpr double rounding = 1e-9;
  const std::vector<Vec2> own = mesh.nodes;
  for (Vec2& node : mesh.nodes) node = real(node);
  enum : char { inside, on_border, on_outline };
  std::vector<char> where(mesh.nodes.size(), inside);
  const auto put = [&](int n, const geometry::Edge& edge, const geometry::Edge& own_edge, char there) {
    const auto node = static_cast<std::size_t>(n);
    if (where[node] == there) return;
    if (where[node] == inside) {
      const double t = geometry::closest_position(own_edge, own[node]);
      if ((own_edge.at(t) - own[node]).norm() > rounding) return;
      mesh.nodes[node] = edge.at(t);
    } else {  // where the border of a region reaches the outline
      mesh.nodes[node] = geometry::closest_point(edge, mesh.nodes[node]);
    }
    where[node] = there;
  };
  std::map<std::pair<int, int>, const BorderNodes*> sides;
  for (const BorderNodes& border : borders)
    for (std::size_t k = 0; k + 1 < border.nodes.size(); ++k)
      sides.emplace(std::minmax(border.nodes[k], border.nodes[k + 1]), &border);
  for (std::size_t c = 0; !sides.empty() && c < mesh.cells.size(); ++c)
    for (const LineElement& element : mesh.cells[c].boundary)
      if (const auto side = sides.find(std::minmax(element.nodes.front(), element.nodes.back())); side != sides.end()) {
        const auto region = static_cast<std::size_t>(side->second->region),
                   e = static_cast<std::size_t>(side->second->edge);
        for (const int node : element.nodes)
          put(node, given_.regions[region].outline.edges[e], made_.regions[region].outline.edges[e], on_border);
      }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const LineElement& element : mesh.edges[e])
      for (const int node : element.nodes) put(node, given_.outline.edges[e], made_.outline.edges[e], on_outline);
  for (std::size_t e = 0; e < mesh.corners.size(); ++e)
    if (mesh.corners[e] >= 0) mesh.nodes[static_cast<std::size_t>(mesh.corners[e])] = given_.outline.edges[e].start;
  for (Cell& cell : mesh.cells) {
    const Vec2 tip = cell.centre;
    cell.centre = real(tip);
    for (std::size_t c = 0; cell.is_open() && c < made_.cracks.size(); ++c) {
      const std::vector<Vec2>&path = made_.cracks[c].path, &given = given_.cracks[c].path;
      if (!path.empty() && path.front() == tip) cell.centre = given.front();
      if (!path.empty() && path.back() == tip) cell.centre = given.back();
    }
    if (given_.mesh.order == 1) continue;
    // Nodes inside a side go with its ends.
    for (const LineElement& element : cell.boundary) {
      const auto a = static_cast<std::size_t>(element.nodes.front()),
                 b = static_cast<std::size_t>(element.nodes.back());
      if (where[a] == inside && where[b] == inside) continue;
      const Vec2 along = own[b] - own[a], at_a = mesh.nodes[a] - real(own[a]), at_b = mesh.nodes[b] - real(own[b]);
      for (std::size_t k = 1; k + 1 < element.nodes.size(); ++k) {
        const auto node = static_cast<std::size_t>(element.nodes[k]);
        if (where[node] != inside) continue;
        const double t = (own[node] - own[a]).dot(along) / along.squaredNorm();
        mesh.nodes[node] = real(own[node]) + (1.0 - t) * at_a + t * at_b;
      }
    }
  }
  return mesh;
}

}  // namespace scabo::mesh
