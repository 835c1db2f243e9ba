#include "scabo/system/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "scabo/base/components.hpp"
#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/system/loads.hpp"

namespace scabo::system {

namespace {

const model::Material& material_of(const model::Model& model, const mesh::Cell& cell) {
  return model.materials[static_cast<std::size_t>(cell.materials.front())];
}

/// Splits 0 ... count - 1 into ranges and calls task(range, begin, end) for each on up to `threads` threads. The ranges
/// do not depend on the number of threads.
template <typename Task>
void for_ranges(std::size_t count, std::size_t length, int threads, const Task& task) {
  const std::size_t ranges = (count + length - 1) / length;
  linalg::parallel_for(static_cast<int>(ranges), threads, [&](int k) {
    const auto range = static_cast<std::size_t>(k);
    task(range, range * length, std::min(count, (range + 1) * length));
  });
}

/// Lists of numbers one after another: list i is numbers[start[i]] ... numbers[start[i + 1] - 1].
struct Lists {
  std::vector<std::size_t> start{0};
  std::vector<int> numbers;
  std::size_t count() const { return start.size() - 1; }
  std::span<const int> of(std::size_t i) const { return {numbers.data() + start[i], start[i + 1] - start[i]}; }
};

/// `list_of(i, numbers)` appends list i to `numbers`, on any thread.
template <typename ListOf>
Lists make_lists(std::size_t count, int threads, const ListOf& list_of) {
  constexpr std::size_t length = 4096;
  struct Range {
    std::vector<int> numbers;
    std::vector<std::size_t> sizes;
  };
  std::vector<Range> ranges((count + length - 1) / length);
  for_ranges(count, length, threads, [&](std::size_t r, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = ranges[r].numbers.size();
      list_of(i, ranges[r].numbers);
      ranges[r].sizes.push_back(ranges[r].numbers.size() - before);
    }
  });
  Lists lists;
  lists.start.reserve(count + 1);
  for (const Range& range : ranges)
    for (const std::size_t size : range.sizes) lists.start.push_back(lists.start.back() + size);
  lists.numbers.reserve(lists.start.back());
  for (Range& range : ranges) {
    lists.numbers.insert(lists.numbers.end(), range.numbers.begin(), range.numbers.end());
    range.numbers = {};
  }
  return lists;
}

/// For each of `count` numbers the lists that contain it, ascending.
Lists transposed(const Lists& lists, std::size_t count) {
  Lists result;
  result.start.assign(count + 1, 0);
  for (const int number : lists.numbers) ++result.start[static_cast<std::size_t>(number) + 1];
  for (std::size_t i = 0; i < count; ++i) result.start[i + 1] += result.start[i];
  result.numbers.resize(lists.numbers.size());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for (std::size_t i = 0; i < lists.count(); ++i)
    for (const int number : lists.of(i)) result.numbers[next[static_cast<std::size_t>(number)]++] = static_cast<int>(i);
  return result;
}

/// Sum of cell matrices, in compressed columns. The nodes of every column come from the cells around its node; then the
/// cells are added in their order, each column by one thread, so that the number of threads changes no bit.
class Assembler {
 public:
  /// A cell matrix, which is kept elsewhere until the next batch: 2 n x 2 n, by columns.
  using CellMatrix = Eigen::Map<const Matrix>;

