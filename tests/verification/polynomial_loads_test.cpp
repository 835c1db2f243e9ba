// Polynomial fields under side-face tractions, body forces and temperature, from a model file to points inside: exact
// to rounding.
//
// u is a cubic in x and y. Its nodes on the boundary are held there, one support each; body force, temperature and the
// tractions on the faces of a crack come from it by hand, and what is looked at is inside: displacement and stress.
#include <fmt/format.h>

#include <Eigen/Dense>

#include "run.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/result/point_tables.hpp"

namespace scabo::verification {
namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// u = sum of a_ij x^i y^j, i + j <= 3.
struct Cubic {
  std::array<std::array<Vec2, 4>, 4> a{};
  Cubic() {
    for (auto& row : a) row.fill(Vec2::Zero());
    double value = 0.7;
    for (std::size_t i = 0; i <= 3; ++i)
      for (std::size_t j = 0; i + j <= 3; ++j) {
        value = std::fmod(value * 7.3 + 0.31, 1.0);
        a[i][j] = 1e-3 * Vec2(value - 0.5, 0.4 - std::fmod(value * 3.1, 1.0));
      }
  }
  /// Derivative, m times by x and n times by y.
  Vec2 at(const Vec2& x, int m, int n) const {
    const auto factor = [](int power, int times, double at) {
      double f = 1.0;
      for (int k = 0; k < times; ++k) f *= power - k;
      return power < times ? 0.0 : f * std::pow(at, power - times);
    };
    Vec2 sum = Vec2::Zero();
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; i + j <= 3; ++j)
        sum += factor(i, m, x.x()) * factor(j, n, x.y()) * a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return sum;
  }
  /// Strain, differentiated m times by x and n times by y.
  Vec3 strain(const Vec2& x, int m = 0, int n = 0) const {
    const Vec2 by_x = at(x, m + 1, n), by_y = at(x, m, n + 1);
    return {by_x.x(), by_y.y(), by_x.y() + by_y.x()};
  }
};

struct Material {
  const char* name;
  std::string plane, text;
  Mat3 D;  // stress = D (strain - unit T)
  Vec3 unit;
};

Mat3 isotropic_strain(double E, double nu) {
  Mat3 D;
  D << 1 - nu, nu, 0, nu, 1 - nu, 0, 0, 0, 0.5 - nu;
  return E / ((1 + nu) * (1 - 2 * nu)) * D;
}

/// Plane stress of E1, E2, nu12, G12, turned by `angle`: strain = T' S T stress with T of the angle.
Mat3 turned_compliance(double E1, double E2, double nu12, double G12, double angle) {
  Mat3 S;
  S << 1 / E1, -nu12 / E1, 0, -nu12 / E1, 1 / E2, 0, 0, 0, 1 / G12;
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 T;  // stress along the axes from that in x and y
  T << c * c, s * s, 2 * c * s, s * s, c * c, -2 * c * s, -c * s, c * s, c * c - s * s;
  return T.transpose() * S * T;
}

std::vector<Material> materials() {
  Mat3 general;
  general << 12, 3, 1.5, 3, 9, -0.8, 1.5, -0.8, 4;
  const double turn = 30 * 3.14159265358979323846 / 180, c = std::cos(turn), s = std::sin(turn);
  return {
      {"isotropic", "strain", "{young: 10, poisson: 0.3, expansion: 1e-3}", isotropic_strain(10, 0.3),
       1.3e-3 * Vec3(1, 1, 0)},
      {"nearly incompressible", "strain", "{young: 10, poisson: 0.4999, expansion: 1e-3}", isotropic_strain(10, 0.4999),
       1.4999e-3 * Vec3(1, 1, 0)},
      {"orthotropic", "stress",
       "{orthotropic: {E1: 14, E2: 4, nu12: 0.25, G12: 3, angle: 30}, expansion: [5e-4, 3e-3]}",
       turned_compliance(14, 4, 0.25, 3, turn).inverse(),
       Vec3(5e-4 * c * c + 3e-3 * s * s, 5e-4 * s * s + 3e-3 * c * c, 2 * c * s * (5e-4 - 3e-3))},
      {"anisotropic", "stress",
       "{anisotropic: {D11: 12, D12: 3, D22: 9, D16: 1.5, D26: -0.8, D66: 4}, expansion: [1e-3, 2e-3, -5e-4]}", general,
       Vec3(1e-3, 2e-3, -5e-4)},
  };
}

/// Largest errors at points inside, relative to the largest boundary displacement and the largest stress.
struct Errors {
  double displacement = 0.0, stress = 0.0;
};

