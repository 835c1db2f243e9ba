// A model built in code, in which every kind of part occurs.
#pragma once

#include "unit/mesh/models.hpp"

namespace scabo::test {

inline model::Place place_on(model::Place::Kind kind, int body, int index, const std::string& text) {
  return {kind, body, index, Vec2::Zero(), text, {}};
}

inline void centre_in_the_middle(model::Body& body) { body.mesh.centre = body.outline.centroid(); }

/// `upper` lies on `lower` and beside the rigid `wall`; `plate` has a crack and stands alone.
inline model::Model whole_model() {
  using Kind = model::Place::Kind;
  model::Model model;
  model::Material steel;
  steel.name = "steel";
  steel.young = 210e9;
  steel.poisson = 0.3;
  steel.density = 7850.0;
  steel.expansion = {12e-6, 12e-6, 12e-6};
  model::Material wood = steel;
  wood.name = "wood";
  model::Orthotropic law;
  law.E1 = 10e9, law.E2 = law.E3 = 1e9, law.nu12 = law.nu13 = law.nu23 = 0.2, law.G12 = 0.8e9;
  wood.law = law;
  model::Material film = steel;
  film.name = "film";
  film.law = model::Anisotropic{40e9, 3e9, 10e9, 1e9, 0.0, 5e9};
  model.materials = {steel, wood, film};

  model.bodies = {elastic("lower", rectangle({0, 0}, {2, 1}), 0.5), elastic("upper", rectangle({0, 1}, {2, 1}), 0.5),
                  elastic("plate", rectangle({5, 0}, {2, 2}), 0.5), rigid("wall", rectangle({2, 1}, {1, 1}))};
  for (model::Body& body : model.bodies) {
    for (std::size_t i = 0; i < 4; ++i) body.outline.corners[i].names = {"corner_" + std::to_string(i)};
    centre_in_the_middle(body);
    body.mesh.source = {};
  }
  model.bodies[1].material = 1;
  model::Crack crack;
  crack.name = "flaw";
  crack.mouth = {5, 1};
  crack.tip = model.bodies[2].mesh.centre = {6, 1};
  crack.edge = 3;
  crack.at = 0.5;
  model.bodies[2].cracks = {crack};
  model.bodies[2].sector_materials = {0, 0, 2, 0};

  const auto support = [&](const std::string& name, const model::Place& on) {
    model::Support made;
    made.name = name;
    made.on = on;
    made.displacement = {0.0, 0.0};
    model.supports.push_back(made);
  };
  support("lower.bottom", place_on(Kind::edge, 0, 0, "lower.bottom"));
  support("plate.bottom", place_on(Kind::edge, 2, 0, "plate.bottom"));
  support("wall", place_on(Kind::body, 3, -1, "wall"));

  const auto load = [&](const std::string& name, const std::optional<model::Place>& on, auto kind) {
    model::Load made;
    made.name = name;
    made.on = on;
    made.kind = kind;
    model.loads.push_back(made);
  };
  load("weight", {}, model::Gravity{{0, -9.81}});
  load("press", place_on(Kind::edge, 1, 2, "upper.top"), model::Pressure{1e3});
  load("pull", place_on(Kind::edge, 2, 2, "plate.top"), model::Traction{{0, 1e3}});
  load("point", place_on(Kind::corner, 1, 3, "upper.corner_3"), model::Force{{10, 0}});
  load("warm", place_on(Kind::body, 0, -1, "lower"), model::Temperature{{1.0, 0.1, 0.0}});
  load("field", place_on(Kind::body, 0, -1, "lower"), model::BodyForce{{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}});
  model::FaceTraction face;
  face.pressure = true;
  face.terms = {{0.0, {10, 0}}, {1.5, {5, 0}}};
  load("inside", place_on(Kind::face, 2, 0, "plate.flaw.right"), face);

  const auto contact = [&](const std::string& name, const std::string& a, const std::string& edge_a,
                           const std::string& b, const std::string& edge_b) {
    model::Contact made;
    made.name = name;
    made.a = edge_of(model, a, edge_a);
    made.b = edge_of(model, b, edge_b);
    model.contacts.push_back(made);
  };
  contact("joint", "lower", "top", "upper", "bottom");
  contact("side", "upper", "right", "wall", "left");
  model.contacts[0].friction = 0.5;

  model::Step step;
  step.name = "step_1";
  step.load_factors.assign(model.loads.size(), 1.0);
  step.support_factors.assign(model.supports.size(), 1.0);
  model.steps = {step};

  model.output.points = {{"crest", {1, 1.5}, 1, {}}};
  model.output.lines = {{"axis", {0, 0.5}, {2, 0.5}, 11, 0, {}}};
  model::OutputGrid grid;
  grid.low = {0.5, 0.25}, grid.high = {1.5, 0.75}, grid.counts = {3, 2}, grid.body = 0;
  model.output.grid = grid;
  return model;
}

}  // namespace scabo::test
