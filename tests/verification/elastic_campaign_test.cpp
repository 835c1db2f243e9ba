// Ten thousand random problems of elastic type, of one to five increments each: W from super-elements, friction up to
// 2, motions of mixed signs, gaps, ties, zeros. With mu <= 1 all are solved and certified; above, solved and certified
// or reported with a reason, never wrong. Seeds are fixed; the figures printed are those of
// docs/methods/12_contact_solver.md.
#include "elastic_campaign.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace scabo::verification {
namespace {

struct Tally {
  int problems = 0, increments = 0, solved = 0, reported = 0, fallbacks = 0, worst = 0;
  long iterations = 0;

  void print(const char* name) const {
    std::printf(
        "%s: %d problems, %d increments, %d solved, %d reported, iterations mean %.2f worst %d, fallbacks %.2f %%\n",
        name, problems, increments, solved, reported, static_cast<double>(iterations) / increments, worst,
        100.0 * fallbacks / increments);
  }
};

/// Signorini's and Coulomb's conditions written out, apart from the certificate.
double violation(const contact::Problem& problem, const Vector& p) {
  const Vector u = problem.W.dense() * p + problem.q;
  double worst = 0.0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double bound = problem.mu[i] * p[2 * i] - std::abs(p[2 * i + 1]);
    worst = std::max({worst, -u[2 * i], -p[2 * i], std::abs(u[2 * i] * p[2 * i]), -bound,
                      std::abs(u[2 * i + 1] * bound), u[2 * i + 1] * p[2 * i + 1]});
  }
  return worst;
}

void follow(const Path& path, int number, Tally& tally) {
  ++tally.problems;
  contact::Problem problem = path.problem;
  Vector slip = Vector::Zero(problem.pairs());
  contact::Start start;
  for (const Vector& motion : path.motions) {
    problem.q = motion;
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) problem.q[2 * i + 1] -= slip[i];
    const contact::Solution solution = contact::solve(problem, start);
    ++tally.increments;
    tally.iterations += solution.iterations;
    tally.worst = std::max(tally.worst, solution.iterations);
    tally.fallbacks += !solution.trace.empty() && solution.trace.back().stage.rfind("newton", 0) != 0;
    if (solution.status != contact::Status::solved) {
      ++tally.reported;
      EXPECT_FALSE(solution.reason.empty());
      if (problem.mu.maxCoeff() <= 1.0)
        ADD_FAILURE() << "problem " << number << ", " << problem.pairs() << " pairs, mu " << problem.mu.maxCoeff()
                      << ": " << solution.reason;
      return;
    }
    ++tally.solved;
    EXPECT_LE(solution.certificate.worst(), 1e-10);
    const double size = 1.0 + solution.p.cwiseAbs().maxCoeff();
    EXPECT_LE(violation(problem, solution.p), 1e-8 * size * size) << "problem " << number;
    slip += solution.slip_increment;
    start.p = solution.p;
  }
}

TEST(ElasticCampaign, EveryProblemUpToFrictionOneIsCertified) {
  const std::vector<Matrix> flexibilities = real_flexibilities();
  std::mt19937 random(71);
  Tally tally;
  for (int k = 0; k < 5000; ++k) follow(random_path(random, flexibilities, 0.0, 1.0), k, tally);
  tally.print("mu 0 to 1");
}

TEST(ElasticCampaign, AboveFrictionOneEveryProblemIsCertifiedOrReported) {
  const std::vector<Matrix> flexibilities = real_flexibilities();
  std::mt19937 random(72);
  Tally tally;
  for (int k = 0; k < 5000; ++k) follow(random_path(random, flexibilities, 1.0, 2.0), k, tally);
  tally.print("mu 1 to 2");
  EXPECT_LE(tally.reported, tally.increments / 100);
}

}  // namespace
}  // namespace scabo::verification
