#include "scabo/mesh/space/face_normals.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "scabo/geometry/facet_basis.hpp"

namespace scabo::mesh {

namespace {

using Eigen::Vector3d;

constexpr double on_surface = 1e-6;  // distance of nodes beside the size of a part: files have six digits

/// Both derivatives of the position, 3 x 2.
Eigen::Matrix<double, 3, 2> tangents_at(const Matrix& x, const Vec2& place) {
  return x * geometry::FacetBasis::of(static_cast<int>(x.cols())).derivatives(place);
}

/// Outward, of length 1.
Vector3d normal_at(const Matrix& x, const Vec2& place) {
  const Eigen::Matrix<double, 3, 2> along = tangents_at(x, place);
  return Vector3d(along.col(0)).cross(Vector3d(along.col(1))).stableNormalized();
}

/// The angle of a facet at one of its nodes.
double angle_at(const Matrix& x, Eigen::Index node) {
  const auto& basis = geometry::FacetBasis::of(static_cast<int>(x.cols()));
  const Eigen::Index corners = basis.corners();
  if (node >= corners) return std::numbers::pi;
  const Vec2 here = basis.places().col(node);
  const Eigen::Matrix<double, 3, 2> along = tangents_at(x, here);
  const Vector3d next = along * (basis.places().col((node + 1) % corners) - here),
                 last = along * (basis.places().col((node + corners - 1) % corners) - here);
  return std::atan2(next.cross(last).norm(), next.dot(last));
}

using Parts = std::vector<std::vector<SolidFacet>>;

/// The facets that are joined by edges at which the face turns little.
Parts smooth_parts(const SolidMesh& mesh, const std::vector<SolidFacet>& face) {
  struct AtEdge {
    std::size_t facet;
    Vector3d normal;
  };
  std::map<std::pair<int, int>, std::vector<AtEdge>> edges;  // by their ends in ascending order
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Matrix x = nodes_of(mesh, face[i]);
    const Matrix& places = geometry::FacetBasis::of(static_cast<int>(face[i].size())).places();
    for (std::size_t k = 0, n = corners_of(face[i]); k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      const Vec2 middle =
          0.5 * (places.col(static_cast<Eigen::Index>(k)) + places.col(static_cast<Eigen::Index>(next)));
      edges[std::minmax(face[i][k], face[i][next])].push_back({i, normal_at(x, middle)});
    }
  }
  std::vector<std::vector<std::size_t>> beside(face.size());
  for (const auto& [ends, around] : edges)
    for (const AtEdge& one : around)
      for (const AtEdge& other : around)
        if (one.facet != other.facet && one.normal.dot(other.normal) >= cosine_of_turn)
          beside[one.facet].push_back(other.facet);
  Parts parts;
  std::vector<char> taken(face.size(), 0);
  for (std::size_t first = 0; first < face.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> found{first};
    taken[first] = 1;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const std::size_t next : beside[found[k]])
        if (!taken[next]) taken[next] = 1, found.push_back(next);
    std::sort(found.begin(), found.end());
    std::vector<SolidFacet>& part = parts.emplace_back();
    for (const std::size_t i : found) part.push_back(face[i]);
  }
  return parts;
}

/// The same for vectors of length 1 that are nearly along an axis.
Vector3d without_rounding(Vector3d n) {
  for (double& component : n)
    if (std::abs(component) < 1e-14) component = 0.0;
  return n.normalized();
}

/// A quadric through points, which are given about their middle and as parts of their largest distance from it.
struct Quadric {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  double c = 0.0;

  double value(const Vector3d& x) const { return x.dot(A * x) + b.dot(x) + c; }
  Vector3d gradient(const Vector3d& x) const { return 2.0 * (A * x) + b; }
};

/// The right singular vectors of A, and the singular values in descending order.
Eigen::JacobiSVD<Matrix> svd_of(const Matrix& A) {
  const Eigen::HouseholderQR<Matrix> qr(A);
  const Matrix R = qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
  return Eigen::JacobiSVD<Matrix>(R, Eigen::ComputeFullV);
}

