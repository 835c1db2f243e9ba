// Bodies from mesh files: what must be exact on them, and meshes that others made.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "scabo/base/error.hpp"
#include "scabo/files/read_mesh_file.hpp"
#include "scabo/model/imported_body.hpp"
#include "scabo/result/probe.hpp"
#include "support/mesh_text.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

namespace fs = std::filesystem;
using test::mesh_of_disc_in_ring;
using test::mesh_of_rectangle;
using test::MeshText;

/// A ring of quadrilaterals between radii `inner` and `outer` over these angles, closed if they span 2 pi. Sides:
/// boundary_1 inside, boundary_2 outside, boundary_3 and boundary_4 at the first and last angle.
MeshText mesh_of_ring(double inner, double outer, std::vector<double> angles, int layers) {
  const bool closed = angles.back() - angles.front() > 2.0 * M_PI - 1e-12;
  if (closed) angles.pop_back();
  const int count = static_cast<int>(angles.size()), sectors = closed ? count : count - 1;
  MeshText mesh;
  for (int i = 0; i <= layers; ++i)
    for (const double angle : angles)
      mesh.nodes.push_back((inner + (outer - inner) * i / layers) * Vec2(std::cos(angle), std::sin(angle)));
  const auto node = [&](int i, int j) { return count * i + j % count; };
  for (int i = 0; i < layers; ++i) {
    for (int j = 0; j < sectors; ++j)
      mesh.cells.push_back({9, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, 1});
    if (closed) continue;
    mesh.cells.push_back({3, {node(i, 0), node(i + 1, 0)}, 3});
    mesh.cells.push_back({3, {node(i, count - 1), node(i + 1, count - 1)}, 4});
  }
  for (int j = 0; j < sectors; ++j) {
    mesh.cells.push_back({3, {node(0, j), node(0, j + 1)}, 1});
    mesh.cells.push_back({3, {node(layers, j), node(layers, j + 1)}, 2});
  }
  return mesh;
}

// ---- patch tests -----------------------------------------------------------------------------------------

struct Patch {
  int type;
  const char* mesh;
};

class ImportedPatch : public testing::TestWithParam<Patch> {};
INSTANTIATE_TEST_SUITE_P(Meshes, ImportedPatch,
                         testing::Values(Patch{5, "superelement"}, Patch{9, "superelement"}, Patch{7, "superelement"},
                                         Patch{22, "superelement"}, Patch{23, "superelement"},
                                         Patch{36, "superelement"}, Patch{5, "fem"}, Patch{9, "fem"}, Patch{22, "fem"},
                                         Patch{23, "fem"}, Patch{9, "superelement, order: 2"},
                                         Patch{7, "superelement, order: 3"}, Patch{23, "superelement, order: 4"}),
                         [](const auto& patch) {
                           std::string name = fmt::format("{}_{}", patch.param.type, patch.param.mesh);
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

// A uniform state of stress in a plate of irregular cells.
TEST_P(ImportedPatch, UniformStress) {
  const double young = 3.0, poisson = 0.3;  // plane strain
  const double c = (1.0 + poisson) / young, strain_x = c * ((1.0 - poisson) - 0.5 * poisson),
               strain_y = c * (0.5 * (1.0 - poisson) - poisson);
  const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: strain, thickness: 0.7}}
materials: {{rock: {{young: 3, poisson: 0.3}}}}
bodies: {{plate: {{material: rock, mesh: {{file: {}, elements: {}}}}}}}
supports: [{{on: plate.edge_4, fix: [x]}}, {{on: plate.edge_1, fix: [y]}}]
loads: {{right: {{on: plate.edge_2, traction: [1, 0]}}, top: {{on: plate.edge_3, traction: [0, 0.5]}}}}
)",
                                        mesh_of_rectangle(GetParam().type, 3.0, 2.0, 6, 4).file(), GetParam().mesh));
  const auto& increment = last(solution);
  const result::Probe probe(solution, increment.fields, 0);
  double worst = 0.0;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 8; ++j) {
      const Vec2 x(0.25 * i, 0.25 * j);
      const auto values = probe.at(x);
      ASSERT_TRUE(values.has_value()) << x.transpose();
      worst = std::max({worst, (values->displacement - Vec2(strain_x * x.x(), strain_y * x.y())).norm(),
                        (values->stress - element::Vec3(1.0, 0.5, 0.0)).norm()});
    }
  EXPECT_LT(worst, 1e-12);
  EXPECT_NEAR(increment.energy.elastic, 0.5 * 0.7 * 6.0 * (strain_x + 0.5 * strain_y), 1e-12);
  RecordProperty("worst", fmt::format("{:.1e}", worst));
  std::printf("%s: worst deviation %.1e\n", GetParam().mesh, worst);
}

