#include "scabo/element/plane/conditioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scabo/base/components.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::element {

namespace {

// From here on a figure may cost the digits that a stiffness has (docs/methods/04_structure.md).
constexpr double very_slender = 1e3, very_different = 1e9, very_graded = 1e5, very_near = 1e5;

double distance_to_side(const Vec2& from, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp((from - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - from).norm();
}

}  // namespace

double slenderness_of(double area, double perimeter) {
  if (!(area > 0.0)) return 1.0;
  const double half = 0.25 * perimeter, root = std::sqrt(std::max(half * half - area, 0.0));
  const double length = half + root;
  return length * length / area;
}

void measure(const std::vector<Mat3>& D, Conditioning& found) {
  double largest = 0.0, softest = std::numeric_limits<double>::infinity();
  for (const Mat3& of : D) {
    const Eigen::SelfAdjointEigenSolver<Mat3> moduli(of, Eigen::EigenvaluesOnly);
    const double low = moduli.eigenvalues()[0], high = moduli.eigenvalues()[2];
    largest = std::max(largest, high);
    softest = std::min(softest, high);
    found.compression = std::max(found.compression, low > 0.0 ? high / low : HUGE_VAL);
  }
  if (largest > 0.0) found.moduli = std::max(found.moduli, largest / softest);
}

void measure(const std::vector<mesh::LineElement>& sides, const std::vector<Vec2>& nodes, const Vec2* centre,
             Conditioning& found) {
  double area = 0.0, perimeter = 0.0, longest = 0.0, shortest = HUGE_VAL, nearest = HUGE_VAL, farthest = 0.0;
  for (const mesh::LineElement& side : sides) {
    const Vec2 &from = nodes[static_cast<std::size_t>(side.nodes.front())],
               &to = nodes[static_cast<std::size_t>(side.nodes.back())];
    const Vec2 a = from - nodes.front(), b = to - nodes.front();
    area += 0.5 * (cross(a, b));
    const double length = (to - from).norm();
    perimeter += length;
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
    if (centre == nullptr) continue;
    nearest = std::min(nearest, distance_to_side(*centre, from, to));
    farthest = std::max(farthest, (from - *centre).norm());
  }
  found.slenderness = std::max(found.slenderness, slenderness_of(std::abs(area), perimeter));
  if (shortest > 0.0) found.sizes = std::max(found.sizes, longest / shortest);
  if (centre != nullptr && nearest > 0.0) found.nearness = std::max(found.nearness, farthest / nearest);
}

Conditioning measured(const mesh::BodyMesh& mesh) {
  double area = 0.0, perimeter = 0.0, longest = 0.0, shortest = HUGE_VAL;
  std::map<std::pair<int, int>, int> cells_at;
  const auto at = [&](int node) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(node)]; };
  for (const mesh::Cell& cell : mesh.cells)
    for (const mesh::LineElement& side : cell.boundary) {
      area += 0.5 * cross(at(side.nodes.front()) - cell.centre, at(side.nodes.back()) - cell.centre);
      ++cells_at[std::minmax(side.nodes.front(), side.nodes.back())];
    }
  for (const auto& [ends, count] : cells_at) {
    const double length = (at(ends.second) - at(ends.first)).norm();
    if (count == 1) perimeter += length;
    longest = std::max(longest, length);
    if (length > 0.0) shortest = std::min(shortest, length);
  }
  Conditioning found;
  found.slenderness = slenderness_of(area, perimeter);
  found.sizes = longest / shortest;
  return found;
}

std::string causes_in_words(const Conditioning& found) {
  struct Cause {
    double figure, limit;
    std::string words;
  };
  const Cause causes[] = {
      {found.slenderness, very_slender, fmt::format("it is {:.2g} times as long as deep", found.slenderness)},
      {found.moduli, very_different,
       fmt::format("its materials differ in stiffness by a factor of {:.1g}", found.moduli)},
      {found.compression, very_different,
       fmt::format("a material resists one strain {:.1g} times as much as another (near Poisson's ratio 1/2, "
                   "1 / (1 - 2 nu))",
                   found.compression)},
      {found.sizes, very_graded, fmt::format("the lengths of its elements differ by a factor of {:.1g}", found.sizes)},
      {found.nearness, very_near,
       fmt::format("its scaling centre is {:.1g} times nearer to its boundary than its size", found.nearness)},
      {found.springs, very_different,
       fmt::format("the stiffness of its springs and its own differ by a factor of {:.1g}", found.springs)}};
  std::string text, all;
  for (const Cause& cause : causes) {
    if (cause.figure >= cause.limit) text += (text.empty() ? "" : ", and ") + cause.words;
    if (cause.figure > 1.0) all += (all.empty() ? "" : ", ") + cause.words;
  }
  if (!text.empty()) return text;
  return (all.empty() ? "" : all + ": ") + "nothing of this explains it; another mesh may help";
}

}  // namespace scabo::element
