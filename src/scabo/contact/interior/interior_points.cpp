#include "scabo/contact/interior/interior_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/interior/judged_steps.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

/// Of a path.
struct PathConstants {
  int most = 100;                  ///< steps; towers and walls that are solved take 11 to 90
  int patience = 5;                ///< steps without `gain` in the residual or in m: rounding, or steps that collapsed
  double gain = 0.9;               ///< of the least so far
  Eigen::Index most_dense = 2500;  ///< rows of a dense W; a step then takes two seconds
};
constexpr PathConstants path_constants;

template <int d>
class AlongPath {
 public:
  template <typename Start>
  AlongPath(const Problem& problem, const Start& start) : problem_(problem), measure_(problem), steps_(problem) {
    start(steps_);
    steps_.evaluate();
    steps_.measure_from_here();
  }

  InteriorPointEnd advance(double aim, const IsSolution& content, const Deadline& deadline) {
    const PathConstants& c = path_constants;
    InteriorPointEnd end;
    end.residual = HUGE_VAL;
    for (;; ++end.iterations, ++taken_) {
      interruption_point();
      deadline.spend(operations_of_system(problem_));
      const double residual = judge_iterate(steps_, problem_, measure_, content, "interior point", end);
      if (!std::isfinite(residual) || end.content || residual <= aim) break;
      ++since_;
      if (steps_.gap() <= c.gain * least_gap_ || residual <= c.gain * least_residual_) since_ = 0;
      least_gap_ = std::min(least_gap_, steps_.gap());
      least_residual_ = std::min(least_residual_, residual);
      if (taken_ >= c.most || since_ >= c.patience || deadline.passed() || !steps_.advance()) break;
      steps_.evaluate();
    }
    return end;
  }

 private:
  const Problem& problem_;
  Measure measure_;
  InteriorSteps<d> steps_;
  double least_gap_ = HUGE_VAL, least_residual_ = HUGE_VAL;
  int taken_ = 0, since_ = 0;
};

}  // namespace

struct InteriorPoints::Path {
  std::variant<AlongPath<2>, AlongPath<3>> along;

  template <typename Start>
  static std::unique_ptr<Path> from(const Problem& problem, const Start& start) {
    if (problem.dimension == 3)
      return std::unique_ptr<Path>(
          new Path{std::variant<AlongPath<2>, AlongPath<3>>(std::in_place_index<1>, problem, start)});
    return std::unique_ptr<Path>(
        new Path{std::variant<AlongPath<2>, AlongPath<3>>(std::in_place_index<0>, problem, start)});
  }
};

bool may_take_interior_points(const Problem& problem) {
  return problem.pairs() > 0 &&
         (problem.W.is_sparse() || (problem.W.is_dense() && problem.W.size() <= path_constants.most_dense)) &&
         problem.W.diagonal().minCoeff() >= 0.0 &&
         !(problem.q.isZero(0.0) && problem.f.isZero(0.0));
}

InteriorPoints::InteriorPoints(const Problem& problem, double start)
    : path_(Path::from(problem, [&](auto& steps) { steps.start(start); })) {}
InteriorPoints::InteriorPoints(const Problem& problem, const Vector& p, const Vector& a, double start)
    : path_(Path::from(problem, [&](auto& steps) { steps.start_near(p, a, start); })) {}
InteriorPoints::~InteriorPoints() = default;
InteriorPoints::InteriorPoints(InteriorPoints&&) noexcept = default;

InteriorPointEnd InteriorPoints::advance(double aim, const IsSolution& content, const Deadline& deadline) {
  return std::visit([&](auto& along) { return along.advance(aim, content, deadline); }, path_->along);
}

InteriorPointEnd interior_points(const Problem& problem, const IsSolution& content, const Deadline& deadline,
                                 double start) {
  return InteriorPoints(problem, start).advance(0.0, content, deadline);
}

}  // namespace scabo::contact
