// The source of tile_kernel.hpp, compiled for registers of SCABO_LANES doubles in namespace SCABO_KERNEL. It includes
// no other header and has internal linkage throughout: an inline function compiled here for a newer processor must not
// be the one that the linker keeps for the rest of the program.

#include "scabo/linalg/tile_kernel.hpp"

namespace scabo::linalg::SCABO_KERNEL {

namespace {

typedef double V8 __attribute__((vector_size(64)));
typedef double V4 __attribute__((vector_size(32)));
typedef double V2 __attribute__((vector_size(16)));

template <int W>
struct Vector;
template <>
struct Vector<8> {
  typedef V8 type;
};
template <>
struct Vector<4> {
  typedef V4 type;
};
template <>
struct Vector<2> {
  typedef V2 type;
};
template <>
struct Vector<1> {
  typedef double type;
};

/// Loads a vector from any address by a copy, which compilers turn into one unaligned move.
template <typename V>
inline V load(const double* from) {
  V value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
template <typename V>
inline void put(const V& value, double* to) {
  __builtin_memcpy(to, &value, sizeof value);
}

constexpr int lanes = SCABO_LANES;
constexpr int tile_vectors = SCABO_TILE_VECTORS, tile_columns = SCABO_TILE_COLUMNS;

/// Entries (k, c) of a right-hand factor of which a tile needs some columns: a matrix or its transpose.
struct Factor {
  const double* at;
  long row, column;  ///< from one k, one c to the next
};

/// acc(r, c) <- C(r, c) - sum over k < depth of A(r, k) B(k, c); R vectors of W rows. The sum is computed first: if it
/// is small, as in the last steps of ring doubling, its rounding is small too.
template <int W, int R, int C>
inline void subtract(const double* A, long a_stride, Factor B, int depth, const double* from, long from_stride,
                     typename Vector<W>::type (&acc)[R][C]) {
  using V = typename Vector<W>::type;
#pragma GCC unroll 8
  for (int r = 0; r < R; ++r)
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) acc[r][c] = V{};
  for (int k = 0; k < depth; ++k, A += a_stride, B.at += B.row) {
    V left[R];
#pragma GCC unroll 8
    for (int r = 0; r < R; ++r) left[r] = load<V>(A + r * W);
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) {
      const double right = B.at[c * B.column];
#pragma GCC unroll 8
      for (int r = 0; r < R; ++r) acc[r][c] += left[r] * right;
    }
  }
#pragma GCC unroll 8
  for (int r = 0; r < R; ++r)
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) acc[r][c] = load<V>(from + c * from_stride + r * W) - acc[r][c];
}

template <int W, int R, int C>
inline void store(const typename Vector<W>::type (&acc)[R][C], double* out, long out_stride) {
#pragma GCC unroll 8
  for (int r = 0; r < R; ++r)
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) put(acc[r][c], out + c * out_stride + r * W);
}

/// Calls f<W, R>(first row) for tiles that cover `rows` rows: widest first, single rows at the end.
template <typename F>
inline void over_rows(int rows, const F& f) {
  int row = 0;
  for (; row + tile_vectors * lanes <= rows; row += tile_vectors * lanes)
    f.template operator()<lanes, tile_vectors>(row);
  if constexpr (tile_vectors > 2)
    if (row + 2 * lanes <= rows) f.template operator()<lanes, 2>(row), row += 2 * lanes;
  if (row + lanes <= rows) f.template operator()<lanes, 1>(row), row += lanes;
  if constexpr (lanes > 4)
    if (row + 4 <= rows) f.template operator()<4, 1>(row), row += 4;
  if constexpr (lanes > 2)
    if (row + 2 <= rows) f.template operator()<2, 1>(row), row += 2;
  if (row < rows) f.template operator()<1, 1>(row);
}

/// Calls f<C>() for the widest block of columns that is not wider than `columns`; returns C.
template <typename F>
inline int with_columns(int columns, const F& f) {
  if constexpr (tile_columns == 8)
    if (columns >= 8) return f.template operator()<8>(), 8;
  if (columns >= 4) return f.template operator()<4>(), 4;
  if (columns >= 2) return f.template operator()<2>(), 2;
  return f.template operator()<1>(), 1;
}

void subtract_square(const double* A, long a_stride, int n, int depth, double* C, long c_stride) {
  for (int j = 0; j < n;)
    j += with_columns(n - j, [&]<int Columns>() {
      over_rows(n - j, [&]<int W, int R>(int row) {
        typename Vector<W>::type acc[R][Columns];
        double* const out = C + j * c_stride + j + row;
        subtract<W, R, Columns>(A + j + row, a_stride, {A + j, a_stride, 1}, depth, out, c_stride, acc);
        store<W, R, Columns>(acc, out, c_stride);
      });
    });
}

