#include "scabo/linalg/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <numeric>
#include <system_error>
#include <thread>
#include <vector>

#include "scabo/base/interruption.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/held_termination.hpp"

namespace scabo::linalg {

namespace {

/// Whether this thread works on a task of several.
thread_local bool working = false;

}  // namespace

void parallel_for(int count, int threads, const std::function<void(int)>& task) {
  const int workers = std::min(threads, count);
  if (workers <= 1 || working) {
    for (int i = 0; i < count; ++i) {
      interruption_point();
      task(i);
    }
    return;
  }
  const Interruptible::Ask* const ask = Interruptible::asked();
  std::atomic<int> next = 0;
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(workers));
  const auto work = [&](std::exception_ptr& failure) {
    working = true;
    const Interruptible here(ask);
    try {
      for (int i = next++; i < count; i = next++) {
        interruption_point();
        task(i);
      }
    } catch (...) {
      failure = std::current_exception();
    }
    working = false;
  };
  set_blas_threads(1);
  {
    std::vector<std::jthread> pool;  // joined at the end of the block
    try {
      const HeldTermination held;  // signals are for the thread that calls
      for (std::size_t k = 1; k < failures.size(); ++k) pool.emplace_back([&, k] { work(failures[k]); });
    } catch (const std::system_error&) {  // a limit on processes or memory: the existing threads do the work
    }
    work(failures[0]);
  }
  set_blas_threads(threads);
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

void parallel_for(const std::vector<double>& work, int threads, const std::function<void(int)>& task) {
  std::vector<int> order(work.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return work[static_cast<std::size_t>(a)] > work[static_cast<std::size_t>(b)]; });
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  const bool one_dominates = !work.empty() && work[static_cast<std::size_t>(order.front())] > 2.0 / 3.0 * all;
  parallel_for(static_cast<int>(work.size()), one_dominates ? 1 : threads,
               [&](int k) { task(order[static_cast<std::size_t>(k)]); });
}

}  // namespace scabo::linalg
