// State of the reader: what is known so far, and one function for each section of the model file.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scabo/input/laws.hpp"
#include "scabo/input/reader.hpp"
#include "scabo/model/model.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace geometry;
using namespace model;

/// Of a mesh file: sets of sides inside a body by name, each as its chains of points.
using LinesOfFile = std::map<std::string, std::vector<std::vector<Vec2>>>;

/// What the reader knows about a body besides the Body itself. Functions that need a part that could not be read stay
/// silent, because the mistake has been reported.
struct BodyState {
  bool shape = false;    ///< the outline has been read, so that names can be looked up in it
  bool held = false;     ///< it has a support
  bool touched = false;  ///< it has a contact
  // Of a body from a mesh file (model/imported_body.hpp):
  std::map<std::string, std::vector<std::string>> pieces;  ///< of edges that are the first of several: the others
  std::set<std::string> edge_names_used;                   ///< by places, of a body with such edges
  std::set<int> edges_used;
  std::map<std::string, Vec2> lost_points;  ///< named nodes that are no corners
  LinesOfFile lines;                        ///< that a crack may follow
  std::optional<Value> added, removed;      ///< names of steps, which are read after the bodies
};

/// Position of a name in a list; models may have thousands of bodies.
using Index = std::unordered_map<std::string, int>;

/// `over` of a curve: the steps that it runs over, in their order, and where they end on it, 0 to 1.
struct CurveOver {
  struct Part {
    std::string step;
    double end = 1.0;
    int piece = -1;  ///< index in model.curves; -1: the step has not been read, or does not use it
    Source source;
  };
  std::vector<Part> parts;
  Index number;  ///< of the part of a step, by its name
};

struct Reading {
  Report report;
  Model model;
  std::vector<BodyState> bodies;        ///< as long as model.bodies
  bool materials_known = true;          ///< false: the section is missing or broken; names cannot be checked
  bool bodies_known = true;             ///< false: a body is missing from model.bodies
  bool places_known = true;             ///< false: a support or contact refers to an unknown body
  std::vector<std::string> load_names;  ///< all names of the section, broken loads included
  Index index_of_body;                  ///< in model.bodies
  Index index_of_material;              ///< in model.materials
  Index index_of_load;                  ///< in model.loads; -1 for a broken load
  /// Loads that act in a contact, by their index in model.loads, and its name: contacts are read after loads.
  std::vector<std::pair<std::size_t, Value>> loads_in_contacts;
  /// Indices in model.contacts of what every entry of the section gave.
  std::map<std::string, std::vector<int>> contacts_of_entry;
  std::set<std::string> own_support_names;  ///< given by the user
  std::vector<bool> support_is_named;       ///< for each of model.supports: its name was given by the user
  bool conditions_known = true;             ///< false: a load, support or contact is broken
  bool rigid_known = true;                  ///< false: it is not known whether a body is rigid

  Index index_of_curve;                  ///< in model.curves; not of pieces
  std::map<int, CurveOver> curves_over;  ///< curves that run over several steps, by their index
  bool curves_known = true;              ///< false: a curve is broken

  std::vector<Value> automatic_sizes;  ///< `size: auto` of meshes without a tolerance of their own

  bool all_dynamic = false;  ///< analysis: {type: dynamic}
  bool steps_known = false;  ///< true: all steps have been read
  /// `fit_in` of contacts, by their entry: the names of steps, which are read after contacts.
  std::vector<std::pair<std::string, Value>> fits_of_contacts;

  /// `added` and `removed` of every support of the model: the names of steps.
  struct Stages {
    std::optional<Value> added, removed;
  };
  std::vector<Stages> stages_of_supports;

  /// `tightened` of bars, by their index in model.bars: the names of steps.
  std::vector<std::pair<std::size_t, Value>> steps_of_bars;

  /// All texts within `contacts` and `ties`, which are read after the bodies whose sides they name.
  std::set<std::string> texts_of_contacts;

