#include "support/random.hpp"

namespace scabo::test {

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

int whole(std::mt19937& random, int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); }

}  // namespace scabo::test
