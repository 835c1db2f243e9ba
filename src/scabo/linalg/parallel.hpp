// Parallel execution of independent tasks that call BLAS.
#pragma once

#include <functional>

namespace scabo::linalg {

/// Calls task(0) ... task(count - 1) on up to `threads` threads, each with single-threaded BLAS; a single task may use
/// `threads` threads of BLAS. Called by a task, it uses the thread of that task alone. The first exception is rethrown
/// after all threads have ended.
void parallel_for(int count, int threads, const std::function<void(int)>& task);

}  // namespace scabo::linalg