  /// `nodes_of_cell`: node numbers of each cell; a node has two degrees of freedom.
  Assembler(std::size_t nodes, Lists nodes_of_cell, int threads)
      : cells_(std::move(nodes_of_cell)), threads_(nodes < few ? 1 : threads), matrix_(columns(nodes), columns(nodes)) {
    sorted_ = make_lists(cells_.count(), threads_, [&](std::size_t cell, std::vector<int>& numbers) {
      const std::span<const int> of_cell = cells_.of(cell);
      const auto before = static_cast<std::ptrdiff_t>(numbers.size());
      for (std::size_t i = 0; i < of_cell.size(); ++i) numbers.push_back(static_cast<int>(i));
      std::sort(numbers.begin() + before, numbers.end(), [&](int i, int j) {
        return of_cell[static_cast<std::size_t>(i)] < of_cell[static_cast<std::size_t>(j)];
      });
    });
    const Lists cells_at = transposed(cells_, nodes);
    rows_ = make_lists(nodes, threads_, [&](std::size_t node, std::vector<int>& numbers) {
      const auto before = static_cast<std::ptrdiff_t>(numbers.size());
      for (const int cell : cells_at.of(node)) {
        const std::span<const int> of_cell = cells_.of(static_cast<std::size_t>(cell));
        numbers.insert(numbers.end(), of_cell.begin(), of_cell.end());
      }
      std::sort(numbers.begin() + before, numbers.end());
      numbers.erase(std::unique(numbers.begin() + before, numbers.end()), numbers.end());
    });
    const std::size_t entries = d * d * rows_.numbers.size();
    ensure(entries <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
           "a sparse matrix has at most 2^31 - 1 entries");
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(entries));
    matrix_.outerIndexPtr()[0] = 0;
    for_ranges(nodes, 4096, threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t node = begin; node < end; ++node)
        for (std::size_t k = 0; k < d; ++k) {
          const std::span<const int> rows = rows_.of(node);
          const std::size_t first = first_entry(node) + k * d * rows.size();
          matrix_.outerIndexPtr()[place_of(node, static_cast<int>(k)) + 1] = static_cast<int>(first + d * rows.size());
          for (std::size_t i = 0; i < rows.size(); ++i) {
            for (std::size_t c = 0; c < d; ++c)
              matrix_.innerIndexPtr()[first + d * i + c] = static_cast<int>(place_of(rows[i], static_cast<int>(c)));
          }
          std::fill_n(matrix_.valuePtr() + first, d * rows.size(), 0.0);
        }
    });
  }

  /// Adds `matrix_of(c, space)` for every cell c; `space` may hold it.
  template <typename Space, typename MatrixOf>
  void add(const MatrixOf& matrix_of) {
    constexpr std::size_t batch = 4096;
    constexpr int together = 64;                       // nodes, whose columns one thread fills
    const int sets = threads_ > 1 ? 4 * threads_ : 1;  // of columns: no bit depends on them
    std::vector<Space> spaces(std::min(batch, cells_.count()));
    std::vector<const double*> matrices(spaces.size());
    for (std::size_t begin = 0; begin < cells_.count(); begin += batch) {
      const std::size_t end = std::min(cells_.count(), begin + batch);
      for_ranges(end - begin, 64, threads_, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) matrices[k] = matrix_of(begin + k, spaces[k]);
      });
      linalg::parallel_for(sets, threads_, [&](int set) {
        for (std::size_t cell = begin; cell < end; ++cell) {
          const std::span<const int> nodes = cells_.of(cell);
          const auto n = places_of(nodes.size());
          const CellMatrix K(matrices[cell - begin], n, n);
          for (std::size_t j = 0; j < nodes.size(); ++j)
            if (nodes[j] / together % sets == set) add_columns(nodes, sorted_.of(cell), j, K);
        }
      });
    }
  }

  linalg::SparseMatrix finish() && { return matrix_.markAsRValue(); }  // or Eigen copies what is moved

 private:
  static constexpr std::size_t d = static_cast<std::size_t>(plane_components.dimension);  // cells are plane
  static constexpr std::size_t few = 4096;  // nodes, of which one thread takes less than a millisecond
  static Eigen::Index columns(std::size_t nodes) { return places_of(nodes); }
  std::size_t first_entry(std::size_t node) const { return d * d * rows_.start[node]; }

  /// The two columns of node j of a cell, its rows in the order of their numbers.
  void add_columns(std::span<const int> nodes, std::span<const int> sorted, std::size_t j, const CellMatrix& K) {
    const auto node = static_cast<std::size_t>(nodes[j]);
    const std::span<const int> rows = rows_.of(node);
    double* x = matrix_.valuePtr() + first_entry(node);
    double* y = x + d * rows.size();
    const auto column = place_of(j);
    std::size_t found = 0;
    for (const int i : sorted) {
      while (rows[found] != nodes[static_cast<std::size_t>(i)]) ++found;
      const auto at = place_of(found), row = place_of(i);
      x[at] += K(row, column);
      x[at + 1] += K(row + 1, column);
      y[at] += K(row, column + 1);
      y[at + 1] += K(row + 1, column + 1);
    }
  }

  Lists cells_;   // nodes of every cell
  Lists sorted_;  // the same as places in `cells_`, by their numbers
  Lists rows_;    // nodes of every node's columns
  int threads_;
  linalg::SparseMatrix matrix_;
};

