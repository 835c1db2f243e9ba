#include "scabo/analysis/super_elements.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/element/ill_posed.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::analysis {

namespace {

bool are_alike(const SolvedSuperElement& a, const SolvedSuperElement& b) {
  if (a.thickness != b.thickness || a.domain != b.domain || a.sectors.materials != b.sectors.materials ||
      a.sectors.D != b.sectors.D || a.ring.nodes.size() != b.ring.nodes.size() ||
      a.ring.elements.size() != b.ring.elements.size())
    return false;
  for (std::size_t e = 0; e < a.ring.elements.size(); ++e)
    if (a.ring.elements[e].nodes != b.ring.elements[e].nodes) return false;
  double size = 0.0;
  for (const Vec2& x : a.ring.nodes) size = std::max(size, x.squaredNorm());
  // Coordinates relative to their centres differ only by rounding.
  for (std::size_t i = 0; i < a.ring.nodes.size(); ++i)
    if ((a.ring.nodes[i] - b.ring.nodes[i]).squaredNorm() > 1e-26 * size) return false;
  return true;
}

/// The error of a super-element in the terms of the model file.
Diagnostic ill_posed(const model::Body& body, const element::IllPosed& error) {
  return {body.source,
          fmt::format(
              "{}; its material constants differ too much for double precision (Poisson's ratio too close to 1/2, or "
              "moduli that differ by a factor of 1e12 or more), the body is too slender (3000:1 or more), or the scaling "
              "centre is too close to the boundary",
              error.what())};
}

/// Many super-elements are distributed over the threads; of a few, the symmetry blocks of each. `bodies`: the first
/// body of each.
void solve_all(const model::Model& model, const std::vector<std::shared_ptr<SolvedSuperElement>>& distinct,
               const std::vector<std::size_t>& bodies, int threads) {
  const auto count = static_cast<int>(distinct.size());
  const bool many = count >= threads && threads > 1;
  const auto solve = [&](int i) {
    SolvedSuperElement& super_element = *distinct[static_cast<std::size_t>(i)];
    super_element.threads = threads;
    try {
      super_element.solution =
          element::solve_super_element(super_element.ring, super_element.sectors.D, super_element.thickness,
                                       many ? 1 : threads, super_element.domain);
    } catch (const element::IllPosed& error) {
      throw InputError(model.file, {ill_posed(model.bodies[bodies[static_cast<std::size_t>(i)]], error)});
    }
  };
  linalg::parallel_for(count, many ? threads : 1, solve);
}

/// The mean displacement of an unbounded body vanishes at the distance of its reference point, or at a thousand radii
/// if there is none.
element::Domain domain_of(const model::Body& body, const element::Ring& ring) {
  element::Domain domain;
  domain.unbounded = body.outside;
  if (!body.outside || !body.reference) return domain;
  double radius = 0.0;
  for (const Vec2& x : ring.nodes) radius = std::max(radius, x.norm());
  domain.far = std::max(10.0, (*body.reference - body.mesh.centre).norm() / radius);
  return domain;
}

}  // namespace

const element::ModalSolution& SolvedSuperElement::modes() const {
  if (!modes_) modes_ = std::make_unique<element::ModalSolution>(element::modal_solution(solution, threads));
  return *modes_;
}

const element::CornerAnalysis& SolvedSuperElement::corner() const {
  if (!corner_) corner_ = std::make_unique<element::CornerAnalysis>(ring, sectors.D, solution);
  return *corner_;
}

std::vector<std::shared_ptr<const SolvedSuperElement>> solve_super_elements(const model::Model& model,
                                                                            const mesh::Mesh& mesh, int threads) {
  std::vector<std::shared_ptr<SolvedSuperElement>> distinct;
  std::vector<std::size_t> bodies;
  std::vector<std::shared_ptr<const SolvedSuperElement>> of_body(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (mesh.bodies[b].super_elements.empty()) continue;
    auto wanted = std::make_shared<SolvedSuperElement>();
    wanted->ring = element::ring_of(mesh.bodies[b].super_elements.front(), mesh.bodies[b].nodes);
    wanted->sectors = element::sectors_of(model, model.bodies[b], mesh.bodies[b]);
    wanted->domain = domain_of(model.bodies[b], wanted->ring);
    wanted->thickness = model.analysis.thickness;
    const auto same =
        std::find_if(distinct.begin(), distinct.end(), [&](const auto& other) { return are_alike(*wanted, *other); });
    of_body[b] = same == distinct.end() ? wanted : *same;
    if (same == distinct.end()) distinct.push_back(wanted), bodies.push_back(b);
  }
  solve_all(model, distinct, bodies, threads);
  return of_body;
}

}  // namespace scabo::analysis
