// The source of batch_kernel.hpp, compiled for SCABO_LANES doubles a register in namespace SCABO_KERNEL. It includes no
// other header and has internal linkage throughout: an inline function compiled here for a newer processor must not be
// the one that the linker keeps for the rest of the program.
//
// Matrix products are computed in tiles of `tile` x `tile` vectors that stay in registers, so that every load serves as
// many multiplications as the number of registers allows.

#include "scabo/element/plane/batch_kernel.hpp"

namespace scabo::element::SCABO_KERNEL {

namespace {

constexpr int lanes = SCABO_LANES;
constexpr int tile = SCABO_TILE;

typedef double V __attribute__((vector_size(8 * SCABO_LANES), may_alias));

inline V square_root(V a) {
  V root;
  for (int l = 0; l < lanes; ++l) root[l] = __builtin_sqrt(a[l]);
  return root;
}

inline V absolute(V a) { return a < 0.0 ? -a : a; }

/// a if it is positive, otherwise NaN: a failure in one lane shows at its end, and the other lanes continue.
inline V positive(V a) { return a > 0.0 ? a : (a - a) / (a - a); }

/// acc(r, c) += sum over k < depth of a[k, r] b[k, c]; a and b advance by a_step and b_step with k, by a_next with r.
template <int R, int C>
inline void accumulate(const V* a, long a_step, long a_next, const V* b, long b_step, int depth, V (&acc)[R][C]) {
  for (int k = 0; k < depth; ++k, a += a_step, b += b_step) {
    V right[C];
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) right[c] = b[c];
#pragma GCC unroll 8
    for (int r = 0; r < R; ++r) {
      const V left = a[r * a_next];
#pragma GCC unroll 8
      for (int c = 0; c < C; ++c) acc[r][c] += left * right[c];
    }
  }
}

/// C(i, j) = factor * C(i, j) - sum_k A(k, i) B(k, j), one tile.
template <int R, int C>
void product_tile(const V* A, const V* B, long stride, int depth, double factor, V* out, long out_stride) {
  V acc[R][C] = {};
  accumulate<R, C>(A, stride, 1, B, stride, depth, acc);
  for (int r = 0; r < R; ++r)
    for (int c = 0; c < C; ++c) {
      V& value = out[r * out_stride + c];
      value = factor == 0.0 ? -acc[r][c] : value - acc[r][c];
    }
}

/// Calls f with the compile-time sizes of a tile of r x c.
template <int R, typename F>
inline void with_columns(int c, const F& f) {
  if (c == tile) return f.template operator()<R, tile>();
  if (c == 1) return f.template operator()<R, 1>();
  if constexpr (tile > 2)
    if (c == 2) return f.template operator()<R, 2>();
  if constexpr (tile > 3)
    if (c == 3) return f.template operator()<R, 3>();
}
template <typename F>
inline void with_tile(int r, int c, const F& f) {
  if (r == tile) return with_columns<tile>(c, f);
  if (r == 1) return with_columns<1>(c, f);
  if constexpr (tile > 2)
    if (r == 2) return with_columns<2>(c, f);
  if constexpr (tile > 3)
    if (r == 3) return with_columns<3>(c, f);
}

inline int least(int a, int b) { return a < b ? a : b; }

/// C <- factor C - A'B, m x m, rows of A and B `stride` apart; only tiles that reach the lower triangle where `lower`.
void subtract_product(const V* A, const V* B, long stride, int m, double factor, bool lower, V* C) {
  for (int i = 0; i < m; i += tile)
    for (int j = 0; j < (lower ? i + 1 : m); j += tile)
      with_tile(least(tile, m - i), least(tile, m - j), [&]<int R, int Columns>() {
        product_tile<R, Columns>(A + i, B + j, stride, m, factor, C + i * static_cast<long>(m) + j, m);
      });
}

/// L: on entry the lower triangle of a matrix, on exit its Cholesky factor with inverse diagonal. m x m by rows.
void cholesky(V* L, int m) {
  for (int j = 0; j < m; j += tile) {
    const int columns = least(tile, m - j);
    for (int i = j; i < m; i += tile)
      with_tile(least(tile, m - i), columns, [&]<int R, int C>() {
        V acc[R][C] = {};
        // Rows j of L are read along k with the same stride as rows i.
        for (int k = 0; k < j; ++k) {
          V right[C];
#pragma GCC unroll 8
          for (int c = 0; c < C; ++c) right[c] = L[(j + c) * static_cast<long>(m) + k];
#pragma GCC unroll 8
          for (int r = 0; r < R; ++r) {
            const V left = L[(i + r) * static_cast<long>(m) + k];
#pragma GCC unroll 8
            for (int c = 0; c < C; ++c) acc[r][c] += left * right[c];
          }
        }
        for (int c = 0; c < C; ++c)
          for (int r = i == j ? c : 0; r < R; ++r) {
            V value = L[(i + r) * static_cast<long>(m) + j + c] - acc[r][c];
            for (int k = 0; k < c; ++k)
              value -= L[(i + r) * static_cast<long>(m) + j + k] * L[(j + c) * static_cast<long>(m) + j + k];
            L[(i + r) * static_cast<long>(m) + j + c] = i == j && r == c
                                                            ? 1.0 / square_root(positive(value))
                                                            : value * L[(j + c) * static_cast<long>(m) + j + c];
          }
      });
  }
}

/// Z <- L^-1 Z, m rows `stride` apart, `columns` columns.
void solve_lower(const V* L, int m, V* Z, long stride, int columns) {
  for (int j = 0; j < columns; j += tile)
    for (int i = 0; i < m; i += tile)
      with_tile(least(tile, m - i), least(tile, columns - j), [&]<int R, int C>() {
        V acc[R][C] = {};
        accumulate<R, C>(L + i * static_cast<long>(m), 1, m, Z + j, stride, i, acc);
        V solved[R][C];
#pragma GCC unroll 8
        for (int r = 0; r < R; ++r) {
          const V* const row = L + (i + r) * static_cast<long>(m) + i;
#pragma GCC unroll 8
          for (int c = 0; c < C; ++c) {
            V value = Z[(i + r) * stride + j + c] - acc[r][c];
#pragma GCC unroll 8
            for (int k = 0; k < r; ++k) value -= row[k] * solved[k][c];
            solved[r][c] = value * row[r];
            Z[(i + r) * stride + j + c] = solved[r][c];
          }
        }
      });
}

/// Adds one boundary element to E0, E1, E2 (n x n by rows).
void add_element(const BatchElement& element, const V* x, const V* D, V thickness, int n, V* E0, V* E1, V* E2) {
  const V d11 = D[0], d12 = D[1], d13 = D[2], d22 = D[3], d23 = D[4], d33 = D[5];
  for (int q = 0; q < element.points; ++q) {
    V px = {}, py = {}, tx = {}, ty = {};  // the point and its derivative along eta
    for (int i = 0; i < element.count; ++i) {
      const V nx = x[2 * element.nodes[i]], ny = x[2 * element.nodes[i] + 1];
      const double N = element.N[q + element.points * i], slope = element.N_eta[q + element.points * i];
      px += N * nx, py += N * ny, tx += slope * nx, ty += slope * ny;
    }
    const V scale = element.weights[q] * thickness / positive(px * ty - py * tx);
    // |J| times the columns of D b1 (p, q), of D b2 (r, s), page 1, (1.5).
    const V p0 = d11 * ty - d13 * tx, p1 = d12 * ty - d23 * tx, p2 = d13 * ty - d33 * tx;
    const V q0 = d13 * ty - d12 * tx, q1 = d23 * ty - d22 * tx, q2 = d33 * ty - d23 * tx;
    const V r0 = d13 * px - d11 * py, r2 = d33 * px - d13 * py;
    const V s0 = d12 * px - d13 * py, s1 = d22 * px - d23 * py, s2 = d23 * px - d33 * py;
    const V a00 = scale * (ty * p0 - tx * p2), a01 = scale * (ty * q0 - tx * q2), a11 = scale * (ty * q2 - tx * q1);
    const V b00 = scale * (px * p2 - py * p0), b01 = scale * (px * q2 - py * q0), b10 = scale * (px * p1 - py * p2),
            b11 = scale * (px * q1 - py * q2);
    const V c00 = scale * (px * r2 - py * r0), c01 = scale * (px * s2 - py * s0), c11 = scale * (px * s1 - py * s2);
    for (int i = 0; i < element.count; ++i) {
      const double Ni = element.N[q + element.points * i], slope_i = element.N_eta[q + element.points * i];
      for (int j = 0; j < element.count; ++j) {
        const double Nj = element.N[q + element.points * j], slope_j = element.N_eta[q + element.points * j];
        const double w0 = Ni * Nj, w1 = slope_i * Nj, w2 = slope_i * slope_j;
        const long at = 2 * element.nodes[i] * static_cast<long>(n) + 2 * element.nodes[j];
        V *e0 = E0 + at, *e1 = E1 + at, *e2 = E2 + at;
        e0[0] += w0 * a00, e0[1] += w0 * a01, e0[n] += w0 * a01, e0[n + 1] += w0 * a11;
        e1[0] += w1 * b00, e1[1] += w1 * b01, e1[n] += w1 * b10, e1[n + 1] += w1 * b11;
        e2[0] += w2 * c00, e2[1] += w2 * c01, e2[n] += w2 * c01, e2[n + 1] += w2 * c11;
      }
    }
  }
}

/// 2 / d of the first ring: approximately the square root of the largest exponent. It affects only the number of
/// doublings.
V first_width(const V* E0, const V* E2, int n) {
  V largest = {};
  for (int i = 0; i < n; i += 2) {
    const long x = i * static_cast<long>(n) + i, y = x + n + 1;
    const V ratio = (E2[x] + E2[y]) / (E0[x] + E0[y]);
    largest = ratio > largest ? ratio : largest;
  }
  // 4 for two nodes: the diagonal of [1 -1; -1 1] against [2 1; 1 2], and their largest eigenvalue.
  return 2.0 / square_root(square_root(4.0 * largest));
}

/// The node whose rows are removed: the one with the largest share of E0, to avoid cancellation.
int heaviest_node(const V* E0, int n) {
  int heaviest = 0;
  double most = -1.0;
  V total = {};
  for (long i = 0; i < n; ++i) total += E0[i * n + i];
  for (long i = 0; i < n; i += 2) {
    const V share = (E0[i * n + i] + E0[(i + 1) * n + i + 1]) / total;
    double sum = 0.0;
    for (int l = 0; l < lanes; ++l) sum += share[l] > 0.0 ? share[l] : 0.0;
    if (sum > most) most = sum, heaviest = static_cast<int>(i);
  }
  return heaviest;
}

/// Eq. (4) of stiffness.hpp and (1) of ring_doubling.hpp: the first ring, without the rows J = out, out + 1. m x m,
/// lower triangles of K11, K22.
void first_ring(const V* E0, const V* E1, const V* E2, int n, int out, V* G, V* F, V* K11, V* K22, V* K12) {
  // G(a, i) = (R'E0)_ai, F(a, i) = (E1 R)_ia; M = R'E0R.
  V m00 = {}, m01 = {}, m11 = {};
  for (int i = 0; i < n; ++i) {
    V g0 = {}, g1 = {}, f0 = {}, f1 = {};
    const V *e0 = E0 + i * static_cast<long>(n), *e1 = E1 + i * static_cast<long>(n);
    for (int j = 0; j < n; j += 2) g0 += e0[j], g1 += e0[j + 1], f0 += e1[j], f1 += e1[j + 1];
    G[i] = g0, G[n + i] = g1, F[i] = f0, F[n + i] = f1;
    if (i % 2 == 0)
      m00 += g0, m01 += g1;
    else
      m11 += g1;
  }
  const V determinant = positive(m00 * m11 - m01 * m01);
  const V i00 = m11 / determinant, i01 = -m01 / determinant, i11 = m00 / determinant;
  const V width = first_width(E0, E2, n), over = 1.0 / width, quarter = 0.25 * width;
  const int m = n - 2;
  for (int i = 0; i < m; ++i) {
    const int at = i < out ? i : i + 2;
    const V p0 = i00 * G[at] + i01 * G[n + at], p1 = i01 * G[at] + i11 * G[n + at];  // M^-1 R'E0
    const V h0 = i00 * F[at] + i01 * F[n + at], h1 = i01 * F[at] + i11 * F[n + at];  // H = M^-1 R'E1'
    for (int j = 0; j <= i; ++j) {
      const int to = j < out ? j : j + 2;
      const long ij = at * static_cast<long>(n) + to, ji = to * static_cast<long>(n) + at;
      const V e0 = over * (E0[ij] - (p0 * G[to] + p1 * G[n + to]));
      const V e2 = quarter * (E2[ij] - (h0 * F[to] + h1 * F[n + to]));
      const V e1_ij = E1[ij] - (h0 * G[to] + h1 * G[n + to]), e1_ji = E1[ji] - (p0 * F[to] + p1 * F[n + to]);
      const V odd = 0.5 * (e1_ij + e1_ji), skew = 0.5 * (e1_ij - e1_ji);
      const long ring = i * static_cast<long>(m) + j;
      K22[ring] = e0 + e2 + odd;
      K11[ring] = e0 + e2 - odd;
      K12[ring] = e2 - e0 + skew;
      K12[j * static_cast<long>(m) + i] = e2 - e0 - skew;
    }
  }
}

/// Largest entry of K12 over all lanes that have not failed, with the diagonal of K22 scaled to 1. `scale`: m vectors.
double coupling(const V* K12, const V* K22, int m, V* scale) {
  for (long i = 0; i < m; ++i) scale[i] = 1.0 / square_root(positive(K22[i * m + i]));
  V largest = {};
  for (long i = 0; i < m; ++i)
    for (long j = 0; j < m; ++j) {
      const V value = absolute(K12[i * m + j]) * scale[i] * scale[j];
      largest = value > largest ? value : largest;
    }
  double most = 0.0;
  for (int l = 0; l < lanes; ++l) most = largest[l] > most ? largest[l] : most;
  return most;
}

/// Eq. (2) of ring_doubling.hpp until K22 has converged.
void double_rings(int m, V* K11, V* K22, V* K12, V* L, V* Z, V* scale) {
  constexpr int most = 16;  // more is left to solve_super_element, as the residual shows
  const long stride = 2 * static_cast<long>(m);
  for (int doubling = 0; doubling < most; ++doubling) {
    const double ratio = coupling(K12, K22, m, scale);
    if (!(ratio > 1e-10)) return;    // the next step would change K22 by its square
    const bool last = ratio < 1e-5;  // and the one after by its fourth power: only K22 is needed
    for (long i = 0; i < m; ++i)
      for (long j = 0; j <= i; ++j) L[i * m + j] = K11[i * m + j] + K22[i * m + j];
    cholesky(L, m);
    for (long i = 0; i < m; ++i)
      for (long j = 0; j < m; ++j) {
        Z[i * stride + j] = K12[i * m + j];
        Z[i * stride + m + j] = K12[j * m + i];
      }
    solve_lower(L, m, Z, stride, last ? m : 2 * m);
    subtract_product(Z, Z, stride, m, 1.0, true, K22);
    if (last) return;
    subtract_product(Z + m, Z + m, stride, m, 1.0, true, K11);
    subtract_product(Z + m, Z, stride, m, 0.0, false, K12);
  }
}

/// K with the rows `out`, `out` + 1, which follow from K R = 0; lower triangle by rows.
void put_back(const V* K22, int n, int out, V* rows, V* K) {
  const int m = n - 2;
  const auto kept = [&](long i, long j) { return i >= j ? K22[i * m + j] : K22[j * m + i]; };
  for (long i = 0; i < m; ++i)  // rows(a, i): K of row J_a
    for (int a = 0; a < 2; ++a) {
      V sum = {};
      for (long j = a; j < m; j += 2) sum -= kept(j, i);
      rows[a * m + i] = sum;
    }
  V corner[2][2] = {};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (long i = b; i < m; i += 2) corner[a][b] -= rows[a * m + i];
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      const bool row_out = i == out || i == out + 1, column_out = j == out || j == out + 1;
      const int r = i < out ? i : i - 2, c = j < out ? j : j - 2;
      K[i * (i + 1) / 2 + j] = row_out && column_out ? 0.5 * (corner[i - out][j - out] + corner[j - out][i - out])
                               : row_out             ? rows[(i - out) * m + c]
                               : column_out          ? rows[(j - out) * m + r]
                                                     : K22[r * static_cast<long>(m) + c];
    }
}

