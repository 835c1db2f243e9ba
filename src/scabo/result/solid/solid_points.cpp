#include "scabo/result/solid/solid_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "scabo/geometry/simplex_basis.hpp"
#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

namespace {

constexpr double on_side = 1e-6;  // of barycentric coordinates, from 0 below

/// Barycentric coordinates of a point, by Newton's method; none if it has none near the cell.
std::optional<Vector> barycentric(const Matrix& nodes, const Eigen::Vector3d& point) {
  const auto& basis = geometry::SimplexBasis::of(3, static_cast<int>(nodes.cols()));
  constexpr int steps = 30;
  constexpr double exact = 1e-12, far = 3.0;
  Vector lambda = Vector::Constant(4, 0.25);
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector3d away = point - nodes * basis.values(lambda);
    const Eigen::Matrix3d J = nodes * basis.derivatives(lambda);
    const Eigen::Vector3d by = J.partialPivLu().solve(away);
    lambda.tail<3>() += by;
    lambda[0] -= by.sum();
    if (!(lambda.lpNorm<Eigen::Infinity>() < far)) return {};
    if (by.lpNorm<Eigen::Infinity>() < exact) return lambda;
  }
  return lambda;
}

/// A place, and how far it lies inside of the sides as a part of the size.
struct Found {
  PlaceInCell at;
  double inside;
};
std::optional<Found> place_in(const Matrix& nodes, const Eigen::Vector3d& point) {
  if (!mesh::is_super_element(static_cast<std::size_t>(nodes.cols()))) {
    const auto lambda = barycentric(nodes, point);
    return lambda ? std::optional(Found{{*lambda, -1}, lambda->minCoeff()}) : std::nullopt;
  }
  const auto place = element::place_in_super_element(nodes, point, on_side);
  return place ? std::optional(Found{{place->at, place->facet}, 1.0 - place->xi()}) : std::nullopt;
}

}  // namespace

SolidFinder::SolidFinder(const mesh::SolidMesh& mesh) : mesh_(mesh) {
  std::vector<geometry::Box> boxes;
  for (const std::vector<int>& cell : mesh.cells) {
    const Matrix nodes = mesh::nodes_of(mesh, cell);
    Eigen::Vector3d low = nodes.rowwise().minCoeff(), high = nodes.rowwise().maxCoeff();
    // A curved side may lie beyond its nodes, by less than this.
    const Eigen::Vector3d more = Eigen::Vector3d::Constant(0.25 * (high - low).maxCoeff());
    low -= more, high += more;
    geometry::Box box;
    box.add(Vec2(low.head<2>()));
    box.add(Vec2(high.head<2>()));
    boxes.push_back(box);
    heights_.push_back({low.z(), high.z()});
  }
  tree_ = std::make_unique<geometry::BoxTree>(std::move(boxes));
}

std::optional<SolidFinder::Place> SolidFinder::at(const Eigen::Vector3d& point) const {
  std::optional<Place> best;
  double least = -on_side;
  tree_->within(point.head<2>(), 0.0, [&](std::size_t number) {
    if (point.z() < heights_[number][0] || point.z() > heights_[number][1]) return;
    const std::vector<int>& cell = mesh_.cells[number];
    const auto found = place_in(mesh::nodes_of(mesh_, cell), point);
    if (!found || found->inside < least || (best && found->inside == least)) return;
    least = found->inside;
    best = Place{number, found->at};
  });
  return best;
}

std::vector<std::vector<SolidPlace>> places_of(const analysis::SolidModel& model,
                                               const std::vector<Eigen::Vector3d>& points,
                                               const std::vector<int>& only) {
  std::vector<std::vector<SolidPlace>> places(points.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto number = static_cast<int>(b);
    const auto is_meant = [&](int body) { return body < 0 || body == number; };
    if (std::none_of(only.begin(), only.end(), is_meant)) continue;
    const SolidFinder finder(model.bodies[b].mesh);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (is_meant(only[i]))
        if (auto in = finder.at(points[i])) places[i].push_back({number, std::move(*in)});
  }
  return places;
}

std::vector<SolidPointValues> values_at(const analysis::SolidModel& model, const analysis::SolidIncrement& increment,
                                        const std::vector<SolidPlace>& places) {
  std::map<int, Matrix> stresses;  // of the bodies that are asked for
  std::vector<SolidPointValues> values;
  for (const SolidPlace& place : places) {
    const auto b = static_cast<std::size_t>(place.body);
    const analysis::SolidBody& body = model.bodies[b];
    const std::vector<int>& cell = body.mesh.cells[place.in.cell];
    SolidPointValues& value = values.emplace_back();
    value.absent = increment.is_absent(b);
    if (value.absent) continue;
    if (body.rigid_at || mesh::is_super_element(cell.size())) {
      const SolidStress stress(model, increment, b);
      const CellField field = stress.field_of(place.in.cell);
      value.displacement = field.displacement_at(place.in.at);
      if (!body.rigid_at) value.stress = stress.at(place.in.cell, field, place.in.at);
      continue;
    }
    const Vector N = geometry::SimplexBasis::of(3, static_cast<int>(cell.size())).values(place.in.at.lambda);
    for (std::size_t i = 0; i < cell.size(); ++i)
      value.displacement += N[static_cast<Eigen::Index>(i)] * increment.u[b].segment<3>(3 * cell[i]);
    const auto [known, is_new] = stresses.try_emplace(place.body);
    if (is_new) known->second = SolidStress(model, increment, b).at_nodes();
    value.stress = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < cell.size(); ++i)
      *value.stress += N[static_cast<Eigen::Index>(i)] * known->second.col(cell[i]);
  }
  return values;
}

}  // namespace scabo::result
