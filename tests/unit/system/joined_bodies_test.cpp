// Bodies joined at their pairs, products with W, and displacements at few places of large bodies, against W itself and
// whole displacements.
#include "scabo/system/joined_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scabo/element/cell_library.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/mesh/plane/divide.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::system {
namespace {

double largest_of(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; }

struct Condensed {
  model::Model model;
  mesh::Mesh mesh;
  Structure structure;
  ContactSystem system;

  explicit Condensed(const std::string& text) : model(input::parse_model(text, "test.yaml")) {
    mesh = mesh::make_mesh(model);
    const auto cells = element::solve_cells(model, mesh, 1);
    structure = make_structure(model, mesh, cells);
    add_loads(structure, model, mesh, cells);
    system = condense(structure, model, mesh);
  }
};

/// Two blocks; `upper`: more keys of the upper one, `more`: more of the model.
std::string blocks(const std::string& mesh, const std::string& upper, const std::string& supports,
                   const std::string& more = "") {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3}, soft: {young: 3e9, poisson: 0.2}}\n"
         "bodies:\n"
         "  lower: {material: steel, shape: {rectangle: {corner: [0, -1], size: [3, 1]}}, mesh: {" +
         mesh +
         "}}\n"
         "  upper: {" +
         upper +
         ", shape: {rectangle: {corner: [0.5, 0], size: [2, 1]}}}\n"
         "supports: [" +
         supports +
         "]\n"
         "loads: {push: {on: upper.top, traction: [1e6, -2e6]}}\n"
         "contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.3}}\n" +
         more;
}
const std::string on_floor = "{on: lower.bottom, fix: [x, y]}";

/// The same with a bed of springs in its contact.
std::string soft_pairs(std::string text) {
  const std::string friction = "friction: 0.3";
  return text.insert(text.find(friction) + friction.size(), ", modulus: 1e11");
}

/// 2N, of springs between the sides.
Vector softness_of_rows(const ContactSystem& system) {
  Vector softness = Vector::Zero(2 * system.softness.size());
  for (Eigen::Index i = 0; i < system.softness.size(); ++i) softness[2 * i] = system.softness[i];
  return softness;
}

struct Case {
  std::string name, text;
};
std::vector<Case> cases() {
  const std::string fem = "kind: fem, order: 2, size: 0.25", floating = "material: soft, mesh: {" + fem + "}";
  return {{"floating", blocks(fem, floating, on_floor)},
          {"superelement", blocks("size: 0.25", "material: soft, mesh: {size: 0.25}", on_floor)},
          {"inclined", blocks(fem, floating,
                              on_floor + ", {on: lower.left, fix: {along: [1, 2]}}, "
                                         "{on: upper.left, fix: {along: [2, 1]}}")},
          {"rigid", blocks(fem, "rigid: true", on_floor)},
          {"soft", soft_pairs(blocks(fem, floating, on_floor,
                                     "bars: {rod: {between: [upper.top_left, [0, 3]], k: 1e9}, tie: {between: "
                                     "[upper.top, lower.right], k: 3e9}}\n"))},
          {"springs", blocks(fem, floating, on_floor, "springs: [{on: upper.top, k_n: 1e9, k_t: 2e9}]\n")}};
}

class Joined : public testing::TestWithParam<Case> {};

TEST_P(Joined, ProductsAreThoseOfW) {
  const Condensed bodies(GetParam().text);
  const Matrix& W = bodies.system.W.dense();
  const PairProducts products(bodies.structure, bodies.system.motion, softness_of_rows(bodies.system));
  ASSERT_EQ(products.size(), W.rows());
  Vector p(W.rows());
  for (Eigen::Index k = 0; k < p.size(); ++k) p[k] = std::sin(3.0 * static_cast<double>(k));
  EXPECT_LT(largest_of(products.times(p) - W * p), 1e-12 * largest_of(W * p));
  const Matrix blocks = products.diagonal_blocks();
  for (Eigen::Index i = 0; i < W.rows(); i += 2)
    EXPECT_LT((blocks.middleCols<2>(i) - W.block<2, 2>(i, i)).cwiseAbs().maxCoeff(), 1e-12 * W.cwiseAbs().maxCoeff());
}

