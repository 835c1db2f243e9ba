// Fields that a super-element must reproduce exactly, whatever its shape.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>

#include "scabo/element/plane/interior_field.hpp"
#include "scabo/system/loads.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

/// An exact solution in the plane about the scaling centre.
struct ExactField {
  std::function<Vec2(const Vec2&)> displacement;
  std::function<Vec3(const Vec2&)> stress;
  Vec2 body_force = Vec2::Zero();  // force / length^3
};

/// Largest relative errors met.
struct Errors {
  double forces = 0.0, displacement = 0.0, stress = 0.0;
  void raise(const Errors& other) {
    forces = std::max(forces, other.forces);
    displacement = std::max(displacement, other.displacement);
    stress = std::max(stress, other.stress);
  }
};

/// K u - h(b) against the consistent nodal forces of the exact tractions; displacement and stress at ten
/// random points.
Errors errors_of(const Ring& ring, const Mat3& D, double thickness, const ExactField& exact, std::mt19937& random) {
  const auto solution = solve_super_element(ring, D, thickness);
  const auto modal = modal_solution(solution);
  const Vector u = at_nodes(ring.nodes, exact.displacement);
  const Vector f = system::traction_forces(ring.elements, ring.nodes, thickness, [&](const Vec2& x, const Vec2& n) {
    return traction_of(exact.stress(x), n);
  });
  const std::vector<RadialLoad> loads = uniform_body_force(ring, exact.body_force, thickness);
  const Vector h = equivalent_load(solution, loads);
  Errors errors;
  errors.forces = largest(solution.K * u - h - f) / std::max(largest(f), largest(h));

  const double size = largest(u);
  double stress_size = 0.0;  // |D| |strain|: a stress may vanish where its strain does not
  for (const Vec2& node : ring.nodes)
    stress_size = std::max(stress_size, largest(D) * largest(D.inverse() * exact.stress(node)));
  const RadialField field(solution, modal, u, loads);
  for (int k = 0; k < 10; ++k) {
    const double xi = k == 0 ? 1.0 : uniform(random, 0.0, 1.0), eta = uniform(random, -1.0, 1.0);
    const int element = whole(random, 0, static_cast<int>(ring.elements.size()) - 1);
    const Vec2 x = xi * boundary_position(ring, element, eta);
    const PointValues values = point_values(ring, field.at(xi), D, element, eta);
    errors.displacement = std::max(errors.displacement, largest(values.displacement - exact.displacement(x)) / size);
    errors.stress = std::max(errors.stress, largest(values.stress - exact.stress(x)) / stress_size);
  }
  return errors;
}

Ring random_ring(std::mt19937& random, int order) {
  const std::vector<Vec2> vertices = random_star(random, std::pow(10.0, uniform(random, -3.0, 3.0)));
  std::vector<int> divisions;
  for (std::size_t i = 0; i < vertices.size(); ++i) divisions.push_back(whole(random, 1, 3));
  return polygon_ring(vertices, divisions, order);
}

void report(const Errors& worst) {
  testing::Test::RecordProperty("worst nodal force", testing::PrintToString(worst.forces));
  testing::Test::RecordProperty("worst displacement", testing::PrintToString(worst.displacement));
  testing::Test::RecordProperty("worst stress", testing::PrintToString(worst.stress));
}

