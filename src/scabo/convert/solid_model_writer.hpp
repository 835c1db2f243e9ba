// The parts of a model in space as a deck of solids is written: sets of its mesh file, loads, and names that are taken.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scabo/convert/convert_abaqus.hpp"
#include "scabo/convert/deck_transforms.hpp"
#include "scabo/convert/solid_bodies_of_deck.hpp"
#include "scabo/convert/write_model.hpp"
#include "scabo/convert/write_steps.hpp"

namespace scabo::convert {

std::string yaml_vector(const std::array<double, 3>& x);

struct SolidModelWriter {
  files::AbaqusDeck deck;
  DeckContent content;
  std::map<int, NodeAxes> axes;  ///< of nodes with axes of their own
  SolidDeckBodies bodies;
  SolidDeckSets sets;
  UniqueNames names, set_names, contact_names;  ///< of loads and supports; of sets; of contacts and ties
  std::vector<Driven> driven;
  ModelParts parts;
  Conversion result;
  Remarks remarks;

  const std::string& name_of(int body) const { return bodies.bodies[static_cast<std::size_t>(body)].name; }
  int body_of_side(int side) const { return bodies.of_cell[static_cast<std::size_t>(side / 4)]; }

  /// A set of the mesh file with these members, called after a label of the deck; the same one for the same members.
  std::string set_of(std::map<std::string, std::vector<int>>& of, const std::vector<int>& members,
                     const std::string& label);
  void add_load(const std::string& label, const std::string& text, const Course& factors);
  /// One load of all components whose courses are the same but for their size.
  void add_vector_load(const std::string& label, const std::string& on, const char* kind,
                       const std::array<Course, 3>& courses);
  /// The outer sides of a surface or node set by body; a remark, and nothing, without any.
  std::map<int, std::vector<int>> surface(const std::string& name, const files::DeckPlace& at);
  /// Of a support that begins or ends after the first step; once for each label.
  void tell_stages(const Given& given);

 private:
  std::set<std::string> told_;
};

}  // namespace scabo::convert
