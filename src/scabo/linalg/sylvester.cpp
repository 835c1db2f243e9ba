#include "scabo/linalg/sylvester.hpp"

#include <lapacke.h>

#include "scabo/base/error.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

namespace {

using Part = Eigen::Ref<const Matrix>;

/// Position at which a quasi-triangular matrix is halved, never inside a 2 x 2 block.
Eigen::Index half(const Part& T) {
  const Eigen::Index middle = T.rows() / 2;
  return T(middle, middle - 1) != 0.0 ? middle + 1 : middle;
}

void solve_small(const Part& T1, const Part& T2, Eigen::Ref<Matrix> C) {
  double scale = 1.0;  // less than 1 only where X would overflow
  const int info =
      LAPACKE_dtrsyl_work(LAPACK_COL_MAJOR, 'T', 'N', 1, static_cast<int>(C.rows()), static_cast<int>(C.cols()),
                          T1.data(), static_cast<int>(T1.outerStride()), T2.data(), static_cast<int>(T2.outerStride()),
                          C.data(), static_cast<int>(C.outerStride()), &scale);
  ensure(info == 0 && scale == 1.0, "Sylvester's equation is singular");
}

void solve(const Part& T1, const Part& T2, Eigen::Ref<Matrix> C) {
  constexpr Eigen::Index small = 48;
  if (C.rows() == 0 || C.cols() == 0) return;
  if (C.rows() <= small && C.cols() <= small) return solve_small(T1, T2, C);
  if (C.rows() >= C.cols()) {
    const Eigen::Index k = half(T1), rest = C.rows() - k;
    solve(T1.topLeftCorner(k, k), T2, C.topRows(k));
    add_product(-1.0, Matrix(T1.topRightCorner(k, rest).transpose()), C.topRows(k), C.bottomRows(rest));
    solve(T1.bottomRightCorner(rest, rest), T2, C.bottomRows(rest));
  } else {
    const Eigen::Index k = half(T2), rest = C.cols() - k;
    solve(T1, T2.topLeftCorner(k, k), C.leftCols(k));
    add_product(-1.0, C.leftCols(k), T2.topRightCorner(k, rest), C.rightCols(rest));
    solve(T1, T2.bottomRightCorner(rest, rest), C.rightCols(rest));
  }
}

}  // namespace

Matrix solve_sylvester(const Matrix& T1, const Matrix& T2, Matrix C) {
  ensure(T1.rows() == T1.cols() && T2.rows() == T2.cols() && C.rows() == T1.rows() && C.cols() == T2.rows(),
         "solve_sylvester: sizes differ");
  solve(T1, T2, C);
  return C;
}

}  // namespace scabo::linalg
