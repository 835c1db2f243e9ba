#include "scabo/result/recovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "scabo/base/components.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/element/finite_element.hpp"
#include "scabo/element/interior_field.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::result {

namespace {

constexpr int ring_count = 10, inner_rings = 6;

/// Sets the values of a point at x, of whose stress `change` is what came with the deformation.
void set_values(Fields& fields, std::size_t point, const Vec2& u, const element::Vec3& change, const Vec2& x,
                const analysis::StaticSolution& solution, int material, double temperature,
                const element::InitialStress& initial) {
  const model::Material& of_point = solution.model.materials[static_cast<std::size_t>(material)];
  const model::Plane plane = solution.model.analysis.plane;
  const double zz = element::stress_zz(change, of_point, plane, temperature);
  if (initial.is_zero())
    fields.set(point, u, change, zz);
  else
    fields.set(point, u, change + initial.at(x), zz + initial.zz_at(x, of_point, plane));
}

/// How many cells are equal to a super-element.
using UsesOfCells = std::unordered_map<const element::SolvedSuperElement*, std::size_t>;

// Points and cells

/// Position of a point of a ring.
Vec2 on_ring(const mesh::BodyMesh& body, const mesh::Cell& cell, int node, double xi) {
  const Vec2& x = body.nodes[static_cast<std::size_t>(node)];
  return xi == 1.0 ? x : Vec2(cell.centre + xi * (x - cell.centre));
}

/// Rings from the boundary inwards, then the centre: quadrilaterals between the rings, triangles at the centre. For an
/// unbounded domain, rings from the boundary outwards.
void add_super_element(Grid& grid, const mesh::BodyMesh& body, const RingSampling& sampling, std::int32_t number) {
  const mesh::Cell& whole = body.cells.front();
  const auto first = static_cast<std::int32_t>(grid.point_count());
  const auto n = static_cast<std::int32_t>(sampling.nodes.size());
  for (const double xi : sampling.levels)
    for (const int node : sampling.nodes) grid.add_point(on_ring(body, whole, node, xi), number);
  const bool unbounded = sampling.levels.back() > 1.0;
  if (!unbounded)
    for (int c = 0; c <= sampling.centre.back(); ++c) grid.add_point(whole.centre, number);
  const auto rings = static_cast<std::int32_t>(sampling.levels.size());
  for (std::int32_t ring = 0; ring < rings; ++ring) {
    const std::int32_t outer = first + ring * n, inner = outer + n;
    for (std::size_t e = 0; e < sampling.points.size(); ++e)
      for (std::size_t i = 0; i + 1 < sampling.points[e].size(); ++i) {
        const std::int32_t a = sampling.points[e][i], b = sampling.points[e][i + 1];
        if (ring + 1 < rings && unbounded)
          grid.add_cell(CellType::quad, std::array{outer + a, inner + a, inner + b, outer + b}, number);
        else if (ring + 1 < rings)
          grid.add_cell(CellType::quad, std::array{inner + a, outer + a, outer + b, inner + b}, number);
        else if (!unbounded)
          grid.add_cell(CellType::triangle, std::array{inner + sampling.centre[e], outer + a, outer + b}, number);
      }
  }
}

CellType type_of(element::FiniteElementKind kind) {
  switch (kind) {
    case element::FiniteElementKind::triangle3:
      return CellType::triangle;
    case element::FiniteElementKind::triangle6:
      return CellType::quadratic_triangle;
    case element::FiniteElementKind::quad4:
      return CellType::quad;
    case element::FiniteElementKind::quad8:
      return CellType::quadratic_quad;
  }
  throw BrokenInvariant("a finite element of unknown kind");
}

/// Every cell: the sides at the points that cells of one material share, and what is inside of them. Rings as above.
CellsBody add_cells(Grid& grid, const mesh::BodyMesh& body, const element::SolvedCells& cells, SamplingLibrary& library,
                    const UsesOfCells& uses, std::int32_t number) {
  const auto first = static_cast<std::int32_t>(grid.point_count());
  CellsBody made;
  made.cells.resize(cells.size());
  // The first points are the nodes; where materials meet, there is one more for each further material.
  for (std::size_t node = 0; node < body.nodes.size(); ++node) {
    made.nodes.push_back(static_cast<int>(node));
    made.materials.push_back(-1);
    grid.add_point(body.nodes[node], number);
  }
  std::map<std::pair<int, int>, std::int32_t> further;  // node and material
  const auto shared_point = [&](int node, int material) {
    int& of_node = made.materials[static_cast<std::size_t>(node)];
    if (of_node < 0) of_node = material;
    if (of_node == material) return static_cast<std::int32_t>(node);
    const auto key = std::pair(node, material);
    if (const auto found = further.find(key); found != further.end()) return found->second;
    const auto point = static_cast<std::int32_t>(made.nodes.size());
    further.emplace(key, point);
    made.nodes.push_back(node);
    made.materials.push_back(material);
    grid.add_point(body.nodes[static_cast<std::size_t>(node)], number);
    return point;
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    interruption_point();
    const mesh::Cell& cell = body.cells[c];
    if (!cells[c]) {
      const element::FiniteElement element = element::finite_element_of(cell, body.nodes);
      for (const int node : element.nodes()) made.cells[c].outer.push_back(shared_point(node, cell.materials.front()));
      continue;
    }
    made.cells[c].sampling = library.of_cell(*cells[c], uses.at(cells[c].get()));
    const RingSampling& sampling = *made.cells[c].sampling;
    const std::vector<int> nodes = cell.nodes();
    for (std::size_t k = 0; k < sampling.nodes.size(); ++k)
      made.cells[c].outer.push_back(shared_point(nodes[static_cast<std::size_t>(sampling.nodes[k])],
                                                 cells[c]->sectors.material_of(sampling.sectors[k])));
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    interruption_point();
    CellsBody::OfCell& of_cell = made.cells[c];
    if (!cells[c]) {
      std::vector<std::int32_t> points = of_cell.outer;
      for (std::int32_t& point : points) point += first;
      grid.add_cell(type_of(element::finite_element_of(body.cells[c], body.nodes).kind), points, number);
      continue;
    }
    const RingSampling& sampling = *of_cell.sampling;
    const mesh::Cell& cell = body.cells[c];
    const std::vector<int> nodes = cell.nodes();
    of_cell.inner = static_cast<std::int32_t>(grid.point_count()) - first;
    const auto n = static_cast<std::int32_t>(sampling.nodes.size());
    const auto rings = static_cast<std::int32_t>(sampling.levels.size());
    for (std::int32_t ring = 1; ring < rings; ++ring)
      for (const int node : sampling.nodes)
        grid.add_point(
            on_ring(body, cell, nodes[static_cast<std::size_t>(node)], sampling.levels[static_cast<std::size_t>(ring)]),
            number);
    const std::int32_t centre = first + of_cell.inner + (rings - 1) * n;
    for (int k = 0; k <= sampling.centre.back(); ++k) grid.add_point(cell.centre, number);
    const auto point = [&](std::int32_t ring, std::int32_t k) {
      return first + (ring == 0 ? of_cell.outer[static_cast<std::size_t>(k)] : of_cell.inner + (ring - 1) * n + k);
    };
    for (std::int32_t ring = 0; ring < rings; ++ring)
      for (std::size_t e = 0; e < sampling.points.size(); ++e)
        for (std::size_t i = 0; i + 1 < sampling.points[e].size(); ++i) {
          const std::int32_t a = sampling.points[e][i], b = sampling.points[e][i + 1];
          if (ring + 1 < rings)
            grid.add_cell(CellType::quad,
                          std::array{point(ring + 1, a), point(ring, a), point(ring, b), point(ring + 1, b)}, number);
          else
            grid.add_cell(CellType::triangle, std::array{centre + sampling.centre[e], point(ring, a), point(ring, b)},
                          number);
        }
  }
  return made;
}

/// The outline as a polygon, arcs in pieces of at most 3 degrees.
std::vector<Vec2> polygon_of(const model::Outline& outline) {
  constexpr double largest_turn = 3.0 / 180.0 * 3.14159265358979323846;
  std::vector<Vec2> points;
  for (const model::Edge& edge : outline.edges) {
    const int pieces =
        edge.arc ? std::max(1, static_cast<int>(std::ceil(std::abs(edge.arc->sweep) / largest_turn))) : 1;
    for (int i = 0; i < pieces; ++i) points.push_back(edge.at(static_cast<double>(i) / pieces));
  }
  return points;
}

RigidBody add_rigid(Grid& grid, const model::Outline& outline, std::int32_t number) {
  std::vector<std::size_t> cell;
  RigidBody body;
  const Vec2 centroid = outline.centroid();
  for (const Vec2& x : polygon_of(outline)) {
    cell.push_back(grid.point_count());
    grid.add_point(x, number);
    body.arms.push_back(x - centroid);
  }
  grid.add_cell(CellType::polygon, cell, number);
  return body;
}

// Values

/// Stresses of every point of the ring at xi: the mean of the boundary elements that meet at it.
Eigen::Matrix3Xd ring_stresses(const element::SolvedSuperElement& super_element, const RingSampling& sampling,
                               const element::RadialField::Values& values, const Vec2& centre, double xi,
                               const element::InteriorLoads& interior) {
  Eigen::Matrix3Xd stresses = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(sampling.nodes.size()));
  for (const RingSampling::Sample& sample : sampling.samples) {
    const auto point = static_cast<std::size_t>(sample.point);
    const std::vector<int>& nodes = super_element.ring.elements[sample.element].nodes;
    const Vec2 x = centre + xi * super_element.ring.node(sampling.nodes[point]);
    element::Vec3 strain = interior.particular_strain(x) -
                           super_element.sectors.unit_strain_of(sample.element) * interior.temperature_at(x);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto local = place_of(i), global = place_of(nodes[i]);
      strain.noalias() += sample.B1.middleCols<2>(local) * values.u_xi.segment<2>(global);
      strain.noalias() += sample.B2.middleCols<2>(local) * values.u_part.segment<2>(global);
    }
    stresses.col(sample.point) += sample.weight * (super_element.sectors.D.of(sample.element) * strain);
  }
  return stresses;
}

