#include "scabo/element/cell_locator.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::element {

CellLocator::CellLocator(const mesh::BodyMesh& mesh, const SolvedCells& cells) : mesh_(mesh), cells_(cells) {
  ensure(!mesh.cells.empty(), "a rigid body has no cells");
  if (mesh.cells.size() == 1) {
    buckets_ = {{0}};
    return;
  }
  Vec2 high = mesh.nodes.front();
  low_ = high;
  for (const Vec2& x : mesh.nodes) low_ = low_.cwiseMin(x), high = high.cwiseMax(x);
  const Vec2 size = (high - low_).cwiseMax(1e-12 * (high - low_).maxCoeff());
  const double side = std::sqrt(size.x() * size.y() / static_cast<double>(mesh.cells.size()));
  for (int k = 0; k < 2; ++k) counts_[k] = std::clamp(static_cast<int>(size[k] / side), 1, 4000);
  step_ = size.cwiseQuotient(counts_.cast<double>());
  buckets_.resize(static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    Vec2 least = mesh.nodes[static_cast<std::size_t>(mesh.cells[c].boundary.front().nodes.front())], most = least;
    const auto include = [&](const Vec2& x) { least = least.cwiseMin(x), most = most.cwiseMax(x); };
    for (const mesh::LineElement& element : mesh.cells[c].boundary)
      for (const int node : element.nodes) include(mesh.nodes[static_cast<std::size_t>(node)]);
    if (cells[c]) include(mesh.cells[c].centre);
    const Vec2 slack = 0.25 * (most - least);  // curved sides may extend beyond their nodes
    const auto index = [&](const Vec2& x, int k) {
      return std::clamp(static_cast<int>((x[k] - low_[k]) / step_[k]), 0, counts_[k] - 1);
    };
    for (int j = index(least - slack, 1); j <= index(most + slack, 1); ++j)
      for (int i = index(least - slack, 0); i <= index(most + slack, 0); ++i)
        buckets_[static_cast<std::size_t>(j) * static_cast<std::size_t>(counts_[0]) + static_cast<std::size_t>(i)]
            .push_back(c);
  }
}

Eigen::Vector2i CellLocator::indices_of(const Vec2& x) const {
  Eigen::Vector2i at;
  for (int k = 0; k < 2; ++k) at[k] = static_cast<int>(std::clamp((x[k] - low_[k]) / step_[k], 0.0, counts_[k] - 1.0));
  return at;
}

const std::vector<std::size_t>& CellLocator::bucket(int i, int j) const {
  return buckets_[static_cast<std::size_t>(j) * static_cast<std::size_t>(counts_[0]) + static_cast<std::size_t>(i)];
}

std::optional<CellPlace> CellLocator::in_cell(std::size_t cell, const Vec2& x) const {
  CellPlace place;
  place.cell = cell;
  if (const auto& super_element = cells_[cell]) {
    const auto scaled = locate(super_element->ring, x - mesh_.cells[cell].centre, super_element->domain.unbounded);
    if (!scaled) return std::nullopt;
    place.scaled = *scaled;
    return place;
  }
  const auto natural = natural_coordinates(finite_element_of(mesh_.cells[cell], mesh_.nodes), x);
  if (!natural) return std::nullopt;
  place.natural = *natural;
  return place;
}

std::optional<CellPlace> CellLocator::find(const Vec2& x) const {
  const Eigen::Vector2i at = indices_of(x);
  for (const std::size_t cell : bucket(at[0], at[1]))
    if (const auto place = in_cell(cell, x)) return place;
  return std::nullopt;
}

std::optional<CellLocator::Candidate> CellLocator::nearest_in(std::size_t cell, const Vec2& x) const {
  if (!cells_[cell]) {
    const auto nearest = nearest_on_sides(finite_element_of(mesh_.cells[cell], mesh_.nodes), x);
    Candidate candidate{{}, nearest.distance};
    candidate.place.cell = cell;
    candidate.place.natural = nearest.natural;
    return candidate;
  }
  // Moved towards the scaling centre the point lies in the cell; the factor tells how far outside it was.
  const Vec2& centre = mesh_.cells[cell].centre;
  const double factor = cells_[cell]->domain.unbounded ? 2.0 : 0.5;
  auto place = in_cell(cell, centre + factor * (x - centre));
  if (!place) return std::nullopt;
  const double distance = (x - centre).norm() * std::abs(1.0 - factor / place->scaled.xi);
  place->scaled.xi = 1.0;
  return Candidate{*place, distance};
}

CellPlace CellLocator::nearest(const Vec2& x) const {
  if (const auto place = find(x)) return *place;
  std::optional<Candidate> best;
  const auto look = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= counts_[0] || j >= counts_[1]) return;
    for (const std::size_t cell : bucket(i, j)) {
      const auto candidate = nearest_in(cell, x);
      if (candidate && (!best || candidate->distance < best->distance)) best = candidate;
    }
  };
  // Squares of buckets around that of the point; what lies beyond square k is at least k steps away.
  const Eigen::Vector2i at = indices_of(x);
  for (int k = 0; k < counts_.maxCoeff(); ++k) {
    for (int i = -k; i <= k; ++i) {
      look(at[0] + i, at[1] - k);
      if (k > 0) look(at[0] + i, at[1] + k);
    }
    for (int j = 1 - k; j < k; ++j) {
      look(at[0] - k, at[1] + j);
      look(at[0] + k, at[1] + j);
    }
    if (best && best->distance <= k * step_.minCoeff()) break;
  }
  ensure(best.has_value(), "a point of a body has no place in its cells");
  return best->place;
}

}  // namespace scabo::element