  /// Mesh files by their paths; null for a broken one, which has been reported.
  std::map<std::string, std::shared_ptr<const files::ImportedMesh>> mesh_files;

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
void read_springs(Reading& reading, const Value& value);
void read_bars(Reading& reading, const Value& value);
void read_loads(Reading& reading, const Value& value);
void read_contacts_and_ties(Reading& reading, const std::optional<Value>& properties_section,
                            const std::optional<Value>& contacts, const std::optional<Value>& ties);
/// Finds the contacts of loads that act in contacts, after both are read.
void find_contacts_of_loads(Reading& reading);
/// Before the steps, which refer to them.
void read_curves(Reading& reading, const Value& value);
/// `record` of a curve: the table of an acceleration, and Curve::record.
std::optional<CurveTable> read_record_of(Reading& reading, const Value& value, Curve& curve);
/// `growth` of a step whose factors are known, as are those of the step `before`; `supports`: those named by the user.
void read_growth(Reading& reading, const Value& value, const Index& supports, const Step& before, Step& step);
/// `limit` or `reduce` of a step that has the factors of the one before; false if it has neither.
bool read_limit(Reading& reading, const MapReader& step_map, Step& step);
/// If the section is absent, there is one step that takes everything to factor 1.
void read_steps(Reading& reading, const std::optional<Value>& value);
void read_output(Reading& reading, const Value& value);
/// Refuses `size: auto` without a wanted error, after the tolerance of the model was read.
void check_automatic_sizes(Reading& reading);
/// `tolerance: {of, relative}`.
void read_tolerance(Reading& reading, const Value& value);
/// A list of numbers that get an error bar.
void read_quantities(Reading& reading, const Value& value, std::vector<Quantity>& quantities);

/// `history` of the output: numbers and sections by name.
void read_history(Reading& reading, const Value& value);
/// `body` of a point, line or section: its index, or -1 without the key; nothing if it is broken.
std::optional<int> read_body_of(Reading& reading, const MapReader& map);

/// A rectangle whose lower left corner is `a`, with its named edges and corners.
Outline rectangle_outline(const Vec2& a, const Vec2& size, const Source& source);
/// `image` as the shape of a body, which gets its materials from it; nothing if it is broken.
std::optional<Outline> read_image(Reading& reading, const Value& value, Body& body);
/// `shape` of a body; nothing if it is broken.
std::optional<Outline> read_shape(Reading& reading, const Value& value);
/// `holes` of a body with an outline, appended to it; false if they are broken.
bool read_holes(Reading& reading, const Value& value, Outline& outline);
/// `regions`: parts of a body with other materials.
void read_regions(Reading& reading, const Value& value, Body& body);
/// `mesh` of an elastic body. `outline`: null if it is not known. `crack`: null if there is none; its tip is the
/// scaling centre.
MeshOptions read_mesh(Reading& reading, const Value& value, const Outline* outline, const Crack* crack);
/// Whether the `mesh` of a body names a file.
bool is_from_file(const std::optional<Value>& mesh);
/// A body, and what the reader knows about it.
struct ReadBody {
  Body body;
  BodyState state;
};
/// Shape, mesh and materials of an elastic body from a mesh file. `of_body`: the map of the body; `value`: its `mesh`.
/// `read` has what is known before. Several bodies, `wall_1`, `wall_2`, ..., where the cells are not all joined by
/// sides.
std::vector<ReadBody> read_imported_bodies(Reading& reading, const MapReader& of_body, const Value& value,
                                           ReadBody read);
/// `added` and `removed` of a body and its `copies` (0: none; with rows and columns `rows`, else 0): the names of
/// steps. One state for each copy; nothing if they are broken.
std::optional<std::vector<BodyState>> read_stages(Reading& reading, const MapReader& map, const BodyState& state,
                                                  std::size_t copies, std::size_t rows);
/// The steps in which bodies are added and removed, and over which interferences grow, by their names; after the steps.
void find_named_steps(Reading& reading);
/// `restart`: results of another run, whose end is the start of this one; before the steps.
void read_restart(Reading& reading, const Value& value);
/// `cracks` of a body with an outline. What could not be read is `unread`.
/// Of a body from a mesh file a path may be the name of one of the `lines` of the file.
std::vector<Crack> read_cracks(Reading& reading, const Value& value, const Body& body,
                               const LinesOfFile* lines = nullptr);
/// `refine` of a `mesh`; without an outline, edges are not looked up.
std::vector<LocalSize> read_refine(Reading& reading, const Value& value, const Outline* outline);
/// `sectors`: the material of each edge; nothing if the section is broken.
std::optional<std::vector<int>> read_sectors(Reading& reading, const Value& value, const Body& body);
/// Index into Model::materials of the material named by `value`; nothing if it does not exist.
std::optional<int> read_material_name(Reading& reading, const Value& value);

/// A place; nothing if it is broken or belongs to a broken body. `body` is its index as soon as it is known.
struct ReadPlace {
  std::optional<Place> place;
  int body = -1;
};
constexpr const char* place_example = "upper.top or {body: upper, near: [6, 3]}";
ReadPlace read_place(Reading& reading, const Value& value);
/// Warns of edges that are one of several pieces of a set while no place names another piece; after all places are
/// read.
void tell_of_pieces(Reading& reading);

/// Stands for a number that is missing or could not be read, which has been reported.
constexpr double unread = std::numeric_limits<double>::quiet_NaN();
/// A number, or `unread`.
inline double number_or_unread(Reading& reading, const std::optional<Value>& value) {
  return value ? read_number(reading.report, *value).value_or(unread) : unread;
}

}  // namespace scabo::input
