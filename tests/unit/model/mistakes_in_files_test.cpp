// A mistake in a file and the same mistake in a model built in code get the same sentence.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "scabo/input/read_model.hpp"
#include "scabo/model/validate.hpp"
#include "unit/model/models.hpp"

namespace scabo::model {
namespace {

struct Twin {
  const char* name;
  const char* key;   ///< replaced in the file
  const char* with;  ///< by this
  std::function<void(Model&)> apply;
};

constexpr const char* file_of_twins =
    "scabo: 1\n"
    "materials: {steel: {young: 210, poisson: 0.3}}\n"
    "bodies:\n"
    "  block: {material: steel, shape: {polygon: {vertices: [[0, 0], [2, 0], [2, 1], [0, 1]]}}, mesh: {size: 0.5, "
    "order: 2}}\n"
    "supports: [{on: block.edge_4, fix: [x, y]}]\n"
    "loads: {push: {on: block.edge_2, force: [1, 0]}}\n"
    "solver: {tolerance: 1e-10}\n";

class Twins : public testing::TestWithParam<Twin> {};

TEST_P(Twins, HearTheSameSentence) {
  const Twin& twin = GetParam();
  std::string text = file_of_twins;
  ASSERT_NE(text.find(twin.key), std::string::npos);
  text.replace(text.find(twin.key), std::string(twin.key).size(), twin.with);
  std::vector<Diagnostic> of_file;
  try {
    input::parse_model(text, "model.yaml");
  } catch (const InputError& error) {
    of_file = error.diagnostics();
  }
  Model model = input::parse_model(file_of_twins, "model.yaml");
  twin.apply(model);
  const std::vector<Mistake> of_code = validate(model);
  ASSERT_EQ(of_file.size(), 1u);
  ASSERT_EQ(of_code.size(), 1u);
  EXPECT_EQ(of_file[0].message, of_code[0].message);
  EXPECT_GT(of_file[0].at.line, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Models, Twins,
    testing::Values(Twin{"young", "young: 210", "young: 0", [](Model& m) { m.materials[0].young = 0.0; }},
                    Twin{"poisson", "poisson: 0.3", "poisson: 0.7", [](Model& m) { m.materials[0].poisson = 0.7; }},
                    Twin{"order", "order: 2", "order: 17", [](Model& m) { m.bodies[0].mesh.order = 17; }},
                    Twin{"size", "size: 0.5", "size: 1e-9", [](Model& m) { m.bodies[0].mesh.size = 1e-9; }},
                    Twin{"tolerance", "1e-10", "1", [](Model& m) { m.solver.tolerance = 1.0; }},
                    Twin{"unsupported", "supports: [{on: block.edge_4, fix: [x, y]}]\n", "",
                         [](Model& m) { m.supports.clear(), m.steps[0].support_factors.clear(); }},
                    Twin{"unloaded", "loads: {push: {on: block.edge_2, force: [1, 0]}}\n", "",
                         [](Model& m) { m.loads.clear(), m.steps[0].load_factors.clear(); }},
                    Twin{"no_edge_length", "[2, 1]", "[2, 0]",
                         [](Model& m) {
                           Outline& outline = m.bodies[0].outline;
                           outline.edges[1].end = outline.edges[2].start = outline.corners[2].position = {2, 0};
                         }},
                    Twin{"force_on_a_body", "on: block.edge_2", "on: block",
                         [](Model& m) { m.loads[0].on = test::place_on(Place::Kind::body, 0, -1, "block"); }}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace scabo::model
