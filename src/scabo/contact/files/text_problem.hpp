// Frictional contact problems in the text layout that Siconos reads and writes (`.dat`), the layout of the collection
// before HDF5.
//
//     dimension                              2 or 3
//     number of pairs                        N
//     storage of W                           0 dense, 1 blocks, 2 sparse
//     dN  dN
//     W                                      see below
//     q_1 ... q_dN
//     mu_1 ... mu_N
//
//     0  dN dN, then all values, column by column
//     1  number of blocks; block rows, block columns; where each block row ends; where each block column ends;
//        number of row pointers, of blocks; row pointers; block columns; for each block its number and its
//        values, column by column
//     2  1 (triplets) or 2 (compressed columns); a line with the version of CSparse; then
//        1  `triplet: 4-by-4, nzmax: 12 nnz: 12`, then `row column : value` for each entry
//        2  `4-by-4, nzmax: 12 nnz: 12, 1-norm: 6.25`, then for each column
//           `col 0 : locations 0 to 2` and `row : value` for each of its entries
//
// The layout cannot store rigid motions, history, cohesion, tension and coefficients that differ by direction; these
// need HDF5 (fclib.hpp). Siconos writes sparse values with six digits, Scabo with
// all digits.
#pragma once

#include <string>
#include <string_view>

#include "scabo/base/error.hpp"
#include "scabo/contact/files/saved_problem.hpp"

namespace scabo::contact {

/// Throws InputError: `file:line:column: what: what is wrong and what to do`.
SavedProblem read_text_problem(const std::string& file);
SavedProblem parse_text_problem(std::string_view text, const std::string& file);

/// W is written as sparse (2) if it is sparse, otherwise as dense (0). Throws std::invalid_argument for a problem that
/// the layout cannot store.
std::string text_of(const Problem& problem);

}  // namespace scabo::contact
