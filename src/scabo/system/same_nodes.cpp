#include "scabo/system/same_nodes.hpp"

#include <bit>
#include <cstdint>

namespace scabo::system {

namespace {

std::uint64_t hash_of(const Vec2& x) {
  constexpr std::uint64_t mixing = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t one = std::bit_cast<std::uint64_t>(x[0]) * mixing, other = std::bit_cast<std::uint64_t>(x[1]);
  const std::uint64_t both = ((one ^ (one >> 32)) + other) * mixing;
  return both ^ (both >> 32);
}

}  // namespace

std::vector<int> same_nodes(const Positions& nodes, const Positions& before) {
  const auto count = static_cast<std::size_t>(before.count());
  const std::size_t mask = std::bit_ceil(2 * count + 1) - 1;
  std::vector<int> first(mask + 1, -1), next(count, -1);  // lists of nodes by their places, ascending
  const auto at = [](const Positions& of, int node) { return Vec2(of.columns().col(node)); };
  for (int node = static_cast<int>(count) - 1; node >= 0; --node) {
    int& head = first[hash_of(at(before, node)) & mask];
    next[static_cast<std::size_t>(node)] = head;
    head = node;
  }
  std::vector<int> same(static_cast<std::size_t>(nodes.count()), -1);
  for (int node = 0; node < static_cast<int>(same.size()); ++node) {
    const Vec2 here = at(nodes, node);
    int* link = &first[hash_of(here) & mask];
    while (*link >= 0 && at(before, *link) != here) link = &next[static_cast<std::size_t>(*link)];
    if (*link < 0) continue;
    same[static_cast<std::size_t>(node)] = *link;
    *link = next[static_cast<std::size_t>(*link)];  // taken
  }
  return same;
}

}  // namespace scabo::system
