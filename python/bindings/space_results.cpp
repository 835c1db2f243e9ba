// Arrays of a static analysis in space.
#include <pybind11/stl.h>

#include <docstrings.hpp>  // made by make_docstrings.py
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "arrays.hpp"
#include "scabo/analysis/space/solid_mechanism.hpp"
#include "scabo/result/solid/solid_cells.hpp"
#include "scabo/result/solid/solid_outputs.hpp"
#include "scabo/result/solid/solid_points.hpp"
#include "scabo/result/solid/solid_stress.hpp"
#include "solved.hpp"
#include "until_ctrl_c.hpp"

namespace scabo::python {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

using Vector3 = Eigen::Vector3d;

const analysis::SolidIncrement& increment_of(const SpaceResult& solved, std::size_t increment) {
  return solved.increments.at(increment);
}

/// Rows of `width` numbers that are filled after they were made.
py::array_t<double> rows(std::size_t count, int width) {
  return py::array_t<double>({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
}

/// The pairs of a contact or tie after an increment, new arrays over the pairs: pair (number from 1), position and
/// normal (n, 3; the latter out of A), area, gap (length, positive if open), slip (n, 3; length, of B relative to A,
/// since the start), force (n, 3; on B), normal_force (compression positive), pressure, shear (n, 3; on B; force /
/// length^2), state (0 open, 1 stick, 2 slip). Vectors are along the global axes.
py::dict pairs(const SpaceResult& solved, std::size_t increment, std::size_t contact) {
  std::vector<const analysis::SolidPair*> list;
  for (const analysis::SolidPair& pair : increment_of(solved, increment).pairs)
    if (pair.contact == static_cast<int>(contact)) list.push_back(&pair);
  const auto numbers = [&](const std::function<double(const analysis::SolidPair&)>& value) {
    py::array_t<double> column(static_cast<py::ssize_t>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) column.mutable_at(static_cast<py::ssize_t>(i)) = value(*list[i]);
    return column;
  };
  const auto vectors = [&](const std::function<Vector3(const analysis::SolidPair&)>& value) {
    py::array_t<double> columns = rows(list.size(), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Vector3 of_pair = value(*list[i]);
      for (int k = 0; k < 3; ++k) columns.mutable_at(static_cast<py::ssize_t>(i), k) = of_pair[k];
    }
    return columns;
  };
  py::array_t<int> number(static_cast<py::ssize_t>(list.size())), state(static_cast<py::ssize_t>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    number.mutable_at(row) = static_cast<int>(i + 1);
    state.mutable_at(row) = static_cast<int>(list[i]->state);
  }
  py::dict table;
  table["pair"] = number;
  table["position"] = vectors([](const auto& pair) { return pair.point; });
  table["normal"] = vectors([](const auto& pair) { return pair.normal; });
  table["area"] = numbers([](const auto& pair) { return pair.area; });
  table["gap"] = numbers([](const auto& pair) { return pair.gap; });
  table["slip"] = vectors([](const auto& pair) { return pair.slip; });
  table["force"] = vectors([](const auto& pair) { return pair.force; });
  table["normal_force"] = numbers([](const auto& pair) { return pair.normal_force(); });
  table["pressure"] = numbers([](const auto& pair) { return pair.normal_force() / pair.area; });
  table["shear"] =
      vectors([](const auto& pair) -> Vector3 { return (pair.force - pair.normal_force() * pair.normal) / pair.area; });
  table["state"] = state;
  return table;
}

/// Whether displacements and pairs of an increment are kept.
bool keeps_fields(const SpaceResult& solved, std::size_t increment) {
  return !increment_of(solved, increment).u.empty();
}

/// Displacements of the nodes of a body, (nodes, 3), length; also of a rigid one.
py::array displacement(const py::object& self, std::size_t increment, std::size_t body) {
  return view(increment_of(self.cast<const SpaceResult&>(), increment).u.at(body), 3, self);
}

/// Positions of the nodes of a body before it deforms, (nodes, 3), length.
py::array nodes(const py::object& self, std::size_t body) {
  const Matrix& at = self.cast<const SpaceResult&>().posed->model.bodies.at(body).mesh.nodes;
  return view(at.data(), {at.cols(), 3}, {3 * of_double, of_double}, self);
}

std::vector<Vector3> points_in_space(const Numbers& array) {
  std::vector<Vector3> points(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points[static_cast<std::size_t>(i)] = {array.at(i, 0), array.at(i, 1), array.at(i, 2)};
  return points;
}

/// The one place of every point; one with body -1 outside, if that is allowed.
std::vector<result::SolidPlace> one_place_of(const SpaceResult& solved, const std::vector<Vector3>& points, int only,
                                             bool allow_outside) {
  const auto places = result::places_of(solved.posed->model, points, std::vector<int>(points.size(), only));
  std::vector<result::SolidPlace> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fail = [&](const std::string& why) {
      throw std::invalid_argument("point " + std::to_string(i) + ": " + why);
    };
    if (!points[i].allFinite()) fail("its coordinates are not finite");
    if (places[i].empty() && !allow_outside)
      fail(only < 0 ? "it lies in no body: move it into one, or use outside='nan'"
                    : "it lies outside of body '" + solved.model->bodies[static_cast<std::size_t>(only)].name +
                          "': move it into the body, or use outside='nan'");
    if (places[i].size() > 1) {
      std::string names;
      for (const result::SolidPlace& place : places[i])
        names += (names.empty() ? "'" : ", '") + solved.model->bodies[static_cast<std::size_t>(place.body)].name + "'";
      fail("it lies in several bodies (" + names +
           "): name one of them, as in body=" + names.substr(0, names.find(',')));
    }
    found.push_back(places[i].empty() ? result::SolidPlace() : places[i].front());
  }
  return found;
}

/// Values at points (n, 3) of the undeformed shape, as new arrays: body (n; -1 outside), displacement (n, 3), stress
/// (n, 6): xx, yy, zz, xy, yz, xz, positive in tension, principal (n, 3), descending, von_mises (n). `only`: the body
/// that is meant, or -1. Points outside raise ValueError, or with `allow_outside` are not a number.
py::dict values(const SpaceResult& solved, std::size_t increment, const Numbers& at, int only, bool allow_outside) {
  const std::vector<Vector3> points = points_in_space(at);
  std::vector<result::SolidPlace> places, inside;
  std::vector<result::SolidPointValues> found;
  until_ctrl_c([&] {
    places = one_place_of(solved, points, only, allow_outside);
    for (const result::SolidPlace& place : places)
      if (place.body >= 0) inside.push_back(place);
    found = result::values_at(solved.posed->model, increment_of(solved, increment), inside);
  });
  py::array_t<int> body(static_cast<py::ssize_t>(points.size()));
  py::array_t<double> displacements = rows(points.size(), 3), stress = rows(points.size(), 6),
                      principal = rows(points.size(), 3), von_mises(static_cast<py::ssize_t>(points.size()));
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    body.mutable_at(row) = places[i].body;
    const result::SolidPointValues* value = places[i].body >= 0 ? &found[next++] : nullptr;
    if (value && value->absent) value = nullptr;
    const bool stressed = value && value->stress;
    const result::StressInSpace measures(stressed ? *value->stress : element::Vec6::Zero());
    for (int k = 0; k < 3; ++k) {
      displacements.mutable_at(row, k) = value ? value->displacement[k] : no_number;
      principal.mutable_at(row, k) = stressed ? measures.principal[k] : no_number;
    }
    for (int k = 0; k < 6; ++k) stress.mutable_at(row, k) = stressed ? (*value->stress)[k] : no_number;
    von_mises.mutable_at(row) = stressed ? measures.von_mises : no_number;
  }
  py::dict table;
  table["body"] = body;
  table["displacement"] = displacements;
  table["stress"] = stress;
  table["principal"] = principal;
  table["von_mises"] = von_mises;
  return table;
}

/// How bodies begin to move where the run ended as a mechanism or collapse; None otherwise. The largest displacement is
/// 1. New arrays over the bodies: shift (n, 3), displacement (length) of the point about (n, 3), rotation (n, 3; about
/// the axes, radians), centre (n, 3; of the axis of rotation the point nearest to about; not a number where a body does
/// not turn), largest (largest displacement of the body, length), moves. Over the pairs: contact (index), pair (number
/// from 1 in the contact), position and normal (m, 3; the latter out of A), opening (m) and slip (m, 3; length, of B
/// relative to A). Besides: rule ('coulomb' or 'associated'), work (of the loads over the motion), text.
py::object mechanism(const SpaceResult& solved) {
  if (solved.increments.empty() || !solved.increments.back().mechanism) return py::none();
  const analysis::SolidMechanism& of = *solved.increments.back().mechanism;
  py::dict table;
  table["rule"] = of.rule == analysis::FlowRule::coulomb ? "coulomb" : "associated";
  table["work"] = of.work;
  table["text"] = analysis::describe(of, solved.posed->model);
  const auto vectors = [](const auto& list, const auto& value) {
    py::array_t<double> columns = rows(list.size(), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Vector3 one = value(list[i]);
      for (int k = 0; k < 3; ++k) columns.mutable_at(static_cast<py::ssize_t>(i), k) = one[k];
    }
    return columns;
  };
  using Motion = analysis::SolidBodyMotion;
  table["shift"] = vectors(of.bodies, [](const Motion& body) { return body.shift; });
  table["about"] = vectors(of.bodies, [](const Motion& body) { return body.about; });
  table["rotation"] = vectors(of.bodies, [](const Motion& body) { return body.rotation; });
  table["centre"] = vectors(
      of.bodies, [](const Motion& body) -> Vector3 { return body.axis().value_or(Vector3::Constant(no_number)); });
  const auto bodies = static_cast<py::ssize_t>(of.bodies.size()), pairs = static_cast<py::ssize_t>(of.pairs.size());
  py::array_t<double> largest(bodies), opening(pairs);
  py::array_t<bool> moves(bodies);
  for (py::ssize_t b = 0; b < bodies; ++b) {
    largest.mutable_at(b) = of.bodies[static_cast<std::size_t>(b)].largest;
    moves.mutable_at(b) = of.bodies[static_cast<std::size_t>(b)].moves();
  }
  py::array_t<int> contact(pairs), number(pairs);
  std::vector<int> of_contact(solved.model->contacts.size(), 0);
  for (py::ssize_t i = 0; i < pairs; ++i) {
    const analysis::SolidPair& pair = of.pairs[static_cast<std::size_t>(i)];
    contact.mutable_at(i) = pair.contact;
    number.mutable_at(i) = ++of_contact[static_cast<std::size_t>(pair.contact)];
    opening.mutable_at(i) = pair.gap;
  }
  using Pair = analysis::SolidPair;
  table["largest"] = largest;
  table["moves"] = moves;
  table["contact"] = contact;
  table["pair"] = number;
  table["position"] = vectors(of.pairs, [](const Pair& pair) { return pair.point; });
  table["normal"] = vectors(of.pairs, [](const Pair& pair) { return pair.normal; });
  table["opening"] = opening;
  table["slip"] = vectors(of.pairs, [](const Pair& pair) { return pair.slip; });
  return table;
}

/// Points, cells and fields of fields.vtu after an increment as new arrays: points (n, 3), undeformed, length;
/// connectivity (indices of points, all cells in sequence), offsets (cells + 1: where each begins, and the end), types
/// (cells, numbers of VTK), cell_body and body (cells and n, from 1, in the order of the model); displacement (n, 3),
/// length; stress (n, 6): xx, yy, zz, xy, yz, xz, principal_1 to principal_3, von_mises (n), force / length^2, positive
/// in tension.
py::dict fields(const SpaceResult& solved, std::size_t increment) {
  result::SolidCells of;
  until_ctrl_c([&] { of = result::solid_cells(solved.posed->model, increment_of(solved, increment)); });
  std::vector<std::int32_t> offsets{0};
  offsets.insert(offsets.end(), of.offsets.begin(), of.offsets.end());
  py::dict table;
  table["points"] = copied(of.points, 3);
  table["connectivity"] = copied(of.connectivity);
  table["offsets"] = copied(offsets);
  table["types"] = copied(of.types);
  table["cell_body"] = copied(of.cell_body);
  table["body"] = copied(of.point_body);
  table["displacement"] = copied(of.displacement, 3);
  table["stress"] = copied(of.stress, 6);
  table["principal_1"] = copied(of.principal_1);
  table["principal_2"] = copied(of.principal_2);
  table["principal_3"] = copied(of.principal_3);
  table["von_mises"] = copied(of.von_mises);
  return table;
}

/// The text of history.csv, made from the fields of the increments that are solved; empty where the model asks for
/// none.
std::string history(const SpaceResult& solved) {
  std::string table;
  until_ctrl_c([&] {
    const result::SolidOutputs outputs(*solved.model, *solved.posed);
    if (!outputs.has_history()) return;
    table = outputs.header_of_history();
    for (std::size_t k = 0; k < solved.increments.size(); ++k)
      if (solved.increments[k].status == contact::Status::solved)
        table += outputs.row_of_history(solved.increments[k], k);
  });
  return table;
}

/// Names of the contacts and ties, in the order of the model.
std::vector<std::string> contact_names(const SpaceResult& solved) {
  std::vector<std::string> names;
  for (const model::SpaceContact& contact : solved.model->contacts) names.push_back(contact.name);
  return names;
}

/// Names of the bodies, in the order of the model.
std::vector<std::string> body_names(const SpaceResult& solved) {
  std::vector<std::string> names;
  for (const model::SpaceBody& body : solved.model->bodies) names.push_back(body.name);
  return names;
}

/// Number of increments: those that converged, and at most one that did not, the last.
std::size_t increments(const SpaceResult& solved) { return solved.increments.size(); }

}  // namespace

void bind_space_results(py::module_& module) {
  py::class_<SpaceResult, std::shared_ptr<SpaceResult>>(module, "SpaceResult", doc::solved::SpaceResult)
      .def_readonly("record", &SpaceResult::record, doc::solved::SpaceResult_record)
      .def_readonly("status", &SpaceResult::status, doc::solved::SpaceResult_status)
      .def_property_readonly("contacts", &contact_names, doc::space_results::contact_names)
      .def_property_readonly("bodies", &body_names, doc::space_results::body_names)
      .def_property_readonly("increments", &increments, doc::space_results::increments)
      .def("pairs", &pairs, py::arg("increment"), py::arg("contact"), doc::space_results::pairs)
      .def("keeps_fields", &keeps_fields, py::arg("increment"), doc::space_results::keeps_fields)
      .def("nodes", &nodes, py::arg("body"), doc::space_results::nodes)
      .def("displacement", &displacement, py::arg("increment"), py::arg("body"), doc::space_results::displacement)
      .def("fields", &fields, py::arg("increment"), doc::space_results::fields)
      .def("history", &history, doc::space_results::history)
      .def("mechanism", &mechanism, doc::space_results::mechanism)
      .def("values", &values, py::arg("increment"), py::arg("points"), py::arg("only"), py::arg("allow_outside"),
           doc::space_results::values);
}

}  // namespace scabo::python
