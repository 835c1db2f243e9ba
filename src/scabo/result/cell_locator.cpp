#include "scabo/result/cell_locator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace scabo::result {

std::optional<Vec2> natural_coordinates(const element::Corners8& corners, const Vec2& x) {
  constexpr double slack = 1e-9;  // points between two elements belong to one of them
  Vec2 low = corners[0], high = corners[0];
  for (const Vec2& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vec2 size = high - low;
  // Curved sides may extend beyond the bounding box of their nodes by less than a quarter of its size.
  if (((x - low).array() < -0.25 * size.array()).any() || ((x - high).array() > 0.25 * size.array()).any())
    return std::nullopt;
  // Position and its gradient are computed like a displacement field whose nodal values are the coordinates.
  element::Vector16 nodal;
  for (std::size_t i = 0; i < 8; ++i) nodal.segment<2>(static_cast<Eigen::Index>(2 * i)) = corners[i];
  const auto position = [&](const Vec2& at) {
    return element::plane_element8_values(element::plane_element8_nodes, nodal, element::Mat3::Zero(), at.x(), at.y())
        .displacement;
  };
  Vec2 natural = Vec2::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vec2 miss = x - position(natural);
    if (miss.norm() <= 1e-14 * size.norm()) break;
    constexpr double h = 1e-3;  // position is quadratic along r and along s: central differences are exact
    Mat2 J;
    J.col(0) = (position(natural + Vec2(h, 0.0)) - position(natural - Vec2(h, 0.0))) / (2.0 * h);
    J.col(1) = (position(natural + Vec2(0.0, h)) - position(natural - Vec2(0.0, h))) / (2.0 * h);
    natural += J.inverse() * miss;
    if (!(natural.lpNorm<Eigen::Infinity>() < 3.0)) return std::nullopt;
  }
  if (natural.lpNorm<Eigen::Infinity>() > 1.0 + slack) return std::nullopt;
  return natural;
}

CellLocator::CellLocator(const mesh::BodyMesh& mesh, const element::SolvedCells& cells) : mesh_(mesh), cells_(cells) {
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

std::size_t CellLocator::bucket_of(const Vec2& x) const {
  if (buckets_.size() == 1) return 0;
  std::size_t at[2];
  for (int k = 0; k < 2; ++k) {
    const double position = std::clamp((x[k] - low_[k]) / step_[k], 0.0, counts_[k] - 1.0);
    at[k] = static_cast<std::size_t>(position);
  }
  return at[1] * static_cast<std::size_t>(counts_[0]) + at[0];
}

std::optional<CellPlace> CellLocator::in_cell(std::size_t cell, const Vec2& x) const {
  CellPlace place;
  place.cell = cell;
  if (const auto& super_element = cells_[cell]) {
    const auto scaled =
        element::locate(super_element->ring, x - mesh_.cells[cell].centre, super_element->domain.unbounded);
    if (!scaled) return std::nullopt;
    place.scaled = *scaled;
    return place;
  }
  const auto natural = natural_coordinates(element::corners8_of(mesh_.cells[cell], mesh_.nodes), x);
  if (!natural) return std::nullopt;
  place.natural = *natural;
  return place;
}

std::optional<CellPlace> CellLocator::find(const Vec2& x) const {
  for (const std::size_t cell : buckets_[bucket_of(x)])
    if (const auto place = in_cell(cell, x)) return place;
  return std::nullopt;
}

CellPlace CellLocator::nearest(const Vec2& x) const {
  if (const auto place = find(x)) return *place;
  // Moved towards the scaling centre the point lies in the cell; the factor tells how far outside it was.
  std::optional<CellPlace> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (!cells_[c]) continue;
    const Vec2& centre = mesh_.cells[c].centre;
    const bool unbounded = cells_[c]->domain.unbounded;
    const double factor = unbounded ? 2.0 : 0.5;
    auto place = in_cell(c, centre + factor * (x - centre));
    if (!place) continue;
    const double outside = std::abs(std::log(place->scaled.xi / factor));
    if (outside >= least) continue;
    least = outside;
    place->scaled.xi = 1.0;
    best = place;
  }
  ensure(best.has_value(), "a point of a body has no place in its cells");
  return *best;
}

}  // namespace scabo::result
