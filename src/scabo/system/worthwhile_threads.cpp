#include "scabo/system/worthwhile_threads.hpp"

#include <cmath>
#include <set>

namespace scabo::system {

namespace {

constexpr double least_work = 2e10;

}  // namespace

double dense_work(const model::Model& model, const mesh::Mesh& mesh) {
  double work = 0.0;
  std::set<std::size_t> sizes;  // bodies of one size are usually identical
  for (const mesh::BodyMesh& body : mesh.bodies) {
    const double n = 2.0 * static_cast<double>(body.nodes.size());
    if (body.cells.size() != 1)
      work += 600.0 * std::pow(n, 1.5);
    else if (sizes.insert(body.nodes.size()).second)
      work += 30.0 * n * n * n;
  }
  if (model.analysis.type == model::AnalysisType::modal) return work;
  // W is a sum over bodies: what touches a body is dense there, and a wall of many small blocks is sparse.
  std::vector<double> components(mesh.bodies.size(), 0.0);
  for (std::size_t c = 0; c < mesh.interfaces.size(); ++c)
    for (const auto& side : {model.contacts[c].a, model.contacts[c].b})
      components[static_cast<std::size_t>(side.body)] += 2.0 * static_cast<double>(mesh.interfaces[c].pairs.size());
  for (const double k : components) work += 1.5 * k * k * k;
  return work;
}

int worthwhile_threads(const model::Model& model, const mesh::Mesh& mesh, int wanted) {
  return dense_work(model, mesh) < least_work ? 1 : wanted;
}

}  // namespace scabo::system
