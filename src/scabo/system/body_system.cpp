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

namespace {

/// Bodies by the hash of their stiffness.
using Known = std::unordered_multimap<std::size_t, const ElasticBody*>;

/// The one for which this holds; null if there is none.
template <typename Holds>
const ElasticBody* known_body(const Known& known, std::size_t hash, const Holds& holds) {
  const auto [begin, end] = known.equal_range(hash);
  const auto entry = std::find_if(begin, end, [&](const auto& of) { return holds(*of.second); });
  return entry == end ? nullptr : entry->second;
}

}  // namespace

std::vector<std::unique_ptr<BodySystem>> elastic_bodies(std::vector<ElasticPart> parts, int threads,
                                                        const linalg::SparseOptions& options,
                                                        const std::vector<std::unique_ptr<BodySystem>>* before) {
  Known factorised, here;
  for (std::size_t p = 0; before && p < before->size(); ++p)
    if (const auto* body = dynamic_cast<const ElasticBody*>((*before)[p].get()))
      factorised.emplace(hash_of(body->factored()->stiffness), body);
  std::vector<std::unique_ptr<ElasticBody>> bodies;
  std::vector<std::size_t> distinct;
  std::vector<double> work;
  for (ElasticPart& part : parts) {
    auto factored = std::make_shared<Factored>();
    part.stiffness.sparse.markAsRValue();  // or Eigen copies what is moved
    factored->stiffness = std::move(part.stiffness);
    factored->largest_diagonal = factored->stiffness.largest_diagonal();
    factored->nodes = std::move(part.nodes);
    factored->contact_dofs = std::move(part.contact_dofs);
    auto body = std::make_unique<ElasticBody>(factored, factored->nodes, std::move(part.constraints));
    const bool is_alone = parts.size() == 1 && factorised.empty();  // equal to none
    const std::size_t hash = is_alone ? 0 : hash_of(factored->stiffness);
    const auto equal_to = [&](const ElasticBody& other) { return other.equals(*body); };
    // Of a body made before the factor must be the very one that would be made here.
    const auto same_as = [&](const ElasticBody& other) {
      return other.factored()->contact_dofs == factored->contact_dofs &&
             other.factored()->nodes.columns() == factored->nodes.columns() && other.equals(*body);
    };
    if (const ElasticBody* const twin = known_body(here, hash, equal_to)) {
      body->share(twin->factored());
    } else if (const ElasticBody* const kept = known_body(factorised, hash, same_as)) {
      body->share(kept->factored());
      here.emplace(hash, body.get());
    } else {
      here.emplace(hash, body.get());
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
    const auto* const like = dynamic_cast<const ElasticBody*>(part.like);
    try {
      if (!like || !body.factorise_by(*like, part.nodes_of_like)) body.factorise(options);
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
