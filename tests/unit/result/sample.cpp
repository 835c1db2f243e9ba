// Writes the results of a solution made by hand into a directory: the same uniform strain in a super-element
// (body 1) and in finite elements (body 2), and a rigid motion of a disc (body 3); two contacts, of three pairs along a
// slope and of one. read_vtu_test.py reads them.
#include <array>
#include <cmath>
#include <cstdio>

#include "scabo/result/results_directory.hpp"
#include "unit/result/solutions.hpp"

namespace {

using namespace scabo;

/// Pair i of three on the line y = x/2, A below: one in each state, with figures that tell them apart.
analysis::PairResult sloped_pair(int i) {
  analysis::PairResult pair;
  pair.pair = i + 1;
  pair.position = {2.0 * i, 1.0 * i};
  pair.normal = Vec2(-1.0, 2.0) / std::sqrt(5.0);
  pair.state = std::array{contact::ContactState::open, contact::ContactState::stick, contact::ContactState::slip}.at(
      static_cast<std::size_t>(i));
  pair.gap = 0.1 * (2 - i);
  pair.slip = 0.01 * i;
  pair.normal_force = 10.0 * i;
  pair.tangential_force = -3.0 * i;
  pair.pressure = 100.0 * i;
  pair.shear = -30.0 * i;
  pair.displacement_a = {0.5, 0.25 * i};
  return pair;
}

std::vector<analysis::ContactResult> contacts() {
  analysis::ContactResult slope, single;
  slope.name = "slope";
  for (int i = 0; i < 3; ++i) slope.pairs.push_back(sloped_pair(i));
  single.name = "single";
  single.pairs = {sloped_pair(1)};
  return {slope, single};
}

}  // namespace

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
  solution.model.contacts.resize(2);
  const Mat2 gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();
  result::ResultsDirectory directory(argv[1], solution.model);
  for (const int number : {1, 2}) {
    analysis::IncrementResult increment =
        increment_of(solution, linear_field(number * gradient), {0.01 * number, -0.02 * number, 0.003 * number});
    increment.increment = number;
    increment.reached = 0.25 * number;
    increment.contacts = contacts();
    solution.increments.push_back(increment);
    directory.add(solution, solution.increments.back());
  }
  directory.finish(solution);
}
