// Initial and far-field stress: ground at rest, with joints and cracks; a body that is released; Kirsch's hole in an
// unbounded plate; holes and cracks against the same under tractions; a tunnel against gravity.
#include <fmt/format.h>

#include <numbers>

#include "run.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/result/recovery.hpp"

namespace scabo::verification {
namespace {

element::PointValues values_at(const analysis::StaticSolution& solution, const Vec2& x, int body = 0) {
  const auto values = result::value_at(solution, last(solution).fields, body, x);
  if (!values) throw std::runtime_error("the point lies in no body");
  return *values;
}

double largest_displacement(const analysis::StaticSolution& solution) {
  double largest = 0.0;
  for (const Vector& u : last(solution).fields.displacements) largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  return largest;
}

constexpr double young_of_soil = 50e6, weight_of_soil = 20e3, horizontal = 0.6, surcharge = 7e3;

/// Stress of the ground below y = 0.
element::Vec3 at_rest(double y) {
  const double vertical = -(surcharge - weight_of_soil * y);
  return {horizontal * vertical, vertical, 0.0};
}

/// 6 x 4 m of ground on rollers, its surface under its surcharge. `bodies`: text after `bodies:`; `more`: other
/// sections.
analysis::StaticSolution ground(const std::string& bodies, const std::string& supports, const std::string& top,
                                const std::string& more = {}, const std::string& loads = {}) {
  return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain, thickness: 0.7}}
materials: {{soil: {{young: {}, poisson: 0.3}}}}
bodies:
{}
supports: [{}]
loads:
  insitu: {{field: {{vertical: {{unit_weight: {}, surface: 0, surcharge: {}}}, K0: {}}}}}
  surcharge: {{on: {}, pressure: {}}}
{}
{}
)",
                         young_of_soil, bodies, supports, weight_of_soil, surcharge, horizontal, top, surcharge, loads,
                         more));
}

TEST(InitialStress, OfGroundOnRollersLeavesItAtRest) {
  for (const char* mesh : {"size: 1, order: 3", "size: 1, order: 1", "kind: fem, size: 0.7",
                           "kind: polygons, size: 0.8", "kind: quadtree, size: 1, order: 4"}) {
    const auto solution = ground(
        fmt::format("  soil: {{material: soil, shape: {{rectangle: {{corner: [0, -4], size: [6, 4]}}}}, mesh: {{{}}}}}",
                    mesh),
        "{on: soil.bottom, fix: normal}, {on: soil.left, fix: normal}, {on: soil.right, fix: normal}", "soil.top");
    EXPECT_LT(largest_displacement(solution), 1e-12 * weight_of_soil * 4.0 / young_of_soil * 4.0) << mesh;
    for (const Vec2& x : {Vec2(2.3, -0.4), Vec2(5.1, -3.2)})
      EXPECT_LT((values_at(solution, x).stress - at_rest(x.y())).norm(), 1e-11 * weight_of_soil * 4.0) << mesh;
    const double sum = 0.7 * (4.0 * surcharge + 8.0 * weight_of_soil);  // of the vertical stress along a side
    EXPECT_LT((last(solution).reactions[0] - Vec2(0.0, 0.7 * 6.0 * (surcharge + 4.0 * weight_of_soil))).norm(),
              1e-11 * sum);
    EXPECT_LT((last(solution).reactions[1] - Vec2(horizontal * sum, 0.0)).norm(), 1e-11 * sum);
    EXPECT_LT(std::abs(last(solution).energy.elastic), 1e-12 * sum * weight_of_soil / young_of_soil);
  }
}

