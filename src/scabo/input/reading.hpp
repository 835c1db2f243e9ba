// State of the reader: what is known so far, and one function for each section of the model file.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scabo/model/model.hpp"
#include "scabo/input/reader.hpp"

namespace scabo::input {

using namespace geometry;
using namespace model;

/// What the reader knows about a body besides the Body itself: which of its parts are valid. Functions that need an
/// invalid part stay silent, because the mistake has been reported.
struct BodyState {
  bool shape = false;     ///< the outline is valid, so that names can be looked up in it
  bool material = false;  ///< Body::material is a valid index
  bool held = false;      ///< it has a support
  bool touched = false;   ///< it has a contact
};

/// Position of a name in a list; models may have thousands of bodies.
using Index = std::unordered_map<std::string, int>;

struct Reading {
  Report report;
  Model model;
  std::vector<BodyState> bodies;            ///< as long as model.bodies
  bool materials_known = true;              ///< false: the section is missing or broken; names cannot be checked
  bool bodies_known = true;                 ///< false: a body is missing from model.bodies
  bool places_known = true;                 ///< false: a support or contact refers to an unknown body
  std::vector<std::string> material_names;  ///< all names of the section, broken materials included
  std::vector<int> material_index;          ///< of each name; -1 for a broken material
  std::vector<std::string> load_names;      ///< all names of the section, broken loads included
  Index index_of_body;                      ///< in model.bodies
  Index index_of_material;                  ///< in material_names
  Index index_of_load;                      ///< in model.loads; -1 for a broken load
  std::set<std::string> own_support_names;  ///< given by the user
  std::vector<bool> support_is_named;       ///< for each of model.supports: its name was given by the user
  bool conditions_known = true;             ///< false: a load or support is broken

  bool steps_known = false;  ///< true: all steps have been read

  int body_index(std::string_view name) const;
  BodyState& state(int body) { return bodies[static_cast<std::size_t>(body)]; }
  const Body& body(int index) const { return model.bodies[static_cast<std::size_t>(index)]; }
};

// Sections, in the order in which they are read.
void read_analysis(Reading& reading, const Value& value);
void read_solver(Reading& reading, const Value& value);
void read_output(Reading& reading, const Value& value);
void read_materials(Reading& reading, const Value& value);
void read_bodies(Reading& reading, const Value& value);
void read_supports(Reading& reading, const Value& value);
void read_loads(Reading& reading, const Value& value);
void read_contacts(Reading& reading, const Value& value);
/// If the section is absent, there is one step that takes everything to factor 1.
void read_steps(Reading& reading, const std::optional<Value>& value);
void read_output(Reading& reading, const Value& value);

/// Contact law: `friction`, `cohesion`, `tension`, `bond`, `shear_strength`.
void read_law(Reading& reading, const MapReader& map, Contact& contact);

/// `shape` of a body; nothing if it is broken.
std::optional<Outline> read_shape(Reading& reading, const Value& value);
/// `holes` of a body with a valid outline, appended to it; false if they are broken.
bool read_holes(Reading& reading, const Value& value, Outline& outline);
/// `regions`: parts of a body with other materials.
void read_regions(Reading& reading, const Value& value, Body& body, bool shape_known);
/// Reverses the direction of an outline without holes; every edge and corner keeps its names.
void turn_round(Outline& outline);
/// `mesh` of an elastic body. `outline`: null if it is not known. `crack`: null if there is none; its tip is the
/// scaling centre. `many_parts`: the body has holes or regions, so that one super-element cannot be all of it.
std::optional<MeshOptions> read_mesh(Reading& reading, const Value& value, const Outline* outline, const Crack* crack,
                                     bool many_parts = false);
/// `cracks` of a body with a valid outline; nothing if they are broken.
std::optional<std::vector<Crack>> read_cracks(Reading& reading, const Value& value, const Body& body);
/// `sectors`: the material of each edge; nothing if the section is broken.
std::optional<std::vector<int>> read_sectors(Reading& reading, const Value& value, const Body& body);
/// Index into Model::materials of the material named by `value`, or -1 if that material is broken; nothing if it does
/// not exist.
std::optional<int> read_material_name(Reading& reading, const Value& value);

/// A place; nothing if it is broken or belongs to a broken body. `body` is its index as soon as it is known.
struct ReadPlace {
  std::optional<Place> place;
  int body = -1;
};
constexpr const char* place_example = "upper.top or {body: upper, near: [6, 3]}";
ReadPlace read_place(Reading& reading, const Value& value);

// Checks that need the whole model, called after all sections have been read.
void check_conflicting_supports(Reading& reading);
void check_never_applied(Reading& reading);
void check_bodies_held(Reading& reading);
void check_something_loads(Reading& reading, const Value& root);
void check_density(Reading& reading);
void check_expansion(Reading& reading);

/// Name of an edge in messages: the name given by the user, or `edge_3`.
const std::string& shown_name(const Edge& edge);

/// `(x, y)` for messages.
std::string point_text(const Vec2& point);

}  // namespace scabo::input
