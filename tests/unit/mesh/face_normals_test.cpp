// Normals of faces at their nodes: exact on planes and quadrics however they are turned, the mean on other surfaces,
// and several where faces meet.
#include "scabo/mesh/space/face_normals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "scabo/mesh/space/shaped_solid.hpp"

namespace scabo::mesh {
namespace {

using Eigen::Vector3d;

const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();

double largest_error(const SolidMesh& mesh, const std::vector<SolidFacet>& face,
                     const std::function<Vector3d(const Vector3d&)>& exact) {
  double largest = 0.0;
  for (const auto& [node, normals] : normals_of_face(mesh, face, boundary_facets(mesh))) {
    EXPECT_EQ(normals.size(), 1u);
    largest = std::max(largest, (normals.front().n - exact(mesh.nodes.col(node))).norm());
  }
  return largest;
}

TEST(FaceNormals, OfPlanesAreExact) {
  ShapedSolid box = solid_of_shape(model::SolidBox{{0, 0, 0}, {3, 1, 0.2}}, {0.4, {}});
  EXPECT_EQ(largest_error(box.mesh, box.faces.at("top"), [](const Vector3d&) { return Vector3d(0, 0, 1); }), 0.0);
  EXPECT_EQ(largest_error(box.mesh, box.faces.at("left"), [](const Vector3d&) { return Vector3d(-1, 0, 0); }), 0.0);
  box.mesh.nodes = (turned * box.mesh.nodes).colwise() + Vector3d(5, -3, 2);
  EXPECT_LT(largest_error(box.mesh, box.faces.at("top"), [](const Vector3d&) -> Vector3d { return turned.col(2); }),
            1e-14);
}

TEST(FaceNormals, OfABoxAreSeveralAtItsEdgesAndCorners) {
  const ShapedSolid box = solid_of_shape(model::SolidBox{{0, 0, 0}, {1, 1, 1}}, {1.0, {}});
  const auto normals = normals_of_face(box.mesh, boundary_facets(box.mesh), boundary_facets(box.mesh));
  for (const auto& [node, at] : normals) {
    const Vector3d x = box.mesh.nodes.col(node);
    std::size_t faces = 0;
    for (int k = 0; k < 3; ++k) faces += std::abs(2.0 * x[k] - 1.0) == 1.0;
    EXPECT_EQ(at.size(), faces);
    for (const NodeNormal& of : at) EXPECT_GT(of.n.dot(x - Vector3d(0.5, 0.5, 0.5)), 0.4);
  }
}

TEST(FaceNormals, OfQuadricsAreExactOnCoarseMeshes) {
  const Vector3d axis = turned.col(2);
  const auto across = [&](const Vector3d& x) -> Vector3d { return (x - x.dot(axis) * axis).normalized(); };
  const ShapedSolid tube = solid_of_shape(model::SolidTube{-axis, 2.0 * axis, 0.5, 1.0}, {0.8, {}});
  EXPECT_LT(largest_error(tube.mesh, tube.faces.at("outside"), across), 1e-11);
  EXPECT_LT(
      largest_error(tube.mesh, tube.faces.at("inside"), [&](const Vector3d& x) -> Vector3d { return -across(x); }),
      1e-11);
  const Vector3d centre(1, -2, 0.5);
  model::SolidSphere sphere{centre, 2.0};
  sphere.kept = {1, 0, -1};
  const ShapedSolid ball = solid_of_shape(sphere, {1.0, {}});
  EXPECT_LT(largest_error(ball.mesh, ball.faces.at("surface"),
                          [&](const Vector3d& x) -> Vector3d { return (x - centre).normalized(); }),
            1e-11);
  ShapedSolid cone = tube;  // of half the radius at its end
  const auto height = [&](const Vector3d& x) { return x.dot(axis); };
  for (auto x : cone.mesh.nodes.colwise()) {
    const Vector3d along = height(x) * axis;
    x = along + (1.0 - 0.25 * (height(x) - 2.0)) * (x - along);
  }
  EXPECT_LT(largest_error(cone.mesh, cone.faces.at("outside"),
                          [&](const Vector3d& x) -> Vector3d { return (across(x) + 0.25 * axis).normalized(); }),
            1e-11);
}

TEST(FaceNormals, OfOtherSurfacesAreMeansThatConverge) {
  std::vector<double> errors;
  for (const double size : {0.25, 0.125}) {
    ShapedSolid box = solid_of_shape(model::SolidBox{{0, 0, 0}, {1, 1, 0.25}}, {size, {}});
    for (auto x : box.mesh.nodes.colwise()) x.z() += 0.3 * std::sin(2.0 * x.x()) * std::cos(x.y());
    errors.push_back(largest_error(box.mesh, box.faces.at("top"), [](const Vector3d& x) -> Vector3d {
      return Vector3d(-0.6 * std::cos(2.0 * x.x()) * std::cos(x.y()), 0.3 * std::sin(2.0 * x.x()) * std::sin(x.y()),
                      1.0)
          .normalized();
    }));
  }
  EXPECT_LT(errors[0], 0.02);
  EXPECT_LT(errors[1], errors[0] / 3.0);  // as the square of the size
}

TEST(FaceNormals, OfACurvedFaceDoNotDependOnWhichPartOfItIsMeant) {
  ShapedSolid box = solid_of_shape(model::SolidBox{{0, 0, 0}, {1, 1, 0.25}}, {0.125, {}});
  for (auto x : box.mesh.nodes.colwise()) x.z() += 0.3 * std::sin(2.0 * x.x());
  std::vector<SolidFacet> left, right;
  for (const SolidFacet& facet : box.faces.at("top"))
    (nodes_of(box.mesh, facet).row(0).mean() < 0.5 ? left : right).push_back(facet);
  const auto boundary = boundary_facets(box.mesh);
  const auto of_left = normals_of_face(box.mesh, left, boundary), of_right = normals_of_face(box.mesh, right, boundary);
  int both = 0;
  for (const auto& [node, normals] : of_left)
    if (const auto other = of_right.find(node); other != of_right.end()) {
      EXPECT_LT((normals.front().n - other->second.front().n).norm(), 1e-14);
      ++both;
    }
  EXPECT_GT(both, 2);
}

}  // namespace
}  // namespace scabo::mesh
