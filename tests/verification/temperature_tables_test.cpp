// Temperatures that a table gives along a line: strips, bars and slabs against closed forms of thermoelasticity (Boley
// and Weiner, Theory of Thermal Stresses, 1960, chapters 9 and 10) and reciprocity.
//
// E is Young's modulus, a the expansion, T(y) the table, in axes of the body, which may be scaled and turned.
#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "scabo/result/probe.hpp"
#include "scabo/result/recovery.hpp"
#include "verification/history_columns.hpp"

namespace scabo::verification {
namespace {

constexpr double young = 200.0, poisson = 0.3, expansion = 1e-3, thickness = 0.5;

/// A body of its own axes: scaled, turned and moved.
struct Frame {
  double scale = 1.0, angle = 0.0;
  Vec2 origin = Vec2::Zero();

  Vec2 point(double x, double y) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return origin + scale * Vec2(c * x - s * y, s * x + c * y);
  }
  std::string at(double x, double y) const {
    const Vec2 p = point(x, y);
    return fmt::format("[{:.17g}, {:.17g}]", p.x(), p.y());
  }
  std::string direction(double x, double y) const {
    const Vec2 d = (point(x, y) - origin) / scale;
    return fmt::format("[{:.17g}, {:.17g}]", d.x(), d.y());
  }
  /// From the axes of the model to those of the body.
  Eigen::Matrix2d rotation() const {
    Eigen::Matrix2d R;
    R << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    return R;
  }
  Vec2 back(const Vec2& v) const { return rotation() * v; }
  /// Stress [xx, yy, xy] in the axes of the body.
  element::Vec3 back(const element::Vec3& stress) const {
    Eigen::Matrix2d sigma;
    sigma << stress[0], stress[2], stress[2], stress[1];
    const Eigen::Matrix2d turned = rotation() * sigma * rotation().transpose();
    return {turned(0, 0), turned(1, 1), turned(0, 1)};
  }
};

const std::vector<Frame> frames = {{}, {1e-3, 0.7, {2.0, -1.0}}, {1e3, -2.1, {0.0, 0.0}}};

/// T between its points, and its integrals from the first point on.
struct Table {
  std::vector<double> s, T;

  double at(double x) const {
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      if (x <= s[i + 1]) return T[i] + (x - s[i]) / (s[i + 1] - s[i]) * (T[i + 1] - T[i]);
    return T.back();
  }
  /// Integral of T (s - about)^power from `from` to `to`, by Gauss's rule in every piece.
  double integral(double from, double to, int power = 0, double about = 0.0) const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < s.size(); ++i) {
      const double a = std::max(from, s[i]), b = std::min(to, s[i + 1]);
      if (b <= a) continue;
      for (const double g : {-0.57735026918962576, 0.57735026918962576}) {
        const double x = 0.5 * (a + b) + 0.5 * (b - a) * g;
        sum += 0.5 * (b - a) * at(x) * std::pow(x - about, power);
      }
    }
    return sum;
  }
  /// As points along the x axis (0) or the y axis (1) of the body.
  std::string text(const Frame& frame, int axis) const {
    std::string places, values;
    for (std::size_t i = 0; i < s.size(); ++i) {
      places += (i ? ", " : "") + (axis == 0 ? frame.at(s[i], 0.2) : frame.at(-0.3, s[i]));
      values += fmt::format("{}{}", i ? ", " : "", T[i]);
    }
    return fmt::format("{{at: [{}], values: [{}]}}", places, values);
  }
};

/// It bends at quarters, where elements may end, or elsewhere; twice within 1/50 of the height.
const Table quarters{{0.0, 0.25, 0.5, 1.0}, {0.0, 40.0, -10.0, 25.0}},
    anywhere{{-1.0, 0.0, 0.31, 0.33, 0.64, 1.0}, {3.0, 3.0, 40.0, -10.0, 20.0, 5.0}};

enum class Ends { free, held };