// Two layers and a block beside them: the contacts carry what the field has there.
TEST(InitialStress, IsCarriedByContactsAtRest) {
  const auto solution = ground(R"(
  lower: {material: soil, shape: {rectangle: {corner: [0, -4], size: [4, 2]}}, mesh: {size: 0.5}}
  upper:
    material: soil
    shape: {rectangle: {corner: [0, -2], size: [4, 2]}}
    mesh: {kind: polygons, size: 0.4}
  beside: {material: soil, shape: {rectangle: {corner: [4, -4], size: [2, 4]}}, mesh: {kind: fem, size: 0.4}})",
                               "{on: lower.bottom, fix: y}, {on: lower.left, fix: x}, {on: upper.left, fix: x}, "
                               "{on: beside.bottom, fix: y}, {on: beside.right, fix: x}",
                               "upper.top",
                               R"(contacts:
  bed: {between: [lower.top, upper.bottom], friction: 0.1}
  low: {between: [lower.right, beside.left], friction: 0}
  high: {between: [upper.right, beside.left], friction: 0})",
                               fmt::format("  more: {{on: beside.top, pressure: {}}}", surcharge));
  EXPECT_LT(largest_displacement(solution), 1e-9 * weight_of_soil * 4.0 / young_of_soil * 4.0);
  const auto& contacts = last(solution).contacts;
  EXPECT_NEAR(contacts[0].normal_force, 0.7 * 4.0 * (surcharge + 2.0 * weight_of_soil), 1e-8 * weight_of_soil);
  // The node where the layers meet has a pair with each of them, which share its force.
  EXPECT_NEAR(contacts[1].normal_force + contacts[2].normal_force,
              0.7 * horizontal * (4.0 * surcharge + 8.0 * weight_of_soil), 1e-8 * weight_of_soil);
  for (const auto& contact : contacts) EXPECT_EQ(contact.open + contact.slip * (contact.tangential_force != 0.0), 0);
}

// A crack at 45 degrees carries shear besides, (1 - K0) / (1 + K0) = 0.25 of the pressure, which friction holds. The
// tip's cell has no pairs on its faces, so that the ground is at rest but for what is released in this small cell.
TEST(InitialStress, IsCarriedByAClosedCrackAtRest) {
  const auto solution =
      ground(R"(
  soil:
    material: soil
    shape: {rectangle: {corner: [0, -4], size: [6, 4]}}
    mesh: {kind: polygons, size: 0.8}
    cracks: [{name: flaw, path: [[2, -3], [4, -1]]}])",
             "{on: soil.bottom, fix: y}, {on: soil.left, fix: x}, {on: soil.right, fix: x}", "soil.top",
             "contacts: {flaw: {between: [soil.flaw.right, soil.flaw.left], friction: 0.3}}");
  EXPECT_LT(largest_displacement(solution), 1e-4 * weight_of_soil * 4.0 / young_of_soil * 4.0);
  double normal = 0.0, tangential = 0.0;
  for (const analysis::PairResult& pair : contact_of(last(solution)).pairs)
    normal += pair.normal_force, tangential += pair.tangential_force;
  // Over the length of the crack (1 + K0) / 2 of the vertical stress.
  EXPECT_NEAR(normal, 0.7 * std::sqrt(8.0) * 0.8 * (surcharge + 2.0 * weight_of_soil), 1e-3 * normal);
  EXPECT_NEAR(std::abs(tangential), 0.25 * normal, 1e-3 * normal);
}

// Nothing holds the stress: it is released, by the strain -D^-1 sigma0, and none is left.
TEST(InitialStress, IsReleasedWhereNothingHoldsIt) {
  for (const char* mesh : {"size: 0.5, order: 3", "kind: polygons, size: 0.3"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{rock: {{young: 10e9, poisson: 0.25}}}}
bodies:
  block:
    material: rock
    shape: {{rectangle: {{corner: [1, 1], size: [2, 1]}}}}
    mesh: {{{}}}
supports: [{{on: block.bottom_left, fix: [x, y]}}, {{on: block.bottom_right, fix: y}}]
loads: {{insitu: {{field: {{stress: [-4e6, -8e6, 1e6]}}}}}}
)",
                                          mesh));
    const element::PointValues values = values_at(solution, {2.2, 1.4});
    EXPECT_LT(values.stress.norm(), 1e-9 * 8e6) << mesh;
    const element::Vec3 strain((4e6 - 0.25 * 8e6) / 10e9, (8e6 - 0.25 * 4e6) / 10e9, -1e6 * 2.5 / 10e9);
    EXPECT_LT((values.strain - strain).norm(), 1e-10 * strain.norm()) << mesh;
    EXPECT_NEAR(last(solution).energy.external, last(solution).energy.elastic, 1e-10 * last(solution).energy.elastic);
  }
}

