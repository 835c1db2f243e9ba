#include "scabo/result/recovery.hpp"

#include <algorithm>
#include <utility>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/result/ring_values.hpp"

namespace scabo::result {

namespace {

/// Sets the values of a point at x, of whose stress `change` is what came with the deformation.
void set_values(Fields& fields, std::size_t point, const Vec2& u, const element::Vec3& change, const Vec2& x,
                const analysis::Discretisation& discretisation, int material, double temperature,
                const element::InitialStress& initial, double strain_zz = 0.0) {
  const model::Material& of_point = discretisation.model.materials[static_cast<std::size_t>(material)];
  const model::Plane plane = discretisation.model.analysis.plane;
  const double zz = element::stress_zz(change, of_point, plane, temperature, strain_zz);
  if (initial.is_zero())
    fields.set(point, u, change, zz);
  else
    fields.set(point, u, change + initial.at(x), zz + initial.zz_at(x, of_point, plane));
}

void recover_inside(Fields& fields, std::size_t point, const analysis::Discretisation& discretisation,
                    const element::SolvedSuperElement& super_element, const Vec2& centre, const RingSampling& sampling,
                    const element::RadialField& field, const element::InteriorLoads& interior,
                    const element::InitialStress& initial, std::size_t first_level) {
  values_inside(super_element, centre, sampling, field, interior, first_level,
                [&](const Vec2& u, const element::Vec3& stress, int material, const Vec2& x) {
                  set_values(fields, point++, u, stress, centre + x, discretisation, material,
                             interior.temperature_at(centre + x), initial);
                });
}

void recover_super_element(Fields& fields, std::size_t point, const analysis::Discretisation& discretisation,
                           const analysis::FieldState& state, std::size_t body, const RingSampling& sampling) {
  const element::SolvedSuperElement& super_element = *discretisation.cells[body].front();
  const Vec2& centre = discretisation.mesh.bodies[body].cells.front().centre;
  const Vector& boundary = state.displacements[body];
  const element::InteriorLoads& interior = element::loads_in(state.interior[body], 0);
  const element::RadialField field(super_element.solution(), super_element.modes(),
                                   interior.without_particular(super_element.ring, centre, boundary), interior.loads,
                                   interior.motion);
  const std::size_t first = point;
  recover_inside(fields, first, discretisation, super_element, centre, sampling, field, interior,
                 state.initial_of(body), 0);
  for (std::size_t i = 0; i < sampling.size(); ++i)  // exactly, without the field
    fields.set_displacement(first + i,
                            sampling.at(i, [&](int node) { return Vec2(boundary.segment<2>(place_of(node))); }));
}

/// By the map of its super-element, which many cells share. Displacements are relative to the first node: the map then
/// gives a translation no stress, not even by rounding.
Eigen::Matrix3Xd recover_mapped_cell(Fields& fields, std::size_t point, const analysis::Discretisation& discretisation,
                                     const CellsBody::OfCell& of_cell, Vector own, const Grid& grid,
                                     const element::InitialStress& initial) {
  const CellMap& map = *of_cell.sampling->map;
  const Vec2 shift = own.head<2>();
  own.reshaped(2, own.size() / 2).colwise() -= shift;
  const Vector values = map.values * own;
  const auto inside = static_cast<Eigen::Index>(map.materials.size());
  for (Eigen::Index i = 0; i < inside; ++i) {
    const element::Vec3 stress = values.segment<3>(5 * i + 2);
    set_values(fields, point, Vec2(shift + values.segment<2>(5 * i)), stress,
               Vec2(grid.points[3 * point], grid.points[3 * point + 1]), discretisation,
               map.materials[static_cast<std::size_t>(i)], 0.0, initial);
    ++point;
  }
  const Eigen::Index outer = (values.size() - 5 * inside) / 3;
  return values.tail(3 * outer).reshaped(3, outer);
}

/// Stresses and temperatures of points on the sides of cells, without strains zz.
SharedValues with_temperatures(const Eigen::Matrix3Xd& stresses, const std::function<double(Eigen::Index)>& of_point) {
  SharedValues values = SharedValues::Zero(5, stresses.cols());
  values.topRows<3>() = stresses;
  for (Eigen::Index i = 0; i < stresses.cols(); ++i) values(3, i) = of_point(i);
  return values;
}

/// Values inside cell `c` into `fields`; those of its points on the sides are returned.
SharedValues recover_cell(Fields& fields, std::size_t first, const analysis::Discretisation& discretisation,
                          const analysis::FieldState& state, std::size_t body, std::size_t c,
                          const CellsBody::OfCell& of_cell, const Grid& grid) {
  const auto& super_element = discretisation.cells[body][c];
  const element::InteriorLoads& interior = element::loads_in(state.interior[body], c);
  if (!super_element) {
    const FiniteElementState finite(discretisation, state, body, c);
    const auto natural = element::natural_nodes(finite.element().kind);
    SharedValues values(5, static_cast<Eigen::Index>(natural.size()));
    for (std::size_t i = 0; i < natural.size(); ++i) {
      const element::PointValues at = finite.at(natural[i]);
      values.col(static_cast<Eigen::Index>(i)) << at.stress, interior.temperature_at(finite.element().x[i]),
          at.strain_zz;
    }
    return values;
  }
  const mesh::Cell& cell = discretisation.mesh.bodies[body].cells[c];
  const std::size_t inner = first + static_cast<std::size_t>(of_cell.inner);
  Vector own = state.displacements[body](element::dofs_of(cell));
  if (of_cell.sampling->map && interior.is_zero())
    return with_temperatures(
        recover_mapped_cell(fields, inner, discretisation, of_cell, std::move(own), grid, state.initial_of(body)),
        [](Eigen::Index) { return 0.0; });
  const element::RadialField field(super_element->solution(), super_element->modes(),
                                   interior.without_particular(super_element->ring, cell.centre, std::move(own)),
                                   interior.loads, interior.motion);
  recover_inside(fields, inner, discretisation, *super_element, cell.centre, *of_cell.sampling, field, interior,
                 state.initial_of(body), 1);
  return with_temperatures(
      ring_stresses(*super_element, *of_cell.sampling, field.at(1.0), cell.centre, 1.0, interior), [&](Eigen::Index i) {
        return interior.temperature_at(cell.centre +
                                       super_element->ring.node(of_cell.sampling->nodes[static_cast<std::size_t>(i)]));
      });
}

/// Stress and temperature on the sides of cells are the means of the cells that share the point.
void recover_cells(Fields& fields, std::size_t first, const analysis::Discretisation& discretisation,
                   const analysis::FieldState& state, std::size_t body, const CellsBody& made, const Grid& grid,
                   const CompleteSums& complete) {
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[body];
  SharedValues sums = SharedValues::Zero(5, static_cast<Eigen::Index>(made.nodes.size()));
  std::vector<int> cells_at(made.nodes.size(), 0);
  constexpr std::size_t at_once = 4096;  // the sums are made in the order of the cells, whatever the threads
  std::vector<SharedValues> of_part(std::min(at_once, mesh.cells.size()));
  for (std::size_t begin = 0; begin < mesh.cells.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, mesh.cells.size() - begin);
    linalg::parallel_for(static_cast<int>(count), discretisation.threads, [&](int k) {
      const auto at = static_cast<std::size_t>(k);
      of_part[at] = recover_cell(fields, first, discretisation, state, body, begin + at, made.cells[begin + at], grid);
    });
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<std::int32_t>& outer = made.cells[begin + k].outer;
      for (std::size_t i = 0; i < outer.size(); ++i) {
        sums.col(outer[i]) += of_part[k].col(static_cast<Eigen::Index>(i));
        ++cells_at[static_cast<std::size_t>(outer[i])];
      }
    }
  }
  if (complete) complete(body, made.nodes, made.materials, sums, cells_at);
  const Vector& u = state.displacements[body];
  for (std::size_t point = 0; point < made.nodes.size(); ++point) {
    const int node = made.nodes[point];
    const Eigen::Vector<double, 5> values = sums.col(static_cast<Eigen::Index>(point)) / cells_at[point];
    set_values(fields, first + point, u.segment<2>(place_of(node)), values.head<3>(),
               mesh.nodes[static_cast<std::size_t>(node)], discretisation, made.materials[point], values[3],
               state.initial_of(body), values[4]);
  }
}