/// A strip from (0, 0) to (length, 1) in the axes of the frame.
std::string strip(const std::string& mesh, const Frame& frame, double length, Ends ends, const std::string& plane,
                  const std::string& temperature, const std::string& more = "") {
  const std::string held = fmt::format(
      "{{on: strip.edge_2, fix: normal, name: right}}, {{on: strip.edge_4, fix: normal, name: left}}, "
      "{{on: strip.vertex_1, fix: {{along: {}}}, name: pin}}",
      frame.direction(0, 1));
  const std::string free =
      fmt::format("{{on: strip.vertex_1, fix: [x, y], name: pin}}, {{on: strip.vertex_2, fix: {{along: {}}}}}",
                  frame.direction(0, 1));
  return fmt::format(R"(scabo: 1
analysis: {{plane: {}, thickness: {}}}
materials: {{m: {{young: {}, poisson: {}, expansion: {}}}}}
bodies:
  strip: {{material: m, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}, mesh: {{{}}}}}
supports: [{}]
loads: {{heat: {{on: strip, temperature: {}}}}}
{})",
                     plane, thickness, young, poisson, expansion, frame.at(0, 0), frame.at(length, 0),
                     frame.at(length, 1), frame.at(0, 1), mesh, ends == Ends::held ? held : free, temperature, more);
}

std::string mesh_of(const std::string& kind, double size, const Frame& frame) {
  return fmt::format("{}, size: {:.17g}", kind, size * frame.scale);
}

class HeldStrip : public testing::TestWithParam<std::string> {};

/// Between two smooth walls: sigma_x = -E a T(y), and across the strip the free strain (1 + nu) a T; in plane strain, a
/// slab between four walls, both divided by 1 - nu, and sigma_z = sigma_x. Exact to rounding.
TEST_P(HeldStrip, HasTheStressOfItsTemperature) {
  const Table& table = anywhere;
  for (const Frame& frame : frames)
    for (const bool strain : {false, true}) {
      const auto solution = run(strip(mesh_of(GetParam(), 0.25, frame), frame, 2.0, Ends::held,
                                      strain ? "strain" : "stress", table.text(frame, 1)));
      const analysis::IncrementResult& end = last(solution);
      const double modulus = young * expansion / (strain ? 1.0 - poisson : 1.0),
                   across = (1.0 + poisson) * expansion / (strain ? 1.0 - poisson : 1.0), highest = 40.0 * modulus;
      const result::Probe probe(solution, end.fields, 0);
      for (const Vec2& x : {Vec2(0.9, 0.2), Vec2(1.3, 0.32), Vec2(0.05, 0.6), Vec2(1.9, 0.97)}) {
        const auto values = probe.at(frame.point(x.x(), x.y()));
        ASSERT_TRUE(values);
        const element::Vec3 exact(-modulus * table.at(x.y()), 0.0, 0.0);
        EXPECT_LT((frame.back(values->stress) - exact).norm() / highest, 1e-9);
        const Vec2 u = frame.back(values->displacement) / (frame.scale * across);
        EXPECT_NEAR(u.y(), table.integral(0.0, x.y()), 1e-8);
        EXPECT_NEAR(u.x(), 0.0, 1e-8);
      }
      // Fields of the .vtu files, at every point; they have seven digits.
      const result::Recovery recovery(solution);
      const result::Fields fields = recovery.fields(solution, end.fields);
      double worst = 0.0, worst_zz = 0.0;
      for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
        const Vec2 x(recovery.grid().points[3 * i], recovery.grid().points[3 * i + 1]);
        const double y = frame.back(Vec2(x - frame.origin)).y() / frame.scale;
        const element::Vec3 stress =
            frame.back(element::Vec3(fields.stress_xx[i], fields.stress_yy[i], fields.stress_xy[i]));
        const double exact = -modulus * table.at(y);
        worst = std::max(worst, (stress - element::Vec3(exact, 0.0, 0.0)).norm() / highest);
        worst_zz = std::max(worst_zz, std::abs(fields.stress_zz[i] - (strain ? exact : 0.0)) / highest);
      }
      EXPECT_LT(worst, 1e-6);
      EXPECT_LT(worst_zz, 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, HeldStrip,
                         testing::Values("order: 2", "order: 5", "kind: polygons, order: 2",
                                         "kind: quadtree, order: 2"));

/// Finite elements take a table as it is where it bends between them; elsewhere the error falls with the square of
/// their size, in the mean.
TEST(TemperatureTable, InFiniteElementsIsExactWhereItBendsBetweenThem) {
  const auto worst = [](double size, const Table& table, bool root_of_mean_square) {
    std::string places, values;
    for (std::size_t i = 0; i < table.s.size(); ++i) {
      places += fmt::format("{}{}", i ? ", " : "", table.s[i]);
      values += fmt::format("{}{}", i ? ", " : "", table.T[i]);
    }
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 200, poisson: 0.3, expansion: 1e-3}}}}
bodies: {{strip: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: fem, size: {}}}}}}}
supports: [{{on: strip.left, fix: x}}, {{on: strip.right, fix: x}}, {{on: strip.bottom_left, fix: y}}]
loads: {{heat: {{temperature: {{over: y, at: [{}], values: [{}]}}}}}}
)",
                                          size, places, values));
    const result::Probe probe(solution, last(solution).fields, 0);
    double largest = 0.0, sum = 0.0;
    constexpr int points = 200;
    for (int i = 0; i < points; ++i) {
      const double y = (i + 0.5) / points;
      const double miss = (probe.at(Vec2(1.03, y))->stress - element::Vec3(-0.2 * table.at(y), 0, 0)).norm() / 8.0;
      largest = std::max(largest, miss);
      sum += miss * miss / points;
    }
    return root_of_mean_square ? std::sqrt(sum) : largest;
  };
  EXPECT_LT(worst(0.25, quarters, false), 1e-9);
  const Table between{{0.0, 0.31, 0.64, 1.0}, {0.0, 40.0, -10.0, 25.0}};
  const double coarse = worst(0.1, between, true), fine = worst(0.025, between, true);
  EXPECT_GT(coarse, 1e-3);
  EXPECT_LT(fine, 0.25 * coarse);
}

