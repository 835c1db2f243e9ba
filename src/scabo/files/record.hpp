// Records of ground motion: what a file says of an acceleration over time.
//
//     PEER (.AT2)     four lines of text, of which the last has NPTS and DT, then values in g
//     K-NET           lines of text with `Sampling Freq(Hz)` and `Scale Factor`, of which values are multiples, in
//     cm/s2 table           time and value in two columns, or in one of several; separated by blanks, commas or
//     semicolons
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"

namespace scabo::files {

struct Record {
  double begin = 0.0, step = 0.0;   ///< times, seconds
  std::vector<double> values;       ///< as in the file, K-NET's times its scale factor
  std::optional<std::string> unit;  ///< that of the format: `g` or `cm/s2`; empty: the file does not say

  double largest() const;
};

/// `column`: of the values in a table, from 2. Throws InputError, with the line, for a file that cannot be read, that
/// has gaps or times that are not equally spaced.
Record read_record(const std::string& file, int column = 2);

}  // namespace scabo::files
