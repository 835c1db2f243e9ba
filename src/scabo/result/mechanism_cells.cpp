#include "scabo/result/mechanism_cells.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "scabo/geometry/plane/polygon.hpp"

namespace scabo::result {

namespace {

constexpr std::uint8_t vertex_cell = 1, line_cell = 3, polygon_cell = 7;

class MechanismDrawing {
 public:
  MechanismDrawing(const analysis::Discretisation& discretisation, const analysis::Mechanism& mechanism)
      : discretisation_(discretisation), mechanism_(mechanism) {}

  MechanismCells drawn() && {
    for (std::size_t b = 0; b < discretisation_.model.bodies.size(); ++b)
      if (mechanism_.bodies[b].present) add_body(b);
    for (std::size_t i = 0; i < mechanism_.pairs.size();) {
      std::size_t end = i + 1;
      while (end < mechanism_.pairs.size() && mechanism_.pairs[end].contact == mechanism_.pairs[i].contact) ++end;
      add_contact(i, end);
      i = end;
    }
    return std::move(cells_);
  }

 private:
  std::int32_t points() const { return static_cast<std::int32_t>(cells_.pair.size()); }

  void add_point(const Vec2& x, std::size_t body, const analysis::PairMotion& motion) {
    const Vec2 u = mechanism_.bodies[body].at(x);
    cells_.points.insert(cells_.points.end(), {x.x(), x.y(), 0.0});
    cells_.displacement.insert(cells_.displacement.end(), {u.x(), u.y(), 0.0});
    cells_.opening.push_back(motion.opening);
    cells_.slip.push_back(motion.slip);
    cells_.pair.push_back(motion.pair);
    cells_.point_body.push_back(static_cast<std::int32_t>(body) + 1);
  }

  template <typename Points>
  void add_cell(std::uint8_t type, const Points& of_cell, double motion, std::int32_t body, std::int32_t contact) {
    for (const auto point : of_cell) cells_.connectivity.push_back(static_cast<std::int32_t>(point));
    cells_.offsets.push_back(static_cast<std::int32_t>(cells_.connectivity.size()));
    cells_.types.push_back(type);
    cells_.motion.push_back(motion);
    cells_.body.push_back(body);
    cells_.contact.push_back(contact);
  }

  void add_body(std::size_t b) {
    const mesh::BodyMesh& mesh = discretisation_.mesh.bodies[b];
    const model::Body& body = discretisation_.model.bodies[b];
    const double motion = mechanism_.bodies[b].largest;
    const auto number = static_cast<std::int32_t>(b) + 1, first = points();
    if (body.rigid) {
      std::vector<std::int32_t> outline;
      for (const Vec2& x : polygon_of(body.outline)) {
        outline.push_back(points());
        add_point(x, b, {});
      }
      add_cell(polygon_cell, outline, motion, number, 0);
      return;
    }
    for (const Vec2& x : mesh.nodes) add_point(x, b, {});
    for (const mesh::Cell& cell : mesh.cells) {
      if (body.outside) {
        for (const mesh::LineElement& element : cell.boundary)
          for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
            add_cell(line_cell, std::initializer_list<int>{first + element.nodes[i], first + element.nodes[i + 1]},
                     motion, number, 0);
        continue;
      }
      std::vector<int> nodes = cell.nodes();
      for (int& node : nodes) node += first;
      add_cell(polygon_cell, nodes, motion, number, 0);
    }
  }

  /// The pairs from `begin` to `end`.
  void add_contact(std::size_t begin, std::size_t end) {
    const int contact = mechanism_.pairs[begin].contact;
    const auto a = static_cast<std::size_t>(discretisation_.model.contacts[static_cast<std::size_t>(contact)].a.body);
    double largest = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      largest = std::max({largest, std::abs(mechanism_.pairs[i].slip), std::abs(mechanism_.pairs[i].opening)});
    if (end == begin + 1) add_cell(vertex_cell, std::initializer_list<std::int32_t>{points()}, largest, 0, contact + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t point = points();
      if (i > begin)
        add_cell(line_cell, std::initializer_list<std::int32_t>{point - 1, point}, largest, 0, contact + 1);
      add_point(mechanism_.pairs[i].position, a, mechanism_.pairs[i]);
    }
  }

  const analysis::Discretisation& discretisation_;
  const analysis::Mechanism& mechanism_;
  MechanismCells cells_;
};

}  // namespace

MechanismCells mechanism_cells(const analysis::Discretisation& discretisation, const analysis::Mechanism& mechanism) {
  return MechanismDrawing(discretisation, mechanism).drawn();
}

}  // namespace scabo::result
