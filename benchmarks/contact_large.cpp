// Time, iterations and memory of one large contact problem whose W is known by its products alone (W = B' K^-1 B):
//
//     contact_large [pairs = 10000] [depth = 20] [friction = 0.3]
//
// An elastic layer pressed and sheared in waves (tests/unit/contact/layer.hpp); directions by GMRES.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <unit/contact/layer.hpp>

#include "scabo/contact/solve.hpp"

int main(int count, char** words) {
  using namespace scabo;
  const int pairs = count > 1 ? std::atoi(words[1]) : 10000, depth = count > 2 ? std::atoi(words[2]) : 20;
  const double mu = count > 3 ? std::atof(words[3]) : 0.3;
  const auto seconds = [begin = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const contact::Problem problem = test::layer_problem(pairs, depth, mu);
  const double built = seconds();
  const Vector image = problem.W * problem.q;
  const double multiplied = seconds();
  const contact::Solution solution = contact::solve(problem);
  const double solved = seconds();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  int states[3] = {};
  for (contact::ContactState state : solution.states) ++states[static_cast<int>(state)];
  std::printf("%d pairs, %d degrees of freedom: assembly and factorisation %.2f s, one product with W %.3f s\n", pairs,
              2 * pairs * depth, built, multiplied - built);
  std::printf("%s in %.2f s, %d Newton iterations; certificate %.1e, natural map %.1e; open %d, stick %d, slip %d\n",
              solution.status == contact::Status::solved ? "solved" : solution.reason.c_str(), solved - multiplied,
              solution.iterations, solution.certificate.worst(), solution.natural_map_residual, states[0], states[1],
              states[2]);
  std::printf("peak memory %.0f MB\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
  return solution.status == contact::Status::solved ? 0 : 1;
}
