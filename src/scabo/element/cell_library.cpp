#include "scabo/element/cell_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "scabo/base/components.hpp"
#include "scabo/element/alike_cells.hpp"
#include "scabo/element/facet/cell_ring.hpp"
#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/batch.hpp"
#include "scabo/element/plane/conditioning.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// `rounding`: of the coordinates from which both were made.
bool are_alike(const SolvedSuperElement& a, const SolvedSuperElement& b, double rounding) {
  const bool held_alike = a.held == b.held || (a.held && b.held && *a.held == *b.held);
  if (a.thickness != b.thickness || a.domain != b.domain || !held_alike || a.scale != b.scale ||
      a.sectors.materials != b.sectors.materials || a.sectors.D != b.sectors.D ||
      a.ring.nodes.size() != b.ring.nodes.size() || a.ring.elements.size() != b.ring.elements.size())
    return false;
  for (std::size_t e = 0; e < a.ring.elements.size(); ++e)
    if (a.ring.elements[e].nodes != b.ring.elements[e].nodes) return false;
  double size = 0.0;
  for (const Vec2& x : a.ring.nodes) size = std::max(size, x.squaredNorm());
  // Coordinates relative to their centres differ only by rounding.
  const double most = std::max(1e-26 * size, std::min(rounding * rounding, most_apart * most_apart * size));
  for (std::size_t i = 0; i < a.ring.nodes.size(); ++i)
    if ((a.ring.nodes[i] - b.ring.nodes[i]).squaredNorm() > most) return false;
  return true;
}

/// Equal in all that its solution follows from.
bool are_same(const SolvedSuperElement& a, const SolvedSuperElement& b) {
  return a.ring.nodes == b.ring.nodes && are_alike(a, b, 0.0);
}

/// The error of a super-element in the terms of the model file.
Diagnostic ill_posed(const model::Body& body, const SolvedSuperElement& super_element, const IllPosed& error) {
  Conditioning found;
  std::vector<Mat3> D;
  for (std::size_t e = 0; e < super_element.ring.elements.size(); ++e) D.push_back(super_element.sectors.D.of(e));
  measure(D, found);
  const Vec2 centre = Vec2::Zero();
  const bool corner = super_element.ring.is_open();  // the centre of one lies on its boundary
  measure(super_element.ring.elements, super_element.ring.nodes, corner ? nullptr : &centre, found);
  return {body.source, fmt::format("{}: {}", error.what(), causes_in_words(found))};
}

// A stiffness from a batch has a rounding error of 1e-14 instead of 4e-15, which energies of small models show; alone,
// so many cells take 0.16 s.
constexpr std::size_t fewest_of_a_batch = 4096, most_of_a_batch = 16384;

/// Solves what a batch can solve, a part at a time because it needs copies; returns the indices of the others.
std::vector<std::size_t> solve_in_batches(const std::vector<std::shared_ptr<SolvedSuperElement>>& distinct,
                                          int threads) {
  std::vector<std::size_t> suitable, others;
  for (std::size_t i = 0; i < distinct.size(); ++i)
    (distinct[i]->domain.unbounded || distinct[i]->held ? others : suitable).push_back(i);
  if (suitable.size() < fewest_of_a_batch) {
    others.insert(others.end(), suitable.begin(), suitable.end());
    return others;
  }
  for (std::size_t first = 0; first < suitable.size(); first += most_of_a_batch) {
    const std::span<const std::size_t> part =
        std::span(suitable).subspan(first, std::min(most_of_a_batch, suitable.size() - first));
    std::vector<BatchItem> items;
    items.reserve(part.size());
    for (const std::size_t i : part)
      items.push_back({distinct[i]->ring, distinct[i]->sectors.D, distinct[i]->thickness});
    BatchSolution batch = solve_batch(items, {.threads = threads});
    for (const int left : batch.alone) others.push_back(part[static_cast<std::size_t>(left)]);
    for (std::size_t k = 0; k < part.size(); ++k)
      if (batch.K[k].size() > 0) distinct[part[k]]->set(std::move(batch.K[k]), batch.rounding[k]);
  }
  return others;
}

