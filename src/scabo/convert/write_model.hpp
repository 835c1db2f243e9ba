// The model file of a converted deck.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/convert/remark.hpp"
#include "scabo/model/material.hpp"

namespace scabo::convert {

/// A key or name as YAML takes it for text.
std::string yaml_word(const std::string& name);
std::string yaml_quoted(const std::string& text);
/// `[x, y]`.
std::string yaml_point(const Vec2& x);

struct NamedCurve {
  std::string name;
  std::vector<std::pair<double, double>> table;  ///< [part of the step, factor]
};

/// What the model says. Texts are the lines of their sections, empty where there is none.
struct ModelParts {
  std::string title;
  double thickness = 1.0;
  model::Plane plane = model::Plane::stress;
  std::string materials, supports, loads, contacts, ties, steps;
  std::vector<NamedCurve> curves;
  std::multimap<std::string, std::string> contacts_of;  ///< names of contacts by their interaction
};

/// Adds a line of `contacts`. `between`: `between: [a, b]`. `interaction`: in upper case.
void add_contact(ModelParts& parts, const std::string& name, const std::string& between, double friction,
                 std::optional<double> modulus, const std::string& interaction, double gap = 0.0);

/// Where it comes from, what is missing, and its title.
std::string head_text(const ModelParts& parts, const Remarks& remarks, const std::string& deck_name);
/// From `supports` on.
std::string sections_text(const ModelParts& parts);

/// `mesh_name` as the model names the mesh file. Essential remarks become comments at its head.
std::string model_text(const ModelParts& parts, const DeckBodies& bodies, const Remarks& remarks,
                       const std::string& deck_name, const std::string& mesh_name);

}  // namespace scabo::convert
