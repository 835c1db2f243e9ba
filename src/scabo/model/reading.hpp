// The model file being read: what is known so far, and one function for each section of the file.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scabo/model/model.hpp"
#include "scabo/model/reader.hpp"

namespace scabo::model {

/// What the reader knows about a body beyond the Body: whether its parts can be relied upon. Whoever needs a
/// part that is not there stays silent, since the mistake is reported already.
struct BodyState {
  bool shape = false;     ///< the outline is complete and names can be looked up in it
  bool material = false;  ///< Body::material is an index
  bool held = false;      ///< a support names it
  bool touched = false;   ///< a contact names it
};

/// Place of a name in a list: models have thousands of bodies.
using Index = std::unordered_map<std::string, int>;

struct Reading {
  Report report;
  Model model;
  std::vector<BodyState> bodies;            ///< as long as model.bodies
  bool materials_known = true;              ///< false: no section, or a broken one: names cannot be checked
  bool bodies_known = true;                 ///< false: some body is not in model.bodies
  bool places_known = true;                 ///< false: some support or contact names a body that is not known
  std::vector<std::string> material_names;  ///< of the section, broken ones included
  std::vector<int> material_index;          ///< of each name; -1 for a broken one
  std::vector<std::string> load_names;      ///< of the section, broken ones included
  Index index_of_body;                      ///< in model.bodies
  Index index_of_material;                  ///< in material_names
  Index index_of_load;                      ///< in model.loads; -1 for a broken one
  std::set<std::string> own_support_names;  ///< given by the user
  std::vector<bool> support_is_named;       ///< for each of model.supports: has its name from the user
  bool conditions_known = true;             ///< false: some load or support is broken

  bool steps_known = false;  ///< true: every step has its factors

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
/// Without a section (nothing): one step that takes everything to factor 1.
void read_steps(Reading& reading, const std::optional<Value>& value);
void read_output(Reading& reading, const Value& value);

/// What a contact carries: `friction`, `cohesion`, `tension`, `bond`, `shear_strength`.
void read_law(Reading& reading, const MapReader& map, Contact& contact);

/// `shape` of a body; nothing when it is broken.
std::optional<Outline> read_shape(Reading& reading, const Value& value);
/// The same outline run the other way round; every edge and corner keeps its names.
void turn_round(Outline& outline);
/// `mesh` of an elastic body whose outline is known, or not (nullptr); `crack`: its tip is the scaling centre.
std::optional<MeshOptions> read_mesh(Reading& reading, const Value& value, const Outline* outline, const Crack* crack);
/// `cracks` of a body whose outline is known; nothing when they are broken.
std::optional<std::vector<Crack>> read_cracks(Reading& reading, const Value& value, const Body& body);
/// `sectors`: a material for each edge; nothing when it is broken.
std::optional<std::vector<int>> read_sectors(Reading& reading, const Value& value, const Body& body);
/// Index into Model::materials of the material that `value` names, -1 for a broken one; nothing when there is none.
std::optional<int> read_material_name(Reading& reading, const Value& value);

/// A place; nothing when it is broken or names a part of a broken body. `body` is its index as soon as that
/// much is known.
struct ReadPlace {
  std::optional<Place> place;
  int body = -1;
};
constexpr const char* place_example = "upper.top or {body: upper, near: [6, 3]}";
ReadPlace read_place(Reading& reading, const Value& value);

// What only the whole model shows; called when every section was read.
void check_conflicting_supports(Reading& reading);
void check_never_applied(Reading& reading);
void check_bodies_held(Reading& reading);
void check_something_loads(Reading& reading, const Value& root);
void check_density(Reading& reading);
void check_expansion(Reading& reading);

/// What messages call an edge: the user's own name for it, or `edge_3`.
const std::string& shown_name(const Edge& edge);

/// `(x, y)` for messages.
std::string point_text(const Vec2& point);

}  // namespace scabo::model
