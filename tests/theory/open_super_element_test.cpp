// Open and unbounded super-elements, sectors of different material, and loads inside, against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "scabo/element/plane/interior_field.hpp"
#include "scabo/element/plane/mirror_symmetry.hpp"
#include "scabo/system/loads.hpp"
#include "support/decompositions.hpp"
#include "theory/open_rings.hpp"

namespace scabo::element {
namespace {

using test::at_nodes, test::elasticity, test::largest, test::open_ring, test::polygon_ring, test::rectangle;

using std::numbers::pi;

/// A square plate with a crack from the middle of its left side to its centre.
Ring cracked_plate(int divisions, int order) {
  return open_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}, divisions, order);
}

/// Three quarters of a square about its centre.
Ring corner_270(int divisions, int order) {
  return open_ring({{0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}, divisions, order);
}

/// The lower half-plane seen from a trench.
Ring half_plane(int divisions, int order) {
  return open_ring({{-1, 0}, {-0.8, -1.1}, {0.9, -0.7}, {1.2, 0}}, divisions, order);
}

std::vector<std::complex<double>> lowest(const Ring& ring, const Elasticity& D, std::size_t count) {
  auto exponents = modal_solution(solve_super_element(ring, D, 1.0)).exponents;
  exponents.resize(count);
  return exponents;
}

TEST(OpenSuperElement, CrackHasTheExponentOneHalfTwice) {
  const auto exponents = lowest(cracked_plate(2, 8), elasticity(10e9, 0.3), 6);
  for (int i : {0, 1}) EXPECT_EQ(std::abs(exponents[static_cast<std::size_t>(i)]), 0.0);
  for (int i : {2, 3}) EXPECT_NEAR(exponents[static_cast<std::size_t>(i)].real(), 0.5, 1e-9);
  for (int i : {4, 5}) EXPECT_NEAR(std::abs(exponents[static_cast<std::size_t>(i)] - 1.0), 0.0, 1e-6);  // may be a pair
}

// Source: the roots of sin(1.5 pi lambda) = -+ lambda sin(1.5 pi), Williams 1952.
TEST(OpenSuperElement, CornerOf270DegreesHasTheExponentsOfWilliams) {
  const auto exponents = lowest(corner_270(2, 10), elasticity(1.0, 0.3), 5);
  EXPECT_NEAR(exponents[2].real(), 0.544483737, 1e-9);
  EXPECT_NEAR(exponents[3].real(), 0.90852919, 1e-8);
}

TEST(OpenSuperElement, SplitsAtTheLineThatExchangesItsFaces) {
  const Mat3 D = elasticity(10e9, 0.3);
  for (const Ring& ring : {cracked_plate(2, 3), corner_270(2, 2)}) {
    EXPECT_EQ(symmetry_blocks(ring, D).size(), 2u);
    const auto split = solve_super_element(ring, D, 1.0);
    std::vector<Mat3> marked(ring.elements.size(), D);  // as good as equal, but no longer its own mirror image
    marked.front() *= 1.0 + 1e-12;
    const auto whole = solve_super_element(ring, marked, 1.0);
    ASSERT_EQ(whole.blocks.size(), 1u);
    EXPECT_LT(largest(split.K - whole.K) / largest(whole.K), 1e-11);
  }
}

/// Stress linear in x and y, in equilibrium with the body force b = -div stress, and its displacement, by integration.
struct LinearField2 {
  Mat2 gradient;                       // of the displacement at the origin
  Eigen::Matrix<double, 2, 3> second;  // u = gradient x + second [x^2, x y, y^2]
  Vec2 displacement(const Vec2& x) const {
    return gradient * x + second * Eigen::Vector3d(x.x() * x.x(), x.x() * x.y(), x.y() * x.y());
  }
  Vec3 strain(const Vec2& x) const {
    const Vec2 by_x = gradient.col(0) + second.col(0) * 2 * x.x() + second.col(1) * x.y(),
               by_y = gradient.col(1) + second.col(2) * 2 * x.y() + second.col(1) * x.x();
    return {by_x.x(), by_y.y(), by_x.y() + by_y.x()};
  }
};

LinearField2 quadratic_field() {
  LinearField2 field;
  field.gradient << 1e-3, 2e-3, -1e-3, 5e-4;
  field.second << 3e-4, -2e-4, 5e-4, 1e-4, 4e-4, -6e-4;
  return field;
}

/// Largest errors of nodal forces, displacement and stress of an exact field with face tractions, body force and
/// temperature.
void expect_exact(const Ring& ring, const Mat3& D, const Vec3& unit_strain, const LinearField& temperature,
                  const LinearField2& exact, double tolerance) {
  const double t = 0.4;
  const auto stress = [&](const Vec2& x) { return Vec3(D * (exact.strain(x) - unit_strain * temperature.at(x))); };
  // b = -div stress, linear fields have constant derivatives.
  const Vec3 at0 = stress({0, 0}), by_x = stress({1, 0}) - at0, by_y = stress({0, 1}) - at0;
  std::vector<RadialLoad> loads = body_force_loads(ring, {-(by_x[0] + by_y[2])}, {-(by_x[2] + by_y[1])}, t);
  if (!temperature.is_zero()) add_radial_loads(loads, thermal_loads(ring, D, {unit_strain}, temperature, t), 1.0);
  if (ring.is_open())
    for (Face face : {Face::first, Face::last}) {
      const Vec2 n = face_normal(ring, face);
      const Vec2 end = ring.nodes[static_cast<std::size_t>(face == Face::first ? ring.first_node() : ring.last_node())];
      const Vec2 constant = test::traction_of(at0, n);
      add_radial_loads(loads, {face_load(ring, face, 0.0, constant, t)}, 1.0);
      add_radial_loads(loads, {face_load(ring, face, 1.0, test::traction_of(stress(end), n) - constant, t)}, 1.0);
    }
  const auto solution = solve_super_element(ring, D, t);
  const auto modal = modal_solution(solution);
  const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return exact.displacement(x); });
  const Vector f = system::traction_forces(
      ring.elements, ring.nodes, t, [&](const Vec2& x, const Vec2& n) { return test::traction_of(stress(x), n); });
  const Vector h = equivalent_load(solution, loads);
  EXPECT_LT(largest(solution.K * u - h - f) / std::max(largest(f), largest(h)), tolerance);
  const RadialField field(solution, modal, u, loads);
  for (int e = 0; e < static_cast<int>(ring.elements.size()); ++e)
    for (double xi : {1.0, 0.6, 0.1, 1e-3}) {
      const Vec2 x = xi * boundary_position(ring, e, 0.3);
      const PointValues values = point_values(ring, field.at(xi), D, e, 0.3, unit_strain * temperature.at(x));
      EXPECT_LT(largest(values.displacement - exact.displacement(x)) / largest(u), tolerance) << "xi = " << xi;
      EXPECT_LT(largest(values.stress - stress(x)) / largest(stress({1, 1})), 100 * tolerance) << "xi = " << xi;
    }
}

