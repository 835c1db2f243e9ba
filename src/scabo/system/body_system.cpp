#include "scabo/system/body_system.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "scabo/linalg/parallel.hpp"
#include "scabo/system/elastic_body.hpp"

namespace scabo::system {

std::unique_ptr<BodySystem> elastic_body(Stiffness stiffness, const Positions& nodes,
                                         std::vector<Constraint> constraints) {
  std::vector<ElasticPart> parts;
  parts.push_back({std::move(stiffness), nodes, std::move(constraints)});
  return std::move(elastic_bodies(std::move(parts), 1).front());
}

std::vector<std::unique_ptr<BodySystem>> elastic_bodies(std::vector<ElasticPart> parts, int threads,
                                                        const linalg::SparseOptions& options) {
  std::vector<std::unique_ptr<ElasticBody>> bodies;
  std::vector<std::size_t> distinct;
  std::vector<double> work;
  std::unordered_multimap<std::size_t, std::size_t> known;  // hash, distinct body
  for (ElasticPart& part : parts) {
    auto factored = std::make_shared<Factored>();
    part.stiffness.sparse.markAsRValue();  // or Eigen copies what is moved
    factored->stiffness = std::move(part.stiffness);
    factored->largest_diagonal = factored->stiffness.largest_diagonal();
    auto body = std::make_unique<ElasticBody>(factored, part.nodes, std::move(part.constraints));
    const std::size_t hash = parts.size() > 1 ? hash_of(factored->stiffness) : 0;  // one has none to be equal to
    const auto [begin, end] = known.equal_range(hash);
    const auto same = std::find_if(begin, end, [&](const auto& entry) {
      const ElasticBody& other = *bodies[entry.second];
      return other.solved_dofs() == body->solved_dofs() && other.inclined() == body->inclined() &&
             equal(other.factored()->stiffness, factored->stiffness);
    });
    if (same != end) {
      body->share(bodies[same->second]->factored());
    } else {
      known.emplace(hash, bodies.size());
      distinct.push_back(bodies.size());
      work.push_back(std::pow(static_cast<double>(factored->stiffness.size()), factored->stiffness.dense ? 3.0 : 1.5));
    }
    bodies.push_back(std::move(body));
  }
  std::vector<char> failed(distinct.size(), 0);
  linalg::parallel_for(work, threads, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    ElasticBody& body = *bodies[distinct[i]];
    const ElasticPart& part = parts[distinct[i]];
    const auto* const before = dynamic_cast<const ElasticBody*>(part.before);
    try {
      if (!before || !body.factorise_by(*before, part.nodes, part.nodes_before, part.contact_dofs))
        body.factorise(options, part.nodes, part.contact_dofs);
    } catch (const linalg::NotPositiveDefinite&) {
      failed[i] = 1;
    }
  });
  if (const auto first = std::find(failed.begin(), failed.end(), 1); first != failed.end())
    throw NotPositiveDefinitePart(distinct[static_cast<std::size_t>(first - failed.begin())]);
  std::vector<std::unique_ptr<BodySystem>> result;
  for (auto& body : bodies) result.push_back(std::move(body));
  return result;
}

}  // namespace scabo::system
