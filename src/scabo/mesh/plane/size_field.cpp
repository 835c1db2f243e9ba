#include "scabo/mesh/plane/size_field.hpp"

#include <algorithm>
#include <limits>

#include "scabo/base/error.hpp"

namespace scabo::mesh {

SizeField::SizeField(const std::vector<Sample>& samples, double growth) : growth_(growth) {
  ensure(growth > 0.0, "sizes grow away from a sample");
  for (const Sample& sample : samples) ensure(sample.size > 0.0, "the size of a sample is positive");
  const auto build_all = [&] {
    lower_.assign(samples_.size(), Vec2::Zero());
    upper_ = lower_;
    smallest_.assign(samples_.size(), 0.0);
    build(0, samples_.size());
  };
  samples_ = samples;
  build_all();
  std::vector<Sample> needed;
  for (const Sample& sample : samples_)
    if (at(sample.at) >= sample.size) needed.push_back(sample);
  samples_ = std::move(needed);
  build_all();
}

double SizeField::at(const Vec2& x) const {
  double least = std::numeric_limits<double>::infinity();
  search(0, samples_.size(), x, least);
  return least;
}

void SizeField::build(std::size_t from, std::size_t to) {
  if (from >= to) return;
  const std::size_t middle = from + (to - from) / 2;
  Vec2 &lower = lower_[middle], &upper = upper_[middle];
  lower = upper = samples_[from].at;
  smallest_[middle] = samples_[from].size;
  for (std::size_t i = from; i < to; ++i) {
    lower = lower.cwiseMin(samples_[i].at);
    upper = upper.cwiseMax(samples_[i].at);
    smallest_[middle] = std::min(smallest_[middle], samples_[i].size);
  }
  const int axis = upper.x() - lower.x() >= upper.y() - lower.y() ? 0 : 1;
  const auto place = [&](std::size_t i) { return samples_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(from), place(middle), place(to),
                   [axis](const Sample& a, const Sample& b) { return a.at[axis] < b.at[axis]; });
  build(from, middle);
  build(middle + 1, to);
}

void SizeField::search(std::size_t from, std::size_t to, const Vec2& x, double& least) const {
  if (from >= to) return;
  const auto bound = [&](std::size_t begin, std::size_t end) {
    if (begin >= end) return std::numeric_limits<double>::infinity();
    const std::size_t root = begin + (end - begin) / 2;
    const Vec2 apart = (lower_[root] - x).cwiseMax(x - upper_[root]).cwiseMax(Vec2::Zero());
    return smallest_[root] + growth_ * apart.norm();
  };
  const std::size_t middle = from + (to - from) / 2;
  least = std::min(least, samples_[middle].size + growth_ * (x - samples_[middle].at).norm());
  const double first = bound(from, middle), second = bound(middle + 1, to);
  const auto left = [&] {
    if (first < least) search(from, middle, x, least);
  };
  const auto right = [&] {
    if (second < least) search(middle + 1, to, x, least);
  };
  if (first <= second)
    left(), right();
  else
    right(), left();
}

}  // namespace scabo::mesh
