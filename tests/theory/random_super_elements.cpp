#include "theory/random_super_elements.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::test {

std::vector<double> marks(std::mt19937& random, int parts) {
  std::vector<double> at;
  const int kind = whole(random, 0, 2);
  for (int i = 1; i < parts; ++i)
    at.push_back(kind == 0   ? static_cast<double>(i) / parts
                 : kind == 1 ? (i + uniform(random, -0.4, 0.4)) / parts
                             : std::pow(10.0, -4.0 * (parts - i) / parts));
  return at;
}

Ring ring_through(const std::vector<Vec2>& vertices, int order, bool open) {
  Ring ring = polygon_ring(vertices, 1, order);
  if (open) {
    ring.elements.back().nodes.back() = static_cast<int>(ring.nodes.size());
    ring.nodes.push_back(ring.nodes.front());
  }
  return ring;
}

Mat3 random_isotropic(std::mt19937& random) {
  const double nu =
      whole(random, 0, 1) == 0 ? uniform(random, -0.3, 0.45) : 0.5 - std::pow(10.0, uniform(random, -5.0, -1.0));
  return elasticity(1.0, nu, whole(random, 0, 2) == 0 ? model::Plane::stress : model::Plane::strain);
}

Sample random_sample(std::mt19937& random, int most) {
  const int order = whole(random, 1, 8);
  std::vector<Vec2> corners = random_star(random);  // 3 to 12 edges
  const int edges = std::clamp(most / (2 * order), static_cast<int>(corners.size()), 40);
  std::vector<int> parts(corners.size(), 1);
  for (int extra = whole(random, 0, edges - static_cast<int>(corners.size())); extra > 0; --extra)
    ++parts[static_cast<std::size_t>(whole(random, 0, static_cast<int>(corners.size()) - 1))];
  std::vector<Vec2> vertices;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vertices.push_back(corners[i]);
    for (double at : marks(random, parts[i]))
      vertices.push_back(corners[i] + at * (corners[(i + 1) % corners.size()] - corners[i]));
  }
  // Thinner in one direction, turned, of any size.
  const double aspect = std::pow(10.0, uniform(random, -2.0, 0.0)), turn = uniform(random, 0.0, 6.3),
               size = std::pow(10.0, uniform(random, -3.0, 3.0));
  Mat2 Q;
  Q << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  for (Vec2& x : vertices) x = size * (Q * Vec2(x.x(), aspect * x.y()));
  Sample sample{ring_through(vertices, order, whole(random, 0, 2) == 0), {}, uniform(random, 0.01, 10.0)};
  const std::size_t sectors = whole(random, 0, 1) == 0 ? 1 : sample.ring.elements.size();
  for (std::size_t e = 0; e < sectors; ++e)
    sample.D.push_back(std::pow(10.0, sectors == 1 ? uniform(random, 0.0, 12.0) : uniform(random, -3.0, 3.0)) *
                       random_isotropic(random));
  return sample;
}

}  // namespace scabo::test
