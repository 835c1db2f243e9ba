#include "scabo/analysis/space/solid_preloads.hpp"

namespace scabo::analysis {

namespace {

double factor_of(const Vector& factors, std::size_t i) {
  return factors.size() > 0 ? factors[static_cast<Eigen::Index>(i)] : 0.0;
}

}  // namespace

std::vector<std::size_t> preloads_being_tightened(const SolidModel& model, const Vector& before,
                                                  const Vector& factors) {
  std::vector<std::size_t> tightened;
  for (std::size_t i = 0; i < model.preloads.size(); ++i)
    if (model.preloads[i].force && factor_of(factors, i) > factor_of(before, i)) tightened.push_back(i);
  return tightened;
}

Vector known_shortenings(const SolidModel& model, const std::vector<std::size_t>& tightened, const Vector& before,
                         const Vector& factors) {
  Vector known(static_cast<Eigen::Index>(model.preloads.size()));
  for (std::size_t i = 0; i < model.preloads.size(); ++i)
    known[static_cast<Eigen::Index>(i)] =
        model.preloads[i].force ? factor_of(before, i) : factor_of(factors, i) * model.preloads[i].shortening;
  for (const std::size_t i : tightened) known[static_cast<Eigen::Index>(i)] = 0.0;
  return known;
}

void add_shortenings(const SolidModel& model, const std::vector<std::size_t>& tightened, const Vector& factors,
                     const system::Structure& structure, const system::ContactSystem& system,
                     const std::vector<Vector>& u, contact::Problem& problem) {
  if (tightened.empty()) return;
  const Eigen::Index motions = problem.G.cols(), all = motions + static_cast<Eigen::Index>(tightened.size());
  Matrix G(problem.G.rows(), all);
  G.leftCols(motions) = problem.G.dense();
  problem.f.conservativeResize(all);
  for (std::size_t k = 0; k < tightened.size(); ++k) {
    const SolidPreload& preload = model.preloads[tightened[k]];
    const auto body = static_cast<std::size_t>(preload.body);
    const Eigen::Index column = motions + static_cast<Eigen::Index>(k);
    const Vector held = Vector::Zero(static_cast<Eigen::Index>(model.bodies[body].supports.size()));
    G.col(column) = system.motion[body] * structure.parts[body]->displacement(preload.cut.forces, held);
    problem.f[column] = factor_of(factors, tightened[k]) * *preload.force + preload.cut.forces.dot(u[body]);
  }
  problem.G = contact::RigidMap(contact::RigidMap::Sparse(G.sparseView()));
}

std::vector<SolidTension> tensions_of(const SolidModel& model, const Vector& shortening, const std::vector<Vector>& u) {
  std::vector<SolidTension> tensions;
  for (std::size_t i = 0; i < model.preloads.size(); ++i) {
    const double s = shortening[static_cast<Eigen::Index>(i)];
    tensions.push_back({model.preloads[i].cut.tension(s, u[static_cast<std::size_t>(model.preloads[i].body)]), s});
  }
  return tensions;
}

}  // namespace scabo::analysis