/// Columns `first` ... of B <- (B - B_before L') L_cc^-T, where B_before are the `first` columns before them.
template <int C>
inline void divide_columns(const double* L, long stride, const double* over, int first, double* B, long b_stride,
                           int rows) {
  const double* const corner = L + first * stride + first;
  over_rows(rows, [&]<int W, int R>(int row) {
    typename Vector<W>::type acc[R][C];
    double* const out = B + first * b_stride + row;
    subtract<W, R, C>(B + row, b_stride, {L + first, stride, 1}, first, out, b_stride, acc);
#pragma GCC unroll 8
    for (int c = 0; c < C; ++c) {
#pragma GCC unroll 8
      for (int d = 0; d < c; ++d)
#pragma GCC unroll 8
        for (int r = 0; r < R; ++r) acc[r][c] -= acc[r][d] * corner[d * stride + c];
#pragma GCC unroll 8
      for (int r = 0; r < R; ++r) acc[r][c] *= over[first + c];
    }
    store<W, R, C>(acc, out, b_stride);
  });
}

/// Columns `first` ... of B <- (B - B_after L) L_cc^-1, where B_after are the n - first - C columns after them.
template <int C>
inline void divide_columns_transposed(const double* L, long stride, const double* over, int first, int n, double* B,
                                      long b_stride, int rows) {
  const double* const corner = L + first * stride + first;
  over_rows(rows, [&]<int W, int R>(int row) {
    typename Vector<W>::type acc[R][C];
    double* const out = B + first * b_stride + row;
    subtract<W, R, C>(B + (first + C) * b_stride + row, b_stride, {corner + C, 1, stride}, n - first - C, out, b_stride,
                      acc);
#pragma GCC unroll 8
    for (int c = C - 1; c >= 0; --c) {
#pragma GCC unroll 8
      for (int d = c + 1; d < C; ++d)
#pragma GCC unroll 8
        for (int r = 0; r < R; ++r) acc[r][c] -= acc[r][d] * corner[c * stride + d];
#pragma GCC unroll 8
      for (int r = 0; r < R; ++r) acc[r][c] *= over[first + c];
    }
    store<W, R, C>(acc, out, b_stride);
  });
}

void divide(const double* L, long stride, const double* over, int n, double* B, long b_stride, int rows,
            bool transposed) {
  if (!transposed) {
    for (int j = 0; j < n;)
      j += with_columns(n - j, [&]<int C>() { divide_columns<C>(L, stride, over, j, B, b_stride, rows); });
  } else {
    for (int end = n; end > 0;)
      end -= with_columns(
          end, [&]<int C>() { divide_columns_transposed<C>(L, stride, over, end - C, n, B, b_stride, rows); });
  }
}

bool cholesky(double* A, long stride, int n, double* over) {
  for (int j = 0; j < n;) {
    bool definite = true;
    j += with_columns(n - j, [&]<int C>() {
      double* const corner = A + j * stride + j;
      over_rows(C, [&]<int W, int R>(int row) {
        typename Vector<W>::type acc[R][C];
        subtract<W, R, C>(A + j + row, stride, {A + j, stride, 1}, j, corner + row, stride, acc);
        store<W, R, C>(acc, corner + row, stride);
      });
      double block[C][C];  // by columns
      for (int c = 0; c < C; ++c)
        for (int r = c; r < C; ++r) block[c][r] = corner[c * stride + r];
      for (int c = 0; c < C; ++c) {
        for (int d = 0; d < c; ++d)
          for (int r = c; r < C; ++r) block[c][r] -= block[d][r] * block[d][c];
        definite = definite && block[c][c] > 0.0;
        const double pivot = __builtin_sqrt(block[c][c]);
        over[j + c] = 1.0 / pivot;
        block[c][c] = pivot;
        for (int r = c + 1; r < C; ++r) block[c][r] *= over[j + c];
      }
      for (int c = 0; c < C; ++c)
        for (int r = c; r < C; ++r) corner[c * stride + r] = block[c][r];
      if (definite && j + C < n) divide_columns<C>(A, stride, over, j, A + j + C, stride, n - j - C);
    });
    if (!definite) return false;
  }
  return true;
}

}  // namespace

extern const TileKernel kernel;
const TileKernel kernel{SCABO_INSTRUCTIONS, subtract_square, cholesky, divide};

}  // namespace scabo::linalg::SCABO_KERNEL