/// Many small super-elements are solved in batches; many others are distributed over the threads; of a few, the
/// symmetry blocks of each. `bodies`: the first body of each. `taken`: how many more are known.
void solve_all(const model::Model& model, const std::vector<std::shared_ptr<SolvedSuperElement>>& distinct,
               const std::vector<std::size_t>& bodies, int taken, int threads) {
  const std::vector<std::size_t> others = solve_in_batches(distinct, threads);
  const auto count = static_cast<int>(others.size());
  const bool many = count + taken >= threads && threads > 1;
  const auto solve = [&](int i) {
    const std::size_t at = others[static_cast<std::size_t>(i)];
    SolvedSuperElement& super_element = *distinct[at];
    try {
      if (super_element.held) {
        HeldSolution held =
            solve_held(super_element.ring, super_element.sectors.D, super_element.thickness, *super_element.held);
        if (held.K) return super_element.set(*std::move(held.K), held.rounding);
      }
      super_element.set(solve_super_element(super_element.ring, super_element.sectors.D, super_element.thickness,
                                            many ? 1 : threads, super_element.domain));
    } catch (const IllPosed& error) {
      throw InputError(model.file, {ill_posed(model.bodies[bodies[at]], super_element, error)});
    }
  };
  linalg::parallel_for(count, many ? threads : 1, solve);
}

/// The mean displacement of an unbounded body vanishes at the distance of its reference point, or at a thousand radii
/// if there is none.
Domain domain_of(const model::Body& body, const Ring& ring) {
  Domain domain;
  domain.unbounded = body.outside;
  if (!body.outside || !body.reference) return domain;
  double radius = 0.0;
  for (const Vec2& x : ring.nodes) radius = std::max(radius, x.norm());
  domain.far = std::max(10.0, (*body.reference - body.mesh.centre).norm() / radius);
  return domain;
}

/// One mistake for all finite elements of a body that have no stiffness.
std::optional<Diagnostic> folded_elements(const model::Body& body, const mesh::BodyMesh& mesh) {
  std::size_t count = 0, first = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cells[c].kind == mesh::CellKind::finite_element &&
        !is_well_shaped(finite_element_of(mesh.cells[c], mesh.nodes)) && count++ == 0)
      first = c;
  if (count == 0) return std::nullopt;
  const FiniteElement element = finite_element_of(mesh.cells[first], mesh.nodes);
  return Diagnostic{body.source,
                    fmt::format("{} of {} finite elements of body '{}' {} folded: number {}, with a corner "
                                "at ({:.6g}, {:.6g}), has a Jacobian of {:.3g}, which must be positive "
                                "everywhere: move its nodes",
                                count, mesh.count(mesh::CellKind::finite_element), body.name, count == 1 ? "is" : "are",
                                first + 1, element.x[0].x(), element.x[0].y(), least_jacobian(element))};
}

/// Equal for super-elements that are alike (but for coordinates whose rounding falls on two sides of a step, which only
/// costs a second solution).
std::size_t hash_of(const SolvedSuperElement& super_element) {
  std::size_t hash = super_element.ring.elements.size();
  const auto add = [&](std::int64_t value) {
    hash ^= static_cast<std::size_t>(value) + 0x9e3779b97f4a7c15ULL + (hash << 6) + (hash >> 2);
  };
  for (const int material : super_element.sectors.materials) add(material);
  double size = 0.0;
  for (const Vec2& x : super_element.ring.nodes) size = std::max(size, x.lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(size, &exponent);
  for (const Vec2& x : super_element.ring.nodes)
    for (const double coordinate : x) add(std::llround(std::ldexp(coordinate, 30 - exponent)));
  return hash;
}

/// Of the coordinates of a body, a length.
double rounding_of(const mesh::BodyMesh& mesh) {
  double farthest = 0.0;
  for (const Vec2& x : mesh.nodes) farthest = std::max(farthest, x.lpNorm<Eigen::Infinity>());
  return 4.0 * std::numeric_limits<double>::epsilon() * farthest;
}

/// Distinct super-elements by hash_of().
using Known = std::unordered_multimap<std::size_t, std::shared_ptr<const SolvedSuperElement>>;
Known distinct_of(const std::vector<SolvedCells>& all) {
  Known known;
  std::unordered_set<const SolvedSuperElement*> seen;
  for (const SolvedCells& cells : all)
    for (const auto& cell : cells)
      if (cell && seen.insert(cell.get()).second) known.emplace(hash_of(*cell), cell);
  return known;
}

/// Takes solutions of the same super-elements `before` for those of `solved`, and them out of `distinct` and `bodies`.
/// Solutions from a batch are not taken, whose last bits may depend on what else is in it.
void take_over(const std::vector<SolvedCells>& before, std::vector<std::shared_ptr<SolvedSuperElement>>& distinct,
               std::vector<std::size_t>& bodies, std::vector<SolvedCells>& solved) {
  const Known known = distinct_of(before);
  if (known.size() >= fewest_of_a_batch) return;
  std::unordered_map<const SolvedSuperElement*, std::shared_ptr<const SolvedSuperElement>> taken;
  std::size_t left = 0;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    const auto [first, last] = known.equal_range(hash_of(*distinct[i]));
    const auto same =
        std::find_if(first, last, [&](const auto& entry) { return are_same(*entry.second, *distinct[i]); });
    if (same != last) {
      taken.emplace(distinct[i].get(), same->second);
      continue;
    }
    bodies[left] = bodies[i];
    distinct[left++] = distinct[i];
  }
  for (SolvedCells& cells : solved)
    for (auto& cell : cells)
      if (const auto found = taken.find(cell.get()); found != taken.end()) cell = found->second;
  distinct.resize(left);
  bodies.resize(left);
}

}  // namespace