// Face tractions xi^0 and xi^1, body forces xi^0; the exponents 1 and 2 are among those of the super-element:
// resonance.
TEST(InteriorLoads, PolynomialFieldsAreExactOnOpenSuperElements) {
  const Mat3 D = elasticity(10.0, 0.3);
  for (int order : {2, 3, 6})
    for (const Ring& ring : {corner_270(2, order), cracked_plate(1, order),
                             open_ring({{0.2, -1}, {1, -1}, {1.4, 0.7}, {-1, 1}, {-1.2, 0.1}}, 1, order)})
      expect_exact(ring, D, Vec3::Zero(), {}, quadratic_field(), 1e-11);
}

TEST(InteriorLoads, TemperatureThatIsLinearIsExact) {
  const Mat3 D = elasticity(10.0, 0.3);
  const Vec3 unit(1e-3, 4e-4, -2e-4);  // as of an orthotropic material at an angle
  const LinearField temperature{0.7, -0.3, 0.5};
  for (int order : {2, 5})
    for (const Ring& ring : {corner_270(1, order), polygon_ring({{-1, -1}, {2, 0}, {0.3, 1}}, 2, order)})
      expect_exact(ring, D, unit, temperature, quadratic_field(), 1e-11);
}

// A uniform change of temperature that nothing hinders makes no stress.
TEST(InteriorLoads, FreeExpansionIsWithoutStress) {
  const Ring ring = cracked_plate(2, 3);
  LinearField2 expansion;
  expansion.gradient << 2e-3, 0, 0, 2e-3;
  expansion.second.setZero();
  const Mat3 D = elasticity(10.0, 0.3);
  const auto loads = thermal_loads(ring, D, {Vec3(1e-3, 1e-3, 0)}, {2.0}, 1.0);
  const auto solution = solve_super_element(ring, D, 1.0);
  const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return expansion.displacement(x); });
  const Vector h = equivalent_load(solution, loads);
  EXPECT_LT(largest(solution.K * u - h) / largest(h), 1e-12);
}