// The same pressure through a contact with a body of another kind and another division.
TEST_P(ImportedPatch, PressureOverAContactWithAnotherMesh) {
  for (const char* upper :
       {"{size: 0.7, order: 2}", "{size: 0.45, kind: polygons, order: 1}", "{size: 0.7, kind: fem}"}) {
    const auto solution =
        run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 30, poisson: 0.2}}}}
bodies:
  lower: {{material: m, mesh: {{file: {}, elements: {}}}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 2], size: [3, 1.5]}}}}, mesh: {}}}
supports:
  - {{on: lower.edge_1, fix: [y]}}
  - {{on: lower.vertex_1, fix: [x]}}
loads: {{weight: {{on: upper.top, pressure: 1}}}}
contacts: {{joint: {{between: [lower.edge_3, upper.bottom], friction: 0.5}}}}
)",
                        mesh_of_rectangle(GetParam().type, 3.0, 2.0, 6, 4).file(), GetParam().mesh, upper));
    const auto& increment = last(solution);
    for (const auto& pair : contact_of(increment).pairs) EXPECT_NEAR(pair.pressure, 1.0, 1e-10) << upper;
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t i = 0; i < solution.mesh.bodies[b].nodes.size(); ++i) {
        const Vec2& x = solution.mesh.bodies[b].nodes[i];
        const auto k = static_cast<Eigen::Index>(2 * i);
        EXPECT_NEAR(increment.fields.displacements[b][k], 0.2 * x.x() / 30.0, 1e-12);
        EXPECT_NEAR(increment.fields.displacements[b][k + 1], -x.y() / 30.0, 1e-12);
      }
  }
}

// A press fit of two rings of chords, the outer one in four pieces that are bonded to each other: the pressure in the
// points in which two pieces meet the inner ring is that of all other points, and nothing slips. With a normal for each
// contact it was up to 1.5 times as large or zero, with friction at its bound.
TEST(Imported, PressFitOfBondedPiecesHasOneNormalWhereTheyMeet) {
  for (const bool uneven : {false, true}) {
    std::vector<double> angles;
    for (int j = 0; j <= 60; ++j) angles.push_back(j * M_PI / 30.0);
    if (uneven) angles[1] = 0.25 * angles[2];  // chords of different lengths beside the point at 0
    std::string bodies = fmt::format("  shaft: {{material: m, mesh: {{file: {}, elements: fem}}}}\n",
                                     mesh_of_ring(0.5, 1.0, angles, 6).file());
    std::string contacts;
    for (int k = 0; k < 4; ++k) {
      const std::vector<double> part(angles.begin() + 15 * k, angles.begin() + 15 * k + 16);
      bodies += fmt::format("  piece_{}: {{material: m, mesh: {{file: {}, elements: fem}}}}\n", k,
                            mesh_of_ring(1.0, 2.0, part, 8).file());
      contacts += fmt::format(
          "  fit_{0}: {{between: [shaft.boundary_2, piece_{0}.boundary_1], friction: 0.3, gap: -1e-3}}\n"
          "  joint_{0}: {{between: [piece_{0}.boundary_4, piece_{1}.boundary_3], bond: true}}\n",
          k, (k + 1) % 4);
    }
    const auto solution = run("scabo: 1\nmaterials: {m: {young: 2e11, poisson: 0.3}}\nbodies:\n" + bodies +
                              "supports:\n  - {on: {body: shaft, near: [0.5, 0]}, fix: [x, y]}\n"
                              "  - {on: {body: shaft, near: [-0.5, 0]}, fix: y}\ncontacts:\n" +
                              contacts);
    std::vector<double> pressures, shears;
    for (const auto& contact : last(solution).contacts)
      if (contact.name.starts_with("fit"))
        for (const auto& pair : contact.pairs) {
          pressures.push_back(pair.pressure);
          shears.push_back(std::abs(pair.shear));
        }
    std::sort(pressures.begin(), pressures.end());
    const double usual = pressures[pressures.size() / 2];
    EXPECT_GE(pressures.front(), (uneven ? 0.9 : 0.995) * usual);
    EXPECT_LE(pressures.back(), (uneven ? 1.15 : 1.005) * usual);
    if (!uneven) EXPECT_LE(*std::max_element(shears.begin(), shears.end()), 1e-6 * usual);
  }
}