Errors errors(const Material& material, bool cracked) {
  const Cubic u;
  const Vec2 tip(0.9, 1.1), mouth(0.0, 0.8);
  const double T0 = 0.4, Tx = -0.3, Ty = 0.5;
  const auto stress = [&](const Vec2& x) {
    return Vec3(material.D * (u.strain(x) - material.unit * (T0 + Tx * x.x() + Ty * x.y())));
  };
  // b = -div stress: constant + x + y.
  const auto force = [&](const Vec2& x) {
    const Vec3 by_x = material.D * (u.strain(x, 1, 0) - material.unit * Tx),
               by_y = material.D * (u.strain(x, 0, 1) - material.unit * Ty);
    return Vec2(-by_x[0] - by_y[2], -by_x[2] - by_y[1]);
  };
  const Vec2 b0 = force({0, 0}), bx = force({1, 0}) - b0, by = force({0, 1}) - b0;
  const auto vector = [](const Vec2& x) { return fmt::format("[{}, {}]", x.x(), x.y()); };
  const auto text = [&](const std::string& supports) {
    std::string model = fmt::format(
        R"(
scabo: 1
analysis: {{plane: {}, thickness: 0.3}}
materials: {{stuff: {}}}
bodies:
  plate:
    material: stuff
    shape: {{polygon: {{vertices: [[0, 0], [2, 0.2], [2.3, 1.8], [0, 2]]}}}}
    mesh: {{size: 1.2, order: 3}}
    {}
supports:
{}loads:
  inside: {{on: plate, body_force: {{constant: {}, x: {}, y: {}}}}}
  warm: {{on: plate, temperature: {{constant: {}, x: {}, y: {}}}}}
)",
        material.plane, material.text,
        cracked ? fmt::format("cracks: [{{tip: {}, mouth: {}, name: flaw}}]", vector(tip), vector(mouth)) : "",
        supports, vector(b0), vector(bx), vector(by), T0, Tx, Ty);
    if (!cracked) return model;
    const Vec2 along = (tip - mouth).normalized();
    for (const std::string side : {"left", "right"}) {
      // Outward from the part left of the crack; from the other the opposite.
      const Vec2 n = side == "left" ? Vec2(along.y(), -along.x()) : Vec2(-along.y(), along.x());
      // A quadratic in xi through three points.
      const auto t = [&](double xi) {
        const Vec3 s = stress(tip + xi * (mouth - tip));
        return Vec2(s[0] * n.x() + s[2] * n.y(), s[2] * n.x() + s[1] * n.y());
      };
      const Vec2 c0 = t(0), c2 = 2 * (t(1) + t(0) - 2 * t(0.5)), c1 = t(1) - c0 - c2;
      model += fmt::format("  {}: {{on: plate.flaw.{}, traction: {{powers: {{0: {}, 1: {}, 2: {}}}}}}}\n", side, side,
                           vector(c0), vector(c1), vector(c2));
    }
    return model;
  };
  const std::string simple = "  - {on: plate.edge_1, fix: [x, y]}\n";
  const model::Model first = input::parse_model(text(simple), "test.yaml");
  std::string supports;
  const auto support = [&](const std::string& place, const Vec2& x) {
    const Vec2 value = u.at(x, 0, 0);
    supports += fmt::format("  - {{on: {}, displacement: [{}, {}]}}\n", place, value.x(), value.y());
  };
  double largest = 0.0;
  const mesh::Mesh mesh = mesh::make_mesh(first);
  for (const Vec2& x : mesh.bodies[0].nodes) {
    largest = std::max(largest, u.at(x, 0, 0).norm());
    if (!cracked || (x - mouth).norm() > 1e-9) support(fmt::format("{{body: plate, near: [{}, {}]}}", x.x(), x.y()), x);
  }
  if (cracked)
    for (const char* side : {"plate.flaw.mouth_left", "plate.flaw.mouth_right"}) support(side, mouth);
  const analysis::StaticSolution solution = run(text(supports));
  std::vector<mesh::OutputPoint> points;
  for (const Vec2& x : {Vec2(0.3, 0.3), Vec2(1.5, 0.6), Vec2(1.0, 1.6), Vec2(0.2, 1.3), Vec2(0.5, 0.8), Vec2(2.0, 1.2)})
    points.push_back({"p", 0, x, 0.0});
  const result::PointEvaluation evaluation(solution, points, 1);
  const auto values = evaluation.at(solution, last(solution));
  Errors errors;
  const double scale = stress({2.3, 1.8}).norm();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& x = points[i].at;
    errors.displacement =
        std::max(errors.displacement, (values[i].values.displacement - u.at(x, 0, 0)).norm() / largest);
    errors.stress = std::max(errors.stress, (values[i].values.stress - stress(x)).norm() / scale);
  }
  return errors;
}

TEST(PolynomialLoads, FromAModelFileAreExactInside) {
  for (const Material& material : materials())
    for (const bool cracked : {false, true}) {
      const Errors found = errors(material, cracked);
      std::cout << material.name << (cracked ? ", cracked" : "") << ": displacement " << found.displacement
                << ", stress " << found.stress << "\n";
      EXPECT_LT(found.displacement, 1e-11) << material.name << cracked;
      EXPECT_LT(found.stress, 1e-9) << material.name << cracked;
    }
}

}  // namespace
}  // namespace scabo::verification