// Kirsch: three times the tension at the crown of the hole, and his stress anywhere; biaxial and shear by
// superposition.
TEST(InitialStress, FarFromAHoleIsKirschsByOneLine) {
  for (const element::Vec3& far : {element::Vec3(1.0, 0.0, 0.0), element::Vec3(-0.6, -1.3, 0.4)}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{steel: {{young: 200, poisson: 0.3}}}}
bodies: {{plate: {{material: steel, outside: true, shape: {{circle: {{centre: [3, -1], radius: 2}}}}, mesh: {{size: 0.5, order: 8}}}}}}
loads: {{far: {{on: plate, field: {{stress: [{}, {}, {}]}}}}}}
)",
                                          far[0], far[1], far[2]));
    for (const double r : {2.0, 2.6, 5.0, 40.0})
      for (const double theta : {0.2, 1.1, std::numbers::pi / 2.0, 4.0}) {
        const double a2 = 4.0 / (r * r), a4 = a2 * a2, mean = 0.5 * (far[0] + far[1]), half = 0.5 * (far[0] - far[1]);
        const double c2 = std::cos(2.0 * theta), s2 = std::sin(2.0 * theta);
        const double direct = half * c2 + far[2] * s2, across = -half * s2 + far[2] * c2;
        const double rr = mean * (1.0 - a2) + direct * (1.0 - 4.0 * a2 + 3.0 * a4),
                     tt = mean * (1.0 + a2) - direct * (1.0 + 3.0 * a4), rt = across * (1.0 + 2.0 * a2 - 3.0 * a4);
        const double c = std::cos(theta), s = std::sin(theta);
        const element::Vec3 exact(c * c * rr + s * s * tt - 2.0 * s * c * rt,
                                  s * s * rr + c * c * tt + 2.0 * s * c * rt, s * c * (rr - tt) + (c * c - s * s) * rt);
        const Vec2 x = Vec2(3.0, -1.0) + r * (1.0 + 1e-12) * Vec2(c, s);
        EXPECT_LT((values_at(solution, x).stress - exact).norm(), 1e-6) << r << ", " << theta;
      }
  }
}

// A plate with a hole and a crack whose outer edges carry the tractions of its field: the stresses are those of the
// plate under these tractions alone, and so are the stress intensity factors.
TEST(InitialStress, WithItsTractionsIsThatOfTractionsAlone) {
  const auto plate = [](const std::string& body, const std::string& field) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e3, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [4, 4]}}}}
    {}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: y}}]
loads:
  top: {{on: plate.top, traction: [20, 100]}}
  bottom: {{on: plate.bottom, traction: [-20, -100]}}
  right: {{on: plate.right, traction: [40, 20]}}
  left: {{on: plate.left, traction: [-40, -20]}}
  {}
)",
                           body, field));
  };
  for (const char* body :
       {"mesh: {kind: polygons, size: 0.4, order: 3}\n    holes: {bore: {circle: {centre: [3, 3], radius: 0.5}}}\n    "
        "cracks: [{name: flaw, path: [[1, 1], [2, 1.3]]}]",
        "mesh: {size: 0.4, order: 6}\n    cracks: [{tip: [2, 2.1], mouth: [0, 2], name: flaw}]",
        "mesh: {kind: fem, size: 0.4}\n    holes: {bore: {circle: {centre: [3, 3], radius: 0.5}}}"}) {
    const auto with = plate(body, "insitu: {field: {stress: [40, 100, 20]}}"), without = plate(body, "");
    for (const Vec2& x : {Vec2(3.0, 2.45), Vec2(0.7, 3.1), Vec2(2.1, 1.3)})
      EXPECT_LT((values_at(with, x).stress - values_at(without, x).stress).norm(), 1e-8 * 100.0) << body;
    ASSERT_EQ(last(with).cracks.size(), last(without).cracks.size());
    for (std::size_t i = 0; i < last(with).cracks.size(); ++i) {
      EXPECT_NEAR(last(with).cracks[i].factors.K_I, last(without).cracks[i].factors.K_I, 1e-7 * 200.0) << body;
      EXPECT_NEAR(last(with).cracks[i].factors.K_II, last(without).cracks[i].factors.K_II, 1e-7 * 200.0) << body;
      EXPECT_FALSE(last(with).cracks[i].factors.T_left);
    }
  }
}

// The stress of ground grows along the faces of a slit in it: what they release is a pull K0 g (4 - y) along their
// normals, 12.5 (1.9 + 2.1 xi) from the tip to the mouth.
TEST(InitialStress, ThatGrowsIsReleasedByTheFacesOfASlit) {
  const auto plate = [](const char* loads) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: 200e3, poisson: 0.3}}}}
bodies:
  plate:
    material: soil
    shape: {{rectangle: {{corner: [0, 0], size: [4, 4]}}}}
    mesh: {{size: 0.4, order: 6}}
    cracks: [{{tip: [2, 2.1], mouth: [2, 0], name: flaw}}]