// Two regions of one file in contact on the border between them, which is a closed curve: a disc in a ring under
// uniform pressure is in a uniform state of stress, whatever the polygon.
TEST(Imported, ContactOfTwoRegionsOnAClosedCurve) {
  for (const bool quadratic : {false, true})
    for (const char* elements : {"superelement", "fem"}) {
      if (!quadratic && std::string(elements) == "fem") continue;  // its middle cell is a polygon
      const std::string file = mesh_of_disc_in_ring(20, quadratic).file();
      const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 30, poisson: 0.2}}}}
bodies:
  disc: {{material: m, mesh: {{file: {0}, region: region_1}}}}
  ring: {{material: m, mesh: {{file: {0}, region: region_2, elements: {1}}}}}
supports:
  - {{on: {{body: disc, near: [1, 0]}}, fix: [y]}}
  - {{on: {{body: disc, near: [-1, 0]}}, fix: [y]}}
  - {{on: {{body: disc, near: [0, 1]}}, fix: [x]}}
loads: {{water: {{on: ring.edge_1, pressure: 1}}}}
contacts: {{joint: {{between: [disc.to_region_2, ring.to_region_1], friction: 0.3}}}}
)",
                                            file, elements));
      const auto& increment = last(solution);
      const auto& contact = contact_of(increment);
      EXPECT_EQ(contact.pairs.size(), quadratic ? 40u : 20u);
      for (const auto& pair : contact.pairs) EXPECT_NEAR(pair.pressure, 1.0, 1e-10);
      for (std::size_t b = 0; b < 2; ++b)
        for (std::size_t i = 0; i < solution.mesh.bodies[b].nodes.size(); ++i)
          EXPECT_LT((increment.fields.displacements[b].segment<2>(static_cast<Eigen::Index>(2 * i)) +
                     0.8 / 30.0 * solution.mesh.bodies[b].nodes[i])
                        .norm(),
                    1e-12);
    }
}

// The same disc in a ring with a circular hole that is divided differently: nodes are inserted on both sides. Those of
// the disc lie on its parabolas, so that the pressure is uniform up to their distance from the circle.
TEST(Imported, ContactOfACurvedBoundaryWithAnotherMesh) {
  for (const double size : {0.19, 0.13}) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 30, poisson: 0.2}}}}
bodies:
  disc: {{material: m, mesh: {{file: {}, region: region_1}}}}
  ring:
    material: m
    shape: {{circle: {{centre: [0, 0], radius: 2}}}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: 1}}}}}}
    mesh: {{kind: polygons, size: {}}}
supports:
  - {{on: {{body: disc, near: [1, 0]}}, fix: [y]}}
  - {{on: {{body: disc, near: [-1, 0]}}, fix: [y]}}
  - {{on: {{body: disc, near: [0, 1]}}, fix: [x]}}
loads: {{water: {{on: ring.rim, pressure: 1}}}}
contacts: {{joint: {{between: [disc.to_region_2, ring.bore], friction: 0.3}}}}
)",
                                          mesh_of_disc_in_ring(32, true).file(), size));
    const auto& contact = contact_of(last(solution));
    EXPECT_EQ(contact.open, 0);
    double worst = 0.0;
    for (const auto& pair : contact.pairs) worst = std::max(worst, std::abs(pair.pressure - 1.0));
    std::printf("ring of %g: %zu pairs, worst deviation of the pressure %.2g\n", size, contact.pairs.size(), worst);
    EXPECT_LT(worst, 0.01);
  }
}

// One rectangle of four nodes: its symmetry blocks have rows that only translations move.
TEST(Imported, OneRectangleOfOrderOne) {
  const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 10, poisson: 0.25}}}}
