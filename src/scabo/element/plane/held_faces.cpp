#include "scabo/element/plane/held_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/base/components.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/sbfem/ring_doubling.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/schur_exponential.hpp"

namespace scabo::element {

namespace {

Matrix mean_with_transposed(const Matrix& A) { return 0.5 * (A + A.transpose()); }

/// A component of an end node that is held.
struct Held {
  Eigen::Index node;
  Vec2 along;
};

std::vector<Held> components_of(const Ring& ring, const mesh::HeldFaces& faces) {
  std::vector<Held> held;
  for (const std::size_t face : {0u, 1u})
    for (const Vec2& along : faces.along[face])
      held.push_back({face == 0 ? ring.first_node() : ring.last_node(), along});
  return held;
}

/// n x n_v: the free components, along the held directions turned by a quarter turn, or x and y.
Matrix free_components(const Ring& ring, const std::vector<Held>& held) {
  std::vector<std::pair<Eigen::Index, Vec2>> columns;
  for (Eigen::Index node = 0; node < static_cast<Eigen::Index>(ring.nodes.size()); ++node) {
    std::vector<Vec2> at_node;
    for (const Held& one : held)
      if (one.node == node) at_node.push_back(one.along);
    if (at_node.empty()) {
      columns.emplace_back(node, Vec2::UnitX());
      columns.emplace_back(node, Vec2::UnitY());
    } else if (at_node.size() == 1) {
      columns.emplace_back(node, Vec2(-at_node.front().y(), at_node.front().x()));
    }
  }
  Matrix T = Matrix::Zero(2 * static_cast<Eigen::Index>(ring.nodes.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    T.block<2, 1>(2 * columns[c].first, static_cast<Eigen::Index>(c)) = columns[c].second;
  return T;
}

/// a = A^-1 h(u) as a 2 x n matrix of u; nothing if h does not determine it, or more than it. Of one direction, the
/// part of a along it.
std::optional<Matrix> translation_of(const std::vector<Held>& held, Eigen::Index n) {
  Matrix of_u = Matrix::Zero(2, n);
  if (held.size() == 1) {
    of_u.middleCols<2>(2 * held[0].node) = held[0].along * held[0].along.transpose();
    return of_u;
  }
  if (held.size() != 2) return std::nullopt;
  Mat2 A;
  A << held[0].along.transpose(), held[1].along.transpose();
  if (std::abs(A.determinant()) < 1e-6) return std::nullopt;
  const Mat2 inverse = A.inverse();
  for (Eigen::Index k = 0; k < 2; ++k)
    of_u.middleCols<2>(2 * held[static_cast<std::size_t>(k)].node) +=
        inverse.col(k) * held[static_cast<std::size_t>(k)].along.transpose();
  return of_u;
}

/// What ring doubling makes of the free components; K_v includes the translation that remains.
struct FreeStiffness {
  Matrix K, S;
  int zero_exponents = 0;
};
FreeStiffness stiffness_of_free(const Matrix& E0, const Matrix& E1, const Matrix& E2, const Vector& t) {
  constexpr double too_much = 1e-9;  // of a Riccati residual, as in stiffness.cpp
  const auto checked = [&](RingStiffness ring) {
    if (!(ring.residual <= too_much))
      throw IllPosed(fmt::format("loss of precision: the Riccati residual remains at {:.0e}", ring.residual));
    return ring;
  };
  if (t.size() == 0) {
    const RingStiffness ring = checked(ring_doubling(E0, E1, E2));
    return {ring.K, ring.S, 0};
  }
  // The row in which the translation is largest by the energy that E0 gives it is taken out.
  Eigen::Index taken = 0;
  t.cwiseProduct(E0.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(&taken);
  const Vector r = t / t[taken];
  std::vector<Eigen::Index> rest;
  for (Eigen::Index row = 0; row < r.size(); ++row)
    if (row != taken) rest.push_back(row);
  const Vector E0r = E0 * r, E1r = E1 * r;
  const double M = r.dot(E0r);
  if (!(M > 0.0)) throw IllPosed("E0 is not positive definite");
  const Matrix E0_v = mean_with_transposed(E0 - E0r * E0r.transpose() / M), E1_v = E1 - E1r * E0r.transpose() / M,
               E2_v = mean_with_transposed(E2 - E1r * E1r.transpose() / M);
  const RingStiffness ring = checked(ring_doubling(E0_v(rest, rest), E1_v(rest, rest), E2_v(rest, rest)));
  FreeStiffness made{Matrix::Zero(r.size(), r.size()), ring.S, 1};  // K r = 0 and symmetry give the row
  const Vector r_rest = r(rest), row = -(ring.K * r_rest);
  made.K(rest, rest) = ring.K;
  for (std::size_t k = 0; k < rest.size(); ++k)
    made.K(rest[k], taken) = made.K(taken, rest[k]) = row[static_cast<Eigen::Index>(k)];
  made.K(taken, taken) = -r_rest.dot(row);
  return made;
}

}  // namespace

HeldSolution solve_held(const Ring& ring, const Elasticity& D, double thickness, const mesh::HeldFaces& faces) {
  ensure(ring.is_open(), "side faces belong to open super-elements");
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, thickness);
  const auto n = places_of(ring.nodes.size());
  const std::vector<Held> held = components_of(ring, faces);
  const Matrix T = free_components(ring, held);
  Matrix R(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) R.row(i) << (i % 2 == 0 ? 1.0 : 0.0), (i % 2 == 0 ? 0.0 : 1.0);
  const Vector left =
      held.size() == 1 ? Vector(T.transpose() * (R * Vec2(-held[0].along.y(), held[0].along.x()))) : Vector();
  const FreeStiffness found =
      stiffness_of_free(mean_with_transposed(T.transpose() * (matrices.E0 * T)), T.transpose() * (matrices.E1 * T),
                        mean_with_transposed(T.transpose() * (matrices.E2 * T)), left);
  HeldSolution solution;
  for (int k = 0; k < found.zero_exponents; ++k) solution.exponents.emplace_back(0.0);
  const linalg::SchurExponential modes(found.S);
  solution.exponents.insert(solution.exponents.end(), modes.eigenvalues().begin(), modes.eigenvalues().end());
  std::stable_sort(solution.exponents.begin(), solution.exponents.end(),
                   [](const auto& a, const auto& b) { return a.real() < b.real(); });
  const std::optional<Matrix> a_of_u = translation_of(held, n);
  if (!a_of_u) return solution;
  const Matrix P = T.transpose() * (Matrix::Identity(n, n) - R * *a_of_u);
  solution.K = mean_with_transposed(P.transpose() * found.K * P);
  solution.rounding = std::numeric_limits<double>::epsilon() *
                      std::max(1.0, matrices.E2.diagonal().cwiseQuotient(solution.K->diagonal()).maxCoeff());
  return solution;
}

namespace {

/// The elasticity of a material seen in a mirror.
Mat3 reflected(const Mat3& D, const Mat2& Q) {
  Mat3 image;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec3 strain = Vec3::Unit(k);  // [xx, yy, 2 xy] of the image
    Mat2 tensor;
    tensor << strain[0], 0.5 * strain[2], 0.5 * strain[2], strain[1];
    const Mat2 there = Q * tensor * Q;
    const Vec3 stress = D * Vec3(there(0, 0), there(1, 1), 2.0 * there(0, 1));
    tensor << stress[0], stress[2], stress[2], stress[1];
    const Mat2 back = Q * tensor * Q;
    image.col(k) << back(0, 0), back(1, 1), back(0, 1);
  }
  return image;
}

}  // namespace

Mirrored with_image(const Ring& ring, const Elasticity& D, Face face, const Vec2& normal) {
  const int n = static_cast<int>(ring.nodes.size());
  Mirrored made;
  const Mat2 Q = made.reflection = Mat2::Identity() - 2.0 * normal * normal.transpose();
  made.ring.nodes.resize(static_cast<std::size_t>(2 * n - 1));
  const bool first = face == Face::first;  // the image comes before, otherwise after
  for (int i = 0; i < n; ++i) {
    made.own.push_back(first ? n - 1 + i : i);
    made.image.push_back(first ? n - 1 - i : 2 * (n - 1) - i);
    made.ring.nodes[static_cast<std::size_t>(made.image.back())] = Q * ring.node(i);
  }
  for (int i = 0; i < n; ++i)
    made.ring.nodes[static_cast<std::size_t>(made.own[static_cast<std::size_t>(i)])] = ring.node(i);
  Vec2 &start = made.ring.nodes.front(), &end = made.ring.nodes.back();
  if ((start - end).norm() < 1e-6 * start.norm()) (first ? start : end) = first ? end : start;
  std::vector<mesh::LineElement> images;
  for (auto element = ring.elements.rbegin(); element != ring.elements.rend(); ++element) {
    mesh::LineElement& image = images.emplace_back();
    for (auto node = element->nodes.rbegin(); node != element->nodes.rend(); ++node)
      image.nodes.push_back(made.image[static_cast<std::size_t>(*node)]);
  }
  std::vector<mesh::LineElement> own = ring.elements;
  for (mesh::LineElement& element : own)
    for (int& node : element.nodes) node = made.own[static_cast<std::size_t>(node)];
  made.ring.elements = first ? images : own;
  const auto& others = first ? own : images;
  made.ring.elements.insert(made.ring.elements.end(), others.begin(), others.end());

  std::vector<Mat3> of_own, of_images;
  bool alike = D.size() == 1;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    of_own.push_back(D.of(e));
    of_images.insert(of_images.begin(), reflected(D.of(e), Q));
    alike = alike && (of_images.front() - D.of(e)).norm() <= 1e-12 * D.of(e).norm();
  }
  if (alike) {
    made.D = D;
    return made;
  }
  std::vector<Mat3>& all = first ? of_images : of_own;
  all.insert(all.end(), (first ? of_own : of_images).begin(), (first ? of_own : of_images).end());
  made.D = Elasticity(all);
  return made;
}

Vector Mirrored::displacement(const Vector& u) const {
  Vector made = Vector::Zero(places_of(ring.nodes.size()));
  for (std::size_t i = 0; i < own.size(); ++i)
    made.segment<2>(place_of(image[i])) = reflection * u.segment<2>(place_of(i));
  for (std::size_t i = 0; i < own.size(); ++i) made.segment<2>(place_of(own[i])) = u.segment<2>(place_of(i));
  return made;
}

std::vector<RadialLoad> Mirrored::loads(const std::vector<RadialLoad>& given) const {
  const auto both = [&](const Vector& f) {
    if (f.size() == 0) return f;
    Vector made = Vector::Zero(places_of(ring.nodes.size()));
    for (std::size_t i = 0; i < own.size(); ++i) {
      made.segment<2>(place_of(own[i])) += f.segment<2>(place_of(i));
      made.segment<2>(place_of(image[i])) += reflection * f.segment<2>(place_of(i));
    }
    return made;
  };
  std::vector<RadialLoad> made;
  for (const RadialLoad& load : given) made.push_back({load.power, both(load.g), both(load.c)});
  return made;
}

}  // namespace scabo::element
