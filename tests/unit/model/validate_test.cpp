// Models built in code: a sound one passes, and every single mistake is found, at its path, once.
#include "scabo/model/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "unit/model/models.hpp"

namespace scabo::model {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Kind = Place::Kind;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

std::string all_of(const std::vector<Mistake>& mistakes) {
  std::string all;
  for (const Mistake& mistake : mistakes) all += mistake.at.path + ": " + mistake.message + '\n';
  return all;
}

TEST(Validate, ASoundModelHasNoMistakes) {
  EXPECT_EQ(all_of(validate(test::whole_model())), "");
  EXPECT_NO_THROW(require_valid(test::whole_model()));
}

struct Mutation {
  const char* name;
  std::function<void(Model&)> apply;
  const char* path;
};

Orthotropic& wood(Model& m) { return std::get<Orthotropic>(*m.materials[1].law); }
Anisotropic& film(Model& m) { return std::get<Anisotropic>(*m.materials[2].law); }
template <typename T>
T& load(Model& m, std::size_t i) {
  return std::get<T>(m.loads[i].kind);
}
void make_fem(Body& body) { body.mesh.kind = MeshKind::fem; }
/// A hole on the left of whose edges the material lies.
void add_hole(Body& body, const Vec2& centre, double radius) {
  Edge rim = test::arc("bore", centre, radius, 0.0, -2.0 * test::pi);
  rim.end = rim.start;
  body.outline.holes.push_back(static_cast<int>(body.outline.edges.size()));
  body.outline.edges.push_back(rim);
  body.outline.corners.push_back({{"bore_start"}, rim.start});
  body.outline.rectangle = false;
  body.mesh.kind = MeshKind::polygons;
}
Region region(const std::string& name, const Vec2& corner, const Vec2& size) {
  Region made;
  made.name = name;
  made.material = 1;
  made.outline = test::rectangle(corner, size);
  return made;
}

std::vector<Mutation> mutations() {
  return {
      // analysis and solver
      {"thickness_zero", [](Model& m) { m.analysis.thickness = 0.0; }, "analysis.thickness"},
      {"thickness_nan", [](Model& m) { m.analysis.thickness = nan; }, "analysis.thickness"},
      {"modes_zero", [](Model& m) { m.analysis.modes = 0; }, "analysis.modes"},
      {"tolerance_zero", [](Model& m) { m.solver.tolerance = 0.0; }, "solver.tolerance"},
      {"tolerance_nan", [](Model& m) { m.solver.tolerance = nan; }, "solver.tolerance"},
      {"tolerance_large", [](Model& m) { m.solver.tolerance = 1.0; }, "solver.tolerance"},
      {"iterations_zero", [](Model& m) { m.solver.iterations = 0; }, "solver.iterations"},
      {"halvings_negative", [](Model& m) { m.solver.halvings = -1; }, "solver.halvings"},
      // materials
      {"young_zero", [](Model& m) { m.materials[0].young = 0.0; }, "materials.steel.young"},
      {"young_negative", [](Model& m) { m.materials[0].young = -1.0; }, "materials.steel.young"},
      {"young_infinite", [](Model& m) { m.materials[0].young = inf; }, "materials.steel.young"},
      {"young_too_large", [](Model& m) { m.materials[0].young = 1e200; }, "materials.steel.young"},
      {"poisson_large", [](Model& m) { m.materials[0].poisson = 0.51; }, "materials.steel.poisson"},
      {"poisson_minus_one", [](Model& m) { m.materials[0].poisson = -1.0; }, "materials.steel.poisson"},
      {"poisson_nan", [](Model& m) { m.materials[0].poisson = nan; }, "materials.steel.poisson"},
      {"poisson_plane_strain", [](Model& m) { m.analysis.plane = Plane::strain, m.materials[0].poisson = 0.5; },
       "materials.steel.poisson"},
      {"density_negative", [](Model& m) { m.materials[0].density = -1.0; }, "materials.steel.density"},
      {"density_nan", [](Model& m) { m.materials[0].density = nan; }, "materials.steel.density"},
      {"density_missing", [](Model& m) { m.materials[1].density.reset(); }, "materials.wood"},
      {"density_missing_modal", [](Model& m) { m.analysis.type = AnalysisType::modal, m.materials[1].density.reset(); },
       "materials.wood"},
      {"density_zero_modal", [](Model& m) { m.analysis.type = AnalysisType::modal, m.materials[1].density = 0.0; },
       "materials.wood"},
      {"expansion_infinite", [](Model& m) { m.materials[0].expansion->at(1) = inf; }, "materials.steel.expansion.1"},
      {"expansion_missing", [](Model& m) { m.materials[0].expansion.reset(); }, "materials.steel"},
      {"E1_negative", [](Model& m) { wood(m).E1 = -1.0; }, "materials.wood.orthotropic.E1"},
      {"E2_nan", [](Model& m) { wood(m).E2 = nan; }, "materials.wood.orthotropic.E2"},
      {"E3_zero", [](Model& m) { wood(m).E3 = 0.0; }, "materials.wood.orthotropic.E3"},
      {"G12_zero", [](Model& m) { wood(m).G12 = 0.0; }, "materials.wood.orthotropic.G12"},
      {"nu12_large", [](Model& m) { wood(m).nu12 = 4.0; }, "materials.wood.orthotropic.nu12"},
      {"nu13_large", [](Model& m) { wood(m).nu13 = 4.0; }, "materials.wood.orthotropic"},
      {"angle_nan", [](Model& m) { wood(m).angle = nan; }, "materials.wood.orthotropic.angle"},
      {"D11_zero", [](Model& m) { film(m).D11 = 0.0; }, "materials.film.anisotropic.D11"},
      {"D16_nan", [](Model& m) { film(m).D16 = nan; }, "materials.film.anisotropic.D16"},
      {"D12_large", [](Model& m) { film(m).D12 = 40e9; }, "materials.film.anisotropic"},
      {"material_name_empty", [](Model& m) { m.materials[2].name = ""; }, "materials.2"},
      {"material_name_twice", [](Model& m) { m.materials[2].name = "steel"; }, "materials.steel"},
      // bodies
      {"body_name_with_a_dot", [](Model& m) { m.bodies[0].name = "a.b"; }, "bodies.a.b"},
      {"body_name_twice", [](Model& m) { m.bodies[1].name = "lower"; }, "bodies.lower"},
      {"material_unknown", [](Model& m) { m.bodies[0].material = 3; }, "bodies.lower.material"},
      {"material_negative", [](Model& m) { m.bodies[0].material = -1; }, "bodies.lower.material"},
      {"material_of_a_rigid_body", [](Model& m) { m.bodies[3].material = 0; }, "bodies.wall.material"},
      {"size_zero", [](Model& m) { m.bodies[1].mesh.size = 0.0; }, "bodies.upper.mesh.size"},
      {"size_nan", [](Model& m) { m.bodies[1].mesh.size = nan; }, "bodies.upper.mesh.size"},
      {"size_infinite", [](Model& m) { m.bodies[1].mesh.size = inf; }, "bodies.upper.mesh.size"},
      {"size_tiny", [](Model& m) { m.bodies[1].mesh.size = 1e-9; }, "bodies.upper.mesh.size"},
      {"order_zero", [](Model& m) { m.bodies[1].mesh.order = 0; }, "bodies.upper.mesh.order"},
      {"order_17", [](Model& m) { m.bodies[1].mesh.order = 17; }, "bodies.upper.mesh.order"},
      {"order_of_fem", [](Model& m) { make_fem(m.bodies[1]), m.bodies[1].mesh.order = 3; }, "bodies.upper.mesh.order"},
      {"sectors_of_polygons",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::polygons;
         m.bodies[1].sector_materials = {0, 0, 0, 0};
       },
       "bodies.upper.sectors"},
      {"mesh_tolerance_nan", [](Model& m) { m.bodies[1].mesh.tolerance = nan; }, "bodies.upper.mesh.tolerance"},
      {"mesh_tolerance_small", [](Model& m) { m.bodies[1].mesh.tolerance = 1e-9; }, "bodies.upper.mesh.tolerance"},
      {"refine_size",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::polygons;
         m.bodies[1].mesh.refine = {{Vec2(0, 1), -1, 0.0, {}}};
       },
       "bodies.upper.mesh.refine.0.size"},
      {"refine_edge",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::quadtree;
         m.bodies[1].mesh.refine = {{{}, 4, 0.1, {}}};
       },
       "bodies.upper.mesh.refine.0.on"},
      {"centre_nan",
       [](Model& m) {
         m.bodies[1].mesh.centre = {nan, 0.0};
       },
       "bodies.upper.mesh.centre.0"},
      {"centre_outside",
       [](Model& m) {
         m.bodies[1].mesh.centre = {9, 9};
       },
       "bodies.upper.mesh.centre"},
      {"centre_on_an_edge",
       [](Model& m) {
         m.bodies[1].mesh.centre = {1, 1};
       },
       "bodies.upper.mesh.centre"},
      {"centre_corner_unknown", [](Model& m) { m.bodies[1].mesh.centre_corner = 4; }, "bodies.upper.mesh.centre"},
      {"centre_corner_negative", [](Model& m) { m.bodies[1].mesh.centre_corner = -2; }, "bodies.upper.mesh.centre"},
      {"centre_corner_elsewhere", [](Model& m) { m.bodies[1].mesh.centre_corner = 2; }, "bodies.upper.mesh.centre"},
      // outlines
      {"outline_empty", [](Model& m) { m.bodies[1].outline = {}; }, "bodies.upper.shape"},
      {"outline_of_one_edge",
       [](Model& m) { m.bodies[1].outline.edges.resize(1), m.bodies[1].outline.corners.resize(1); },
       "bodies.upper.shape"},
      {"corner_missing", [](Model& m) { m.bodies[1].outline.corners.pop_back(); }, "bodies.upper.shape"},
      {"corner_elsewhere", [](Model& m) { m.bodies[1].outline.corners[2].position.x() += 0.1; },
       "bodies.upper.shape.top"},
      {"corner_nan", [](Model& m) { m.bodies[1].outline.corners[2].position.x() = nan; }, "bodies.upper.shape.top"},
      {"vertex_nan", [](Model& m) { m.bodies[1].outline.edges[1].end.x() = nan; }, "bodies.upper.shape.right"},
      {"vertex_infinite", [](Model& m) { m.bodies[1].outline.edges[1].start.y() = inf; }, "bodies.upper.shape.right"},
      {"edge_without_name", [](Model& m) { m.bodies[1].outline.edges[1].names.clear(); }, "bodies.upper.shape.edge_2"},
      {"corner_without_name", [](Model& m) { m.bodies[1].outline.corners[1].names.clear(); },
       "bodies.upper.shape.right"},
      {"edge_name_twice", [](Model& m) { m.bodies[1].outline.edges[1].names.push_back("top"); },
       "bodies.upper.shape.right.name"},
      {"not_closed", [](Model& m) { m.bodies[1].outline.edges[1].end.x() += 0.5; }, "bodies.upper.shape.top"},
      {"clockwise", [](Model& m) { turn_round(m.bodies[1].outline), m.bodies[1].outline.rectangle = false; },
       "bodies.upper.shape"},
      {"no_extent",
       [](Model& m) {
         m.bodies[1].outline = test::rectangle({0, 0}, {0, 0});
       },
       "bodies.upper.shape"},
      {"too_large",
       [](Model& m) {
         m.bodies[1].outline = test::rectangle({0, 0}, {1e40, 1e40});
       },
       "bodies.upper.shape"},
      {"far_away",
       [](Model& m) {
         m.bodies[1].outline = test::rectangle({1e12, 0}, {1, 1});
       },
       "bodies.upper.shape"},
      {"flat",
       [](Model& m) {
         m.bodies[1].outline = test::rectangle({0, 0}, {1, 0});
       },
       "bodies.upper.shape.right"},
      {"bow_tie",
       [](Model& m) {
         m.bodies[1].outline = test::polygon({{0, 0}, {1, 1}, {1, 0}, {0, 2}}, {"a", "b", "c", "d"});
       },
       "bodies.upper.shape"},
      {"no_rectangle",
       [](Model& m) {
         m.bodies[1].outline = test::polygon({{0, 1}, {2, 1}, {2.5, 2}, {0, 2}}, {"bottom", "right", "top", "left"});
         m.bodies[1].outline.rectangle = true;
       },
       "bodies.upper.shape"},
      {"arc_radius",
       [](Model& m) {
         m.bodies[1].outline.edges[1].arc = Arc{{2, 1.5}, 0.4, -test::pi / 2, test::pi};
       },
       "bodies.upper.shape.right.arc"},
      {"arc_nan",
       [](Model& m) {
         m.bodies[1].outline.edges[1].arc = Arc{{2, 1.5}, 0.5, nan, test::pi};
       },
       "bodies.upper.shape.right"},
      {"arc_no_sweep",
       [](Model& m) {
         m.bodies[1].outline.edges[1].arc = Arc{{2, 1.5}, 0.5, -test::pi / 2, 0.0};
       },
       "bodies.upper.shape.right.arc"},
      {"arc_centre",
       [](Model& m) {
         m.bodies[1].outline.edges[1].arc = Arc{{2, 1.7}, 0.5, -test::pi / 2, test::pi};
       },
       "bodies.upper.shape.right.arc.centre"},
      // holes and regions
      {"hole_in_one_super_element",
       [](Model& m) {
         add_hole(m.bodies[1], {1, 1.5}, 0.2), m.bodies[1].mesh.kind = MeshKind::superelement;
       },
       "bodies.upper.mesh"},
      {"hole_crosses",
       [](Model& m) {
         add_hole(m.bodies[1], {1, 1.5}, 0.6);
       },
       "bodies.upper.holes.0"},
      {"hole_outside",
       [](Model& m) {
         add_hole(m.bodies[1], {1, 8}, 0.2);
       },
       "bodies.upper.holes.0"},
      {"hole_without_edges",
       [](Model& m) { m.bodies[1].mesh.kind = MeshKind::polygons, m.bodies[1].outline.holes = {4}; },
       "bodies.upper.shape"},
      {"hole_negative", [](Model& m) { m.bodies[1].mesh.kind = MeshKind::polygons, m.bodies[1].outline.holes = {-1}; },
       "bodies.upper.shape"},
      {"region_in_one_super_element",
       [](Model& m) {
         m.bodies[1].regions = {region("core", {0.5, 1.2}, {0.5, 0.5})};
       },
       "bodies.upper.mesh"},
      {"region_outside",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::polygons;
         m.bodies[1].regions = {region("core", {7, 7}, {0.5, 0.5})};
       },
       "bodies.upper.regions.core.shape"},
      {"region_without_material",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::polygons;
         m.bodies[1].regions = {region("core", {0.5, 1.2}, {0.5, 0.5})};
         m.bodies[1].regions[0].material = 9;
       },
       "bodies.upper.regions.core.material"},
      {"regions_cross",
       [](Model& m) {
         m.bodies[1].mesh.kind = MeshKind::polygons;
         m.bodies[1].regions = {region("core", {0.5, 1.2}, {0.5, 0.5}), region("rod", {0.75, 1.3}, {0.5, 0.5})};
       },
       "bodies.upper.regions.rod.shape"},
      // cracks, sectors, unbounded bodies
      {"cracks_two", [](Model& m) { m.bodies[2].cracks.push_back(m.bodies[2].cracks[0]); }, "bodies.plate.cracks.1"},
      {"crack_edge", [](Model& m) { m.bodies[2].cracks[0].edge = 4; }, "bodies.plate.cracks.0.mouth"},
      {"crack_at", [](Model& m) { m.bodies[2].cracks[0].at = 1.0; }, "bodies.plate.cracks.0.mouth"},
      {"crack_mouth_elsewhere", [](Model& m) { m.bodies[2].cracks[0].at = 0.25; }, "bodies.plate.cracks.0.mouth"},
      {"crack_mouth_nan", [](Model& m) { m.bodies[2].cracks[0].mouth.y() = nan; }, "bodies.plate.cracks.0.mouth.1"},
      {"crack_tip_outside", [](Model& m) { m.bodies[2].cracks[0].tip.x() = 9.0; }, "bodies.plate.cracks.0.tip"},
      {"crack_tip_not_centre", [](Model& m) { m.bodies[2].mesh.centre.x() = 6.1; }, "bodies.plate.mesh.centre"},
      {"crack_named_like_an_edge", [](Model& m) { m.bodies[2].cracks[0].name = "top"; }, "bodies.plate.cracks.0"},
      {"crack_without_name", [](Model& m) { m.bodies[2].cracks[0].name = ""; }, "bodies.plate.cracks.0.name"},
      {"sectors_few", [](Model& m) { m.bodies[2].sector_materials.pop_back(); }, "bodies.plate.sectors"},
      {"sector_unknown", [](Model& m) { m.bodies[2].sector_materials[2] = 7; }, "bodies.plate.sectors.top"},
      {"reference_inside", [](Model& m) { m.bodies[1].reference = Vec2(1, 1); }, "bodies.upper.reference"},
      // supports
      {"support_body", [](Model& m) { m.supports[0].on.body = 4; }, "supports.0.on"},
      {"support_body_negative", [](Model& m) { m.supports[0].on.body = -1; }, "supports.0.on"},
      {"support_edge", [](Model& m) { m.supports[0].on.index = 4; }, "supports.0.on"},
      {"support_edge_negative", [](Model& m) { m.supports[0].on.index = -1; }, "supports.0.on"},
      {"support_corner", [](Model& m) { m.supports[0].on = test::place_on(Kind::corner, 0, 17, "lower.x"); },
       "supports.0.on"},
      {"support_face", [](Model& m) { m.supports[1].on = test::place_on(Kind::face, 2, 2, "f"); }, "supports.1.on"},
      {"support_mouth", [](Model& m) { m.supports[1].on = test::place_on(Kind::mouth, 2, 2, "f"); }, "supports.1.on"},
      {"support_near_nan",
       [](Model& m) {
         m.supports[0].on.kind = Kind::near, m.supports[0].on.near = {nan, 0};
       },
       "supports.0.on.near.0"},
      {"support_near_far",
       [](Model& m) {
         m.supports[0].on.kind = Kind::near, m.supports[0].on.near = {99, 0};
       },
       "supports.0.on.near"},
      {"support_free", [](Model& m) { m.supports[0].displacement = {}; }, "supports.0.displacement"},
      {"support_nan", [](Model& m) { m.supports[0].displacement[1] = nan; }, "supports.0.displacement.1"},
      {"support_unnamed", [](Model& m) { m.supports[0].name = ""; }, "supports.0.name"},
      {"support_name_twice", [](Model& m) { m.supports[1].name = "wall"; }, "supports.2.name"},
      {"supports_in_conflict",
       [](Model& m) {
         m.supports[1].on = test::place_on(Kind::corner, 2, 0, "plate.corner_0");
         m.supports.push_back(m.supports[1]);
         m.supports.back().name = "pull";
         m.loads[2].name = "tear";
         m.supports.back().displacement = {1.0, {}};
         m.steps[0].support_factors.push_back(1.0);
       },
       "supports.3"},
      {"body_unsupported",
       [](Model& m) {
         m.supports.erase(m.supports.begin() + 1);
         m.steps[0].support_factors.pop_back();
       },
       "bodies.plate"},
      // loads
      {"load_name", [](Model& m) { m.loads[1].name = "1st"; }, "loads.1st"},
      {"load_name_twice", [](Model& m) { m.loads[1].name = "pull"; }, "loads.pull"},
      {"load_named_like_a_support", [](Model& m) { m.supports[1].name = "pull"; }, "loads.pull"},
      {"load_without_place", [](Model& m) { m.loads[1].on.reset(); }, "loads.press"},
      {"load_on_no_body", [](Model& m) { m.loads[1].on->body = 9; }, "loads.press.on"},
      {"load_on_no_edge", [](Model& m) { m.loads[1].on->index = 9; }, "loads.press.on"},
      {"pressure_nan", [](Model& m) { load<Pressure>(m, 1).value = nan; }, "loads.press.pressure"},
      {"pressure_on_a_corner", [](Model& m) { m.loads[1].on = test::place_on(Kind::corner, 1, 0, "upper.c"); },
       "loads.press.on"},
      {"traction_infinite", [](Model& m) { load<Traction>(m, 2).value.y() = inf; }, "loads.pull.traction.1"},
      {"traction_on_a_face", [](Model& m) { m.loads[2].on = test::place_on(Kind::face, 2, 1, "plate.flaw.left"); },
       "loads.pull.traction"},
      {"force_nan", [](Model& m) { load<Force>(m, 3).value.x() = nan; }, "loads.point.force.0"},
      {"force_on_a_body", [](Model& m) { m.loads[3].on = test::place_on(Kind::body, 1, -1, "upper"); },
       "loads.point.on"},
      {"gravity_nan", [](Model& m) { load<Gravity>(m, 0).value.x() = nan; }, "loads.weight.gravity.0"},
      {"gravity_on_the_wall", [](Model& m) { m.loads[0].on = test::place_on(Kind::body, 3, -1, "wall"); },
       "loads.weight.on"},
      {"temperature_nan", [](Model& m) { load<Temperature>(m, 4).change.per_x = nan; }, "loads.warm.temperature.x"},
      {"temperature_on_the_wall", [](Model& m) { m.loads[4].on = test::place_on(Kind::body, 3, -1, "wall"); },
       "loads.warm.on"},
      {"body_force_nan", [](Model& m) { load<BodyForce>(m, 5).y.per_y = inf; }, "loads.field.body_force.y"},
      {"powers_none", [](Model& m) { load<FaceTraction>(m, 6).terms.clear(); }, "loads.inside.pressure"},
      {"power_minus_one", [](Model& m) { load<FaceTraction>(m, 6).terms[0].power = -1.0; },
       "loads.inside.pressure.powers.-1"},
      {"power_nan", [](Model& m) { load<FaceTraction>(m, 6).terms[0].power = nan; },
       "loads.inside.pressure.powers.nan"},
      {"power_twice", [](Model& m) { load<FaceTraction>(m, 6).terms[0].power = 1.5; },
       "loads.inside.pressure.powers.1.5"},
      {"powers_on_an_edge", [](Model& m) { m.loads[6].on = test::place_on(Kind::edge, 2, 2, "plate.top"); },
       "loads.inside.pressure"},
      {"face_of_a_closed_body", [](Model& m) { m.loads[6].on = test::place_on(Kind::face, 1, 0, "upper.f"); },
       "loads.inside.on"},
      {"face_unknown", [](Model& m) { m.loads[6].on->index = 2; }, "loads.inside.on"},
      // contacts
      {"friction_negative", [](Model& m) { m.contacts[0].friction = -0.1; }, "contacts.joint.friction"},
      {"friction_nan", [](Model& m) { m.contacts[0].friction = nan; }, "contacts.joint.friction"},
      {"friction_large", [](Model& m) { m.contacts[0].friction = 1e7; }, "contacts.joint.friction"},
      {"dynamic_above_static", [](Model& m) { m.contacts[0].dynamic_friction = 0.9; },
       "contacts.joint.friction.dynamic"},
      {"slip_distance_negative",
       [](Model& m) { m.contacts[0].dynamic_friction = 0.1, m.contacts[0].slip_distance = -1.0; },
       "contacts.joint.friction.slip_distance"},
      {"along_outside",
       [](Model& m) {
         m.contacts[0].friction_along = {{0, 0.1}, {2, 0.1}};
       },
       "contacts.joint.friction.along.1"},
      {"along_not_ascending",
       [](Model& m) {
         m.contacts[0].friction_along = {{1, 0.1}, {0, 0.1}};
       },
       "contacts.joint.friction.along.1"},
      {"along_nan",
       [](Model& m) {
         m.contacts[0].friction_along = {{0, nan}};
       },
       "contacts.joint.friction.along.0"},
      {"cohesion_negative", [](Model& m) { m.contacts[0].cohesion = -1.0; }, "contacts.joint.cohesion"},
      {"tension_nan", [](Model& m) { m.contacts[0].tension = nan; }, "contacts.joint.tension"},
      {"tension_without_cohesion", [](Model& m) { m.contacts[0].tension = 1.0; }, "contacts.joint.tension"},
      {"bond_with_friction", [](Model& m) { m.contacts[0].bond = true; }, "contacts.joint.friction"},
      {"bond_with_gap",
       [](Model& m) { m.contacts[0].bond = true, m.contacts[0].friction = 0.0, m.contacts[0].gap = 1.0; },
       "contacts.joint.gap"},
      {"shear_strength_and_friction", [](Model& m) { m.contacts[0].shear_strength = 1.0; }, "contacts.joint.friction"},
      {"shear_strength_negative", [](Model& m) { m.contacts[0].friction = 0.0, m.contacts[0].shear_strength = -1.0; },
       "contacts.joint.shear_strength"},
      {"gap_infinite", [](Model& m) { m.contacts[0].gap = inf; }, "contacts.joint.gap"},
      {"contact_of_no_body", [](Model& m) { m.contacts[1].b.body = 5; }, "contacts.side.between.1"},
      {"contact_of_no_edge", [](Model& m) { m.contacts[1].b.index = 5; }, "contacts.side.between.1"},
      {"contact_of_a_corner", [](Model& m) { m.contacts[1].b.kind = Kind::corner; }, "contacts.side.between.1"},
      {"contact_with_itself", [](Model& m) { m.contacts[0].a = test::edge_of(m, "upper", "top"); },
       "contacts.joint.between"},
      {"contact_twice", [](Model& m) { m.contacts.push_back(m.contacts[0]), m.contacts[2].name = "again"; },
       "contacts.again"},
      {"contact_name_twice", [](Model& m) { m.contacts[1].name = "joint"; }, "contacts.joint"},
      {"wall_in_no_contact", [](Model& m) { m.contacts.pop_back(); }, "bodies.wall"},
      // steps
      {"steps_none", [](Model& m) { m.steps.clear(); }, "steps"},
      {"increments_zero", [](Model& m) { m.steps[0].increments = 0; }, "steps.0.increments"},
      {"step_name", [](Model& m) { m.steps[0].name = ""; }, "steps.0.name"},
      {"step_name_twice", [](Model& m) { m.steps.push_back(m.steps[0]); }, "steps.1"},
      {"load_factors_few", [](Model& m) { m.steps[0].load_factors.pop_back(); }, "steps.0"},
      {"support_factors_many", [](Model& m) { m.steps[0].support_factors.push_back(1.0); }, "steps.0"},
      {"factor_nan", [](Model& m) { m.steps[0].load_factors[0] = nan; }, "steps.0.loads"},
      {"load_never_applied", [](Model& m) { m.steps[0].load_factors[3] = 0.0; }, "loads.point"},
      {"support_never_applied", [](Model& m) { m.steps[0].support_factors[1] = 0.0; }, "supports.1"},
      {"no_loading", [](Model& m) { m.loads.clear(), m.steps[0].load_factors.clear(); }, "loads"},
      // output
      {"point_nan", [](Model& m) { m.output.points[0].at.x() = nan; }, "output.points.0.at.0"},
      {"point_body", [](Model& m) { m.output.points[0].body = 4; }, "output.points.0.body"},
      {"point_name", [](Model& m) { m.output.points[0].name = "a b"; }, "output.points.0.name"},
      {"line_points", [](Model& m) { m.output.lines[0].points = 1; }, "output.lines.0.points"},
      {"line_without_length", [](Model& m) { m.output.lines[0].to = m.output.lines[0].from; }, "output.lines.0"},
      {"line_infinite", [](Model& m) { m.output.lines[0].to.y() = inf; }, "output.lines.0.to.1"},
      {"grid_counts", [](Model& m) { m.output.grid->counts[1] = 0; }, "output.grid.y.2"},
      {"grid_spacing", [](Model& m) { m.output.grid->spacing = 0.0; }, "output.grid.spacing"},
      {"grid_too_many",
       [](Model& m) {
         m.output.grid->counts = {10'000, 10'000};
       },
       "output.grid"},
      {"grid_body", [](Model& m) { m.output.grid->body = -2; }, "output.grid.body"},
      {"every_zero", [](Model& m) { m.output.every = 0; }, "output.every"},
  };
}

