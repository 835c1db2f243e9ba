// Arrays of a static analysis.
#include <pybind11/stl.h>

#include <docstrings.hpp>  // made by make_docstrings.py
#include <limits>
#include <memory>
#include <optional>

#include "arrays.hpp"
#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/mesh/plane/output_points.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/recovery.hpp"
#include "scabo/result/stress.hpp"
#include "scabo/result/summary.hpp"
#include "solved.hpp"
#include "until_ctrl_c.hpp"

namespace scabo::python {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

const analysis::IncrementResult& increment_of(const StaticResult& solved, std::size_t increment) {
  return solved.solution.increments.at(increment);
}

/// The pairs of a contact after an increment, each column an array over the pairs: pair (number from 1), x, y (on A,
/// length), normal_x, normal_y (out of A), gap (length, positive if open), slip (length, of B relative to A along t),
/// normal_force (on B, compression positive), tangential_force (on B along t), pressure, shear (force / length^2),
/// state (0 open, 1 stick, 2 slip), and normal_displacement_a, tangential_displacement_a, normal_displacement_b,
/// tangential_displacement_b (length, along n and t). Displacements and columns need the fields of the increment.
py::dict pairs(const py::object& self, std::size_t increment, std::size_t contact) {
  const auto& solved = self.cast<const StaticResult&>();
  const std::vector<analysis::PairResult>& list = increment_of(solved, increment).contacts.at(contact).pairs;
  static const analysis::PairResult nothing;
  const analysis::PairResult& first = list.empty() ? nothing : list.front();
  const auto count = static_cast<py::ssize_t>(list.size());
  constexpr py::ssize_t stride = sizeof(analysis::PairResult);
  py::dict table;
  const auto add = [&](const char* name, const double& member) {
    table[name] = view(&member, {count}, {stride}, self);
  };
  static_assert(sizeof(contact::ContactState) == sizeof(int));
  table["pair"] = view(&first.pair, {count}, {stride}, self);
  add("x", first.position.x());
  add("y", first.position.y());
  add("normal_x", first.normal.x());
  add("normal_y", first.normal.y());
  add("gap", first.gap);
  add("slip", first.slip);
  add("normal_force", first.normal_force);
  add("tangential_force", first.tangential_force);
  add("pressure", first.pressure);
  add("shear", first.shear);
  table["state"] = view(reinterpret_cast<const int*>(&first.state), {count}, {stride}, self);
  add("normal_displacement_a", first.displacement_a.x());
  add("tangential_displacement_a", first.displacement_a.y());
  add("normal_displacement_b", first.displacement_b.x());
  add("tangential_displacement_b", first.displacement_b.y());
  return table;
}

/// Whether displacements and pairs of an increment are kept.
bool keeps_fields(const StaticResult& solved, std::size_t increment) {
  return !increment_of(solved, increment).fields.displacements.empty();
}

/// Displacements of the nodes of a body, (nodes, 2), length, or [u_x, u_y, rotation] of a rigid body about its centroid
/// (rotation counter-clockwise); relative to the reference point, which takes a copy if that moves.
py::array displacement(const py::object& self, std::size_t increment, std::size_t body) {
  const auto& solved = self.cast<const StaticResult&>();
  const analysis::FieldState& state = increment_of(solved, increment).fields;
  const Vector& u = state.displacements.at(body);
  const bool rigid = solved.solution.model.bodies[body].rigid;
  const Vec2 reference = state.reference_displacement(body);
  if (reference.isZero(0.0)) return rigid ? view(u, self) : view(u, 2, self);
  Vector moved = u;
  for (Eigen::Index i = 0; i < (rigid ? 2 : moved.size()); ++i) moved[i] -= reference[i % 2];
  const auto [held, owner] = kept(std::move(moved));
  return rigid ? view(*held, owner) : view(*held, 2, owner);
}

/// Positions of the nodes of a body before it deforms, (nodes, 2), length; empty for a rigid body.
py::array nodes(const py::object& self, std::size_t body) {
  return view(self.cast<const StaticResult&>().solution.mesh.bodies.at(body).nodes, self);
}

/// The body of every point; -1 for points outside, if they are allowed.
std::vector<int> bodies_of(const StaticResult& solved, const std::vector<Vec2>& points, int only, bool allow_outside) {
  const model::Model& model = solved.solution.model;
  const mesh::BodyFinder finder(model);
  std::vector<int> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fail = [&](const std::string& why) {
      throw std::invalid_argument("point " + std::to_string(i) + ": " + why);
    };
    if (!points[i].allFinite()) fail("its coordinates are not finite");
    const std::vector<int> bodies = finder.at(points[i], only);
    if (bodies.empty() && !allow_outside) fail(finder.why_outside(points[i], only) + ", or use outside='nan'");
    if (bodies.size() > 1) {
      std::string names;
      for (const int body : bodies)
        names += (names.empty() ? "'" : ", '") + model.bodies[static_cast<std::size_t>(body)].name + "'";
      fail("it lies in several bodies (" + names +
           "): name one of them, as in body=" + names.substr(0, names.find(',')));
    }
    found.push_back(bodies.empty() ? -1 : bodies.front());
  }
  return found;
}

