// Invariant subspaces of a real matrix that belong to groups of its eigenvalues, from an ordered real Schur form.
//
// S = U T U' with the eigenvalues along T sorted by group. For one group, with the groups before it (A), the group
// itself (B) and the groups after it (C),
//
//         [ A  T_AB T_AC ]
//     T = [    B    T_BC ],     A Y - Y B = -T_AB,     B W - W C = T_BC                                         (1)
//         [         C    ]
//
//     V = U [Y; 1; 0],   Q = [0, 1, W] U':      S V = V B,   Q S = B Q,   Q V = 1                               (2)
//
// V Q is the spectral projection onto the group, and Q gives the coordinates of a vector in it. (1) are Sylvester
// equations of quasi-triangular matrices. No eigenvectors are computed: eigenvalues within a group may be repeated,
// defective, or nearly so. Only the gaps between groups matter.
//
// Source: Golub, Van Loan, Matrix Computations, 4th ed. 2013, section 7.6.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

struct InvariantSubspace {
  Matrix V;                                       // n x m
  Matrix T;                                       // m x m, quasi-triangular: S restricted to the subspace (B of eq. 1)
  Matrix Q;                                       // m x n
  std::vector<std::complex<double>> eigenvalues;  ///< m, in the order of T
  double projection_norm = 1.0;                   ///< |V Q|: amplification of rounding, 1 if orthogonal to the rest
};

/// Number of the group of an eigenvalue, 0 or more; both of a complex pair must be in the same group.
using GroupOf = std::function<int(std::complex<double>)>;

class OrderedSchur {
 public:
  /// S: n x n. Throws BrokenInvariant if LAPACK finds two groups too close to be separated.
  OrderedSchur(const Matrix& S, const GroupOf& group_of);

  const Matrix& U() const { return schur_.U; }
  const Matrix& T() const { return schur_.T; }
  const std::vector<std::complex<double>>& eigenvalues() const { return eigenvalues_; }  ///< along T
  /// Subspace of the eigenvalues at `first` to `first + count - 1` along T; the range must not split a complex pair.
  InvariantSubspace subspace(int first, int count) const;
  /// Subspace of group `group`; without columns if the group is empty.
  InvariantSubspace group(int group) const;

 private:
  RealSchur schur_;
  std::vector<std::complex<double>> eigenvalues_;
  std::vector<int> groups_;  // group of every eigenvalue, ascending
};

/// Groups of eigenvalues that are closer than `gap` to each other directly or through others; a complex pair is always
/// in one group. Groups are numbered from 0 in ascending order of their mean real part.
std::vector<int> clusters(const std::vector<std::complex<double>>& eigenvalues, double gap);

/// Whether some eigenvalues of quasi-triangular T are equal within `spread` and still coupled, so that there are fewer
/// eigenvectors than eigenvalues. (With a full set of eigenvectors T is diagonal there; defective eigenvalues are
/// separated only by a root of rounding, and the coupling remains.)
bool is_defective(const Matrix& T, const std::vector<std::complex<double>>& eigenvalues, double spread);
inline bool is_defective(const InvariantSubspace& part, double spread) {
  return is_defective(part.T, part.eigenvalues, spread);
}

/// exp(T s) for a small T, m x m.
Matrix small_exponential(const Matrix& T, double s);

/// X of T' X + X T = P for quasi-triangular T whose eigenvalues have positive real part.
Matrix solve_lyapunov(const Matrix& T, const Matrix& P);

}  // namespace scabo::linalg