class Mutated : public testing::TestWithParam<Mutation> {};

TEST_P(Mutated, IsFoundOnceAtItsPath) {
  Model model = test::whole_model();
  GetParam().apply(model);
  const std::vector<Mistake> mistakes = validate(model);
  ASSERT_EQ(mistakes.size(), 1u) << all_of(mistakes);
  EXPECT_EQ(mistakes[0].at.path, GetParam().path) << mistakes[0].message;
  EXPECT_EQ(mistakes[0].at.line, 0);
  try {
    require_valid(model);
    FAIL() << "is accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), std::string("model: ") + GetParam().path + ": " + mistakes[0].message);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Mutated, testing::ValuesIn(mutations()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Validate, TakesHolesAndRegions) {
  Model model = test::whole_model();
  add_hole(model.bodies[1], {1.5, 1.5}, 0.2);
  model.bodies[1].regions = {region("core", {0.3, 1.2}, {0.6, 0.6}), region("rod", {0.5, 1.4}, {0.2, 0.2})};
  EXPECT_EQ(all_of(validate(model)), "");
}

TEST(Validate, TellsManyMistakesAtOnce) {
  Model model = test::whole_model();
  model.materials[0].young = 0.0;
  model.bodies[1].mesh.order = 17;
  model.contacts[0].friction = -1.0;
  EXPECT_EQ(all_of(validate(model)),
            "materials.steel.young: must be greater than 0, not 0\n"
            "bodies.upper.mesh.order: must be a whole number from 1 to 16, not 17\n"
            "contacts.joint.friction: must be 0 or more, not -1\n");
}

}  // namespace
}  // namespace scabo::model
