#include "scabo/analysis/state/discretisation.hpp"

#include <gtest/gtest.h>

#include "scabo/input/read_model.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::analysis {
namespace {

model::Model two_posts() {
  return input::parse_model(R"(
scabo: 1
materials: {steel: {young: 2e11, poisson: 0.3}}
bodies:
  left: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1, 2]}}, mesh: {size: 0.5, order: 1}}
  right: {material: steel, shape: {rectangle: {corner: [3, 0], size: [1, 3]}}, mesh: {size: 0.5, order: 1}}
supports: [{on: left.bottom, fix: [x, y]}, {on: right.bottom, fix: [x, y]}]
loads: {pull: {on: left.top, traction: [0, 5e6]}}
steps: [{name: pull}]
)",
                            "posts.yaml");
}

Discretisation discretised(const model::Model& model) {
  Discretisation of;
  of.model = model;
  of.mesh = mesh::make_mesh(model);
  Timing timing;
  discretise(of, {}, timing);
  return of;
}

TEST(Discretisation, OfAnotherMeshKeepsSuperElementsAndFactorsThatStayTheSame) {
  const Discretisation before = discretised(two_posts());
  model::Model finer = before.model;
  finer.bodies[1].mesh.size = 0.25;
  Timing timing;
  const Discretisation after = remesh(before, before.model, mesh::make_mesh(finer), timing);
  EXPECT_EQ(after.cells[0].front(), before.cells[0].front());
  EXPECT_NE(after.cells[1].front(), before.cells[1].front());
  EXPECT_EQ(after.structure->parts[0]->factor(), before.structure->parts[0]->factor());
  EXPECT_NE(after.structure->parts[1]->factor(), before.structure->parts[1]->factor());
  EXPECT_EQ(after.structure->parts[0]->size(), before.structure->parts[0]->size());
  EXPECT_EQ(after.structure->parts[1]->size(), 2 * before.structure->parts[1]->size());
  EXPECT_EQ(after.force_scale, before.force_scale);
  EXPECT_GT(after.force_scale, 0.0);
}

TEST(Discretisation, TakesThePlaceOfAnotherUnderTheSameModel) {
  Discretisation of = discretised(two_posts());
  const model::Step* const step = of.model.steps.data();
  Timing timing;
  model::Model finer = of.model;
  finer.bodies[1].mesh.size = 0.25;
  const mesh::Mesh mesh = mesh::make_mesh(finer);
  replace(of, remesh(of, of.model, mesh, timing));
  EXPECT_EQ(of.model.steps.data(), step);
  EXPECT_EQ(of.model.steps.front().name, "pull");
  EXPECT_EQ(of.mesh.nodes(), mesh.nodes());
  EXPECT_EQ(of.structure->parts[1]->size(), static_cast<Eigen::Index>(2 * mesh.bodies[1].nodes.size()));
}

}  // namespace
}  // namespace scabo::analysis
