// State of a validation, and one function for each part of a model (validate.cpp calls them in this order).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/validate.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::model {

/// Paths are given in two parts, joined by a dot, so that they are put together only for a mistake.
class Checking {
 public:
  Checking(const Model& checked, const Gaps& reader_gaps);

  const Model& model;
  Gaps gaps;                   ///< those of the reader, and parts that turned out to be wrong
  std::vector<char> shape;     ///< per body: its outline is sound
  std::vector<char> faces;     ///< per body: its cracks and side faces are sound
  std::vector<char> held;      ///< per body: it has a support or springs
  std::vector<char> touched;   ///< per body: it has a contact or tie
  std::vector<char> sprung;    ///< per body: it has springs
  std::vector<char> support;   ///< per support: it is sound
  std::vector<char> load;      ///< per load: it is sound
  std::vector<Mistake> found;  ///< the mistakes

  /// Mistakes that follow lie in a part with this position in a file, if it has one.
  void enter(const Source& source);

  void error(std::string_view path, std::string_view key, std::string message, std::string given = {});
  void error_of_key(std::string_view path, std::string_view key, std::string message);
  /// The mistake reported last is one of its part as a whole.
  void of_whole() { found.back().of_whole = true; }

  // Each reports a value out of its range, and returns whether it is within.
  bool number(std::string_view path, std::string_view key, double value);  ///< finite, of reasonable magnitude
  bool positive(std::string_view path, std::string_view key, double value);
  bool not_negative(std::string_view path, std::string_view key, double value);
  bool vector(std::string_view path, std::string_view key, const Vec2& value);
  bool whole(std::string_view path, std::string_view key, long value, const limits::Range& range);
  bool within(std::string_view path, std::string_view key, double value, const char* least, const char* most);

  bool is_body(int index) const { return index >= 0 && static_cast<std::size_t>(index) < model.bodies.size(); }
  const Body& body(int index) const { return model.bodies[static_cast<std::size_t>(index)]; }
  bool sound_shape(int index) const { return shape[static_cast<std::size_t>(index)] != 0; }
  bool sound_faces(int index) const { return faces[static_cast<std::size_t>(index)] != 0; }

 private:
  int line_ = 0, column_ = 0;
};

/// `bodies.upper`; by its number if it has no name.
std::string path_of(std::string_view section, const std::string& name, std::size_t index);
/// `supports.2`: as in the file that the part comes from, or by its number.
std::string path_of(std::string_view section, const Source& source, std::size_t index);

/// `contacts.joints`: the entry of the file, also of a contact or tie that `between: all` found; by its name if it
/// comes from no file.
std::string path_of_joint(std::string_view section, const Source& source, const std::string& name, std::size_t index);

/// `loads.tip`; `springs.0` for what springs have at rest.
std::string path_of_load(const Load& load, std::size_t index);

/// Checks the name of a part, and that no part before it has the same; `what`: `body`.
void check_name(Checking& checking, const std::string& path, const std::string& name, const char* what,
                std::unordered_set<std::string>& before);

void check_analysis(Checking& checking);
void check_solver(Checking& checking);
void check_materials(Checking& checking);
void check_bodies(Checking& checking);
void check_supports(Checking& checking);
void check_springs(Checking& checking);
/// Bars, before contacts.
void check_bars(Checking& checking);
void check_loads(Checking& checking);
void check_contacts_and_ties(Checking& checking);
void check_steps(Checking& checking);
void check_output(Checking& checking);
/// What bodies of revolution cannot have.
void check_revolution(Checking& checking);
/// Numbers with an error bar, and the tolerance of one.
void check_quantities(Checking& checking);
// These need the whole model.
void check_density(Checking& checking);
/// Velocities before the first time step.
void check_initial(Checking& checking);
/// Water that moves with edges.
void check_added_masses(Checking& checking);
void check_point_masses(Checking& checking);
void check_expansion(Checking& checking);
void check_bodies_held(Checking& checking);
void check_something_loads(Checking& checking);
void check_never_applied(Checking& checking);
void check_conflicting_supports(Checking& checking);
/// Bars that are tightened in steps, and what they and beds of springs in contacts do not go with.
void check_bars_in_steps(Checking& checking);
/// Fluids that enter contacts where they open.
void check_entering(Checking& checking);
/// Steps over which interferences grow.
void check_fits(Checking& checking);
/// Steps in which cracks grow.
void check_growth_steps(Checking& checking);
/// Steps that look for a limit.
void check_limit_steps(Checking& checking);
/// Bodies that are added or removed in steps.
void check_stages(Checking& checking);

/// Whether an outline is closed and simple, named, of reasonable size, runs counter-clockwise, and has its holes
/// inside. `body_size`: of the body, where the outline is that of a region in it.
bool check_outline(Checking& checking, const std::string& path, const Outline& outline, double body_size = 0.0);
/// Whether the mesh of a body and its outline belong together. The outline is closed, and named; it may touch itself,
/// as at a crack between cells.
bool check_imported(Checking& checking, const std::string& path, const Body& body);
/// The first point that the edges of two outlines share, if there is one; edges of `b` are numbered after those of `a`.
std::optional<geometry::Crossing> crossing_between(const Outline& a, const Outline& b);
/// Whether `outline` lies inside `outer`, apart from its edges; `what`: `region 'core'`.
bool check_inside(Checking& checking, const std::string& path, const std::string& what, const Outline& outer,
                  const Outline& outline);
/// Whether a place exists; reports it if not. A place of a body with a broken shape is passed over: false.
bool check_place(Checking& checking, const std::string& path, const Place& place);
/// Why nothing can hold a side face of an unbounded body, and what to do.
std::string endless_face(const Model& model, const Place& place);
/// As given by the user, or made from names.
std::string text_of(const Model& model, const Place& place);

/// The law of a contact.
void check_law(Checking& checking, const std::string& path, const Contact& contact);

}  // namespace scabo::model
