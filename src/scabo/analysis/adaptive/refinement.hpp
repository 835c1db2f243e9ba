// Mark and refine: which parts of bodies are changed after a pass, and how.
//
// There are two kinds of refinement behind one interface: a body that is one super-element has its boundary elements
// raised and divided (hp), a body of many cells gets smaller cells (h). Parts of both kinds are marked together.
#pragma once

#include <memory>

#include "scabo/analysis/march/options.hpp"
#include "scabo/mesh/plane/division.hpp"

namespace scabo::analysis {

/// A part of a body that is refined as a whole: element `at.element` of `at.edge`, or cell `at.element` (then
/// `at.edge` is -1).
struct Part {
  mesh::EdgeElement at;
  double share = 0.0;  ///< its part of the sum of eq. (1) of adaptive.hpp, >= 0
};

/// What the estimate says of a mesh.
struct MeshErrors {
  const mesh::Mesh& mesh;
  /// [body][boundary element] of a body of one cell, [body][cell] of others: shares; empty without a tolerance.
  std::vector<std::vector<double>> shares;
  std::vector<std::vector<bool>> frozen;  ///< [body][boundary element of all cells, in their order]: not to be changed
                                          ///< in bodies of one cell
};

/// The parts with the largest shares, which together have 80 % of the sum, largest first; cells with nearly the same
/// share as the last one as well, so that rounding does not decide between the two sides of a symmetric body.
std::vector<Part> mark(std::vector<Part> parts);

/// One kind of refinement, with the state from which the next mesh is made.
class Refinement {
 public:
  virtual ~Refinement() = default;
  /// The parts that may be refined.
  virtual std::vector<Part> parts(const MeshErrors& errors) const = 0;
  /// Refines those of the marked parts that are of its kind. Returns how many parts it raised and divided.
  virtual RefinementPass refine(const MeshErrors& errors, const std::vector<Part>& marked) = 0;
  /// Degrees of freedom that the largest refined body is going to have, approximately for many cells.
  virtual int largest_body() const = 0;
};

/// Boundary elements of bodies that are one super-element: a division whose elements carry the squared error predicted
/// for them.
class BoundaryRefinement : public Refinement {
 public:
  explicit BoundaryRefinement(const model::Model& model);

  const mesh::Division& division() const { return division_; }

  /// Divides elements that end at a corner, with the small part at the corner, and elements that face them alike.
  void divide_at_corners(const mesh::Mesh& mesh, const std::vector<mesh::EdgeElement>& elements);

  std::vector<Part> parts(const MeshErrors& errors) const override;
  RefinementPass refine(const MeshErrors& errors, const std::vector<Part>& marked) override;
  int largest_body() const override;

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

/// Cells of all other meshes: sizes that become smaller from pass to pass. A marked square is halved; a
/// polygon of order p with the squared error e gets the size h (e' / e)^(1 / (2 p + 2)), between 0.35 h and 0.7 h, with
/// e' the squared error that each of the present cells may have. So does a triangle. A cell of a file is halved as a
/// square is (mesh/plane/divided_file.hpp).
class CellRefinement : public Refinement {
 public:
  explicit CellRefinement(const model::Model& model);

  const mesh::Sizes& sizes() const { return sizes_; }
  /// All sizes multiplied by `factor`.
  mesh::Sizes scaled_sizes(double factor) const;

  /// Cells at a point of a refined body become `part` of the size of the first mesh.
  void divide_at(const mesh::Mesh& mesh, const model::Place& point, double part);

  std::vector<Part> parts(const MeshErrors& errors) const override;
  RefinementPass refine(const MeshErrors& errors, const std::vector<Part>& marked) override;
  int largest_body() const override { return largest_body_; }

 private:
  const model::Model& model_;
  mesh::Sizes sizes_;
  int largest_body_ = 0;
};

/// Both kinds, for the bodies of a model: what the meshes of all passes are made of.
class ModelRefinement {
 public:
  /// Refers to `model`.
  explicit ModelRefinement(const model::Model& model) : model_(model), boundaries(model), cells(model) {}

  mesh::Mesh mesh() const { return mesh::make_mesh(model_, boundaries.division(), cells.sizes()); }
  std::vector<Part> parts(const MeshErrors& errors) const;
  RefinementPass refine(const MeshErrors& errors, const std::vector<Part>& marked);

 private:
  const model::Model& model_;

 public:
  BoundaryRefinement boundaries;
  CellRefinement cells;
};

}  // namespace scabo::analysis
