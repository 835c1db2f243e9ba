#include "scabo/model/nearest_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

#include "scabo/model/cad_shape.hpp"

namespace scabo::model {

namespace {

using Eigen::Vector3d;

constexpr double rounding = 1e-9;  // of the size of the body

double to_segment(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const double t = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (point - a - t * (b - a)).norm();
}

/// In the triangle's plane where the point is above it, else to its sides.
double to_triangle(const Eigen::Matrix3d& x, const Vector3d& point) {
  const Vector3d normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
  bool above = true;
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k < 3; ++k) {
    const Vector3d a = x.col(k), b = x.col((k + 1) % 3);
    above = above && normal.dot((b - a).cross(point - a)) >= 0.0;
    least = std::min(least, to_segment(a, b, point));
  }
  return above ? std::abs(normal.dot(point - x.col(0))) : least;
}

}  // namespace

std::vector<std::string> nearest_faces(const files::ImportedSolidMesh& mesh, const Vector3d& point) {
  const Vector3d extent = mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff();
  const double same = rounding * extent.norm();
  double least = std::numeric_limits<double>::max();
  std::vector<std::pair<std::string, std::set<std::pair<int, int>>>> faces;  // with their nearest sides
  for (const files::SolidSideSet& set : mesh.side_sets)
    for (const files::SolidSide& side : set.sides) {
      double distance = std::numeric_limits<double>::max();
      for (const std::vector<int>& corners :
           files::triangles_of_side(mesh.cells[static_cast<std::size_t>(side.cell)], side.side))
        distance = std::min(distance, to_triangle(mesh.nodes(Eigen::all, corners), point));
      if (distance > least + same) continue;
      if (distance < least - same) faces.clear();
      least = std::min(least, distance);
      if (faces.empty() || faces.back().first != set.name)
        faces.emplace_back(set.name, std::set<std::pair<int, int>>{});
      faces.back().second.emplace(side.cell, side.side);
    }
  std::vector<std::string> names;
  for (const auto& [name, sides] : faces)
    if (names.empty() || sides != faces.front().second) names.push_back(name);
  return names;
}

std::vector<std::string> nearest_faces(const SolidShape& shape, const Vector3d& point) {
  const std::vector<std::string> known = face_names(shape);
  std::vector<double> distances;
  for (const std::string& name : known) distances.push_back(distance_to_face(shape, name, point));
  const double least = *std::min_element(distances.begin(), distances.end());
  double size = 0.0;
  for (const double distance : distances) size = std::max(size, distance);
  const auto* drawn = std::get_if<SolidExtrusion>(&shape);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (distances[i] > least + rounding * size) continue;
    const bool again = drawn != nullptr && !names.empty() &&
                       std::any_of(drawn->outline.edges.begin(), drawn->outline.edges.end(), [&](const auto& edge) {
                         const auto has = [&](const std::string& name) {
                           return std::find(edge.names.begin(), edge.names.end(), name) != edge.names.end();
                         };
                         return has(names.back()) && has(known[i]);
                       });
    if (!again) names.push_back(known[i]);
  }
  return names;
}

}  // namespace scabo::model