/// Values inside a super-element, `set(u, stress, material, x)` for each point in turn: at the rings from `first_level`
/// on, then at the centre. x is relative to the scaling centre. `field`: without particular solutions.
template <typename Set>
void values_inside(const element::SolvedSuperElement& super_element, const Vec2& centre, const RingSampling& sampling,
                   const element::RadialField& field, const element::InteriorLoads& interior, std::size_t first_level,
                   const Set& set) {
  for (std::size_t level = first_level; level < sampling.levels.size(); ++level) {
    const double xi = sampling.levels[level];
    const element::RadialField::Values values = field.at(xi);
    const Eigen::Matrix3Xd stresses = ring_stresses(super_element, sampling, values, centre, xi, interior);
    for (std::size_t i = 0; i < sampling.nodes.size(); ++i) {
      const Vec2 x = xi * super_element.ring.node(sampling.nodes[i]);
      set(Vec2(values.u.segment<2>(place_of(sampling.nodes[i])) + interior.particular_displacement(centre + x)),
          element::Vec3(stresses.col(static_cast<Eigen::Index>(i))),
          super_element.sectors.material_of(sampling.sectors[i]), x);
    }
  }
  if (super_element.domain.unbounded) return;
  const element::RadialField::Values values = field.at(0.0);
  const Eigen::Matrix3Xd stresses = ring_stresses(super_element, sampling, values, centre, 0.0, interior);
  for (int c = 0; c <= sampling.centre.back(); ++c) {  // the mean of the sectors of one material
    element::Vec3 stress = element::Vec3::Zero();
    int count = 0, material = 0;
    for (std::size_t e = 0; e < sampling.points.size(); ++e) {
      if (sampling.centre[e] != c) continue;
      material = super_element.sectors.material_of(e);
      for (const int i : sampling.points[e]) stress += stresses.col(i), ++count;
    }
    stress /= count;
    set(Vec2(values.u.head<2>() + interior.particular_displacement(centre)), stress, material, Vec2::Zero());
  }
}