/// |K r| / (|K| |r|) for the rotation r.
V rotation_residual(const V* K, const V* x, int n, V* forces) {
  V size = {}, length = {}, residual = {};
  for (int i = 0; i < n; ++i) forces[i] = V{};
  for (int i = 0; i < n; ++i) {
    const V r_i = i % 2 == 0 ? -x[i + 1] : x[i - 1];
    for (int j = 0; j <= i; ++j) {
      const V value = K[i * (i + 1) / 2 + j], r_j = j % 2 == 0 ? -x[j + 1] : x[j - 1];
      forces[i] += value * r_j;
      if (j < i) forces[j] += value * r_i;
      size += absolute(value);
    }
    length += absolute(r_i);
  }
  for (int i = 0; i < n; ++i) residual += absolute(forces[i]);
  return residual * static_cast<double>(n) / (size * length);
}

void solve(const BatchShape& shape, const BatchLanes& data, double* workspace) {
  const int n = 2 * shape.nodes, m = n - 2;
  const long full = static_cast<long>(n) * n, part = static_cast<long>(m) * m;
  const V* const x = reinterpret_cast<const V*>(data.x);
  const V* const D = reinterpret_cast<const V*>(data.D);
  V* const E0 = reinterpret_cast<V*>(workspace);
  V *const E1 = E0 + full, *const E2 = E1 + full, *const K11 = E2 + full, *const K22 = K11 + part,
           *const K12 = K22 + part, *const vectors = K12 + part, *const E2_diagonal = vectors + 4 * n;
  for (long i = 0; i < 3 * full; ++i) E0[i] = V{};
  for (int e = 0; e < shape.elements; ++e)
    add_element(shape.element[e], x, D + (shape.elasticities == 1 ? 0 : 6 * e),
                *reinterpret_cast<const V*>(data.thickness), n, E0, E1, E2);
  for (long i = 0; i < n; ++i) E2_diagonal[i] = E2[i * n + i];
  const int out = heaviest_node(E0, n);
  first_ring(E0, E1, E2, n, out, vectors, vectors + 2 * n, K11, K22, K12);
  // The coefficient matrices are no longer needed; their memory is used for L (m^2) and Z (2 m^2).
  double_rings(m, K11, K22, K12, E0, E1, vectors);
  V* const K = reinterpret_cast<V*>(data.K);
  put_back(K22, n, out, vectors, K);
  *reinterpret_cast<V*>(data.residual) = rotation_residual(K, x, n, vectors);
  V cancellation = {};
  for (long i = 0; i < n; ++i) {
    const V ratio = E2_diagonal[i] / K[i * (i + 1) / 2 + i];
    cancellation = ratio > cancellation ? ratio : cancellation;
  }
  *reinterpret_cast<V*>(data.cancellation) = cancellation;
}

}  // namespace

extern const BatchKernel kernel;
const BatchKernel kernel{SCABO_INSTRUCTIONS, lanes, solve};

}  // namespace scabo::element::SCABO_KERNEL