/// A body that is one super-element, all of which is here.
bool is_super_element(const element::SolvedCells& cells, const std::vector<char>& divided, std::size_t body) {
  return cells.size() == 1 && cells.front() && (divided.empty() || divided[body] == 0);
}

/// Whether the single super-elements of a model have so few nodes that fine fields of them make small files: at most
/// 16,000 to 32,000 points.
bool few_points(const analysis::Discretisation& discretisation, const std::vector<char>& divided) {
  constexpr std::size_t few_nodes = 800;
  std::size_t nodes = 0;
  for (std::size_t b = 0; b < discretisation.cells.size(); ++b)
    if (is_super_element(discretisation.cells[b], divided, b)) nodes += discretisation.mesh.bodies[b].nodes.size();
  return nodes <= few_nodes;
}

}  // namespace

Recovery::Recovery(const analysis::Discretisation& discretisation, const std::vector<char>& divided) {
  SamplingLibrary library(few_points(discretisation, divided));
  UsesOfCells uses;
  for (const element::SolvedCells& cells : discretisation.cells)
    for (const auto& cell : cells)
      if (cell) ++uses[cell.get()];
  for (std::size_t b = 0; b < discretisation.model.bodies.size(); ++b) {
    const mesh::BodyMesh& body = discretisation.mesh.bodies[b];
    const element::SolvedCells& cells = discretisation.cells[b];
    const auto number = static_cast<std::int32_t>(b + 1);
    grid_.first_point.push_back(grid_.point_count());
    if (discretisation.model.bodies[b].rigid) {
      bodies_.push_back(add_rigid(grid_, discretisation.model.bodies[b].outline, number));
    } else if (is_super_element(cells, divided, b)) {
      SuperElementBody made{library.of_body(*cells.front())};
      add_super_element(grid_, body, *made.sampling, number);
      bodies_.push_back(std::move(made));
    } else {
      bodies_.push_back(add_cells(grid_, body, cells, library, uses, number));
    }
  }
  grid_.first_point.push_back(grid_.point_count());
}