TEST(PatchTest, LinearDisplacementsOnAThousandRandomPolygons) {
  std::mt19937 random(1);
  Errors worst;
  for (int k = 0; k < 1000; ++k) {
    const Ring ring = random_ring(random, whole(random, 1, 4));
    const Mat3 D = random_elasticity(random);
    Mat2 gradient;
    for (double& entry : gradient.reshaped()) entry = uniform(random, -1e-3, 1e-3);
    const Vec2 shift = gradient * ring.nodes.front() * uniform(random, 0.0, 2.0);
    const Vec3 stress = D * Vec3(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
    const ExactField exact{[&](const Vec2& x) { return Vec2(gradient * x + shift); },
                           [&](const Vec2&) { return stress; }};
    const Errors errors = errors_of(ring, D, uniform(random, 0.1, 2.0), exact, random);
    worst.raise(errors);
    EXPECT_LT(errors.forces, 1e-11) << "polygon " << k;
    EXPECT_LT(errors.displacement, 1e-11) << "polygon " << k;
    EXPECT_LT(errors.stress, 1e-11) << "polygon " << k;
  }
  report(worst);
}

// With straight edges of order p, boundary displacements that are polynomials of degree p are met exactly,
// and so are all polynomial solutions of that degree: Kolosov's 2 G u = kappa phi - z conj(phi') - conj(psi)
// with phi and psi of degree p; stress_xx + stress_yy = 4 Re phi', stress_yy - stress_xx + 2 i stress_xy = 2
// (conj(z) phi'' + psi').
TEST(PatchTest, PolynomialSolutionsOfTheOrderOfTheEdges) {
  using Complex = std::complex<double>;
  std::mt19937 random(2);
  Errors worst;
  for (int k = 0; k < 200; ++k) {
    const int order = whole(random, 1, 4), degree = whole(random, 1, order);
    const Ring ring = random_ring(random, order);
    const Mat3 D = random_elasticity(random);
    const double G = D(2, 2), lame = D(0, 1), kappa = (lame + 3.0 * G) / (lame + G);
    double size = 0.0;
    for (const Vec2& node : ring.nodes) size = std::max(size, node.norm());
    const Complex a(uniform(random, -1, 1), uniform(random, -1, 1)), b(uniform(random, -1, 1), uniform(random, -1, 1));
    const auto power = [&](Complex z, int n) { return n < 0 ? Complex(0.0) : std::pow(z / size, n); };
    const ExactField exact{
        [&](const Vec2& x) {
          const Complex z(x.x(), x.y());
          const Complex phi = a * power(z, degree), slope = a * (degree / size) * power(z, degree - 1);
          const Complex u = (kappa * phi - z * std::conj(slope) - std::conj(b * power(z, degree))) / (2.0 * G);
          return Vec2(u.real(), u.imag());
        },
        [&](const Vec2& x) {
          const Complex z(x.x(), x.y());
          const Complex slope = a * (degree / size) * power(z, degree - 1);
          const Complex curvature = a * (degree * (degree - 1) / (size * size)) * power(z, degree - 2);
          const double sum = 4.0 * slope.real();
          const Complex difference = 2.0 * (std::conj(z) * curvature + b * (degree / size) * power(z, degree - 1));
          return Vec3(0.5 * (sum - difference.real()), 0.5 * (sum + difference.real()), 0.5 * difference.imag());
        }};
    const Errors errors = errors_of(ring, D, 1.0, exact, random);
    worst.raise(errors);
    EXPECT_LT(errors.forces, 1e-11) << "polygon " << k << ", order " << order << ", degree " << degree;
    EXPECT_LT(errors.displacement, 1e-11) << "polygon " << k << ", order " << order << ", degree " << degree;
    EXPECT_LT(errors.stress, 1e-11) << "polygon " << k << ", order " << order << ", degree " << degree;
  }
  report(worst);
}

// Any quadratic displacement field balances some uniform body force: exact for edges of order 2 and more.
TEST(PatchTest, QuadraticDisplacementsUnderAUniformBodyForce) {
  std::mt19937 random(3);
  Errors worst;
  for (int k = 0; k < 200; ++k) {
    const Ring ring = random_ring(random, whole(random, 2, 4));
    const Mat3 D = random_elasticity(random);
    double size = 0.0;
    for (const Vec2& node : ring.nodes) size = std::max(size, node.norm());
    Mat2 H[2];  // u_i = 1/2 x'H_i x
    for (Mat2& curvature : H) {
      const double xy = uniform(random, -1, 1);
      curvature << uniform(random, -1, 1), xy, xy, uniform(random, -1, 1);
      curvature /= size;
    }
    const auto strain = [&](const Vec2& x) {
      const Vec2 gx = H[0] * x, gy = H[1] * x;
      return Vec3(gx.x(), gy.y(), gx.y() + gy.x());
    };
    const Vec3 along_x = D * strain(Vec2(1, 0)), along_y = D * strain(Vec2(0, 1));
    ExactField exact{[&](const Vec2& x) { return Vec2(0.5 * x.dot(H[0] * x), 0.5 * x.dot(H[1] * x)); },
                     [&](const Vec2& x) { return Vec3(D * strain(x)); }};
    exact.body_force = -Vec2(along_x[0] + along_y[2], along_x[2] + along_y[1]);  // -div stress
    const Errors errors = errors_of(ring, D, 0.3, exact, random);
    worst.raise(errors);
    EXPECT_LT(errors.forces, 1e-11) << "polygon " << k;
    EXPECT_LT(errors.displacement, 1e-11) << "polygon " << k;
    EXPECT_LT(errors.stress, 1e-11) << "polygon " << k;
  }
  report(worst);
}

}  // namespace
}  // namespace scabo::element
