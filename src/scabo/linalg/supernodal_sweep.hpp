// A block of the inverse of A = L L' from the supernodal factor L:
//
//     E' A^-1 E = Y'Y,   Y = L^-1 E,   columns of E: columns of the identity                                       (1)
//
// A supernode is a group of consecutive columns of L with the same rows below them: a full trapezoid. The elimination
// tree has an edge from each supernode to the one that contains the first of its rows below. Column j of Y has nonzero
// entries only on the path from the supernode of its unit entry to the root. Supernodes are in postorder, therefore
// the columns that have reached a supernode are consecutive once they are sorted by their unit entries, and (1) is a
// sum over the supernodes of small dense products. Each supernode is visited once, as in the multifrontal method:
//
//     1. right-hand sides: unit entries, and what its children hand on
//     2. L11 Y1 = R1;  R2 - L21 Y1 is handed on to the parent;  Y1'Y1 is added to the result
//
// What waits to be handed on takes no more memory than (columns of E) x (rows of the largest supernode).
#pragma once

#include <cstdint>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// L, owned by someone else: columns [first_column[s], first_column[s + 1]) belong to supernode s; their rows are
/// rows[first_row[s]] ..., ascending, beginning with the columns themselves; entries are values[first_value[s]] ...,
/// column by column.
struct SupernodalFactor {
  std::int64_t size = 0, supernodes = 0;
  const std::int64_t *first_column = nullptr, *first_row = nullptr, *first_value = nullptr, *rows = nullptr;
  const double* values = nullptr;

  std::int64_t columns_of(std::int64_t s) const { return first_column[s + 1] - first_column[s]; }
  std::int64_t rows_of(std::int64_t s) const { return first_row[s + 1] - first_row[s]; }
};

/// (1), symmetric; `positions`: rows of L of the unit entries of E.
Matrix inverse_block(const SupernodalFactor& L, const std::vector<std::int64_t>& positions);

/// L^-1 b, in the order of the rows of L: visits only supernodes that nonzero entries of b reach.
Vector forward(const SupernodalFactor& L, Vector b);

/// L'^-1 y.
Vector backward(const SupernodalFactor& L, Vector y);
/// Its entries at the rows `wanted` of L: visits only supernodes on the paths from these to the root, since rows of a
/// supernode belong to it or to those above it on its path.
Vector backward_at(const SupernodalFactor& L, Vector y, const std::vector<std::int64_t>& wanted);

}  // namespace scabo::linalg