/// sigma_x of a long free strip far from its ends: E a (T_0 + T_1 (y - 1/2) - T(y)), with the mean T_0 and the slope
/// T_1 of the linear temperature that has the same resultants. Resultants over a section are zero.
double stress_of_free_strip(const Table& table, double y) {
  const double mean = table.integral(0.0, 1.0), slope = 12.0 * table.integral(0.0, 1.0, 1, 0.5);
  return young * expansion * (mean + slope * (y - 0.5) - table.at(y));
}

struct FreeCase {
  const char* kind;
  double size, stress, resultants;  // bounds, of E a (T_max - T_min)
};
void PrintTo(const FreeCase& of, std::ostream* stream) { *stream << of.kind; }
class FreeStrip : public testing::TestWithParam<FreeCase> {};

double error_of_free_strip(const FreeCase& of, double size, const Frame& frame, std::map<std::string, double>& cut) {
  const std::string section = fmt::format("output: {{history: {{cut: {{section: {{from: {}, to: {}}}}}}}}}\n",
                                          frame.at(3.07, -0.5), frame.at(3.07, 1.5));
  const auto solution =
      run(strip(mesh_of(of.kind, size, frame), frame, 6.0, Ends::free, "stress", anywhere.text(frame, 1), section));
  cut = history_of(solution);
  const result::Probe probe(solution, last(solution).fields, 0);
  double worst = 0.0;
  for (int i = 0; i <= 40; ++i) {
    const double y = 0.0125 + 0.975 * i / 40;
    const auto values = probe.at(frame.point(3.07, y));
    const element::Vec3 exact(stress_of_free_strip(anywhere, y), 0.0, 0.0);
    worst = std::max(worst, (frame.back(values->stress) - exact).norm() / (50.0 * young * expansion));
  }
  return worst;
}