supports: [{{on: plate.top, fix: [x, y]}}, {{on: plate.left, fix: [x, y]}}, {{on: plate.right, fix: [x, y]}}]
loads:
{}
)",
                           loads));
  };
  const auto released = plate(
      "  insitu: {field: {vertical: {unit_weight: 25, surface: 4}, K0: 0.5}}\n"
      "  below: {on: plate.bottom, pressure: 100}\n");
  const auto pulled = plate(
      "  left: {on: plate.flaw.left, pressure: {powers: {0: -23.75, 1: -26.25}}}\n"
      "  right: {on: plate.flaw.right, pressure: {powers: {0: -23.75, 1: -26.25}}}\n");
  const Vector &of_released = last(released).fields.displacements[0], &of_pulled = last(pulled).fields.displacements[0];
  EXPECT_LT((of_released - of_pulled).norm(), 1e-8 * of_pulled.norm());
  const double K_I = last(pulled).cracks.at(0).factors.K_I;
  EXPECT_LT(K_I, -10.0);
  EXPECT_NEAR(last(released).cracks.at(0).factors.K_I, K_I, 1e-7 * std::abs(K_I));
}

// Gravity between rollers makes K0 = nu / (1 - nu): ground with a tunnel has the same stress by gravity as by the
// field.
TEST(InitialStress, WithATunnelIsThatOfGravityBetweenRollers) {
  const double nu = 0.25;
  const auto tunnel = [&](const std::string& load) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: 50e6, poisson: {}, density: 2000}}}}
bodies:
  soil:
    material: soil
    shape: {{rectangle: {{corner: [0, -12], size: [16, 12]}}}}
    holes: {{tunnel: {{circle: {{centre: [8, -5], radius: 2}}}}}}
    mesh: {{kind: polygons, size: 1, order: 4}}
supports: [{{on: soil.bottom, fix: normal}}, {{on: soil.left, fix: normal}}, {{on: soil.right, fix: normal}}]
loads: {{load: {}}}
)",
                           nu, load));
  };
  const auto by_field =
      tunnel(fmt::format("{{field: {{vertical: {{unit_weight: 20e3, surface: 0}}, K0: {:.17g}}}}}", nu / (1 - nu)));
  const auto by_gravity = tunnel("{gravity: [0, -10]}");
  const double stress = 20e3 * 12.0;
  // Cells with curved sides do not have the quadratic displacement of gravity exactly: 1.5e-7 with order 4.
  for (const Vec2& x : {Vec2(8, -2.9), Vec2(5.9, -5), Vec2(3, -10), Vec2(10, -3)})
    EXPECT_LT((values_at(by_field, x).stress - values_at(by_gravity, x).stress).norm(), 1e-6 * stress) << x.transpose();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((last(by_field).reactions[i] - last(by_gravity).reactions[i]).norm(), 1e-8 * stress * 12.0);
  // Gravity moves the ground without a tunnel by u_y = -gamma (1 + nu) (1 - 2 nu) / (1 - nu) / E (H^2 - y^2) / 2.
  const double before = -20e3 * (1 + nu) * (1 - 2 * nu) / (1 - nu) / 50e6 * 0.5 * (144.0 - 9.0);
  EXPECT_NEAR(values_at(by_gravity, {8, -3}).displacement.y() - values_at(by_field, {8, -3}).displacement.y(), before,
              1e-8 * std::abs(before));
}

// Twins in mm and turned: `up` turns with the ground.
TEST(InitialStress, OfTwinsInOtherUnitsAndTurnedGivesTheSame) {
  const auto pit = [](double angle, double l) {
    const auto at = [&](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", l * (std::cos(angle) * x - std::sin(angle) * y),
                         l * (std::sin(angle) * x + std::cos(angle) * y));
    };
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain, thickness: {0}}}
materials: {{soil: {{young: {1:.17g}, poisson: 0.3}}}}
bodies:
  soil:
    material: soil
    shape: {{polygon: {{vertices: [{2}, {3}, {4}, {5}, {6}, {7}]}}}}
    mesh: {{size: {8}, order: 4, centre: {12}}}