// A quadratic traction on both faces in balance with itself, and a power that is a whole exponent: the nodal forces do
// not depend on how the load is divided into powers near the resonance.
TEST(InteriorLoads, PowersNearAnExponentGoOverIntoIt) {
  const Ring ring = corner_270(2, 4);
  const Mat3 D = elasticity(1.0, 0.25);
  const auto solution = solve_super_element(ring, D, 1.0);
  const auto modal = modal_solution(solution);
  const Vector u = Vector::LinSpaced(solution.K.rows(), -1.0, 1.0);
  const auto at_power = [&](double power) {
    const std::vector<RadialLoad> loads{face_load(ring, Face::last, power, {0.3, -0.2}, 1.0)};
    return RadialField(solution, modal, u + equivalent_load(solution, loads), loads).at(0.4).u_xi.eval();
  };
  const double lambda = modal.exponents[2].real();  // load power j = lambda exactly
  const Vector resonant = at_power(lambda - 1.0);
  for (double off : {1e-6, 1e-9, -1e-9})
    EXPECT_LT(largest(at_power(lambda - 1.0 + off) - resonant) / largest(resonant), 10 * std::abs(off) + 1e-11);
}

/// The field of every boundary node of an unbounded domain around a hole.
struct KirschHole {  // under internal pressure 1, plane: u_r = (1 + nu) / E * a^2 / r, sigma_r = -sigma_t = -a^2 / r^2
  double young = 3.0, poisson = 0.2;
  Vec2 displacement(const Vec2& x) const { return (1 + poisson) / young * x / x.squaredNorm(); }
  Vec3 stress(const Vec2& x) const {
    const double r2 = x.squaredNorm(), c = (x.x() * x.x() - x.y() * x.y()) / r2, s = 2 * x.x() * x.y() / r2;
    return Vec3(-c, c, -s) / r2;
  }
};

double error_of_hole(int divisions, int order) {
  const Ring ring = polygon_ring(rectangle(2.0, 2.0), divisions, order);  // not a circle: nothing is built in
  const KirschHole exact;
  const Mat3 D = elasticity(exact.young, exact.poisson);
  const auto solution = solve_super_element(ring, D, 0.7, 1, {true, 100.0});
  const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return exact.displacement(x); });
  const Vector f = system::traction_forces(ring.elements, ring.nodes, 0.7, [&](const Vec2& x, const Vec2& n) {
    return Vec2(-test::traction_of(exact.stress(x), n));  // the body lies outside: its normal points inwards
  });
  const auto modal = modal_solution(solution);
  const RadialField field(solution, modal, test::solve_cholesky(solution.K, f));
  double worst = largest(test::solve_cholesky(solution.K, f) - u) / largest(u);
  for (double xi : {1.0, 3.0, 40.0}) {
    const Vec2 x = xi * boundary_position(ring, 1, 0.4);
    const PointValues values = point_values(ring, field.at(xi), D, 1, 0.4);
    worst = std::max(worst, largest(values.stress - exact.stress(x)) / largest(exact.stress(x)) * 0.1);
  }
  return worst;
}

