// Faces of cracks between cells, and rings around their tips.
#include "scabo/mesh/plane/crack_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "scabo/mesh/plane/tip_rings.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::mesh {
namespace {

/// A rectangle of 4 x 2 with its lower left corner at the origin, and cracks.
model::Body block(model::MeshKind kind, const std::vector<std::vector<Vec2>>& paths) {
  model::Body body;
  body.name = "block";
  body.material = 0;
  const std::vector<Vec2> corners{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  for (std::size_t k = 0; k < 4; ++k) {
    body.outline.edges.push_back(test::line("edge_" + std::to_string(k + 1), corners[k], corners[(k + 1) % 4]));
    model::Corner& corner = body.outline.corners.emplace_back();
    corner.names = {"vertex_" + std::to_string(k + 1)};
    corner.position = corners[k];
  }
  body.mesh.kind = kind;
  body.mesh.size = 0.3;
  body.mesh.order = 3;
  for (const std::vector<Vec2>& path : paths) {
    model::Crack& crack = body.cracks.emplace_back();
    crack.name = "crack_" + std::to_string(body.cracks.size());
    crack.path = path;
  }
  return body;
}

BodyMesh mesh_of(const model::Body& body) { return std::get<BodyMesh>(divide_into_cells(body, {}, 1e6)); }

double length_of(const BodyMesh& mesh, const std::vector<LineElement>& elements) {
  double length = 0.0;
  for (const LineElement& element : elements)
    length += (mesh.nodes[static_cast<std::size_t>(element.nodes.back())] -
               mesh.nodes[static_cast<std::size_t>(element.nodes.front())])
                  .norm();
  return length;
}

/// Area of a cell with straight sides; an open one ends at its centre.
double area_of(const BodyMesh& mesh, const Cell& cell) {
  double area = 0.0;
  for (const LineElement& element : cell.boundary)
    area += 0.5 * cross(Vec2(mesh.nodes[static_cast<std::size_t>(element.nodes.front())] - cell.centre),
                        Vec2(mesh.nodes[static_cast<std::size_t>(element.nodes.back())] - cell.centre));
  return area;
}

double area_of(const BodyMesh& mesh) {
  double area = 0.0;
  for (const Cell& cell : mesh.cells) area += area_of(mesh, cell);
  return area;
}

class CrackFaces : public testing::TestWithParam<model::MeshKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, CrackFaces, testing::Values(model::MeshKind::polygons, model::MeshKind::quadtree));

// A bent crack from the left edge to a tip.
TEST_P(CrackFaces, RunAlongThePath) {
  const model::Body body = block(GetParam(), {{{0, 1}, {1, 1}, {2, 1.5}}});
  const BodyMesh mesh = mesh_of(body);
  ASSERT_EQ(mesh.faces.size(), 2u);
  const std::vector<LineElement>&right = mesh.faces[0], &left = mesh.faces[1];
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(left.front().nodes.front())], Vec2(0, 1));
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(right.back().nodes.back())], Vec2(0, 1));
  for (const auto* face : {&left, &right})
    for (std::size_t k = 0; k + 1 < face->size(); ++k) EXPECT_EQ((*face)[k].nodes.back(), (*face)[k + 1].nodes.front());
  // Without what belongs to the cell at the tip.
  const double whole = 1.0 + std::sqrt(1.25);
  EXPECT_LT(length_of(mesh, left), whole - 0.05);
  EXPECT_GT(length_of(mesh, left), whole - 0.6);

  const std::vector<FacePair> pairs = face_pairs(mesh, 0);
  EXPECT_EQ(pairs.size(), 3 * left.size() + 1);
  Vec2 sum = Vec2::Zero();
  for (const FacePair& pair : pairs) {
    const Vec2 x = mesh.nodes[static_cast<std::size_t>(pair.left)];
    EXPECT_NE(pair.left, pair.right);
    EXPECT_EQ(x, mesh.nodes[static_cast<std::size_t>(pair.right)]);
    sum += pair.normal;
    const Vec2 n = pair.normal.normalized(), second = Vec2(0.5, -1.0).normalized();
    if (x.x() < 1.0 - 1e-9) EXPECT_LT((n - Vec2(0, -1)).norm(), 1e-12);
    if (x.x() > 1.0 + 1e-9) EXPECT_LT((n - second).norm(), 1e-12);
    if (std::abs(x.x() - 1.0) < 1e-9) EXPECT_GT(n.dot(Vec2(0, -1)), 0.93);  // between the two: 26.6 degrees
    if (std::abs(x.x() - 1.0) < 1e-9) EXPECT_GT(n.dot(second), 0.93);
  }
  const Vec2 chord = mesh.nodes[static_cast<std::size_t>(left.back().nodes.back())] - Vec2(0, 1);
  EXPECT_LT((sum - tangent_of(chord)).norm(), 1e-12);
}