Fields Recovery::fields(const analysis::Discretisation& discretisation, const analysis::FieldState& state,
                        const CompleteSums& complete) const {
  ensure(state.displacements.size() == bodies_.size() && state.interior.size() == bodies_.size(),
         "a state has displacements and interior loads of every body");
  Fields fields(grid_.point_count());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t point = grid_.first_point[b];
    if (const auto* super_element = std::get_if<SuperElementBody>(&bodies_[b])) {
      recover_super_element(fields, point, discretisation, state, b, *super_element->sampling);
    } else if (const auto* rigid = std::get_if<RigidBody>(&bodies_[b])) {
      for (std::size_t i = 0; i < rigid->arms.size(); ++i)
        fields.set(point + i, rigid_displacement(state.displacements[b], rigid->arms[i]), element::Vec3::Zero(), 0.0);
    } else {
      recover_cells(fields, point, discretisation, state, b, std::get<CellsBody>(bodies_[b]), grid_, complete);
    }
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t point = grid_.first_point[b]; point < grid_.first_point[b + 1]; ++point)
      for (std::size_t k = 0; k < 2; ++k)
        fields.displacement[3 * point + k] -= state.reference_displacement(b)[static_cast<Eigen::Index>(k)];
  return fields;
}

}  // namespace scabo::result