// On a side of the square the field has poles at the distance of the centre: polynomials on half a side converge like
// 4.6^-p, a factor 21 for two orders.
TEST(UnboundedSuperElement, SquareHoleUnderExactTractionsConverges) {
  double before = 1.0;
  for (int order : {2, 4, 6, 8, 10}) {
    const double error = error_of_hole(2, order);
    EXPECT_LT(error, before / 4.6) << "order " << order;
    before = error;
  }
  EXPECT_LT(before, 1e-6);
}

// Loads out of balance (Kelvin's point force; on a half-plane, Flamant's): stress and relative displacement are those
// of the closed form, whatever the distance at which displacement is held.
TEST(UnboundedSuperElement, ForceOnAHalfPlaneIsFlamants) {
  const Ring ring = half_plane(4, 8);
  const double E = 2.0, nu = 0.3;
  const Mat3 D = elasticity(E, nu);
  const Vec2 P(0.4, -1.0);
  // sigma_r = 2 P . r / (pi r^2) times the direction from the load; the force P acts on the half-plane at the origin.
  const auto stress = [&](const Vec2& x) {
    const Vec2 e = x.normalized();
    const double s = -2.0 * P.dot(e) / (pi * x.norm());
    return Vec3(s * e.x() * e.x(), s * e.y() * e.y(), s * e.x() * e.y());
  };
  const Vector f = system::traction_forces(ring.elements, ring.nodes, 1.0, [&](const Vec2& x, const Vec2& n) {
    return Vec2(-test::traction_of(stress(x), n));
  });
  std::vector<Vec2> relative;
  for (double far : {50.0, 5000.0}) {
    const auto solution = solve_super_element(ring, D, 1.0, 1, {true, far});
    EXPECT_LT(largest(solution.K - solution.K.transpose()), 1e-14 * largest(solution.K));
    const Vector u = test::solve_cholesky(solution.K, f);
    const auto modal = modal_solution(solution);
    const RadialField field(solution, modal, u);
    for (double xi : {1.0, 2.0, 100.0}) {
      const Vec2 x = xi * boundary_position(ring, 3, -0.2);
      const PointValues values = point_values(ring, field.at(xi), D, 3, -0.2);
      EXPECT_LT(largest(values.stress - stress(x)) / largest(stress(x)), 1e-5) << "xi = " << xi;
    }
    // Flamant: depression of the surface between r and 10 r differs by 2 |P_n| ln 10 / (pi E).
    const auto at = [&](double xi) { return point_values(ring, field.at(xi), D, 0, -1.0).displacement; };
    const Vec2 difference = at(1.0) - at(10.0);
    EXPECT_NEAR(difference.y(), 2.0 * P.y() / (pi * E) * std::log(10.0), 1e-6);
    relative.push_back(difference);
  }
  EXPECT_LT(largest(relative[0] - relative[1]), 1e-10);
}

// Bimaterial strip under tension across its interface, layer by layer uniform: exact with a material in each sector.
TEST(Sectors, LayersUnderUniformStressAreExact) {
  const Ring ring = polygon_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 0}, {1, 1}, {-1, 1}}, 1, 2);
  const double stiff = 1e6, soft = 1.0;
  std::vector<Mat3> D(6, elasticity(soft, 0.0));
  for (int e : {0, 1, 2}) D[static_cast<std::size_t>(e)] = elasticity(stiff, 0.0);
  const auto displacement = [&](const Vec2& x) { return Vec2(0.0, x.y() / (x.y() < 0 ? stiff : soft)); };
  const auto solution = solve_super_element(ring, D, 1.0);
  const Vector u = at_nodes(ring.nodes, displacement);
  const auto modal = modal_solution(solution);
  const RadialField field(solution, modal, u);
  for (int e = 0; e < 6; ++e) {
    const PointValues values = point_values(ring, field.at(0.5), D, e, 0.4);
    EXPECT_LT(largest(values.stress - Vec3(0, 1, 0)), 1e-8);  // rounding times the ratio of the stiffnesses
  }
}

}  // namespace
}  // namespace scabo::element