std::vector<int> dofs_of(const mesh::Cell& cell) {
  std::vector<int> dofs;
  for (const int node : cell.nodes()) {
    for (const int c : {0, 1}) dofs.push_back(static_cast<int>(place_of(node, c)));
  }
  return dofs;
}

void SolvedSuperElement::set(SuperElementSolution solution) {
  rounding_ = solution.rounding;
  whole_ = std::make_unique<const SuperElementSolution>(std::move(solution));
}

void SolvedSuperElement::set(Matrix K, double rounding) {
  K_ = std::move(K);
  rounding_ = rounding;
}

const SuperElementSolution& SolvedSuperElement::solution() const {
  if (whole_) return *whole_;
  std::call_once(solution_flag_, [&] {
    solution_ =
        std::make_unique<const SuperElementSolution>(solve_super_element(ring, sectors.D, thickness, threads, domain));
  });
  return *solution_;
}

const ModalSolution& SolvedSuperElement::modes() const {
  std::call_once(modes_flag_,
                 [&] { modes_ = std::make_unique<const ModalSolution>(modal_solution(solution(), threads)); });
  return *modes_;
}

const InternalLevel& SolvedSuperElement::level(const std::vector<double>& density) const {
  std::call_once(level_flag_, [&] {
    const bool coupled = !is_uniform(density);
    level_ = std::make_unique<const InternalLevel>(internal_level(
        mass_matrix(ring, solution(), modes(), density, thickness, threads), solution(), modes(), coupled, threads));
  });
  return *level_;
}

const InternalModes& SolvedSuperElement::level_modes(const std::vector<double>& density) const {
  std::call_once(level_modes_flag_, [&] {
    level_modes_ = std::make_unique<const InternalModes>(
        internal_modes(mass_matrix(ring, solution(), modes(), density, thickness, threads), solution(), modes(),
                       !is_uniform(density)));
  });
  return *level_modes_;
}

const CornerAnalysis& SolvedSuperElement::corner() const {
  std::call_once(corner_flag_, [&] {
    const Ring* of = &ring;
    const Elasticity* D = &sectors.D;
    const SuperElementSolution* solved = &solution();
    if (held && held->mirror >= 0) {
      const auto face = static_cast<std::size_t>(held->mirror);
      both_ = std::make_unique<const Mirrored>(
          with_image(ring, sectors.D, face == 0 ? Face::first : Face::last, held->along[face].front()));
      of = &both_->ring;
      D = &both_->D;
      solution_of_both_ =
          std::make_unique<const SuperElementSolution>(solve_super_element(*of, *D, thickness, threads));
      solved = solution_of_both_.get();
    }
    corner_ = std::make_unique<const CornerAnalysis>(*of, *D, *solved);
    if (scale == 1.0 || corner_->kind() == CornerKind::crack) return;
    const double own = corner_->of(Vector::Zero(places_of(of->nodes.size()))).reference_length;
    corner_ = std::make_unique<const CornerAnalysis>(*of, *D, *solved, own / scale);
  });
  return *corner_;
}

