#include "scabo/mesh/plane/graded_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

/// The integral of 1 / size along a part of an edge, at the ends of short steps.
class ElementCount {
 public:
  ElementCount(const geometry::Edge& edge, const EdgePart& part, const std::function<double(const Vec2&)>& size,
               const LeastDivision& least)
      : edge_(edge), size_(size), most_(least.most) {
    longest_ = edge.arc && least.turn > 0.0 ? edge.length() * least.turn / std::abs(edge.arc->sweep)
                                            : std::numeric_limits<double>::infinity();
    ends_.push_back(part.from);
    sums_.push_back(0.0);
    constexpr int samples = 1000;
    for (int i = 0; i < samples; ++i)
      add(std::lerp(part.from, part.to, double(i) / samples), std::lerp(part.from, part.to, (i + 1.0) / samples));
  }

  double elements() const { return sums_.back(); }

  /// The fraction of the edge up to which the integral is `sum`; sums are asked for in ascending order.
  double place_of(double sum) {
    while (sums_[next_ + 1] < sum) ++next_;
    return std::lerp(ends_[next_], ends_[next_ + 1], (sum - sums_[next_]) / (sums_[next_ + 1] - sums_[next_]));
  }

 private:
  /// Steps are short compared with the size, which changes by less than the distance.
  void add(double low, double high) {
    constexpr double longest_step = 0.25;  // of the size
    if (sums_.back() > most_) return;
    const double step = (high - low) * edge_.length();
    const double size = std::min(size_(edge_.at(0.5 * (low + high))), longest_);
    if (step > longest_step * size && step > 1e-9 * edge_.length()) {
      add(low, 0.5 * (low + high));
      add(0.5 * (low + high), high);
      return;
    }
    ends_.push_back(high);
    sums_.push_back(sums_.back() + step / size);
  }

  const geometry::Edge& edge_;
  const std::function<double(const Vec2&)>& size_;
  double most_, longest_;
  std::vector<double> ends_, sums_;
  std::size_t next_ = 0;
};

}  // namespace

double wanted_size(const model::Body& body, const SizeField& sizes, const Vec2& x) {
  const double largest = body.imported ? std::numeric_limits<double>::infinity() : body.mesh.size;
  double size = std::min(largest, sizes.at(x));
  for (const model::LocalSize& local : body.mesh.refine) {
    const double distance = local.near
                                ? (*local.near - x).norm()
                                : geometry::distance_to(body.outline.edges[static_cast<std::size_t>(local.edge)], x);
    size = std::min(size, local.size + local.growth * distance);
  }
  return size;
}

std::vector<double> graded_breaks(const geometry::Edge& edge, const EdgePart& part,
                                  const std::function<double(const Vec2&)>& size, const LeastDivision& least) {
  ElementCount integral(edge, part, size, least);
  if (integral.elements() > least.most) return {};
  const double count = std::max(least.elements, std::ceil(integral.elements() - least.rounding));
  std::vector<double> breaks{part.from};
  for (int k = 1; k < count; ++k) breaks.push_back(integral.place_of(k / count * integral.elements()));
  breaks.push_back(part.to);
  return breaks;
}

}  // namespace scabo::mesh