// All pairs held along the normal, every second one along the joint as well.
TEST_P(Joined, HeldPairsHaveTheForcesThatGiveThemTheirMotions) {
  const Condensed bodies(GetParam().text);
  const Matrix& W = bodies.system.W.dense();
  const Matrix& G = bodies.system.G.dense();
  const auto joined = JoinedBodies::of(bodies.structure, bodies.system.motion, softness_of_rows(bodies.system));
  ASSERT_NE(joined, nullptr);
  std::vector<int> rows;
  for (int k = 0; k < W.rows(); ++k)
    if (k % 2 == 0 || k % 4 == 1) rows.push_back(k);
  const auto held = joined->hold(rows);
  ASSERT_NE(held, nullptr);
  Vector u(static_cast<Eigen::Index>(rows.size())), z(G.cols());
  for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 1e-4 * std::cos(0.7 * static_cast<double>(k));
  for (Eigen::Index k = 0; k < z.size(); ++k) z[k] = 1e6 * (1.0 + static_cast<double>(k));
  Vector p, a;
  held->solve(u, z, p, a);
  const Matrix W_hh = W(rows, rows), G_h = G(rows, Eigen::all);
  const Vector left = u - W_hh * p - G_h * a;  // eps p; W has no part of a body where that is held without supports
  const double flexibility = W_hh.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    EXPECT_GE(left[k] * p[k], -1e-9 * largest_of(u) * std::abs(p[k]));
    EXPECT_LE(std::abs(left[k]), 2e-4 * flexibility * std::abs(p[k]) + 1e-9 * largest_of(u));
  }
  EXPECT_LT(largest_of(G_h.transpose() * p - z), 1e-7 * largest_of(p));
}

// Some rows, in any order.
TEST_P(Joined, GiveBlocksOfW) {
  const Condensed bodies(GetParam().text);
  const Matrix& W = bodies.system.W.dense();
  const auto joined = JoinedBodies::of(bodies.structure, bodies.system.motion, softness_of_rows(bodies.system));
  ASSERT_NE(joined, nullptr);
  const std::vector<int> rows = {6, 7, 0, 11};
  EXPECT_LT((joined->flexibility(rows) - W(rows, rows)).cwiseAbs().maxCoeff(), 1e-12 * W.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Bodies, Joined, testing::ValuesIn(cases()), [](const auto& info) { return info.param.name; });

// 24,000 degrees of freedom and more: there only what the pairs need is computed.
TEST(LargeBody, DisplacementAtFewPlacesIsThatOfTheWhole) {
  const std::string fem = "kind: fem, order: 2, size: 0.02";
  for (const std::string& supports :
       {on_floor, std::string("{on: lower.left, fix: {along: [1, 2]}}, "
                              "{on: lower.right, displacement: {along: [2, 1], value: 1e-5}}")}) {
    const Condensed bodies(blocks(fem, "rigid: true", supports, "steps: [{name: one, loads: {push: 1}}]\n"));
    const BodySystem& lower = *bodies.structure.parts[0];
    ASSERT_GT(lower.size(), 24000);
    Vector f = Vector::Zero(lower.size()), prescribed(static_cast<Eigen::Index>(lower.constraints().size()));
    for (std::size_t c = 0; c < lower.constraints().size(); ++c)
      prescribed[static_cast<Eigen::Index>(c)] = lower.constraints()[c].value;
    const std::vector<int> dofs = touched_part(bodies.system.motion[0]).dofs;
    for (const int dof : dofs) f[dof] = 1e3 * std::cos(0.01 * dof);
    for (const double gravity : {0.0, 2.0}) {
      f.array() += gravity;
      const Vector whole = lower.displacement(f, prescribed), few = lower.displacement_at(f, prescribed, dofs);
      EXPECT_LT(largest_of(whole(dofs) - few(dofs)), 1e-11 * largest_of(whole));
      const double acting = std::max(largest_of(f), largest_of(lower.reactions(whole, f)));
      for (const double part : {1e-11, 1e-13}) {  // tenths of what certificates allow
        const Displaced displaced = lower.displaced(f, prescribed, {part, 0.0});
        EXPECT_LE(lower.imbalance_of(displaced.unbalanced), part * acting);
        EXPECT_LT(largest_of(displaced.u - whole), 1e-11 * largest_of(whole));
        const Vector plain = displaced.unbalanced - lower.unbalanced(displaced.u, f);
        EXPECT_LT(lower.imbalance_of(plain), 1e-11 * acting);
        EXPECT_LT(largest_of(lower.reactions_of(plain)), 1e-11 * acting);
      }
      const Displaced coarse = lower.displaced(f, prescribed, {1e-13, 1e20 * acting});
      EXPECT_GT(lower.imbalance_of(coarse.unbalanced), 1e-13 * acting);  // no more than what is wanted
    }
  }
}

}  // namespace
}  // namespace scabo::system