/// A body of a part, and the number in the part of each of its nodes; empty: the same.
struct BodyOfPart {
  const mesh::BodyMesh& mesh;
  const element::SolvedCells& cells;
  Extent extent;
  std::vector<int> numbers;
};

std::vector<BodyOfPart> bodies_of(const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells,
                                  const Dofs& dofs, std::size_t part, const model::Model& model) {
  std::vector<BodyOfPart> bodies;
  for (const int body : dofs.bodies_of(part)) {
    const auto b = static_cast<std::size_t>(body);
    std::vector<int> numbers(mesh.bodies[b].nodes.size());
    for (std::size_t node = 0; node < numbers.size(); ++node)
      numbers[node] = dofs.node_in_part(body, static_cast<int>(node));
    bodies.push_back({mesh.bodies[b], cells[b], model::extent_of(model, body), std::move(numbers)});
  }
  return bodies;
}

/// Sum of the matrices of all cells. `of_solved(cell)`: matrix of a super-element, which stays where it is;
/// `of_finite(cell, element, extent)`: of a finite element.
template <typename OfSolved, typename OfFinite>
linalg::SparseMatrix assembled(std::size_t nodes, const std::vector<BodyOfPart>& bodies, int threads,
                               const OfSolved& of_solved, const OfFinite& of_finite) {
  std::vector<std::size_t> first;  // number of the first cell of each body
  std::size_t count = 0;
  for (const BodyOfPart& body : bodies) {
    first.push_back(count);
    count += body.mesh.cells.size();
  }
  const auto place_of = [&](std::size_t cell) {
    const auto b = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), cell) - first.begin()) - 1;
    return std::pair<const BodyOfPart&, std::size_t>(bodies[b], cell - first[b]);
  };
  Lists nodes_of_cell = make_lists(count, threads, [&](std::size_t cell, std::vector<int>& numbers) {
    const auto place = place_of(cell);
    const BodyOfPart& body = place.first;
    const auto add = [&](std::span<const int> of_cell) {
      for (const int node : of_cell)
        numbers.push_back(body.numbers.empty() ? node : body.numbers[static_cast<std::size_t>(node)]);
    };
    const mesh::Cell& one = body.mesh.cells[place.second];
    if (body.cells[place.second])
      add(one.nodes());
    else
      add(element::finite_element_of(one, body.mesh.nodes).nodes());
  });
  Assembler assembler(nodes, std::move(nodes_of_cell), threads);
  assembler.add<element::ElementMatrix>([&](std::size_t cell, element::ElementMatrix& space) {
    const auto place = place_of(cell);
    const BodyOfPart& body = place.first;
    if (const auto& solved = body.cells[place.second]) return of_solved(*solved).data();
    const mesh::Cell& one = body.mesh.cells[place.second];
    space = of_finite(one, element::finite_element_of(one, body.mesh.nodes), body.extent);
    return static_cast<const double*>(space.data());
  });
  return std::move(assembler).finish();
}

linalg::SparseMatrix stiffness_of(const model::Model& model, std::size_t nodes, const std::vector<BodyOfPart>& bodies,
                                  int threads) {
  return assembled(
      nodes, bodies, threads, [](const element::SolvedSuperElement& cell) -> const Matrix& { return cell.K(); },
      [&](const mesh::Cell& cell, const element::FiniteElement& finite, const Extent& extent) {
        const element::SectionLaw law = element::section_law(material_of(model, cell), model.analysis.plane);
        return element::finite_element_stiffness(finite, law, extent);
      });
}

linalg::SparseMatrix mass_of(const model::Model& model, std::size_t nodes, const std::vector<BodyOfPart>& bodies,
                             MassLibrary& masses) {
  return assembled(
      nodes, bodies, 1, [&](const element::SolvedSuperElement& cell) -> const Matrix& { return *masses.of(cell); },
      [&](const mesh::Cell& cell, const element::FiniteElement& finite, const Extent& extent) {
        return element::finite_element_mass(finite, *material_of(model, cell).density, extent);
      });
}

double rounding_of(const element::SolvedCells& cells) {
  double rounding = Stiffness().rounding;
  for (const auto& cell : cells)
    if (cell) rounding = std::max(rounding, cell->rounding());
  return rounding;
}