void recover_inside(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
                    const element::SolvedSuperElement& super_element, const Vec2& centre, const RingSampling& sampling,
                    const element::RadialField& field, const element::InteriorLoads& interior,
                    const element::InitialStress& initial, std::size_t first_level) {
  values_inside(super_element, centre, sampling, field, interior, first_level,
                [&](const Vec2& u, const element::Vec3& stress, int material, const Vec2& x) {
                  set_values(fields, point++, u, stress, centre + x, solution, material,
                             interior.temperature_at(centre + x), initial);
                });
}

void recover_super_element(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
                           const analysis::FieldState& state, std::size_t body, const RingSampling& sampling) {
  const element::SolvedSuperElement& super_element = *solution.cells[body].front();
  const Vec2& centre = solution.mesh.bodies[body].cells.front().centre;
  const Vector& boundary = state.displacements[body];
  const element::InteriorLoads& interior = element::loads_in(state.interior[body], 0);
  const element::RadialField field(super_element.solution(), super_element.modes(),
                                   interior.without_particular(super_element.ring, centre, boundary), interior.loads);
  const std::size_t first = point;
  recover_inside(fields, first, solution, super_element, centre, sampling, field, interior, state.initial_of(body), 0);
  for (std::size_t i = 0; i < sampling.nodes.size(); ++i)  // exactly, without the field
    fields.set_displacement(first + i, boundary.segment<2>(place_of(sampling.nodes[i])));
}

