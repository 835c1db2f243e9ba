// Writes the results of a solution made by hand into a directory: the same uniform strain in a super-element
// (body 1) and in finite elements (body 2), and a rigid motion of a disc (body 3). read_vtu_test.py reads
// them.
#include <cstdio>

#include "scabo/result/results_directory.hpp"
#include "unit/result/solutions.hpp"

int main(int argc, char** argv) {
  using namespace scabo;
  using namespace scabo::test;
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
    return 1;
  }
  const model::Outline disc = outline({arc("lower", {9.0, 0.0}, 0.5, pi, pi), arc("upper", {9.0, 0.0}, 0.5, 0.0, pi)});
  analysis::StaticSolution solution = solution_of(
      model_of({elastic("a", pentagon(), 0.7, 2), finite_elements("b", {5.0, 0.0}, {1.0, 0.5}, 0.25), rigid("c", disc)},
               model::Plane::strain));
  const Mat2 gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();
  result::ResultsDirectory directory(argv[1], solution.model);
  for (const int number : {1, 2}) {
    analysis::IncrementResult increment =
        increment_of(solution, linear_field(number * gradient), {0.01 * number, -0.02 * number, 0.003 * number});
    increment.increment = number;
    solution.increments.push_back(increment);
    directory.add(solution, solution.increments.back());
  }
  directory.finish(solution);
}