bodies: {{part: {{material: m, mesh: {{file: {}}}}}}}
supports: [{{on: part.edge_4, fix: [x]}}, {{on: part.vertex_1, fix: [y]}}]
loads: {{pull: {{on: part.edge_2, traction: [1, 0]}}}}
)",
                                        mesh_of_rectangle(9, 2.0, 1.0, 1, 1).file()));
  EXPECT_NEAR(last(solution).energy.elastic, 0.5 * 2.0 / 10.0, 1e-15);
}

// Regions of different weight: the reactions are the weight, and each region has its own material.
TEST(Imported, WeightOfRegions) {
  const auto region = [](int i, int) { return i < 2 ? 1 : 2; };
  for (const int type : {5, 9, 23})
    for (const char* elements : {"superelement", "fem"}) {
      const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: strain, thickness: 2}}
materials: {{rock: {{young: 3e9, poisson: 0.3, density: 1000}}, ore: {{young: 9e9, poisson: 0.2, density: 4000}}}}
bodies: {{block: {{material: rock, materials: {{region_2: ore}}, mesh: {{file: {}, elements: {}}}}}}}
supports: [{{on: block.edge_1, fix: [y]}}, {{on: block.vertex_1, fix: [x]}}]
loads: {{weight: {{gravity: [0, -10]}}}}
output: {{points: [[0.3, 1.1]]}}
)",
                                            mesh_of_rectangle(type, 3.0, 2.0, 6, 4, region).file(), elements));
      EXPECT_NEAR(last(solution).reactions[0].y(), 2.0 * 10.0 * (1000.0 * 2.0 + 4000.0 * 4.0), 1e-6);
    }
}

// A dam of one region on the rock of another: the joint carries its weight and the water's push, by friction.
TEST(Imported, RegionsInContactCarryWeightAndPush) {
  const auto region = [](int, int j) { return j < 2 ? 1 : 2; };
  for (const char* lower : {"superelement", "superelement, order: 2", "fem"})
    for (const char* upper : {"superelement", "fem"}) {
      const std::string file = mesh_of_rectangle(9, 2.0, 3.0, 8, 6, region).file();
      const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: strain, thickness: 1}}
materials: {{rock: {{young: 3e9, poisson: 0.3, density: 2000}}}}
bodies:
  rock: {{material: rock, mesh: {{file: {0}, region: region_1, elements: {1}}}}}
  dam: {{material: rock, mesh: {{file: {0}, region: region_2, elements: {2}}}}}
supports: [{{on: rock.edge_1, fix: [x, y]}}]
loads:
  weight: {{on: dam, gravity: [0, -10]}}
  push: {{on: dam.edge_3, force: [12e3, 0]}}
contacts: {{joint: {{between: [rock.to_region_2, dam.to_region_1], friction: 0.6}}}}
)",
                                            file, lower, upper));
      const auto& contact = contact_of(last(solution));
      EXPECT_NEAR(contact.normal_force, 2.0 * 2.0 * 2000.0 * 10.0, 1e-5);
      EXPECT_NEAR(std::abs(contact.tangential_force), 12e3, 1e-5);
      EXPECT_EQ(contact.pairs.size(), std::string(lower).find("order") == std::string::npos ? 9u : 17u);
    }
}

// ---- meshes that others made -----------------------------------------------------------------------------

bool runs(const std::string& command) { return std::system(("(" + command + ") >/dev/null 2>&1").c_str()) == 0; }

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("scabo_imported_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Energy of the first region's connected body of a mesh file, clamped on its side furthest to the left and pulled on
/// the one furthest to the right.
class Pulled {
 public:
  explicit Pulled(std::string file) : file_(std::move(file)) {
    const auto mesh = files::read_mesh_file(file_);
    const auto is_one = [](const auto& made) {
      const auto* bodies = std::get_if<model::ImportedBodies>(&made);
      return bodies != nullptr && bodies->parts.size() == 1;
    };
    auto made = model::imported_bodies(mesh, {}, false);
    if (!is_one(made)) {
      region_ = mesh.regions.front();
      made = model::imported_bodies(mesh, {0, -1}, false);
    }
    for (std::size_t set = 0; !is_one(made) && set < mesh.cell_sets.size(); ++set) {
      region_ = mesh.cell_sets[set].name;
      made = model::imported_bodies(mesh, {-1, static_cast<int>(set)}, false);
    }
    const model::ImportedBody& body = std::get<model::ImportedBodies>(made).parts.front();
    cells_ = body.mesh->cells.size();
    const auto& outline = body.outline;
    double left = 1e300, right = -1e300;
    for (const auto& edge : outline.edges) {
      const double x = edge.at(0.5).x();
      if (x < left) left = x, clamped_ = edge.names.front();
      if (x > right) right = x, pulled_ = edge.names.front();
    }
  }
  double energy(const std::string& elements) const {
    const std::string region = region_.empty() ? "" : ", region: \"" + region_ + "\"";
    return last(run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 210, poisson: 0.3}}}}