/// By the map of its super-element, which many cells share. Displacements are relative to the first node: the map then
/// gives a translation no stress, not even by rounding.
Eigen::Matrix3Xd recover_mapped_cell(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
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
               Vec2(grid.points[3 * point], grid.points[3 * point + 1]), solution,
               map.materials[static_cast<std::size_t>(i)], 0.0, initial);
    ++point;
  }
  const Eigen::Index outer = (values.size() - 5 * inside) / 3;
  return values.tail(3 * outer).reshaped(3, outer);
}

/// Stresses and temperatures of points on the sides of cells.
SharedValues with_temperatures(const Eigen::Matrix3Xd& stresses, const std::function<double(Eigen::Index)>& of_point) {
  SharedValues values(4, stresses.cols());
  values.topRows<3>() = stresses;
  for (Eigen::Index i = 0; i < stresses.cols(); ++i) values(3, i) = of_point(i);
  return values;
}

/// Values inside cell `c` into `fields`; those of its points on the sides are returned.
SharedValues recover_cell(Fields& fields, std::size_t first, const analysis::StaticSolution& solution,
                          const analysis::FieldState& state, std::size_t body, std::size_t c,
                          const CellsBody::OfCell& of_cell, const Grid& grid) {
  const auto& super_element = solution.cells[body][c];
  const element::InteriorLoads& interior = element::loads_in(state.interior[body], c);
  if (!super_element) {
    const FiniteElementState finite(solution, state, body, c);
    const auto natural = element::natural_nodes(finite.element().kind);
    Eigen::Matrix3Xd stresses(3, static_cast<Eigen::Index>(natural.size()));
    for (std::size_t i = 0; i < natural.size(); ++i)
      stresses.col(static_cast<Eigen::Index>(i)) = finite.at(natural[i]).stress;
    return with_temperatures(stresses, [&](Eigen::Index i) {
      return interior.temperature_at(finite.element().x[static_cast<std::size_t>(i)]);
    });
  }
  const mesh::Cell& cell = solution.mesh.bodies[body].cells[c];
  const std::size_t inner = first + static_cast<std::size_t>(of_cell.inner);
  Vector own = state.displacements[body](element::dofs_of(cell));
  if (of_cell.sampling->map && interior.is_zero())
    return with_temperatures(
        recover_mapped_cell(fields, inner, solution, of_cell, std::move(own), grid, state.initial_of(body)),
        [](Eigen::Index) { return 0.0; });
  const element::RadialField field(super_element->solution(), super_element->modes(),
                                   interior.without_particular(super_element->ring, cell.centre, std::move(own)),
                                   interior.loads);
  recover_inside(fields, inner, solution, *super_element, cell.centre, *of_cell.sampling, field, interior,
                 state.initial_of(body), 1);
  return with_temperatures(
      ring_stresses(*super_element, *of_cell.sampling, field.at(1.0), cell.centre, 1.0, interior), [&](Eigen::Index i) {
        return interior.temperature_at(cell.centre +
                                       super_element->ring.node(of_cell.sampling->nodes[static_cast<std::size_t>(i)]));
      });
}

/// Stress and temperature on the sides of cells are the means of the cells that share the point.
void recover_cells(Fields& fields, std::size_t first, const analysis::StaticSolution& solution,
                   const analysis::FieldState& state, std::size_t body, const CellsBody& made, const Grid& grid,
                   const CompleteSums& complete) {
  const mesh::BodyMesh& mesh = solution.mesh.bodies[body];
  SharedValues sums = SharedValues::Zero(4, static_cast<Eigen::Index>(made.nodes.size()));
  std::vector<int> cells_at(made.nodes.size(), 0);
  constexpr std::size_t at_once = 4096;  // the sums are made in the order of the cells, whatever the threads
  std::vector<SharedValues> of_part(std::min(at_once, mesh.cells.size()));
  for (std::size_t begin = 0; begin < mesh.cells.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, mesh.cells.size() - begin);
    linalg::parallel_for(static_cast<int>(count), solution.threads, [&](int k) {
      const auto at = static_cast<std::size_t>(k);
      of_part[at] = recover_cell(fields, first, solution, state, body, begin + at, made.cells[begin + at], grid);
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
    const Eigen::Vector4d values = sums.col(static_cast<Eigen::Index>(point)) / cells_at[point];
    set_values(fields, first + point, u.segment<2>(place_of(node)), values.head<3>(),
               mesh.nodes[static_cast<std::size_t>(node)], solution, made.materials[point], values[3],
               state.initial_of(body));
  }
}

}  // namespace

