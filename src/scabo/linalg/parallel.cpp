#include "scabo/linalg/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

namespace {

/// Whether this thread works on a task of several.
thread_local bool working = false;

}  // namespace

void parallel_for(int count, int threads, const std::function<void(int)>& task) {
  const int workers = std::min(threads, count);
  if (workers <= 1 || working) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  std::atomic<int> next = 0;
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(workers));
  const auto work = [&](std::exception_ptr& failure) {
    working = true;
    try {
      for (int i = next++; i < count; i = next++) task(i);
    } catch (...) {
      failure = std::current_exception();
    }
    working = false;
  };
  set_blas_threads(1);
  {
    std::vector<std::jthread> pool;  // joined at the end of the block
    try {
      for (std::size_t k = 1; k < failures.size(); ++k) pool.emplace_back([&, k] { work(failures[k]); });
    } catch (const std::system_error&) {  // a limit on processes or memory: the existing threads do the work
    }
    work(failures[0]);
  }
  set_blas_threads(threads);
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace scabo::linalg
