#include "scabo/system/assembly.hpp"

#include <span>

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
  explicit Assembler(Eigen::Index size) : size_(size) {}

  template <typename Derived>
  void add(const std::vector<int>& dofs, const Eigen::MatrixBase<Derived>& matrix) {
    for (std::size_t j = 0; j < dofs.size(); ++j)
      for (std::size_t i = 0; i < dofs.size(); ++i)
        entries_.emplace_back(dofs[i], dofs[j], matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }

  void reserve(const mesh::BodyMesh& mesh) {
    std::size_t entries = 0;
    for (const mesh::Cell& cell : mesh.cells) {
      std::size_t dofs = 2;
      for (const mesh::LineElement& element : cell.boundary) dofs += 2 * (element.nodes.size() - 1);
      entries += dofs * dofs;
    }
    entries_.reserve(entries_.size() + entries);
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

/// Numbers of degrees of freedom of a cell with these nodes.
using DofsOfNodes = std::function<std::vector<int>(std::span<const int> nodes)>;

std::vector<int> numbers_in_body(std::span<const int> nodes) {
  std::vector<int> numbers;
  numbers.reserve(2 * nodes.size());
  for (const int node : nodes) numbers.insert(numbers.end(), {2 * node, 2 * node + 1});
  return numbers;
}

void add_stiffness(Assembler& assembler, const model::Model& model, const mesh::BodyMesh& mesh,
                   const element::SolvedCells& cells, const DofsOfNodes& dofs_of) {
  assembler.reserve(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const mesh::Cell& cell = mesh.cells[c];
    if (cells[c]) {
      assembler.add(dofs_of(cell.nodes()), cells[c]->K());
      continue;
    }
    const element::Mat3 D = element::elasticity_matrix(material_of(model, cell), model.analysis.plane);
    const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
    assembler.add(dofs_of(finite.nodes()), element::finite_element_stiffness(finite, D, model.analysis.thickness));
  }
}

void add_mass(Assembler& assembler, const model::Model& model, const mesh::BodyMesh& mesh,
              const element::SolvedCells& cells, MassLibrary& masses, const DofsOfNodes& dofs_of) {
  assembler.reserve(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const mesh::Cell& cell = mesh.cells[c];
    if (cells[c]) {
      assembler.add(dofs_of(cell.nodes()), *masses.of(*cells[c]));
      continue;
    }
    const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
    assembler.add(dofs_of(finite.nodes()),
                  element::finite_element_mass(finite, *material_of(model, cell).density, model.analysis.thickness));
  }
}

double rounding_of(const element::SolvedCells& cells) {
  double rounding = Stiffness().rounding;
  for (const auto& cell : cells)
    if (cell) rounding = std::max(rounding, cell->rounding());
  return rounding;
}

}  // namespace

Stiffness body_stiffness(const model::Model& model, const mesh::BodyMesh& mesh, const element::SolvedCells& cells) {
  Stiffness stiffness;
  stiffness.rounding = rounding_of(cells);
  if (is_whole(mesh)) {
    stiffness.dense = std::shared_ptr<const Matrix>(cells.front(), &cells.front()->K());
    return stiffness;
  }
  Assembler assembler(static_cast<Eigen::Index>(2 * mesh.nodes.size()));
  add_stiffness(assembler, model, mesh, cells, numbers_in_body);
  stiffness.sparse = assembler.finish();
  return stiffness;
}

Stiffness part_stiffness(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, const Dofs& dofs, std::size_t part) {
  const std::vector<int>& bodies = dofs.bodies_of(part);
  Stiffness stiffness;
  if (bodies.size() == 1) {
    const auto b = static_cast<std::size_t>(bodies.front());
    stiffness = body_stiffness(model, mesh.bodies[b], cells[b]);
  } else {
    Assembler assembler(dofs.size(part));
    for (const int body : bodies) {
      const auto b = static_cast<std::size_t>(body);
      stiffness.rounding = std::max(stiffness.rounding, rounding_of(cells[b]));
      add_stiffness(assembler, model, mesh.bodies[b], cells[b],
                    [&](std::span<const int> nodes) { return dofs.of(body, nodes); });
    }
    stiffness.sparse = assembler.finish();
  }
  stiffness.unbounded = dofs.is_unbounded(part);
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
  Assembler assembler(static_cast<Eigen::Index>(2 * mesh.nodes.size()));
  add_mass(assembler, model, mesh, cells, masses, numbers_in_body);
  mass.sparse = assembler.finish();
  return mass;
}

Stiffness part_mass(const model::Model& model, const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells,
                    const Dofs& dofs, std::size_t part, MassLibrary& masses) {
  const std::vector<int>& bodies = dofs.bodies_of(part);
  if (bodies.size() == 1) {
    const auto b = static_cast<std::size_t>(bodies.front());
    return body_mass(model, mesh.bodies[b], cells[b], masses);
  }
  Assembler assembler(dofs.size(part));
  for (const int body : bodies) {
    const auto b = static_cast<std::size_t>(body);
    add_mass(assembler, model, mesh.bodies[b], cells[b], masses,
             [&](std::span<const int> nodes) { return dofs.of(body, nodes); });
  }
  Stiffness mass;
  mass.sparse = assembler.finish();
  return mass;
}

}  // namespace scabo::system
