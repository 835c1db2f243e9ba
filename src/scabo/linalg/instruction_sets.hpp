// Selection among kernels that are compiled for several instruction sets.
#pragma once

#include <vector>

namespace scabo::linalg {

/// The kernels that this processor can run, the fastest first; the baseline is always included.
template <typename Kernel>
std::vector<const Kernel*> runnable(const Kernel& avx512, const Kernel& avx2, const Kernel& baseline) {
  std::vector<const Kernel*> found;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) found.push_back(&avx512);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&avx2);
#else
  static_cast<void>(avx512), static_cast<void>(avx2);
#endif
  found.push_back(&baseline);
  return found;
}

}  // namespace scabo::linalg
