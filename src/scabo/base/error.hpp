// Errors of Scabo.
//
// Bad input is an InputError: a list of diagnostics, each with its place in the model file and a remedy. A broken
// invariant is a bug of Scabo and is reported as one. A solve that does not converge is neither of these: it is a
// result (contact/solution.hpp).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scabo {

/// Position in a model file.
struct Source {
  int line = 0;      ///< from 1; 0 when the model was not read from a file
  int column = 0;    ///< from 1
  std::string path;  ///< keys from the root, as in `bodies.upper.material`
};

/// A mistake in the input: its position, and a message that says how to correct it.
struct Diagnostic {
  Source at;
  std::string message;
};

/// The model file, or a file that it names, is wrong. Carries every mistake found.
class InputError : public std::runtime_error {
 public:
  InputError(std::string file, std::vector<Diagnostic> diagnostics);
  const std::string& file() const { return file_; }
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::string file_;
  std::vector<Diagnostic> diagnostics_;
};

/// `model.yaml:12:5: bodies.upper.material: there is no material named 'concreet' (did you mean 'concrete'?)`
std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic);

/// An invariant of Scabo's own code does not hold: a bug that should be reported.
class BrokenInvariant : public std::logic_error {
 public:
  explicit BrokenInvariant(const std::string& what) : std::logic_error("bug in Scabo, please report it: " + what) {}
};

/// Throws BrokenInvariant with `what` unless `holds`.
inline void ensure(bool holds, const char* what) {
  if (!holds) throw BrokenInvariant(what);
}

}  // namespace scabo
