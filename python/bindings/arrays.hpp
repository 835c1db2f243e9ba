// NumPy arrays that show memory of the library without a copy (they keep its owner alive, and cannot be written), and
// copies.
#pragma once

#include <pybind11/numpy.h>

#include <utility>
#include <vector>

#include "bindings.hpp"
#include "scabo/base/types.hpp"

namespace scabo::python {

/// `strides` in bytes. `owner`: the Python object that holds the memory.
template <typename Number>
py::array view(const Number* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, py::handle owner) {
  py::array array(py::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

constexpr py::ssize_t of_double = sizeof(double);

inline py::array view(const Vector& x, py::handle owner) { return view(x.data(), {x.size()}, {of_double}, owner); }

/// `columns` components of each point beside each other: n / columns x columns.
inline py::array view(const Vector& x, py::ssize_t columns, py::handle owner) {
  return view(x.data(), {x.size() / columns, columns}, {columns * of_double, of_double}, owner);
}

inline py::array view(const Matrix& A, py::handle owner) {
  return view(A.data(), {A.rows(), A.cols()}, {of_double, A.rows() * of_double}, owner);
}

/// n x 2.
inline py::array view(const std::vector<Vec2>& points, py::handle owner) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  return view(reinterpret_cast<const double*>(points.data()), {static_cast<py::ssize_t>(points.size()), 2},
              {2 * of_double, of_double}, owner);
}

/// Moves a new value to memory that Python owns, for a view of it: the value and its owner.
template <typename Value>
std::pair<const Value*, py::capsule> kept(Value value) {
  auto* const held = new Value(std::move(value));
  return {held, py::capsule(held, [](void* memory) { delete static_cast<Value*>(memory); })};
}

/// What Python gives as numbers, converted to double where necessary, row by row.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline std::vector<Vec2> points_of(const Numbers& array) {
  if (array.ndim() != 2 || array.shape(1) != 2) throw py::value_error("points must be an array of shape (n, 2)");
  std::vector<Vec2> points(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points[static_cast<std::size_t>(i)] = {array.at(i, 0), array.at(i, 1)};
  return points;
}

inline Vector vector_of(const Numbers& array) {
  if (array.ndim() != 1) throw py::value_error("must be an array of one dimension");
  return Eigen::Map<const Vector>(array.data(), array.size());
}

/// A copy of rows of `columns` numbers, of one in a flat array.
template <typename Number>
py::array copied(const std::vector<Number>& numbers, py::ssize_t columns = 1) {
  const auto count = static_cast<py::ssize_t>(numbers.size()) / columns;
  return columns == 1 ? py::array_t<Number>(count, numbers.data())
                      : py::array_t<Number>(std::vector<py::ssize_t>{count, columns}, numbers.data());
}

}  // namespace scabo::python