std::vector<double> ring_levels(const element::Ring& ring) {
  double length = 0.0, radius = 0.0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    length += (ring.nodes[(i + 1) % ring.nodes.size()] - ring.nodes[i]).norm();
    radius += ring.nodes[i].norm();
  }
  // Widths w, w g, w g^2 ... of `ring_count` rings add up to 1; g grows with the sum.
  const double width = std::clamp(length / radius, 0.02, 1.0 / ring_count);
  double low = 1.0, high = 2.0;
  for (int halving = 0; halving < 50; ++halving) {
    const double growth = 0.5 * (low + high);
    double sum = 0.0, next = width;
    for (int i = 0; i < ring_count; ++i, next *= growth) sum += next;
    (sum < 1.0 ? low : high) = growth;
  }
  std::vector<double> levels;
  double xi = 1.0, next = width;
  for (int i = 0; i < ring_count; ++i, xi -= next, next *= low) levels.push_back(xi);
  // Stresses may be unbounded towards the centre of an open super-element: each ring is at half the distance of the
  // previous one.
  if (ring.is_open())
    for (int i = 0; i < inner_rings; ++i) levels.push_back(0.5 * levels.back());
  return levels;
}

std::vector<double> outer_ring_levels() {
  std::vector<double> levels{1.0};
  constexpr int rings = 16;
  for (int i = 1; i <= rings; ++i) levels.push_back(std::pow(farthest, static_cast<double>(i) / rings));
  return levels;
}

namespace {

/// Points of the elements of a ring: where materials meet, one point for each of them.
void share_points(const element::Ring& ring, const element::Sectors& sectors, RingSampling& sampling) {
  const std::size_t count = ring.elements.size();
  std::vector<int> point_of(ring.nodes.size(), -1), material_at(ring.nodes.size(), -1);
  for (std::size_t node = 0; node < ring.nodes.size(); ++node) sampling.nodes.push_back(static_cast<int>(node));
  sampling.sectors.assign(ring.nodes.size(), 0);
  for (std::size_t e = 0; e < count; ++e) {
    const int material = sectors.material_of(e);
    const bool goes_on = e > 0 && sectors.material_of(e - 1) == material;
    sampling.centre.push_back(e == 0 ? 0 : sampling.centre.back() + (goes_on ? 0 : 1));
    std::vector<int>& points = sampling.points.emplace_back();
    for (const int node : ring.elements[e].nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (material_at[i] == -1) {
        material_at[i] = material;
        point_of[i] = node;
        sampling.sectors[i] = e;
      } else if (material_at[i] != material) {
        point_of[i] = static_cast<int>(sampling.nodes.size());
        sampling.nodes.push_back(node);
        sampling.sectors.push_back(e);
        material_at[i] = material;
      }
      points.push_back(point_of[i]);
    }
  }
}

}  // namespace

RingSampling ring_sampling(const element::Ring& ring, const element::Sectors& sectors, bool unbounded) {
  RingSampling sampling;
  share_points(ring, sectors, sampling);
  std::vector<int> elements_at(sampling.nodes.size(), 0);
  for (const std::vector<int>& points : sampling.points)
    for (const int point : points) ++elements_at[static_cast<std::size_t>(point)];
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
    const std::vector<double> lobatto = geometry::lobatto_points(order);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      element::StrainMatrices strain =
          element::strain_matrices(ring, element, basis.values(lobatto[i]), basis.derivatives(lobatto[i]));
      const int point = sampling.points[e][i];
      sampling.samples.push_back(
          {point, 1.0 / elements_at[static_cast<std::size_t>(point)], e, std::move(strain.B1), std::move(strain.B2)});
    }
  }
  sampling.levels = unbounded ? outer_ring_levels() : ring_levels(ring);
  return sampling;
}

std::shared_ptr<const RingSampling> SamplingLibrary::of_body(const element::SolvedSuperElement& super_element) {
  std::shared_ptr<const RingSampling>& sampling = known_[&super_element];
  if (!sampling)
    sampling = std::make_shared<const RingSampling>(
        ring_sampling(super_element.ring, super_element.sectors, super_element.domain.unbounded));
  return sampling;
}

