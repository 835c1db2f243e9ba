// Staged construction: when a body or a support is there, and what is wrong with that, in the plane and in space.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/model/step.hpp"

namespace scabo::model {

/// Indices of the steps in which it is put in place (0: it is there from the start) and taken away (-1: it stays).
struct Stay {
  int added = 0, removed = -1;

  /// Step -1: before the first one.
  bool is_there(int step) const { return (added == 0 || step >= added) && (removed < 0 || step < removed); }
  bool is_staged() const { return added > 0 || removed >= 0; }
  /// Whether it is there wherever `other` is.
  bool covers(const Stay& other) const {
    return added <= other.added && (removed < 0 || (other.removed >= 0 && other.removed <= removed));
  }
  /// Whether both are there at some time.
  bool meets(const Stay& other) const {
    return (removed < 0 || other.added < removed) && (other.removed < 0 || added < other.removed);
  }
};

/// Why a support cannot begin or end in its steps, beside those of its body; as a sentence without a subject.
std::optional<std::string> wrong_stay_on_body(const Stay& support, const Stay& body, const std::string& name,
                                              const std::vector<Step>& steps);

/// Why it cannot be taken away in its step, as a sentence without a subject; `what`: body or support.
std::optional<std::string> wrong_removal(const Stay& stay, const std::vector<Step>& steps, bool restarts,
                                         const char* what);

/// Whether a load, with this factor or curve of a step, acts in it at some time. `at_start`: factors of all loads
/// before the first step; empty: 0.
bool acts_in(const std::vector<Step>& steps, const std::vector<double>& at_start, std::size_t load, std::size_t step);

/// Why a load on a body is without effect, if it is.
std::optional<std::string> load_never_acts(const std::string& load, std::size_t index, const std::string& body,
                                           const Stay& stay, const std::vector<Step>& steps,
                                           const std::vector<double>& at_start);

/// Why the displacement of a support, which is not 0, cannot count from the step `added`, in which its body is placed
/// or it begins: `begins` says what of both.
std::optional<std::string> displaced_too_early(const std::string& support, std::size_t index, int added,
                                               const std::string& begins, const std::vector<Step>& steps);

}  // namespace scabo::model