/// Entries of the water that moves with an edge, in the numbering of its body.
std::vector<Eigen::Triplet<double>> entries_of(const model::AddedMass& water, const model::Model& model,
                                               const mesh::Mesh& mesh) {
  const mesh::PlaceNodes edge = mesh::nodes_of(*water.on, mesh);
  const std::vector<Vec2>& nodes = mesh.bodies[static_cast<std::size_t>(water.on->body)].nodes;
  double bottom = water.bottom.value_or(water.level);
  if (!water.bottom)
    for (const mesh::LineElement& element : edge.elements)
      for (const int node : element.nodes)
        bottom = std::min(bottom, water.up.dot(nodes[static_cast<std::size_t>(node)]));
  const auto depth = [&](const Vec2& x) { return water.level - water.up.dot(x); };
  const auto layer = [&](const Vec2& x) {
    return 0.875 * water.density * std::sqrt((water.level - bottom) * std::max(depth(x), 0.0));  // Westergaard 1933
  };
  return mass_along_normals(edge.elements, nodes, model::extent_of(model, water.on->body), layer, {depth, {0.0}});
}

/// Adds entries in the numbering of a part.
void add(const std::vector<Eigen::Triplet<double>>& entries, Stiffness& mass) {
  if (mass.dense) {
    Matrix with = *mass.dense;
    for (const Eigen::Triplet<double>& entry : entries) with(entry.row(), entry.col()) += entry.value();
    mass.dense = std::make_shared<const Matrix>(std::move(with));
    return;
  }
  linalg::SparseMatrix more(mass.sparse.rows(), mass.sparse.cols());
  more.setFromTriplets(entries.begin(), entries.end());
  mass.sparse += more;
}

/// The water that moves with the edges of a part, and its point masses.
void add_to_mass(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs, std::size_t part,
                 Stiffness& mass) {
  for (const model::AddedMass& water : model.added_masses) {
    const int body = water.on->body;
    if (dofs.part_of(body) != part) continue;
    std::vector<Eigen::Triplet<double>> entries = entries_of(water, model, mesh);
    const auto in_part = [&](int dof) {
      return dofs.of(body, plane_components.node_of(dof), plane_components.component_of(dof));
    };
    for (Eigen::Triplet<double>& entry : entries) entry = {in_part(entry.row()), in_part(entry.col()), entry.value()};
    add(entries, mass);
  }
  for (const model::PointMass& point : model.point_masses) {
    if (dofs.part_of(point.on->body) != part) continue;
    const int node = mesh::nodes_of(*point.on, mesh).nodes.front();
    std::vector<Eigen::Triplet<double>> entries;
    for (int component = 0; component < 2; ++component) {
      const int dof = dofs.of(point.on->body, node, component);
      entries.emplace_back(dof, dof, point.mass);
    }
    add(entries, mass);
  }
}

}  // namespace

bool is_whole(const mesh::BodyMesh& mesh) {
  if (mesh.cells.size() != 1 || mesh.cells.front().kind != mesh::CellKind::superelement) return false;
  const std::vector<int> nodes = mesh.cells.front().nodes();
  if (nodes.size() != mesh.nodes.size()) return false;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != static_cast<int>(i)) return false;
  return true;
}

Stiffness body_stiffness(const model::Model& model, const Extent& extent, const mesh::BodyMesh& mesh,
                         const element::SolvedCells& cells, int threads) {
  Stiffness stiffness;
  stiffness.rounding = rounding_of(cells);
  if (is_whole(mesh))
    stiffness.dense = std::shared_ptr<const Matrix>(cells.front(), &cells.front()->K());
  else
    stiffness.sparse = stiffness_of(model, mesh.nodes.size(), {{mesh, cells, extent, {}}}, threads).markAsRValue();
  return stiffness;
}

Stiffness part_stiffness(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, const Dofs& dofs, std::size_t part,
                         int threads) {
  const std::vector<int>& bodies = dofs.bodies_of(part);
  const auto first = static_cast<std::size_t>(bodies.front());
  Stiffness stiffness = bodies.size() == 1 ? body_stiffness(model, model::extent_of(model, bodies.front()),
                                                            mesh.bodies[first], cells[first], threads)
                                           : Stiffness();
  if (bodies.size() > 1) {
    for (const int body : bodies)
      stiffness.rounding = std::max(stiffness.rounding, rounding_of(cells[static_cast<std::size_t>(body)]));
    stiffness.sparse =
        stiffness_of(model, dofs.nodes(part).size(), bodies_of(mesh, cells, dofs, part, model), threads).markAsRValue();
  }
  stiffness.resists_rigid_motions = dofs.is_unbounded(part);
  stiffness.revolved = dofs.revolved();
  for (std::size_t i = 0; i < dofs.nodes(part).size(); ++i)
    if (dofs.is_on_axis(part, dofs.nodes(part)[i])) stiffness.on_axis.push_back(static_cast<int>(place_of(i)));
  return stiffness;
}

