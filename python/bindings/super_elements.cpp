// Super-elements by themselves: stiffness, exponents, interior fields.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <cmath>
#include <docstrings.hpp>  // made by make_docstrings.py
#include <limits>
#include <memory>

#include "arrays.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/dense.hpp"
#include "until_ctrl_c.hpp"

namespace scabo::python {

namespace {

using element::Ring;

/// A super-element by itself. Displacements and forces of its boundary are x, y of node after node, n = 2 nodes of
/// them.
class SuperElement {
 public:
  SuperElement(const std::vector<Vec2>& nodes, const Vec2& centre, bool open, int order, double young, double poisson,
               bool plane_strain, double thickness, bool unbounded, int threads)
      : ring_(ring_of(nodes, centre, open, order)), thickness_(thickness) {
    model::Material material;
    material.young = young;
    material.poisson = poisson;
    D_ = element::elasticity_matrix(material, plane_strain ? model::Plane::strain : model::Plane::stress);
    const linalg::KeptBlasThreads kept;
    linalg::set_blas_threads(threads);
    solution_ = element::solve_super_element(ring_, D_, thickness, threads, {unbounded});
  }

  const Matrix& stiffness() const { return solution_.K; }
  const element::Mat3& elasticity() const { return D_; }
  element::CoefficientMatrices coefficients() const { return element::coefficient_matrices(ring_, D_, thickness_); }

  const element::ModalSolution& modes() {
    if (!modes_) {
      const linalg::KeptBlasThreads kept;
      linalg::set_blas_threads(1);
      modes_ = std::make_unique<const element::ModalSolution>(element::modal_solution(solution_));
    }
    return *modes_;
  }

  /// Values at points relative to the centre; nothing for points outside.
  std::vector<std::optional<element::PointValues>> values(const Vector& u, const std::vector<Vec2>& points) {
    const element::RadialField field(solution_, modes(), u);
    std::vector<std::optional<element::PointValues>> all;
    for (const Vec2& x : points) {
      const auto place = element::locate(ring_, x, solution_.domain.unbounded);
      all.push_back(
          place ? std::optional(element::point_values(ring_, field.at(place->xi), D_, place->element, place->eta))
                : std::nullopt);
    }
    return all;
  }

 private:
  static Ring ring_of(const std::vector<Vec2>& nodes, const Vec2& centre, bool open, int order) {
    const auto count = static_cast<int>(nodes.size());
    Ring ring;
    for (const Vec2& x : nodes) ring.nodes.push_back(x - centre);
    for (int first = 0; first + (open ? order : 0) < count; first += order) {
      mesh::LineElement element;
      for (int k = 0; k <= order; ++k) element.nodes.push_back((first + k) % count);
      ring.elements.push_back(std::move(element));
    }
    return ring;
  }

  Ring ring_;
  double thickness_;
  element::Mat3 D_;
  element::SuperElementSolution solution_;
  std::unique_ptr<const element::ModalSolution> modes_;
};

/// Solves a super-element. `nodes`: its boundary, (nodes, 2), counter-clockwise, with the inner nodes of elements of
/// this `order` at the Gauss-Lobatto-Legendre points; `centre`: scaling centre; `open`: the boundary does not close;
/// `young`: force / length^2; `plane_strain`: else plane stress; `unbounded`: outside of the boundary. Raises
/// ValueError for what cannot be solved.
std::shared_ptr<SuperElement> make(const Numbers& nodes, const std::array<double, 2>& centre, bool open, int order,
                                   double young, double poisson, bool plane_strain, double thickness, bool unbounded,
                                   int threads) {
  const std::vector<Vec2> points = points_of(nodes);
  return until_ctrl_c([&] {
    return std::make_shared<SuperElement>(points, Vec2(centre[0], centre[1]), open, order, young, poisson, plane_strain,
                                          thickness, unbounded, threads);
  });
}

/// E0, E1, E2 of the scaled boundary equation, as dense arrays, (n, n) each, force / length.
py::tuple coefficients(const SuperElement& super_element) {
  const element::CoefficientMatrices found = super_element.coefficients();
  const auto dense = [](const Eigen::SparseMatrix<double>& sparse) {
    const auto [held, owner] = kept(Matrix(sparse));
    return view(*held, owner);
  };
  return py::make_tuple(dense(found.E0), dense(found.E1), dense(found.E2));
}

/// All n exponents lambda of u ~ xi^lambda, complex, in ascending real part; exactly 0 for the two translations. Below
/// 1: stress is infinite at the scaling centre. A copy.
py::array_t<std::complex<double>> exponents(SuperElement& super_element) {
  const std::vector<std::complex<double>>* const found = until_ctrl_c([&] { return &super_element.modes().exponents; });
  return py::array_t<std::complex<double>>(static_cast<py::ssize_t>(found->size()), found->data());
}

/// Displacement (m, 2) and stress (m, 3): xx, yy, xy, positive in tension, at points (m, 2) relative to the scaling
/// centre, from the displacements of the boundary (n). Not a number for points outside.
py::tuple values(SuperElement& super_element, const Numbers& displacement, const Numbers& at) {
  const Vector u = vector_of(displacement);
  const std::vector<Vec2> points = points_of(at);
  const std::vector<std::optional<element::PointValues>> all =
      until_ctrl_c([&] { return super_element.values(u, points); });
  const auto count = static_cast<py::ssize_t>(all.size());
  py::array_t<double> displacements({count, py::ssize_t{2}}), stress({count, py::ssize_t{3}});
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto& value = all[static_cast<std::size_t>(i)];
    for (int k = 0; k < 2; ++k) displacements.mutable_at(i, k) = value ? value->displacement[k] : none;
    for (int k = 0; k < 3; ++k) stress.mutable_at(i, k) = value ? value->stress[k] : none;
  }
  return py::make_tuple(displacements, stress);
}

py::array stiffness(const py::object& self) { return view(self.cast<const SuperElement&>().stiffness(), self); }

}  // namespace

void bind_super_elements(py::module_& module) {
  py::class_<SuperElement, std::shared_ptr<SuperElement>>(module, "SuperElement", doc::super_elements::SuperElement)
      .def(py::init(&make), py::arg("nodes"), py::arg("centre"), py::arg("open"), py::arg("order"), py::arg("young"),
           py::arg("poisson"), py::arg("plane_strain"), py::arg("thickness"), py::arg("unbounded"), py::arg("threads"),
           doc::super_elements::make)
      .def_property_readonly("stiffness", &stiffness, doc::super_element::SuperElementSolution_K)
      .def_property_readonly("exponents", &exponents, doc::super_elements::exponents)
      .def("coefficients", &coefficients, doc::super_elements::coefficients)
      .def("values", &values, py::arg("displacement"), py::arg("points"), doc::super_elements::values);
  module.def("lobatto_points", &geometry::lobatto_points, py::arg("order"), doc::line_basis::lobatto_points);
}

}  // namespace scabo::python