// Two cracks that end on a third one from both sides: it has a pair for each two nodes that face each other.
TEST_P(CrackFaces, OfCracksThatMeet) {
  const model::Body body = block(GetParam(), {{{1, 1}, {3, 1}}, {{2, 1}, {2.2, 1.7}}, {{1.5, 1}, {1.4, 0.5}}});
  const BodyMesh mesh = mesh_of(body);
  const auto at = [&](int crack, const Vec2& x) {
    const std::vector<FacePair> pairs = face_pairs(mesh, crack);
    return std::count_if(pairs.begin(), pairs.end(), [&](const FacePair& pair) {
      return (mesh.nodes[static_cast<std::size_t>(pair.left)] - x).norm() < 1e-9;
    });
  };
  EXPECT_EQ(at(0, {2, 1}), 2);
  EXPECT_EQ(at(1, {2, 1}), 1);
  EXPECT_EQ(at(0, {1.5, 1}), 2);
  EXPECT_EQ(at(2, {1.5, 1}), 1);
}

TEST_P(CrackFaces, RingsFillTheCellsAtTheTips) {
  const model::Body body = block(GetParam(), {{{1, 1}, {3, 1.2}}, {{1.5, 0.4}, {2.5, 0.4}}});
  const BodyMesh plain = mesh_of(body);
  BodyMesh mesh = plain;
  const TipRings rings{.count = 6, .ratio = 0.4, .order = 5};
  add_tip_rings(mesh, body, {0}, rings);
  const std::vector<TipFace> tips = tip_faces(body, plain);
  ASSERT_EQ(tips.size(), 8u);
  std::size_t cells = plain.cells.size();
  double inside = 0.0;  // lengths of the sides of cells along the first crack
  for (const TipFace& tip : tips) {
    const Cell &before = plain.cells[tip.cell], &after = mesh.cells[tip.cell];
    EXPECT_EQ(before.centre, tip.at_end ? body.cracks[static_cast<std::size_t>(tip.crack)].path.back()
                                        : body.cracks[static_cast<std::size_t>(tip.crack)].path.front());
    if (!tip.last) continue;
    const double scale = tip.crack == 0 ? std::pow(0.4, 6) : 1.0;
    EXPECT_TRUE(after.is_open());
    EXPECT_NEAR(area_of(mesh, after), scale * scale * area_of(plain, before), 1e-12);
    if (tip.crack != 0) continue;
    cells += 6 * before.boundary.size();
    inside += (1.0 - scale) *
              (plain.nodes[static_cast<std::size_t>(before.boundary.back().nodes.back())] - before.centre).norm();
  }
  EXPECT_EQ(mesh.cells.size(), cells);
  EXPECT_NEAR(area_of(mesh), 8.0, 1e-12);
  for (const Cell& cell : mesh.cells) EXPECT_GT(area_of(mesh, cell), 0.0);
  for (const int face : {0, 1}) {
    const auto f = static_cast<std::size_t>(face);
    EXPECT_NEAR(length_of(mesh, mesh.faces[f]), length_of(plain, plain.faces[f]) + inside, 1e-12);
    EXPECT_EQ(mesh.faces[f].size(), plain.faces[f].size() + 12);
    EXPECT_EQ(mesh.faces[f].front().nodes.size(), 6u);
    for (std::size_t k = 0; k + 1 < mesh.faces[f].size(); ++k)
      EXPECT_EQ(mesh.faces[f][k].nodes.back(), mesh.faces[f][k + 1].nodes.front());
    EXPECT_EQ(mesh.faces[f + 2].size(), plain.faces[f + 2].size());  // of the other crack
  }
  for (const FacePair& pair : face_pairs(mesh, 0))
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(pair.left)], mesh.nodes[static_cast<std::size_t>(pair.right)]);
}