std::shared_ptr<const Matrix> MassLibrary::of(const element::SolvedSuperElement& super_element) {
  std::shared_ptr<const Matrix>& mass = known_[&super_element];
  if (!mass) mass = std::make_shared<const Matrix>(compute_(super_element));
  return mass;
}

MassLibrary masses_of(const model::Model& model, int threads) {
  return MassLibrary([&model, threads](const element::SolvedSuperElement& cell) {
    std::vector<double> density;
    for (const int material : cell.sectors.materials)
      density.push_back(*model.materials[static_cast<std::size_t>(material)].density);
    if (std::all_of(density.begin(), density.end(), [](double of) { return of == 0.0; }))
      return Matrix(Matrix::Zero(cell.K().rows(), cell.K().cols()));
    return element::mass_matrix(cell.ring, cell.solution(), cell.modes(), density, cell.thickness, threads);
  });
}

std::optional<Stiffness> part_damping(const model::Model& model, const mesh::Mesh& mesh,
                                      const std::vector<element::SolvedCells>& cells, const Dofs& dofs,
                                      std::size_t part, MassLibrary& masses) {
  const std::vector<BodyOfPart> bodies = bodies_of(mesh, cells, dofs, part, model);
  const auto damps = [&](int material) {
    return model.materials[static_cast<std::size_t>(material)].damping.has_value();
  };
  bool any = false;
  for (const BodyOfPart& body : bodies)
    for (const mesh::Cell& cell : body.mesh.cells) any = any || damps(cell.materials.front());
  if (!any) return {};
  const auto damping_of = [&](int material) {
    return model.materials[static_cast<std::size_t>(material)].damping.value_or(model::Damping{0.0, 1.0, 2.0});
  };
  MassLibrary of_cells([&](const element::SolvedSuperElement& cell) {
    const model::Damping damping = damping_of(cell.sectors.materials.front());
    return Matrix(damping.of_mass() * *masses.of(cell) + damping.of_stiffness() * cell.K());
  });
  Stiffness C;
  if (bodies.size() == 1 && is_whole(bodies.front().mesh)) {
    C.dense = of_cells.of(*bodies.front().cells.front());
    return C;
  }
  C.sparse = assembled(
      dofs.nodes(part).size(), bodies, 1,
      [&](const element::SolvedSuperElement& cell) -> const Matrix& { return *of_cells.of(cell); },
      [&](const mesh::Cell& cell, const element::FiniteElement& finite, const Extent& extent) {
        const model::Material& material = material_of(model, cell);
        const model::Damping damping = damping_of(cell.materials.front());
        const element::SectionLaw law = element::section_law(material, model.analysis.plane);
        return element::ElementMatrix(damping.of_mass() *
                                          element::finite_element_mass(finite, *material.density, extent) +
                                      damping.of_stiffness() * element::finite_element_stiffness(finite, law, extent));
      });
  return C;
}

Stiffness body_mass(const model::Model& model, const Extent& extent, const mesh::BodyMesh& mesh,
                    const element::SolvedCells& cells, MassLibrary& masses) {
  Stiffness mass;
  if (is_whole(mesh))
    mass.dense = masses.of(*cells.front());
  else
    mass.sparse = mass_of(model, mesh.nodes.size(), {{mesh, cells, extent, {}}}, masses);
  return mass;
}

Stiffness part_mass(const model::Model& model, const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells,
                    const Dofs& dofs, std::size_t part, MassLibrary& masses) {
  const std::vector<int>& bodies = dofs.bodies_of(part);
  Stiffness mass;
  if (bodies.size() == 1) {
    const auto b = static_cast<std::size_t>(bodies.front());
    mass = body_mass(model, model::extent_of(model, bodies.front()), mesh.bodies[b], cells[b], masses);
  } else {
    mass.sparse = mass_of(model, dofs.nodes(part).size(), bodies_of(mesh, cells, dofs, part, model), masses);
  }
  add_to_mass(model, mesh, dofs, part, mass);
  return mass;
}

}  // namespace scabo::system
