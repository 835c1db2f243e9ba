#include "scabo/linalg/blas_kernels.hpp"

#include <cstdlib>
#include <mutex>

// OpenBLAS built for several processors (DYNAMIC_ARCH) exports these; weak, so that any BLAS can be linked.
extern "C" {
[[gnu::weak]] void gotoblas_dynamic_init();
[[gnu::weak]] void gotoblas_dynamic_quit();
}

namespace scabo::linalg {

void choose_blas_kernels() {
#if defined(__x86_64__)
  static std::once_flag once;
  std::call_once(once, [] {
    if (!gotoblas_dynamic_init || !gotoblas_dynamic_quit || std::getenv("OPENBLAS_CORETYPE")) return;
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    setenv("OPENBLAS_CORETYPE", wide ? "SkylakeX" : "Haswell", 1);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
    unsetenv("OPENBLAS_CORETYPE");  // child processes choose for themselves
  });
#endif
}

}  // namespace scabo::linalg