bodies: {{part: {{material: m, mesh: {{file: "{}"{}, elements: {}}}}}}}
supports: [{{on: part.{}, fix: [x, y]}}]
loads: {{pull: {{on: part.{}, force: [1, 1]}}}}
)",
                                file_, region, elements, clamped_, pulled_)))
        .energy.elastic;
  }
  std::size_t cells() const { return cells_; }

 private:
  std::string file_, region_, clamped_, pulled_;
  std::size_t cells_ = 0;
};

/// Energies of one mesh as super-elements and as finite elements, compared with super-elements of order 4 on its cells,
/// whose space contains that of the former. Under given forces the energy grows with the space.
void compare(const std::string& name, const std::string& file) {
  SCOPED_TRACE(name);
  const Pulled pulled(file);
  const double super = pulled.energy("superelement"), fem = pulled.energy("fem"),
               fine = pulled.energy("superelement, order: 4");
  std::printf(
      "%-14s %6zu cells: super-elements %.8g, finite elements %.8g (%+.3f %%), order 4 %.8g; short of it by %.3f %% "
      "and %.3f %%\n",
      name.c_str(), pulled.cells(), super, fem, 100.0 * (fem / super - 1.0), fine, 100.0 * (1.0 - super / fine),
      100.0 * (1.0 - fem / fine));
  EXPECT_LE(super, fine * (1.0 + 1e-10));
  EXPECT_LE(fem, fine * (1.0 + 1e-10));
}

TEST(Imported, CalculixTestExamples) {
  const fs::path folder = "/usr/share/doc/calculix-ccx-test/examples/test";
  if (!fs::exists(folder)) GTEST_SKIP() << "the package calculix-ccx-test is not installed";
  const Folder unpacked;
  ASSERT_TRUE(
      runs("cp " + (folder / "*.inp*").string() + " " + unpacked.file("") + " && gunzip -f " + unpacked.file("*.gz")));
  const std::vector<std::string> plane{
      "concretebeam", "dam",         "edgeload",     "leifer1",      "leifer2", "oneel",   "planestrain",
      "planestrain2", "planestress", "planestress2", "planestress3", "plate",   "rot4",    "scheibe",
      "shell1",       "shell1lin",   "shell3",       "shellf",       "shellf2", "spring4", "square"};
  EXPECT_EQ(plane.size(), 21u);
  for (const std::string& name : plane) compare(name, unpacked.file(name + ".inp"));
}

TEST(Imported, GmshTutorials) {
  const fs::path folder_of_geo = "/usr/share/doc/gmsh-doc/doc/gmsh/tutorial";
  if (!fs::exists(folder_of_geo) || !runs("gmsh -version")) GTEST_SKIP() << "gmsh and gmsh-doc are not installed";
  const Folder folder;
  for (const std::string name : {"t1", "t2", "t6", "t11"}) {
    const fs::path plain = folder_of_geo / (name + ".geo"), packed = folder_of_geo / (name + ".geo.gz");
    ASSERT_TRUE(runs(fs::exists(plain) ? "cp " + plain.string() + " " + folder.file(name + ".geo")
                                       : "zcat " + packed.string() + " > " + folder.file(name + ".geo")));
    for (const int order : {1, 2}) {
      const std::string file = folder.file(fmt::format("{}_{}.msh", name, order));
      ASSERT_TRUE(
          runs(fmt::format("gmsh -2 {} -format msh41 -order {} -o {}", folder.file(name + ".geo"), order, file)));
      compare(fmt::format("{} order {}", name, order), file);
    }
  }
}

}  // namespace
}  // namespace scabo::verification
