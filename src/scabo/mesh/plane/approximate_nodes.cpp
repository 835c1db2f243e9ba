#include "scabo/mesh/plane/approximate_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

/// The size changes by at most this part of itself from the middle of a square to its corners.
constexpr double nearly_constant = 0.25;
/// More squares than this are not looked at: what is left counts as its middle does.
constexpr std::size_t most_squares = 200'000;

/// Corners and sides of cells on an area of s^2.
struct Density {
  double corners, sides;
};

/// Three sides meet at a corner of polygons, six at one of triangles. A square of a quadtree has a side between s / 2
/// and s, and small ones beside large ones add hanging nodes. Measured on the bodies of the tests: polygons 2.1 to 3.4
/// corners, triangles 1.2 to 1.7, quadtrees 1.1 to 4.2, with the upper values where sizes are graded or bodies narrow.
Density density(model::MeshKind kind) {
  if (kind == model::MeshKind::fem) return {1.2, 3.6};
  if (kind == model::MeshKind::quadtree) return {1.5, 3.0};
  return {2.0, 3.0};
}

struct Square {
  Vec2 middle = Vec2::Zero();
  double half = 0.0;
  std::vector<int> locals;     ///< places of `refine` that may ask for the least size somewhere in it
  std::vector<int> edges;      ///< edges of the outline that may pass through it
  std::optional<bool> inside;  ///< the body, once no edge passes through it
};

class Integral {
 public:
  Integral(const model::Body& body, double largest) : body_(body), largest_(largest) {
    for (const geometry::Edge& edge : body.outline.edges) boxes_.push_back(geometry::box_of(edge));
  }

  /// The integral of dA / s^2.
  double area_in_sizes() {
    const geometry::Box box = geometry::box_of(body_.outline);
    Square all{0.5 * (box.low + box.high), 0.5 * (box.high - box.low).maxCoeff(), {}, {}, {}};
    for (std::size_t i = 0; i < body_.mesh.refine.size(); ++i)
      if (body_.mesh.refine[i].size < largest_) all.locals.push_back(static_cast<int>(i));
    for (std::size_t e = 0; e < boxes_.size(); ++e) all.edges.push_back(static_cast<int>(e));
    std::deque<Square> squares{all};  // the larger ones first
    for (std::size_t seen = 0; !squares.empty(); ++seen) {
      const Square square = std::move(squares.front());
      squares.pop_front();
      look_at(square, squares, seen + squares.size() < most_squares);
    }
    // Of the squares through which the outline passes, as much is inside as the whole area leaves.
    const double area = std::abs(body_.outline.area());
    const double part = partly_area_ > 0.0 ? std::clamp((area - inside_area_) / partly_area_, 0.0, 1.0) : 0.0;
    double count = inside_cells_ + part * partly_cells_;
    for (const model::LocalSize& local : body_.mesh.refine)  // the same integral beside one edge: l / (growth size)
      if (!local.near && local.size < largest_)
        count = std::max(count, std::min(body_.outline.edges[static_cast<std::size_t>(local.edge)].length() /
                                             (local.growth * local.size),
                                         area / (local.size * local.size)));
    return count;
  }

 private:
  double size_of(int i, const Vec2& x) const {
    const model::LocalSize& local = body_.mesh.refine[static_cast<std::size_t>(i)];
    const double distance = local.near
                                ? (*local.near - x).norm()
                                : geometry::distance_to(body_.outline.edges[static_cast<std::size_t>(local.edge)], x);
    return local.size + local.growth * distance;
  }

  bool passes_through(int edge, const Square& square) const {
    const geometry::Box& box = boxes_[static_cast<std::size_t>(edge)];
    return (box.low - square.middle).cwiseMax(square.middle - box.high).maxCoeff() < square.half;
  }

  void look_at(const Square& square, std::deque<Square>& squares, bool may_divide) {
    double growth = 0.0;
    for (const int i : square.locals) growth = std::max(growth, body_.mesh.refine[static_cast<std::size_t>(i)].growth);
    const double change = growth * std::numbers::sqrt2 * square.half;
    double size = largest_;
    std::vector<double> sizes;
    for (const int i : square.locals) {
      sizes.push_back(size_of(i, square.middle));
      size = std::min(size, sizes.back());
    }
    Square part;
    for (std::size_t k = 0; k < sizes.size(); ++k)
      if (sizes[k] - change < largest_ && sizes[k] - change <= size + change) part.locals.push_back(square.locals[k]);
    for (const int edge : square.edges)
      if (passes_through(edge, square)) part.edges.push_back(edge);
    part.inside = square.inside;
    if (part.edges.empty() && !part.inside) part.inside = geometry::encloses(body_.outline, square.middle);
    if (part.inside && !*part.inside) return;
    if (!part.locals.empty() && change > nearly_constant * size && may_divide) {
      part.half = 0.5 * square.half;
      for (const double x : {-part.half, part.half})
        for (const double y : {-part.half, part.half}) {
          part.middle = square.middle + Vec2(x, y);
          squares.push_back(part);
        }
      return;
    }
    const double area = 4.0 * square.half * square.half, count = area / (size * size);
    (part.inside ? inside_area_ : partly_area_) += area;
    (part.inside ? inside_cells_ : partly_cells_) += count;
  }

  const model::Body& body_;
  const double largest_;
  std::vector<geometry::Box> boxes_;  // of the edges
  double inside_area_ = 0.0, inside_cells_ = 0.0, partly_area_ = 0.0, partly_cells_ = 0.0;
};

}  // namespace

double approximate_nodes(const model::Body& body) {
  const geometry::Box box = geometry::box_of(body.outline);
  // The squares of a quadtree are no larger than a thin body is wide.
  const double largest = body.mesh.kind == model::MeshKind::quadtree
                             ? std::min(body.mesh.size, 2.0 * (box.high - box.low).minCoeff())
                             : body.mesh.size;
  const Density of = density(body.mesh.kind);
  return Integral(body, largest).area_in_sizes() * (of.corners + of.sides * (body.mesh.order - 1));
}

std::string text_of_count(double nodes, double limit, int digits) {
  const std::string rounded = fmt::format("{:.{}g}", nodes, digits);
  return std::stod(rounded) > limit ? rounded : fmt::format("{:.0f}", std::ceil(nodes));
}

}  // namespace scabo::mesh
