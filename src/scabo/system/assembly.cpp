#include "scabo/system/assembly.hpp"

#include "scabo/element/finite_element.hpp"

namespace scabo::system {

namespace {

/// Whether the body is one super-element with the same node numbers.
bool is_whole(const mesh::BodyMesh& mesh) {
  if (mesh.cells.size() != 1 || mesh.cells.front().kind != mesh::CellKind::superelement) return false;
  const std::vector<int> nodes = mesh.cells.front().nodes();
  if (nodes.size() != mesh.nodes.size()) return false;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != static_cast<int>(i)) return false;
  return true;
}

/// Sum of cell matrices.
class Assembler {
 public:
  explicit Assembler(const mesh::BodyMesh& mesh) : size_(static_cast<Eigen::Index>(2 * mesh.nodes.size())) {
    std::size_t entries = 0;
    for (const mesh::Cell& cell : mesh.cells) {
      std::size_t dofs = 2;
      for (const mesh::LineElement& element : cell.boundary) dofs += 2 * (element.nodes.size() - 1);
      entries += dofs * dofs;
    }
    entries_.reserve(entries);
  }

  template <typename Derived>
  void add(const std::vector<int>& dofs, const Eigen::MatrixBase<Derived>& matrix) {
    for (std::size_t j = 0; j < dofs.size(); ++j)
      for (std::size_t i = 0; i < dofs.size(); ++i)
        entries_.emplace_back(dofs[i], dofs[j], matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }

  linalg::SparseMatrix finish() const {
    linalg::SparseMatrix matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

 private:
  Eigen::Index size_;
  std::vector<Eigen::Triplet<double>> entries_;
};

const model::Material& material_of(const model::Model& model, const mesh::Cell& cell) {
  return model.materials[static_cast<std::size_t>(cell.materials.front())];
}

}  // namespace

Stiffness body_stiffness(const model::Model& model, const mesh::BodyMesh& mesh, const element::SolvedCells& cells,
                         bool unbounded) {
  Stiffness stiffness;
  stiffness.unbounded = unbounded;
  for (const auto& cell : cells)
    if (cell) stiffness.rounding = std::max(stiffness.rounding, cell->solution.rounding);
  if (is_whole(mesh)) {
    stiffness.dense = std::shared_ptr<const Matrix>(cells.front(), &cells.front()->solution.K);
    return stiffness;
  }
  Assembler assembler(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const mesh::Cell& cell = mesh.cells[c];
    if (cells[c]) {
      assembler.add(element::dofs_of(cell), cells[c]->solution.K);
      continue;
    }
    const element::Mat3 D = element::elasticity_matrix(material_of(model, cell), model.analysis.plane);
    const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
    assembler.add(element::dofs_of(finite),
                  element::finite_element_stiffness(finite, D, model.analysis.thickness));
  }
  stiffness.sparse = assembler.finish();
  return stiffness;
}

std::shared_ptr<const Matrix> MassLibrary::of(const element::SolvedSuperElement& super_element) {
  std::shared_ptr<const Matrix>& mass = known_[&super_element];
  if (!mass) mass = std::make_shared<const Matrix>(compute_(super_element));
  return mass;
}

Stiffness body_mass(const model::Model& model, const mesh::BodyMesh& mesh, const element::SolvedCells& cells,
                    MassLibrary& masses) {
  Stiffness mass;
  if (is_whole(mesh)) {
    mass.dense = masses.of(*cells.front());
    return mass;
  }
  Assembler assembler(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const mesh::Cell& cell = mesh.cells[c];
    if (cells[c]) {
      assembler.add(element::dofs_of(cell), *masses.of(*cells[c]));
      continue;
    }
    const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
    assembler.add(element::dofs_of(finite), element::finite_element_mass(finite, *material_of(model, cell).density,
                                                                         model.analysis.thickness));
  }
  mass.sparse = assembler.finish();
  return mass;
}

}  // namespace scabo::system