StressIntensity SolvedSuperElement::factors(const Vector& u, const std::vector<RadialLoad>& loads) const {
  const CornerAnalysis& analysis = corner();
  return both_ ? analysis.of(both_->displacement(u), both_->loads(loads)) : analysis.of(u, loads);
}

void take_alike(std::vector<SolvedCells>& cells, const mesh::Mesh& mesh, const std::vector<SolvedCells>& like) {
  const Known known = distinct_of(like);
  std::unordered_map<const SolvedSuperElement*, std::shared_ptr<const SolvedSuperElement>> taken;
  for (std::size_t b = 0; b < cells.size(); ++b) {
    const double rounding = rounding_of(mesh.bodies[b]);
    for (auto& cell : cells[b]) {
      if (!cell) continue;
      const auto [found, is_new] = taken.try_emplace(cell.get(), cell);
      if (is_new) {
        const auto [first, last] = known.equal_range(hash_of(*cell));
        const auto alike =
            std::find_if(first, last, [&](const auto& entry) { return are_alike(*entry.second, *cell, rounding); });
        if (alike != last) found->second = alike->second;
      }
      cell = found->second;
    }
  }
}

std::vector<SolvedCells> solve_cells(const model::Model& model, const mesh::Mesh& mesh, int threads,
                                     const std::vector<char>& elsewhere, const std::vector<SolvedCells>& before) {
  std::vector<std::shared_ptr<SolvedSuperElement>> distinct;
  std::vector<char> here;                                   // for each of them
  std::unordered_multimap<std::size_t, std::size_t> known;  // hash to index in `distinct`
  std::vector<std::size_t> bodies;
  std::vector<SolvedCells> solved(model.bodies.size());
  std::vector<Diagnostic> folded;
  std::shared_ptr<SolvedSuperElement> wanted;  // the next one, until it is found to be a distinct one
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (auto mistake = folded_elements(model.bodies[b], mesh.bodies[b])) folded.push_back(std::move(*mistake));
    const double rounding = rounding_of(mesh.bodies[b]);
    for (const mesh::Cell& cell : mesh.bodies[b].cells) {
      if (cell.kind != mesh::CellKind::superelement) {
        solved[b].emplace_back();
        continue;
      }
      if (!wanted) wanted = std::make_shared<SolvedSuperElement>();
      set_ring(wanted->ring, cell, mesh.bodies[b].nodes);
      if (wanted->sectors.materials != cell.materials) wanted->sectors = sectors_of(model, cell);
      wanted->domain = domain_of(model.bodies[b], wanted->ring);
      wanted->thickness = model::thickness_of(model, static_cast<int>(b));
      wanted->threads = threads;
      wanted->held = cell.held;
      wanted->scale = cell.scale;
      const bool is_here = elsewhere.empty() || elsewhere[b] == 0;
      const std::size_t hash = hash_of(*wanted);
      const auto [first, last] = known.equal_range(hash);
      const auto same = std::find_if(
          first, last, [&](const auto& entry) { return are_alike(*wanted, *distinct[entry.second], rounding); });
      if (same != last) {
        solved[b].push_back(distinct[same->second]);
        if (is_here) here[same->second] = 1;
        continue;
      }
      known.emplace(hash, distinct.size());
      distinct.push_back(wanted);
      here.push_back(is_here ? 1 : 0);
      bodies.push_back(b);
      solved[b].push_back(std::move(wanted));
    }
  }
  if (!folded.empty()) throw InputError(model.file, std::move(folded));
  if (!elsewhere.empty()) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < distinct.size(); ++i)
      if (here[i]) distinct[kept] = distinct[i], bodies[kept++] = bodies[i];
    distinct.resize(kept);
    bodies.resize(kept);
  }
  const std::size_t all = distinct.size();
  if (!before.empty() && all < fewest_of_a_batch) take_over(before, distinct, bodies, solved);
  solve_all(model, distinct, bodies, static_cast<int>(all - distinct.size()), threads);
  return solved;
}

}  // namespace scabo::element
