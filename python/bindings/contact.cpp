// Discrete contact problems, as `scabo contact` solves them.
#include <pybind11/stl.h>

#include <docstrings.hpp>  // made by make_docstrings.py
#include <memory>

#include "arrays.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/contact/status_name.hpp"
#include "scabo/contact/unit_motions.hpp"
#include "scabo/linalg/dense.hpp"
#include "solved.hpp"
#include "until_ctrl_c.hpp"

namespace scabo::python {

namespace {

using contact::Certificate;
using contact::Problem;
/// Solution of a discrete contact problem of N pairs in d dimensions with m rigid motions. Arrays show its memory.
using Solution = contact::Solution;

Matrix matrix_of(const Numbers& array) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(array.data(), array.shape(0), array.shape(1));
}

/// Of the columns as SciPy keeps them (csc): where each begins, rows, values.
contact::Delassus operator_of(const py::tuple& columns, Eigen::Index size) {
  using Indices = py::array_t<int, py::array::c_style | py::array::forcecast>;
  using Sparse = Eigen::SparseMatrix<double>;
  const auto starts = columns[0].cast<Indices>(), rows = columns[1].cast<Indices>();
  const auto values = columns[2].cast<Numbers>();
  return contact::Delassus(
      Sparse(Eigen::Map<const Sparse>(size, size, values.size(), starts.data(), rows.data(), values.data())));
}

/// Solves u = W p + q + G a, G' p + f = 0 with Coulomb friction on N pairs in `dimension` d = 2 or 3; per pair first
/// the normal, then the tangential components. `dense`: W, (d N, d N), or `columns`: the same as SciPy keeps a sparse
/// matrix by columns (indptr, indices, data); `q`: motions without contact forces, (d N), the normal ones positive if
/// open; `mu`, `cohesion` and `tension`: (N), the latter two forces, or empty; `G`: (d N, m) or None; `f`: (m);
/// `start_forces` (d N) and `start_motions` (m): where Newton begins, or empty. `tolerance`: free of units, of the
/// certificate (`by_certificate`) or of the natural map. `force_scale`: largest applied force, 0 if it is not known.
/// `seconds`: limit of time, 0 for none.
std::shared_ptr<Solution> solve(const std::optional<Numbers>& dense, const std::optional<py::tuple>& columns,
                                const Numbers& q, const Numbers& mu, int dimension, const Numbers& cohesion,
                                const Numbers& tension, const std::optional<Numbers>& G, const Numbers& f,
                                const Numbers& start_forces, const Numbers& start_motions, double tolerance,
                                bool by_certificate, int iterations, double force_scale, double seconds, int threads) {
  Problem problem;
  problem.dimension = dimension;
  problem.q = vector_of(q);
  problem.mu = vector_of(mu);
  problem.cohesion = vector_of(cohesion);
  problem.tension = vector_of(tension);
  if (columns)
    problem.W = operator_of(*columns, problem.q.size());
  else
    problem.W = matrix_of(*dense);
  if (G)
    problem.G = matrix_of(*G);
  else
    problem.G.resize(problem.q.size(), 0);
  problem.f = vector_of(f);
  const contact::Start start{vector_of(start_forces), vector_of(start_motions)};
  contact::SolverOptions options;
  options.tolerance = tolerance;
  options.judge = by_certificate ? contact::Judge::certificate : contact::Judge::natural_map;
  options.iterations = iterations;
  options.force_scale = force_scale;
  options.on_iteration = [](const contact::Iteration&) { interruption_point(); };
  return until_ctrl_c([&] {
    if (seconds > 0.0) options.deadline = contact::Deadline::in(seconds);
    const linalg::KeptBlasThreads kept;
    linalg::set_blas_threads(threads);
    const contact::UnitMotions scaled = contact::in_unit_motions(problem, start);
    return std::make_shared<Solution>(scaled.given(contact::solve(scaled.problem, scaled.start, options)));
  });
}

/// Largest violations of the conditions of a solution, free of units, each 0 or more: equilibrium (set by an analysis
/// only), penetration, tension, friction_excess, complementarity, slip_direction, rigid_balance.
py::dict certificate_of(const Solution& solution) {
  const Certificate& found = solution.certificate;
  py::dict certificate;
  certificate["equilibrium"] = found.equilibrium;
  certificate["penetration"] = found.penetration;
  certificate["tension"] = found.tension;
  certificate["friction_excess"] = found.friction_excess;
  certificate["complementarity"] = found.complementarity;
  certificate["slip_direction"] = found.slip_direction;
  certificate["rigid_balance"] = found.rigid_balance;
  return certificate;
}

/// A member that is a vector, as a view.
template <Vector Solution::*member>
py::array vector_view(const py::object& self) {
  return view(self.cast<const Solution&>().*member, self);
}

}  // namespace

void bind_contact(py::module_& module) {
  py::class_<Solution, std::shared_ptr<Solution>>(module, "DiscreteSolution", doc::contact::Solution)
      .def_property_readonly(
          "status", [](const Solution& of) { return contact::name_of(of.status); }, doc::solution::Solution_status)
      .def_property_readonly("forces", &vector_view<&Solution::p>, doc::solution::Solution_p)
      .def_property_readonly("rigid_motions", &vector_view<&Solution::a>, doc::solution::Solution_a)
      .def_property_readonly("gap", &vector_view<&Solution::gap>, doc::solution::Solution_gap)
      .def_property_readonly("slip", &vector_view<&Solution::slip_increment>, doc::solution::Solution_slip_increment)
      .def_property_readonly("unrestrained_motion", &vector_view<&Solution::motion>, doc::solution::Solution_motion)
      .def_property_readonly("proof", &vector_view<&Solution::proof>, doc::solution::Solution_proof)
      .def_property_readonly(
          "states",
          [](const py::object& self) {
            const auto& states = self.cast<const Solution&>().states;
            return view(reinterpret_cast<const int*>(states.data()), {static_cast<py::ssize_t>(states.size())},
                        {static_cast<py::ssize_t>(sizeof(int))}, self);
          },
          doc::solution::Solution_states)
      .def_readonly("iterations", &Solution::iterations, doc::solution::Solution_iterations)
      .def_readonly("natural_map_residual", &Solution::natural_map_residual,
                    doc::solution::Solution_natural_map_residual)
      .def_readonly("rounding", &Solution::rounding, doc::solution::Solution_rounding)
      .def_readonly("reason", &Solution::reason, doc::solution::Solution_reason)
      .def_property_readonly("certificate", &certificate_of, doc::contact::certificate_of);
  module.def("solve_contact", &solve, py::arg("dense"), py::arg("columns"), py::arg("q"), py::arg("mu"),
             py::arg("dimension"), py::arg("cohesion"), py::arg("tension"), py::arg("G"), py::arg("f"),
             py::arg("start_forces"), py::arg("start_motions"), py::arg("tolerance"), py::arg("by_certificate"),
             py::arg("iterations"), py::arg("force_scale"), py::arg("seconds"), py::arg("threads"),
             doc::contact::solve);
}

}  // namespace scabo::python
