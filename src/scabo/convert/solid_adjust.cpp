#include "scabo/convert/solid_adjust.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace scabo::convert {

namespace {

std::vector<int> side_corners(const files::ImportedSolidMesh& mesh, int side) {
  return files::corners_of(mesh.cells[static_cast<std::size_t>(side / 4)], side % 4);
}
std::vector<int> side_nodes(const files::ImportedSolidMesh& mesh, int side) {
  return files::nodes_of_side(mesh.cells[static_cast<std::size_t>(side / 4)], side % 4);
}

struct MasterPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double size = 0.0;  // root of the area

  double gap(const Eigen::Vector3d& x) const { return (x - point).dot(normal); }
};

/// Of sides, which lie in it if they are plane.
MasterPlane master_plane(const files::ImportedSolidMesh& mesh, const std::vector<int>& sides) {
  MasterPlane plane;
  for (const int side : sides) {
    const Eigen::Matrix3d x = mesh.nodes(Eigen::all, side_corners(mesh, side));
    plane.normal += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
    plane.point += x.rowwise().mean() / static_cast<double>(sides.size());
  }
  plane.size = std::sqrt(plane.normal.norm());
  plane.normal.normalize();
  return plane;
}

/// Whether the foot of a point lies on a side, up to a millionth.
bool is_opposite(const files::ImportedSolidMesh& mesh, int side, const MasterPlane& plane, const Eigen::Vector3d& at) {
  const Eigen::Matrix3d x = mesh.nodes(Eigen::all, side_corners(mesh, side));
  const double area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(plane.normal);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d from = x.col(i), to = x.col((i + 1) % 3);
    if ((to - from).cross(at - from).dot(plane.normal) < -1e-6 * area) return false;
  }
  return true;
}

}  // namespace

std::optional<std::pair<double, double>> gaps_of_mesh(const files::ImportedSolidMesh& mesh,
                                                      const std::vector<int>& master, const std::vector<int>& slave) {
  std::vector<MasterPlane> planes;
  for (const int side : master) planes.push_back(master_plane(mesh, {side}));
  std::set<int> nodes;
  for (const int side : slave)
    for (const int node : side_corners(mesh, side)) nodes.insert(node);
  std::optional<std::pair<double, double>> gaps;
  for (const int node : nodes) {
    const Eigen::Vector3d x = mesh.nodes.col(node);
    std::optional<double> nearest;
    for (std::size_t k = 0; k < master.size(); ++k) {
      const double gap = planes[k].gap(x);
      if ((!nearest || std::abs(gap) < std::abs(*nearest)) && is_opposite(mesh, master[k], planes[k], x)) nearest = gap;
    }
    if (!nearest) continue;
    if (!gaps) gaps = std::pair(*nearest, *nearest);
    gaps->first = std::min(gaps->first, *nearest);
    gaps->second = std::max(gaps->second, *nearest);
  }
  return gaps;
}

bool face_each_other(const files::ImportedSolidMesh& mesh, const std::vector<int>& a, const std::vector<int>& b) {
  const auto planes_of = [&](const std::vector<int>& sides) {
    std::vector<MasterPlane> planes;
    for (const int side : sides) planes.push_back(master_plane(mesh, {side}));
    return planes;
  };
  const std::vector<MasterPlane> on_a = planes_of(a), on_b = planes_of(b);
  const auto faces = [&](int side, const MasterPlane& plane, const MasterPlane& other) {
    return plane.normal.dot(other.normal) < -0.5 && plane.gap(other.point) > -plane.size &&
           is_opposite(mesh, side, plane, other.point);
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      if (faces(a[i], on_a[i], on_b[k]) || faces(b[k], on_b[k], on_a[i])) return true;
  return false;
}

void adjust_solids(files::AbaqusDeck& deck, const DeckContact& contact, const std::vector<int>& master,
                   const std::vector<int>& slave, Remarks& remarks) {
  if (!contact.adjusted_nodes && !(contact.adjust_within.value_or(0.0) > 0.0)) return;
  files::ImportedSolidMesh& mesh = *deck.solid;
  const MasterPlane plane = master_plane(mesh, master);
  for (const int side : master)
    for (const int node : side_nodes(mesh, side))
      if (std::abs(plane.gap(mesh.nodes.col(node))) > 1e-6 * plane.size)
        return remarks.essential(contact.at,
                                 "ADJUST moves nodes onto a plane master only; move them in the deck, or "
                                 "give the contact of the model a 'gap'");
  const auto in_set = [&](int node) { return contact.adjusted_nodes->contains(node); };
  std::set<int> moved;
  for (const int side : slave) {
    const std::vector<int> corners = side_corners(mesh, side);
    const bool whole =
        contact.adjusted_nodes && std::all_of(corners.begin(), corners.end(), in_set);  // with nodes that are added
    for (const int node : side_nodes(mesh, side)) {
      const bool is_added = deck.node_numbers[static_cast<std::size_t>(node)] <= 0;
      const Eigen::Vector3d x = mesh.nodes.col(node);
      const bool chosen = contact.adjusted_nodes ? in_set(node) || (whole && is_added)
                                                 : plane.gap(x) <= *contact.adjust_within * (1.0 + 1e-9);
      if (chosen && std::any_of(master.begin(), master.end(),
                                [&](int opposite) { return is_opposite(mesh, opposite, plane, x); }))
        moved.insert(node);
    }
  }
  for (const int node : moved) mesh.nodes.col(node) -= plane.gap(mesh.nodes.col(node)) * plane.normal;
}

}  // namespace scabo::convert