namespace {

/// Column by column: the values of a unit displacement.
CellMap cell_map(const element::SolvedSuperElement& super_element, const RingSampling& sampling) {
  CellMap map;
  const auto n = places_of(super_element.ring.nodes.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    const element::RadialField field(super_element.solution(), super_element.modes(), Vector::Unit(n, j));
    std::vector<double> column;
    map.materials.clear();
    values_inside(super_element, Vec2::Zero(), sampling, field, {}, 1,
                  [&](const Vec2& u, const element::Vec3& stress, int material, const Vec2&) {
                    column.insert(column.end(), {u[0], u[1], stress[0], stress[1], stress[2]});
                    map.materials.push_back(material);
                  });
    const Eigen::Matrix3Xd outer = ring_stresses(super_element, sampling, field.at(1.0), Vec2::Zero(), 1.0, {});
    column.insert(column.end(), outer.data(), outer.data() + outer.size());
    if (j == 0) map.values.resize(static_cast<Eigen::Index>(column.size()), n);
    map.values.col(j) = Eigen::Map<const Vector>(column.data(), map.values.rows());
  }
  return map;
}

}  // namespace

std::shared_ptr<const RingSampling> SamplingLibrary::of_cell(const element::SolvedSuperElement& super_element,
                                                             std::size_t cells) {
  std::shared_ptr<const RingSampling>& sampling = known_cells_[&super_element];
  if (sampling) return sampling;
  RingSampling made = ring_sampling(super_element.ring, super_element.sectors, false);
  if (!super_element.ring.is_open()) {
    made.levels = {1.0, 0.5};  // small: a ring between sides and centre
    if (cells > 4 * super_element.ring.nodes.size()) made.map = cell_map(super_element, made);
  }
  sampling = std::make_shared<const RingSampling>(std::move(made));
  return sampling;
}

Recovery::Recovery(const analysis::StaticSolution& solution, const std::vector<char>& divided) {
  SamplingLibrary library;
  UsesOfCells uses;
  for (const element::SolvedCells& cells : solution.cells)
    for (const auto& cell : cells)
      if (cell) ++uses[cell.get()];
  for (std::size_t b = 0; b < solution.model.bodies.size(); ++b) {
    const mesh::BodyMesh& body = solution.mesh.bodies[b];
    const element::SolvedCells& cells = solution.cells[b];
    const auto number = static_cast<std::int32_t>(b + 1);
    grid_.first_point.push_back(grid_.point_count());
    if (solution.model.bodies[b].rigid) {
      bodies_.push_back(add_rigid(grid_, solution.model.bodies[b].outline, number));
    } else if (cells.size() == 1 && cells.front() && (divided.empty() || divided[b] == 0)) {
      SuperElementBody made{library.of_body(*cells.front())};
      add_super_element(grid_, body, *made.sampling, number);
      bodies_.push_back(std::move(made));
    } else {
      bodies_.push_back(add_cells(grid_, body, cells, library, uses, number));
    }
  }
  grid_.first_point.push_back(grid_.point_count());
}

Fields Recovery::fields(const analysis::StaticSolution& solution, const analysis::FieldState& state,
                        const CompleteSums& complete) const {
  ensure(state.displacements.size() == bodies_.size() && state.interior.size() == bodies_.size(),
         "a state has displacements and interior loads of every body");
  Fields fields(grid_.point_count());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t point = grid_.first_point[b];
    if (const auto* super_element = std::get_if<SuperElementBody>(&bodies_[b])) {
      recover_super_element(fields, point, solution, state, b, *super_element->sampling);
    } else if (const auto* rigid = std::get_if<RigidBody>(&bodies_[b])) {
      for (std::size_t i = 0; i < rigid->arms.size(); ++i)
        fields.set(point + i, rigid_displacement(state.displacements[b], rigid->arms[i]), element::Vec3::Zero(), 0.0);
    } else {
      recover_cells(fields, point, solution, state, b, std::get<CellsBody>(bodies_[b]), grid_, complete);
    }
  }
  for (std::size_t point = 0; point < grid_.point_count(); ++point)
    for (std::size_t k = 0; k < 2; ++k)
      fields.displacement[3 * point + k] -= state.reference_displacement[static_cast<Eigen::Index>(k)];
  return fields;
}

}  // namespace scabo::result