TEST_P(FreeStrip, HasTheStressOfBoleyAndWeiner) {
  for (const Frame& frame : frames) {
    std::map<std::string, double> cut;
    const double error = error_of_free_strip(GetParam(), GetParam().size, frame, cut);
    RecordProperty("error", fmt::format("{:.2g}", error));
    EXPECT_LT(error, GetParam().stress);
    const double force = 50.0 * young * expansion * thickness * frame.scale;
    EXPECT_NEAR(cut.at("cut.normal") / force, 0.0, GetParam().resultants);
    EXPECT_NEAR(cut.at("cut.shear") / force, 0.0, GetParam().resultants);
    EXPECT_NEAR(cut.at("cut.moment") / (force * frame.scale), 0.0, GetParam().resultants);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, FreeStrip,
                         testing::Values(FreeCase{"order: 4", 0.25, 1e-5, 1e-4},
                                         FreeCase{"kind: polygons, order: 2", 0.125, 1e-5, 1e-4},
                                         FreeCase{"kind: quadtree, order: 2", 0.125, 1e-5, 1e-4}));

/// A bar between smooth walls: by reciprocity with uniform tension, the force on a wall is E a t / L int T dA, whatever
/// T. Exact to rounding wherever the table bends, except with edges of order 1, which do not follow the quadratic free
/// expansion; half of it at half the temperature.
struct BarCase {
  const char* mesh;
  double bound;
};
void PrintTo(const BarCase& of, std::ostream* stream) { *stream << of.mesh; }
class HeldBar : public testing::TestWithParam<BarCase> {};

TEST_P(HeldBar, PressesOnItsWallsByReciprocity) {
  const Table table{{0.3, 0.55, 1.47, 1.5, 1.9}, {10.0, 40.0, -30.0, 20.0, 15.0}};
  const double mean = (0.3 * 10.0 + table.integral(0.3, 1.9) + 0.6 * 15.0) / 2.5;
  for (const Frame& frame : frames) {
    const auto solution =
        run(strip(mesh_of(GetParam().mesh, 0.25, frame), frame, 2.5, Ends::held, "stress", table.text(frame, 0),
                  "curves: {day: {table: [[0, 0], [1, 0.5], [2, 1]]}}\n"
                  "steps: [{name: warm, increments: 4, loads: {heat: day}}]\n"));
    last(solution);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& increment = increment_at(solution, k);
      const double exact = -young * expansion * thickness * frame.scale * mean * 0.25 * static_cast<double>(k + 1);
      const Vec2 right = frame.back(Vec2(increment.reactions[0][0], increment.reactions[0][1]));
      EXPECT_NEAR(right.x() / exact, 1.0, GetParam().bound) << frame.scale;
      EXPECT_NEAR(right.y() / exact, 0.0, GetParam().bound);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, HeldBar,
                         testing::Values(BarCase{"order: 2", 1e-9}, BarCase{"kind: polygons, order: 2", 1e-9},
                                         BarCase{"kind: polygons, order: 1", 1e-3},
                                         BarCase{"kind: quadtree, order: 2", 1e-9}, BarCase{"kind: fem", 1e-9}));

/// A table whose points lie on one line is the linear temperature: free expansion without stress, and with a crack or a
/// notch the same displacements.
TEST(TemperatureTable, OnOneLineIsTheLinearTemperature) {
  const Frame frame{1.0, 0.4, {1.0, 0.5}};
  const Vec2 d = frame.back(Vec2(1, 0));
  // T = 5 + 8 (coordinate along the strip), in x and y.
  const double along_x = 8.0 * std::cos(0.4), along_y = 8.0 * std::sin(0.4);
  const double constant = 5.0 - along_x * frame.origin.x() - along_y * frame.origin.y();
  ASSERT_NEAR(d.norm(), 1.0, 1e-15);
  const std::string linear = fmt::format("{{constant: {:.17g}, x: {:.17g}, y: {:.17g}}}", constant, along_x, along_y);
  const Table table{{-1.0, 0.4, 0.9, 3.0}, {-3.0, 8.2, 12.2, 29.0}};
  for (const char* kind : {"order: 2", "kind: polygons, order: 2", "kind: quadtree, order: 2", "kind: fem"}) {
    std::vector<analysis::StaticSolution> solutions;
    for (const std::string& text : {linear, table.text(frame, 0)})
      solutions.push_back(run(strip(mesh_of(kind, 0.25, frame), frame, 2.0, Ends::free, "stress", text)));
    const result::Probe a(solutions[0], last(solutions[0]).fields, 0), b(solutions[1], last(solutions[1]).fields, 0);
    for (const Vec2& x : {Vec2(0.41, 0.2), Vec2(1.3, 0.83)}) {
      const auto first = a.at(frame.point(x.x(), x.y())), second = b.at(frame.point(x.x(), x.y()));
      EXPECT_LT((first->displacement - second->displacement).norm(), 1e-12);
      EXPECT_LT(second->stress.norm(), 1e-9);
    }
  }
}

/// A cracked plate, one super-element or cells: an open cell takes the linear part.
TEST(TemperatureTable, OnOneLineGivesACrackTheSameFactors) {
  for (const char* mesh : {"size: 0.2, order: 3", "kind: polygons, size: 0.2, order: 3"}) {
    std::vector<double> factors;
    for (const char* heat :
         {"{constant: -30, x: 60}", "{over: x, at: [-1, 0.1, 0.4, 2], values: [-90, -24, -6, 90]}"}) {
      const std::string crack =
          std::string(mesh).starts_with("kind") ? "path: [[0, 1], [0.5, 1]]" : "tip: [0.5, 1], mouth: [0, 1]";
      const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 200, poisson: 0.3, expansion: 1e-3}}}}
bodies:
  plate: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}, mesh: {{{}}},
    cracks: [{{name: slit, {}}}]}}
