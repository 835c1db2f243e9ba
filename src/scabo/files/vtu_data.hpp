// Arrays of numbers in a VTK XML file: text, base64 or raw bytes, with zlib's compression or without.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace scabo::files {

/// Values in the two forms that a mesh needs.
struct VtuValues {
  bool integers = false;
  std::vector<std::int64_t> whole;
  std::vector<double> real;
  std::vector<int> lines;  ///< per value, of text; else empty
  std::size_t size() const { return integers ? whole.size() : real.size(); }
  double at(std::size_t i) const { return integers ? static_cast<double>(whole[i]) : real[i]; }
};

/// How all arrays of a file are written.
struct VtuEncoding {
  bool zlib = false;
  bool wide_header = false;  ///< counts of bytes have 8 bytes, otherwise 4
};

/// Where an array is, and how.
struct VtuSource {
  enum class Form { text, base64, raw } form = Form::text;
  std::string_view data;  ///< raw and appended base64: from the start of the array to the end of all data
  int line = 0;           ///< of the start of `data`; 0 in binary data
  std::string what;       ///< for messages, as in `array 'connectivity'`
};

/// The values of type `type` (Int8 ... UInt64, Float32, Float64); at most `most`. Throws InputError for `file`.
VtuValues read_vtu_values(const VtuSource& source, const std::string& type, const VtuEncoding& encoding,
                          std::size_t most, const std::string& file);

}  // namespace scabo::files
