#include "scabo/element/sbfem/super_element.hpp"

namespace scabo::element {

Matrix Block::join(const Matrix& v, const Matrix& a) const {
  Matrix u = R * a;
  u(I, Eigen::all) += v;
  return u;
}

Matrix Block::v_of(const Matrix& u) const { return u(I, Eigen::all) - R(I, Eigen::all) * u(J, Eigen::all); }

Matrix Block::from_v(const Matrix& f_v) const {
  Matrix f(R.rows(), f_v.cols());
  f(I, Eigen::all) = f_v;
  f(J, Eigen::all) = -Matrix(R(I, Eigen::all)).transpose() * f_v;
  return f;
}

}  // namespace scabo::element