supports: [{{on: plate.top, fix: [y]}}, {{on: plate.bottom, fix: [y]}}, {{on: plate.bottom_right, fix: [x]}}]
loads: {{heat: {{on: plate, temperature: {}}}}}
)",
                                            mesh, crack, heat));
      factors.push_back(last(solution).cracks.at(0).factors.K_I);
    }
    EXPECT_GT(std::abs(factors[0]), 0.1);
    EXPECT_NEAR(factors[1] / factors[0], 1.0, 1e-9);
  }
}

/// Two tables and a linear temperature act together as the sum of each alone, and those of two materials side by side
/// each in its own body.
TEST(TemperatureTable, Superposes) {
  const Frame frame;
  const std::string mesh = mesh_of("order: 3", 0.25, frame);
  const auto with = [&](const std::string& loads) {
    std::string text = strip(mesh, frame, 2.0, Ends::held, "stress", "0");
    const std::string old = "{heat: {on: strip, temperature: 0}}";
    text.replace(text.find(old), old.size(), loads);
    return run(text);
  };
  const std::string one = fmt::format("a: {{on: strip, temperature: {}}}", anywhere.text(frame, 1)),
                    two = fmt::format("b: {{temperature: {}}}", quarters.text(frame, 0)),
                    three = "c: {on: strip, temperature: {constant: 3, x: -7}}";
  const auto all = with(fmt::format("{{{}, {}, {}}}", one, two, three));
  const Vec2 x(0.83, 0.41);
  element::Vec3 sum = element::Vec3::Zero();
  Vec2 u = Vec2::Zero();
  for (const std::string& load : {one, two, three}) {
    const auto alone = with("{" + load + "}");
    const auto values = result::value_at(alone, last(alone).fields, 0, x);
    sum += values->stress;
    u += values->displacement;
  }
  const auto together = result::value_at(all, last(all).fields, 0, x);
  EXPECT_LT((together->stress - sum).norm(), 1e-10 * sum.norm());
  EXPECT_LT((together->displacement - u).norm(), 1e-10 * u.norm());
  EXPECT_GT(sum.norm(), 1.0);
}

/// The bar of a displacement contains that of a far finer mesh, on one super-element and on polygons, whose cells take
/// the table as it is.
TEST(TemperatureTable, ErrorBarsContainTheTruth) {
  const Frame frame;
  const auto with = [&](const std::string& mesh, const std::string& more) {
    return run(strip(mesh, frame, 2.0, Ends::free, "stress", anywhere.text(frame, 0), more));
  };
  const auto fine = with("order: 6, size: 0.125", "");
  const double truth = result::value_at(fine, last(fine).fields, 0, Vec2(1.3, 0.8))->displacement.y();
  for (const char* mesh : {"order: 2, size: 0.5", "kind: polygons, order: 2, size: 0.5"}) {
    const auto solution =
        with(mesh, "output: {points: [{at: [1.3, 0.8], name: P}]}\ntolerance: {of: P.uy, relative: 1e-3}\n");
    const auto& quantities = last(solution).quantities;
    ASSERT_EQ(quantities.size(), 1U);
    EXPECT_LE(std::abs(quantities[0].value - truth), quantities[0].bar) << mesh;
    EXPECT_LE(quantities[0].bar, 1e-3 * std::abs(truth));
  }
}

}  // namespace
}  // namespace scabo::verification
