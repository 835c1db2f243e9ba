// Which elements to refine and how: a division and what is known of its elements.
#pragma once

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/mesh/division.hpp"

namespace scabo::analysis {

/// A division whose elements carry the squared error predicted for them.
class Refinement {
 public:
  explicit Refinement(const model::Model& model);

  const mesh::Division& division() const { return division_; }

  /// Divides elements that end at a corner, the small part at the corner; those that face them alike.
  void divide_at_corners(const mesh::Mesh& mesh, const std::vector<mesh::EdgeElement>& elements);

  /// Refines after a pass. `shares`: [body][boundary element], each element's part of the sum of eq. (1) of
  /// adaptive.hpp; `frozen` elements stay. Returns how many were raised and divided; none: nothing can be refined any
  /// more.
  RefinementPass refine(const mesh::Mesh& mesh, const std::vector<std::vector<double>>& shares,
                        const std::vector<std::vector<bool>>& frozen);

 private:
  enum class Change { none, raise, divide };
  Change change_for(const mesh::EdgeElement& at, double share) const;
  bool at_corner(const mesh::EdgeElement& at, bool start) const;
  double cut_of(const mesh::EdgeElement& at) const;
  void apply(const mesh::EdgeElement& at, Change change, double cut, double share);

  const model::Model& model_;
  mesh::Division division_;
  std::vector<std::vector<std::vector<double>>> predicted_;  // [body][edge][element], squared; infinite: nothing yet
};

}  // namespace scabo::analysis
