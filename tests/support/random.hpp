// Random numbers of tests: seeds are fixed, so that a failure can be met again.
#pragma once

#include <random>

namespace scabo::test {

/// Uniform in [from, to).
double uniform(std::mt19937& random, double from, double to);

/// A whole number of from, ..., to.
int whole(std::mt19937& random, int from, int to);

}  // namespace scabo::test