/// Arrays over points that are filled after they were made.
py::array_t<double> columns(std::size_t points, int count) {
  return py::array_t<double>({static_cast<py::ssize_t>(points), static_cast<py::ssize_t>(count)});
}

/// Values at points (n, 2) of the undeformed shape, as new arrays: body (n; -1 outside), displacement (n, 2), stress
/// (n, 4): xx, yy, xy, zz, positive in tension, strain (n, 3): xx, yy, gamma_xy, principal (n, 3), descending,
/// principal_angle (n, from x, radians), von_mises (n), energy_density (n). `only`: the body that is meant, or -1.
/// Points outside raise ValueError, or with `allow_outside` are not a number.
py::dict values(const StaticResult& solved, std::size_t increment, const Numbers& at, int only, bool allow_outside) {
  const std::vector<Vec2> points = points_of(at);
  std::vector<result::PointResult> results;
  std::vector<int> bodies;
  until_ctrl_c([&] {
    bodies = bodies_of(solved, points, only, allow_outside);
    std::vector<mesh::OutputPoint> places;
    for (std::size_t i = 0; i < points.size(); ++i) places.push_back({"", bodies[i], points[i], 0.0});
    const result::PointEvaluation evaluation(solved.solution, std::move(places), 1);
    results = evaluation.at(solved.solution, increment_of(solved, increment));
  });
  const std::size_t n = results.size();
  py::array_t<double> displacements = columns(n, 2), stress = columns(n, 4), strain = columns(n, 3),
                      principal = columns(n, 3);
  py::array_t<double> angle(static_cast<py::ssize_t>(n)), von_mises(static_cast<py::ssize_t>(n)),
      energy(static_cast<py::ssize_t>(n));
  py::array_t<int> body(static_cast<py::ssize_t>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    const result::PointResult& value = results[i];
    const bool inside = bodies[i] >= 0 && !value.absent, stressed = inside && value.has_stress;
    const result::StressMeasures measures =
        stressed ? result::stress_measures(value.values.stress, value.stress_zz) : result::StressMeasures();
    body.mutable_at(row) = bodies[i];
    for (int k = 0; k < 2; ++k) displacements.mutable_at(row, k) = inside ? value.values.displacement[k] : no_number;
    for (int k = 0; k < 3; ++k) {
      stress.mutable_at(row, k) = stressed ? value.values.stress[k] : no_number;
      strain.mutable_at(row, k) = stressed ? value.values.strain[k] : no_number;
      principal.mutable_at(row, k) = stressed ? measures.principal[static_cast<std::size_t>(k)] : no_number;
    }
    stress.mutable_at(row, 3) = stressed ? value.stress_zz : no_number;
    angle.mutable_at(row) = stressed ? measures.angle : no_number;
    von_mises.mutable_at(row) = stressed ? measures.von_mises : no_number;
    energy.mutable_at(row) = stressed ? value.energy_density : no_number;
  }
  py::dict table;
  table["body"] = body;
  table["displacement"] = displacements;
  table["stress"] = stress;
  table["strain"] = strain;
  table["principal"] = principal;
  table["principal_angle"] = angle;
  table["von_mises"] = von_mises;
  table["energy_density"] = energy;
  return table;
}

