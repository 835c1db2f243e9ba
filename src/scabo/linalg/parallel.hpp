// Parallel execution of independent tasks that call BLAS.
#pragma once

#include <functional>
#include <vector>

namespace scabo::linalg {

/// Calls task(0) ... task(count - 1), each after an interruption point, on up to `threads` threads with single-threaded
/// BLAS; a single task may use `threads` threads of BLAS. Called by a task, it uses the thread of that task alone. The
/// first exception is rethrown after all threads have ended.
void parallel_for(int count, int threads, const std::function<void(int)>& task);

/// The same for tasks of different sizes, `work` in any unit: the largest begin first. If one is more than two thirds
/// of all work, they run one after another, each with `threads` threads of BLAS.
void parallel_for(const std::vector<double>& work, int threads, const std::function<void(int)>& task);

}  // namespace scabo::linalg
