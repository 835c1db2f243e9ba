// Bodies whose cells, stiffness and factor are divided among several processes (ranks). This process, the first one,
// has all vectors and does everything else: loads, contact, results. Who starts the others provides `Ranks`
// (apps/scabo_mpi); without them, all bodies are here.
#pragma once

#include <memory>
#include <vector>

#include "scabo/linalg/sparse_factor.hpp"
#include "scabo/linalg/twofold.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/dofs.hpp"
#include "scabo/system/inclined_nodes.hpp"

namespace scabo::system {

/// The stiffness K of a part (n x n), its rows on several processes. Vectors are those of the whole part.
class DividedStiffness {
 public:
  virtual ~DividedStiffness() = default;
  virtual Eigen::Index size() const = 0;        ///< n
  virtual double entries() const = 0;           ///< stored ones, of all processes
  virtual double largest_diagonal() const = 0;  ///< max_i K_ii
  virtual double rounding() const = 0;          ///< Stiffness::rounding
  virtual Vector times(const Vector& u) const = 0;
  virtual linalg::TwofoldVector times(const linalg::TwofoldVector& u) const = 0;  ///< in twice the working precision
  virtual Vector times_squares(const Vector& u) const = 0;  ///< product of the matrix of the squared entries
  /// Factor of the rows and columns `dofs` (ascending) of T'(K + S)T: `springs` is S, 0 x 0 without springs, and
  /// `inclined` has T. The i-th unknown is dofs[i]. The factor may refuse inverse_block() of unknowns that are not
  /// among `contact_dofs` (ascending, distinct, of both directions at a node). Throws NotPositiveDefinite. Adds to
  /// `costs`.
  virtual std::unique_ptr<linalg::SparseFactor> factorise(const std::vector<int>& dofs, const InclinedNodes& inclined,
                                                          const linalg::SparseMatrix& springs,
                                                          const std::vector<int>& contact_dofs,
                                                          linalg::FactorisationCosts& costs) const = 0;
};

/// All processes of a run. Its functions may be called from several threads.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int count() const = 0;  ///< this process included, 2 or more
  /// Smallest number of degrees of freedom of a part that is divided.
  virtual double divide_from() const = 0;
  /// Divides the cells of an elastic part and solves and assembles them where they then are, on up to `threads` threads
  /// of each process. Throws what element::solve_cells throws.
  virtual std::shared_ptr<const DividedStiffness> stiffness(const model::Model& model, const mesh::Mesh& mesh,
                                                            const Dofs& dofs, std::size_t part, int threads) = 0;
};

/// Whether an elastic part is divided: it is large, has at least as many cells as there are ranks, and is bounded.
bool is_divided(const Ranks* ranks, const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                std::size_t part);

/// For each body: whether it belongs to a part that is divided; empty without ranks.
std::vector<char> divided_bodies(const Ranks* ranks, const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::system
