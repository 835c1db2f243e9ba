// Which elements to refine and how: a division with the predicted errors of its elements.
#pragma once

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/mesh/division.hpp"

namespace scabo::analysis {

/// A division whose elements carry the squared error predicted for them.
class Refinement {
 public:
  explicit Refinement(const model::Model& model);

  const mesh::Division& division() const { return division_; }

  /// Divides elements that end at a corner, with the small part at the corner, and elements that face them alike.
  void divide_at_corners(const mesh::Mesh& mesh, const std::vector<mesh::EdgeElement>& elements);

  /// Refines after a pass. `shares`: [body][boundary element], the part of each element in the sum of eq. (1) of
  /// adaptive.hpp; `frozen` elements are not changed. Returns how many were raised and divided; if none were, no
  /// further refinement is possible.
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
  /// [body][edge][element]: squared predicted error; infinite if not predicted yet.
  std::vector<std::vector<std::vector<double>>> predicted_;
};

}  // namespace scabo::analysis