supports: [{{on: soil.edge_1, fix: normal}}, {{on: soil.edge_2, fix: normal}}, {{on: soil.edge_6, fix: normal}}]
loads: {{insitu: {{field: {{vertical: {{unit_weight: {9:.17g}, surface: 0, up: [{10:.17g}, {11:.17g}]}}, K0: 0.5}}}}}}
)",
                           l, 50e6 / (l * l), at(0, -6), at(10, -6), at(10, 0), at(6, 0), at(6, -3), at(0, -3), 0.8 * l,
                           20e3 / (l * l * l), -3.0 * std::sin(angle), 3.0 * std::cos(angle), at(7.5, -4)));
  };
  const auto first = pit(0.0, 1.0);
  const Vector& u = last(first).fields.displacements[0];
  EXPECT_GT(u.lpNorm<Eigen::Infinity>(), 1e-4);
  for (const auto& [angle, l] :
       {std::pair(0.0, 1e3), std::pair(0.0, 1e-3), std::pair(0.7, 1.0), std::pair(-2.0, 1e3)}) {
    const auto twin = pit(angle, l);
    const Vector& v = last(twin).fields.displacements[0];
    Mat2 turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (Eigen::Index i = 0; i < u.size(); i += 2)
      EXPECT_LT((v.segment<2>(i) / l - turn * u.segment<2>(i)).norm(), 1e-9 * u.lpNorm<Eigen::Infinity>());
  }
}

// A step that lowers the pressure in the tunnel: in balance with the field at the start, the ground moves as it falls.
TEST(InitialStress, HoldsTheGroundUntilASupportIsTakenAway) {
  const auto solution = run(R"(
scabo: 1
analysis: {plane: strain}
materials: {rock: {young: 1e9, poisson: 0.25}}
bodies: {rock: {material: rock, outside: true, shape: {circle: {centre: [0, 0], radius: 2}}, mesh: {size: 0.5, order: 6}}}
loads:
  far: {on: rock, field: {stress: [-2e6, -2e6, 0]}}
  lining: {on: rock.rim, pressure: 2e6}
steps:
  - {name: rest, loads: {far: 1, lining: 1}}
  - {name: unload, loads: {lining: 0}}
)");
  ASSERT_EQ(solution.increments.size(), 2u);
  const Vector &rest = increment_at(solution, 0).fields.displacements[0], &u = last(solution).fields.displacements[0];
  const double closure = 2e6 * 2.0 * 1.25 / 1e9;  // p R / 2 G
  EXPECT_LT(rest.lpNorm<Eigen::Infinity>(), 1e-9 * closure);
  const auto& nodes = solution.mesh.bodies[0].nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((u.segment<2>(static_cast<Eigen::Index>(2 * i)) + closure / 2.0 * nodes[i]).norm(), 1e-7 * closure);
}

// Out of the plane: as given, by the law of the material, or K0 times the vertical stress; in tables and in pictures,
// of one super-element, of many equal cells (whose fields are a map) and of finite elements.
TEST(InitialStress, HasItsStressOutOfThePlane) {
  struct Case {
    const char* field;
    double xx, yy, zz;
  };
  for (const char* mesh : {"size: 1", "kind: quadtree, size: 0.2", "kind: fem, size: 0.5", "kind: polygons, size: 0.5"})
    for (const Case& of : {Case{"{stress: [-3e6, -8e6, 0]}", -3e6, -8e6, 0.2 * -11e6},
                           Case{"{stress: [-3e6, -8e6, 0], szz: -5e6}", -3e6, -8e6, -5e6},
                           Case{"{vertical: {unit_weight: 20e3, surface: 10}, K0: 0.5}", -80e3, -160e3, -80e3}}) {
      const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{rock: {{young: 10e9, poisson: 0.2}}}}
bodies: {{rock: {{material: rock, shape: {{rectangle: {{corner: [0, 0], size: [6, 4]}}}}, mesh: {{{}}}}}}}
supports: [{{on: rock.bottom, fix: [x, y]}}, {{on: rock.left, fix: [x, y]}}, {{on: rock.right, fix: [x, y]}}, {{on: rock.top, fix: [x, y]}}]
loads: {{insitu: {{field: {}}}}}
)",
                                            mesh, of.field));
      const Vec2 x(3.3, 2.0);
      const auto at = result::PointEvaluation(solution, {{"p", 0, x, 0.0}}, 1).at(solution, last(solution)).front();
      EXPECT_LT((at.values.stress - element::Vec3(of.xx, of.yy, 0.0)).norm(), 1e-9 * 8e6) << mesh << of.field;
      EXPECT_NEAR(at.stress_zz, of.zz, 1e-9 * 8e6) << mesh << of.field;
      EXPECT_NEAR(at.energy_density, 0.0, 1e-6);
      const result::Recovery recovery(solution);
      const result::Fields fields = recovery.fields(solution, last(solution).fields);
      for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
        const double part = of.xx == -80e3 ? (10.0 - recovery.grid().points[3 * i + 1]) / 8.0 : 1.0;
        EXPECT_NEAR(fields.stress_yy[i], part * of.yy, 1e-6 * 8e6) << mesh << of.field;
        EXPECT_NEAR(fields.stress_zz[i], part * of.zz, 1e-6 * 8e6) << mesh << of.field;
      }
    }
}

