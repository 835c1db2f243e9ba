#include "scabo/analysis/worthwhile_threads.hpp"

#include <cmath>
#include <set>

namespace scabo::analysis {

namespace {

constexpr double least_work = 2e10;

}  // namespace

double dense_work(const model::Model& model, const mesh::Mesh& mesh) {
  double work = 0.0;
  std::set<std::size_t> sizes;  // bodies of one size are usually identical
  for (const mesh::BodyMesh& body : mesh.bodies) {
    const double n = 2.0 * static_cast<double>(body.nodes.size());
    if (!body.elements.empty())
      work += 600.0 * std::pow(n, 1.5);
    else if (sizes.insert(body.nodes.size()).second)
      work += 30.0 * n * n * n;
  }
  if (model.analysis.type == model::AnalysisType::modal) return work;
  double components = 0.0;
  for (const mesh::Interface& interface : mesh.interfaces)
    components += 2.0 * static_cast<double>(interface.pairs.size());
  return work + 3.0 * components * components * components;
}

int worthwhile_threads(const model::Model& model, const mesh::Mesh& mesh, int wanted) {
  return dense_work(model, mesh) < least_work ? 1 : wanted;
}

}  // namespace scabo::analysis
