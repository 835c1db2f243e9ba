// The reader of models in space: what is known so far, and its functions, one for each entry of a section.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/input/laws.hpp"
#include "scabo/input/restart.hpp"
#include "scabo/input/space/solid_values.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::input {

class SpaceReader {
 public:
  SpaceReader(Report& report, const std::string& file) : report_(report) { model_.file = file; }
  model::SpaceModel read(const Value& root);
  std::vector<Warning>& warnings() { return model_.warnings; }

 private:
  using Components = std::array<std::optional<double>, 3>;
  using Formulas = std::array<model::SpaceFormula, 3>;
  /// `added` and `removed`: the names of steps.
  struct Stages {
    std::size_t first;  ///< of the bodies of an entry, up to those of the next one; or a support
    std::optional<Value> added, removed;
  };

  void analysis(const Value& value);
  void solver(const Value& value);
  void material(const Entry& entry);

  // read_solid_bodies.cpp
  int material_of(const Value& value);
  void body(const Entry& entry);
  std::optional<model::SpacePreload> preload(const Value& value);
  std::shared_ptr<const files::ImportedSolidMesh> mesh_of_file(const Value& value, bool hexahedra);
  void add_bodies_of_file(const Value& mesh, model::SpaceBody body);
  void add_bodies_of_cad(const Value& shape, const model::CadShape& cad, model::SpaceBody body);
  void add_parts(const Value& value, std::vector<files::ImportedSolidMesh> parts, model::SpaceBody body);
  std::optional<int> region_of(const Value& value, const files::ImportedSolidMesh& mesh) const;
  /// A face of a body; or the body, where `or_body` names what may be on a whole one, as in `a load`.
  std::optional<model::SpaceFace> face(const Value& value, const char* or_body = nullptr);
  std::optional<model::SpaceFace> face_or_curve(const Value& value, const char* or_body);
  std::optional<model::SpaceFace> face_found(const Value& value);
  std::optional<model::SpaceFace> face_near(const Value& near, const Eigen::Vector3d& point, model::SpaceFace face);
  std::optional<model::SpaceFace> face_along(const Value& value, const Eigen::Vector3d& normal,
                                             const std::optional<Value>& part, model::SpaceFace face);
  void find_face(const Value& value, const std::string& part, model::SpaceFace& face);

  // read_solid_places.cpp
  std::optional<model::SpaceFace> edge_or_point(const Value& value);
  void meeting_faces(const Value& value, std::size_t count, model::SpaceFace& place);
  /// A face, an edge or a point; or the body.
  std::optional<model::SpaceFace> place(const Value& value, const char* or_body = nullptr);
  bool check_place_of_load(const Value& on, const model::SpaceLoad& load);

  // read_solid_conditions.cpp
  Components fixed(const Value& value);
  Components components(const Value& value, const char* names);
  void fix(const Value& value, model::SpaceSupport& support);
  void along_normal(const Value& value, model::SpaceSupport& support);
  void direction_of(const Value& value, model::SpaceSupport& support);
  void displacement(const Value& value, model::SpaceSupport& support);
  Formulas formulas(const Value& value);
  void support(const Value& value);
  void rigid_support(const MapReader& map, model::SpaceSupport& support);
  void springs(const Value& value);
  void spring(const Value& value);
  void spring_at_rest(const Value& value, model::SpaceSpring& spring);
  void load(const Entry& entry);
  bool friction_axes(const MapReader& map, model::SpaceContact& contact);
  void load_value(const std::string& kind, const Value& value, model::SpaceLoad& load);
  void place_of_load(const MapReader& map, const Entry& entry, model::SpaceLoad& load);
  void check_gravity(const Entry& entry, const model::SpaceLoad& load);
  void law(const MapReader& map, model::SpaceContact& contact);
  void pair_of_faces(const Entry& entry, bool tied);
  void refuse_joined_faces(const Entry& entry, const model::SpaceContact& contact);

  // read_solid_bars.cpp
  void bar(const Entry& entry);
  std::optional<model::SpaceBar::End> bar_end(const Value& value);

  // read_solid_output.cpp
  void output(const Value& value);
  void point(const Value& value);
  void line(const Value& value);
  void section(const Entry& entry, const Value& value);
  void face_resultant(const Entry& entry);
  void displacement_of_point(const Entry& entry);
  void quantity_of_several(const Entry& entry);
  int point_named(const Value& value);
  void quantity(const Entry& entry);
  int body_named(const Value& value);

  // read_solid_steps.cpp
  void curves(const Value& value);
  void steps(const std::optional<Value>& value);
  model::Step step(const Value& value, const model::Step& before, std::size_t number);
  void friction(const Value& value, model::Step& step);
  std::vector<model::Contact> laws() const;
  void factor(const Entry& entry, model::Step& step);
  void find_fits();
  void find_tightened();
  int step_named(const Value& value) const;

  // read_solid_stages.cpp
  void restart(const Value& value);
  bool has_stage(const std::string& step) const;
  model::Stay stay_of(const Stages& of, const char* what);
  void find_stages();
  void check_stages();

  double number(const std::optional<Value>& value, double otherwise = 0.0) const {
    return value ? read_number(report_, *value).value_or(otherwise) : otherwise;
  }
  double number_from(const std::optional<Value>& value, double least, bool itself) const {
    return read_number_from(report_, value, least, itself);
  }
  Eigen::Vector3d vector(const Value& value) const { return read_vector_in_space(report_, value); }
  const model::SpaceBody& body_at(int index) const { return model_.bodies[static_cast<std::size_t>(index)]; }

  Report& report_;
  Value root_;
  model::SpaceModel model_;
  ContactProperties properties_;
  bool curves_known_ = true;  ///< false: some could not be read
  std::map<std::pair<std::string, bool>, std::shared_ptr<const files::ImportedSolidMesh>> meshes_;
  std::vector<std::pair<std::size_t, Value>> fits_;            ///< contacts, and the names of the steps of `fit_in`
  std::vector<std::pair<std::size_t, Value>> tightened_;       ///< bodies, and the names of the steps of their preloads
  std::vector<std::pair<std::size_t, Value>> tightened_bars_;  ///< the same of bars
  std::optional<EndOfRun> end_;                                ///< of the run from which this one starts
  std::vector<Stages> stages_of_supports_;
  std::vector<Stages> stages_;  ///< of every entry of the bodies
};

}  // namespace scabo::input
