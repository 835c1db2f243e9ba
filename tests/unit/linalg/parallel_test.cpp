#include "scabo/linalg/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace scabo::linalg {
namespace {

TEST(ParallelFor, DoesEveryTaskOnce) {
  std::vector<std::atomic<int>> done(1000);
  parallel_for(1000, 4, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
  for (const auto& times : done) EXPECT_EQ(times, 1);
}

// Two loops inside each other would start threads by the square of their number and change the number that BLAS may
// use under the feet of the outer tasks.
TEST(ParallelFor, InsideATaskUsesTheThreadOfThatTask) {
  std::vector<std::atomic<int>> elsewhere(8);
  parallel_for(8, 4, [&](int i) {
    const auto own = std::this_thread::get_id();
    parallel_for(16, 4, [&](int) {
      if (std::this_thread::get_id() != own) ++elsewhere[static_cast<std::size_t>(i)];
    });
  });
  for (const auto& count : elsewhere) EXPECT_EQ(count, 0);
}

TEST(ParallelFor, ThrowsTheExceptionOfATaskAndWorksAfterwards) {
  const auto fails = [](int i) {
    if (i == 37) throw std::runtime_error("task 37");
  };
  EXPECT_THROW(parallel_for(100, 3, fails), std::runtime_error);
  EXPECT_THROW(parallel_for(100, 1, fails), std::runtime_error);
  std::atomic<int> sum = 0;
  parallel_for(100, 3, [&](int i) { sum += i; });
  EXPECT_EQ(sum, 4950);
}

}  // namespace
}  // namespace scabo::linalg