// Copies stop where the coordinates have no digits left.
TEST(TipRingsFarAway, AreFewer) {
  model::Body body = block(model::MeshKind::polygons, {{{1, 1}, {3, 1}}});
  BodyMesh near = mesh_of(body), far = near;
  for (Vec2& x : far.nodes) x.x() += 1e6;
  for (Cell& cell : far.cells) cell.centre.x() += 1e6;
  add_tip_rings(near, body, {0});
  for (Vec2& x : body.cracks.front().path) x.x() += 1e6;
  add_tip_rings(far, body, {0});
  EXPECT_EQ(near.faces[0].size() - 28, mesh_of(block(model::MeshKind::polygons, {{{1, 1}, {3, 1}}})).faces[0].size());
  EXPECT_LT(far.faces[0].size(), near.faces[0].size());
  EXPECT_GT(far.faces[0].size(), near.faces[0].size() - 28);
}

// One face is divided where the other one is.
TEST(CrackFacesAlike, AreDivided) {
  const model::Body body = block(model::MeshKind::polygons, {{{0, 1}, {2, 1}}});
  BodyMesh mesh = mesh_of(body);
  const std::size_t before = mesh.faces[1].size();
  LineElement& old = mesh.faces[1][1];
  const LineElement whole = old;
  const Vec2 a = mesh.nodes[static_cast<std::size_t>(old.nodes.front())],
             b = mesh.nodes[static_cast<std::size_t>(old.nodes.back())];
  std::vector<LineElement> halves;
  int from = old.nodes.front();
  for (const double t : {0.0, 0.5}) {
    LineElement& half = halves.emplace_back();
    half.nodes.push_back(from);
    for (const double s : {0.25, 0.5}) {  // any two points: what counts is that they are copied
      half.nodes.push_back(static_cast<int>(mesh.nodes.size()));
      mesh.nodes.push_back(a + (t + 0.5 * s) * (b - a));
    }
    if (t > 0.0) {
      half.nodes.push_back(old.nodes.back());
    } else {
      from = static_cast<int>(mesh.nodes.size());
      half.nodes.push_back(from);
      mesh.nodes.push_back(0.5 * (a + b));
    }
  }
  for (Cell& cell : mesh.cells)
    for (std::size_t k = 0; k < cell.boundary.size(); ++k)
      if (cell.boundary[k].nodes == whole.nodes) {
        cell.boundary[k] = halves[0];
        cell.boundary.insert(cell.boundary.begin() + static_cast<std::ptrdiff_t>(k) + 1, halves[1]);
        break;
      }
  mesh.faces[1][1] = halves[0];
  mesh.faces[1].insert(mesh.faces[1].begin() + 2, halves[1]);
  divide_faces_alike(mesh, {0});
  EXPECT_EQ(mesh.faces[1].size(), before + 1);
  ASSERT_EQ(mesh.faces[0].size(), before + 1);
  for (const FacePair& pair : face_pairs(mesh, 0))
    EXPECT_LT(
        (mesh.nodes[static_cast<std::size_t>(pair.left)] - mesh.nodes[static_cast<std::size_t>(pair.right)]).norm(),
        1e-12);
}

}  // namespace
}  // namespace scabo::mesh
