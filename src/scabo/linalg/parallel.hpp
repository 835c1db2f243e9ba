// Independent tasks that call BLAS.
#pragma once

#include <functional>

namespace scabo::linalg {

/// Calls task(0) ... task(count - 1), on up to `threads` threads at once, each with a BLAS of one thread; a single task
/// keeps BLAS's `threads`. The first exception is thrown again, after all threads have ended.
void parallel_for(int count, int threads, const std::function<void(int)>& task);

}  // namespace scabo::linalg