/// How bodies begin to move where the run ended as a mechanism or collapse; None otherwise. The largest displacement is
/// 1. Arrays over the bodies: shift (n, 2), displacement (length) of the point about (n, 2), rotation (radians,
/// counter-clockwise), centre (n, 2; not a number where a body does not turn), largest (largest displacement of the
/// body, length), moves. Arrays over the pairs: contact (index), pair (number from 1), position (m, 2; on A), normal
/// (m, 2; out of A), opening and slip (length, of B relative to A). Besides: rule ('coulomb' or 'associated'), work (of
/// the loads over the motion), text. Arrays show the memory of the solution, but for centre and moves.
py::object mechanism(const py::object& self) {
  const analysis::StaticSolution& solution = self.cast<const StaticResult&>().solution;
  if (!solution.mechanism) return py::none();
  const analysis::Mechanism& of = *solution.mechanism;
  py::dict table;
  table["rule"] = analysis::name_of(of.rule);
  table["work"] = of.work;
  table["text"] = analysis::describe(of, solution.model);
  static const analysis::BodyMotion no_body;
  static const analysis::PairMotion no_pair;
  const analysis::BodyMotion& body = of.bodies.empty() ? no_body : of.bodies.front();
  const analysis::PairMotion& pair = of.pairs.empty() ? no_pair : of.pairs.front();
  const auto bodies = static_cast<py::ssize_t>(of.bodies.size()), pairs = static_cast<py::ssize_t>(of.pairs.size());
  constexpr py::ssize_t of_body = sizeof(analysis::BodyMotion), of_pair = sizeof(analysis::PairMotion);
  table["shift"] = view(body.shift.data(), {bodies, 2}, {of_body, of_double}, self);
  table["about"] = view(body.about.data(), {bodies, 2}, {of_body, of_double}, self);
  table["rotation"] = view(&body.rotation, {bodies}, {of_body}, self);
  table["largest"] = view(&body.largest, {bodies}, {of_body}, self);
  py::array_t<double> centre = columns(of.bodies.size(), 2);
  py::array_t<bool> moves(bodies);
  for (py::ssize_t b = 0; b < bodies; ++b) {
    const analysis::BodyMotion& motion = of.bodies[static_cast<std::size_t>(b)];
    const std::optional<Vec2> at = motion.centre();
    for (int k = 0; k < 2; ++k) centre.mutable_at(b, k) = at ? (*at)[k] : no_number;
    moves.mutable_at(b) = motion.moves();
  }
  table["centre"] = centre;
  table["moves"] = moves;
  table["contact"] = view(&pair.contact, {pairs}, {of_pair}, self);
  table["pair"] = view(&pair.pair, {pairs}, {of_pair}, self);
  table["position"] = view(pair.position.data(), {pairs, 2}, {of_pair, of_double}, self);
  table["normal"] = view(pair.normal.data(), {pairs, 2}, {of_pair, of_double}, self);
  table["opening"] = view(&pair.opening, {pairs}, {of_pair}, self);
  table["slip"] = view(&pair.slip, {pairs}, {of_pair}, self);
  return table;
}