TEST(InitialStress, WithGravityBesidesIsWarnedOf) {
  const auto warnings = [](const char* weight) {
    const auto model = input::parse_model(fmt::format(R"(
scabo: 1
materials: {{soil: {{young: 50e6, poisson: 0.3, density: 2000}}}}
bodies:
  soil: {{material: soil, shape: {{rectangle: {{corner: [0, -4], size: [6, 4]}}}}, mesh: {{size: 1}}}}
  block: {{material: soil, shape: {{rectangle: {{corner: [1, 0], size: [1, 1]}}}}, mesh: {{size: 1}}}}
supports: [{{on: soil.bottom, fix: [x, y]}}, {{on: block.top, fix: x}}]
contacts: {{joint: {{between: [soil.top, block.bottom]}}}}
loads:
  insitu: {{on: soil, field: {{vertical: {{unit_weight: 20e3, surface: 0}}, K0: 0.5}}}}
  weight: {{{}gravity: [0, -10]}}
)",
                                                      weight),
                                          "test.yaml");
    std::string texts;
    for (const Warning& warning : model.warnings) texts += warning.text;
    return texts;
  };
  EXPECT_NE(warnings("").find("gravity 'weight' acts on body 'soil'"), std::string::npos);
  EXPECT_EQ(warnings("on: block, "), "");
}

// A near field tied to the unbounded ground around it: both have the field, and nothing moves; nor is there a
// resultant.
TEST(InitialStress, OfTiedUnboundedGroundLeavesItAtRest) {
  const auto solution = run(R"(
scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  near: {material: steel, shape: {rectangle: {corner: [-4, -4], size: [8, 8]}}, mesh: {kind: polygons, size: 1, order: 3}}
  far: {material: steel, outside: true, shape: {rectangle: {corner: [-4, -4], size: [8, 8]}}, mesh: {size: 1, order: 4}}
ties: {border: {between: [near, far]}}
loads: {far: {field: {stress: [100e6, 20e6, -5e6]}}}
)");
  EXPECT_LT(largest_displacement(solution), 1e-12 * 1e8 / 210e9);
  EXPECT_LT((values_at(solution, {1.2, 2.3}, 0).stress - element::Vec3(100e6, 20e6, -5e6)).norm(), 1e-3);
  EXPECT_LT((values_at(solution, {9.0, 5.0}, 1).stress - element::Vec3(100e6, 20e6, -5e6)).norm(), 1e-3);
  EXPECT_TRUE(solution.warnings.empty());
}

// A trench in a half-plane, whose free surface is that of the field: with the pressures of the ground that was there on
// its walls and bottom it stays at rest.
TEST(InitialStress, OfAHalfPlaneWithATrenchIsReleasedInTheTrench) {
  const auto trench = [](const char* loads) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: 50e6, poisson: 0.3}}}}
bodies:
  ground:
    material: soil
    outside: true
    shape: {{polygon: {{vertices: [[0, 0], [-2, 0], [-2, -3], [2, -3], [2, 0]]}}}}
    mesh: {{size: 0.5, order: 4, centre: [0, 0]}}
    reference: [0, -100]
loads:
  insitu: {{on: ground, field: {{vertical: {{unit_weight: 20e3, surface: 0}}, K0: 0.5}}}}
{}
)",
                           loads));
  };
  const auto open = trench("");
  const double moved = largest_displacement(open);
  EXPECT_GT(moved, 1e-3);
  EXPECT_GT(values_at(open, {0, -3.0001}).displacement.y(), 0.0);  // the bottom rises
  EXPECT_LT((values_at(open, {0, -60}).stress - element::Vec3(-6e5, -1.2e6, 0.0)).norm(), 2e-2 * 1.2e6);
  const auto filled = trench(R"(  wall: {on: ground.edge_2, pressure: {over: y, at: [-3, 0], values: [30e3, 0]}}
  other: {on: ground.edge_4, pressure: {over: y, at: [-3, 0], values: [30e3, 0]}}
  bottom: {on: ground.edge_3, pressure: 60e3}
)");
  EXPECT_LT(largest_displacement(filled), 1e-10 * moved);
}

}  // namespace
}  // namespace scabo::verification