/// The only one on which all points lie.
std::optional<Quadric> quadric_through(const Matrix& x) {
  constexpr Eigen::Index terms = 10;
  if (x.cols() < terms) return {};
  Matrix rows(x.cols(), terms);
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vector3d p = x.col(i);
    rows.row(i) << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(), p.x() * p.z(), p.x(),
        p.y(), p.z(), 1.0;
  }
  const auto svd = svd_of(rows);
  constexpr double only = 1e-3;
  if (!(svd.singularValues()[terms - 1] < only * svd.singularValues()[terms - 2])) return {};
  const Vector v = svd.matrixV().col(terms - 1);
  Quadric q;
  q.A.diagonal() = v.head<3>();
  q.A(0, 1) = q.A(1, 0) = 0.5 * v[3], q.A(1, 2) = q.A(2, 1) = 0.5 * v[4], q.A(0, 2) = q.A(2, 0) = 0.5 * v[5];
  q.b = v.segment<3>(6), q.c = v[9];
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vector3d gradient = q.gradient(x.col(i));
    if (std::abs(q.value(x.col(i))) > on_surface * gradient.norm()) return {};
  }
  return q;
}

/// Facets of the boundary around every node, with the number that the node has there.
using Around = std::map<int, std::vector<std::pair<const SolidFacet*, Eigen::Index>>>;

/// The normals of one smooth part.
class NormalsOfPart {
 public:
  NormalsOfPart(const SolidMesh& mesh, const std::vector<SolidFacet>& part, const Around& around)
      : mesh_(mesh), around_(around) {
    for (const SolidFacet& facet : part)
      for (std::size_t k = 0; k < facet.size(); ++k)
        own_.try_emplace(facet[k], Vector3d::Zero()).first->second += weighted(facet, static_cast<Eigen::Index>(k));
    std::vector<int> nodes;
    for (const auto& [node, sum] : own_) nodes.push_back(node);
    Matrix x = nodes_of(mesh_, nodes);
    middle_ = x.rowwise().mean();
    x.colwise() -= middle_;
    size_ = x.colwise().norm().maxCoeff();
    x /= size_;
    const Vector3d normal = svd_of(x.transpose()).matrixV().col(2);
    if ((normal.transpose() * x).cwiseAbs().maxCoeff() <= on_surface)
      plane_ = normal;
    else
      quadric_ = quadric_through(x);
  }

  const std::map<int, Vector3d>& own() const { return own_; }
  bool is_curved() const { return !plane_; }
  Vector3d at(int node) const {
    const Vector3d outwards = own_.at(node);
    Vector3d n = Vector3d::Zero();
    if (plane_) n = *plane_;
    if (quadric_) n = quadric_->gradient((mesh_.nodes.col(node) - middle_) / size_).normalized();
    if (n.dot(outwards.normalized()) < 0.0) n = -n;
    if (!(n.dot(outwards.normalized()) >= cosine_of_turn)) n = smooth_mean(node, outwards.normalized());
    return without_rounding(n);
  }

 private:
  /// The normal of a facet at one of its nodes times its angle there.
  Vector3d weighted(const SolidFacet& facet, Eigen::Index k) const {
    const Matrix x = nodes_of(mesh_, facet);
    const Matrix& places = geometry::FacetBasis::of(static_cast<int>(facet.size())).places();
    return angle_at(x, k) * normal_at(x, places.col(k));
  }

  Vector3d smooth_mean(int node, const Vector3d& outwards) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& [facet, k] : around_.at(node))
      if (const Vector3d one = weighted(*facet, k); one.normalized().dot(outwards) >= cosine_of_turn) sum += one;
    return sum.normalized();
  }

  const SolidMesh& mesh_;
  const Around& around_;
  std::map<int, Vector3d> own_;  // sums over its facets
  Vector3d middle_;
  double size_ = 1.0;
  std::optional<Vector3d> plane_;
  std::optional<Quadric> quadric_;
};

}  // namespace

std::map<int, std::vector<NodeNormal>> normals_of_face(const SolidMesh& mesh, const std::vector<SolidFacet>& face,
                                                       const std::vector<SolidFacet>& boundary) {
  Around around;
  for (const SolidFacet& facet : boundary)
    for (std::size_t k = 0; k < facet.size(); ++k) around[facet[k]].emplace_back(&facet, static_cast<Eigen::Index>(k));
  std::map<int, std::vector<NodeNormal>> normals;
  for (const std::vector<SolidFacet>& part : smooth_parts(mesh, face)) {
    const NormalsOfPart of(mesh, part, around);
    for (const auto& [node, sum] : of.own()) normals[node].push_back({of.at(node), of.is_curved()});
  }
  return normals;
}

}  // namespace scabo::mesh