/// Points, cells and fields of fields.vtu after an increment, without the bodies that are absent, as new arrays: points
/// (n, 3), undeformed, length; connectivity (indices of points, all cells in sequence), offsets (cells + 1: where each
/// begins, and the end), types (cells, numbers of VTK), cell_body and body (cells and n, from 1, in the order of the
/// model); displacement (n, 3), length; stress (n, 6): xx, yy, zz, xy, yz, xz, principal_1 to principal_3, von_mises
/// (n), force / length^2, positive in tension; principal_angle (n, from x, radians).
py::dict fields(const StaticResult& solved, std::size_t increment) {
  result::GridFields of;
  until_ctrl_c([&] {
    const analysis::IncrementResult& at = increment_of(solved, increment);
    const result::Recovery recovery(solved.solution);
    of = result::without_bodies(recovery.grid(), recovery.fields(solved.solution, at.fields), at.absent);
  });
  std::vector<std::int32_t> offsets{0};
  offsets.insert(offsets.end(), of.grid.offsets.begin(), of.grid.offsets.end());
  py::dict table;
  table["points"] = copied(of.grid.points, 3);
  table["connectivity"] = copied(of.grid.connectivity);
  table["offsets"] = copied(offsets);
  table["types"] = copied(of.grid.types);
  table["cell_body"] = copied(of.grid.cell_body);
  table["body"] = copied(of.grid.point_body);
  table["displacement"] = copied(of.fields.displacement, 3);
  table["stress"] = copied(of.fields.stress, 6);
  table["principal_1"] = copied(of.fields.principal_1);
  table["principal_2"] = copied(of.fields.principal_2);
  table["principal_3"] = copied(of.fields.principal_3);
  table["principal_angle"] = copied(of.fields.principal_angle);
  table["von_mises"] = copied(of.fields.von_mises);
  return table;
}

/// The text of history.csv, made from the fields of the increments that converged; empty where the model asks for none.
std::string history(const StaticResult& solved) {
  std::string table;
  until_ctrl_c([&] {
    result::History of(solved.solution.model);
    if (!of.wanted()) return;
    table = of.header();
    for (const analysis::IncrementResult& increment : solved.solution.increments)
      if (increment.converged) table += of.row(solved.solution, increment);
  });
  return table;
}

/// Names of the contacts, in the order of the model.
std::vector<std::string> contact_names(const StaticResult& solved) {
  std::vector<std::string> names;
  for (const model::Contact& contact : solved.solution.model.contacts) names.push_back(contact.name);
  return names;
}

/// Names of the bodies, in the order of the model.
std::vector<std::string> body_names(const StaticResult& solved) {
  std::vector<std::string> names;
  for (const model::Body& body : solved.solution.model.bodies) names.push_back(body.name);
  return names;
}

/// How the run ended: solved, not_converged, mechanism, collapse or interrupted.
std::string status(const StaticResult& solved) { return std::string(result::name_of(solved.solution.outcome)); }

/// Whether the model asks for its discrete contact problems as files, which only a run can write.
bool writes_problems(const StaticResult& solved) { return solved.solution.model.output.discrete_problems; }

/// Number of increments: those that converged, and at most one that did not, the last.
std::size_t increments(const StaticResult& solved) { return solved.solution.increments.size(); }

}  // namespace

void bind_static_results(py::module_& module) {
  py::class_<StaticResult, std::shared_ptr<StaticResult>>(module, "StaticResult", doc::solved::StaticResult)
      .def_readonly("record", &StaticResult::record, doc::solved::StaticResult_record)
      .def_property_readonly("status", &status, doc::static_results::status)
      .def_property_readonly("writes_problems", &writes_problems, doc::static_results::writes_problems)
      .def_property_readonly("contacts", &contact_names, doc::static_results::contact_names)
      .def_property_readonly("bodies", &body_names, doc::static_results::body_names)
      .def_property_readonly("increments", &increments, doc::static_results::increments)
      .def("pairs", &pairs, py::arg("increment"), py::arg("contact"), doc::static_results::pairs)
      .def("keeps_fields", &keeps_fields, py::arg("increment"), doc::static_results::keeps_fields)
      .def("nodes", &nodes, py::arg("body"), doc::static_results::nodes)
      .def("displacement", &displacement, py::arg("increment"), py::arg("body"), doc::static_results::displacement)
      .def("fields", &fields, py::arg("increment"), doc::static_results::fields)
      .def("history", &history, doc::static_results::history)
      .def("mechanism", &mechanism, doc::static_results::mechanism)
      .def("values", &values, py::arg("increment"), py::arg("points"), py::arg("only"), py::arg("allow_outside"),
           doc::static_results::values);
}

}  // namespace scabo::python
