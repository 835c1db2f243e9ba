// Which of its kernels OpenBLAS uses.
#pragma once

namespace scabo::linalg {

/// Chooses OpenBLAS's kernels once, before the first large product. OpenBLAS 0.3.21 takes a processor it does not know
/// (any newer than itself) for one of 2004. Where AVX-512 is there, SkylakeX's are taken: their products are twice as
/// fast as Haswell's (measured 57 against 36 GFlop/s at n = 158, 66 against 35 at 638); their triangular solve is half
/// as fast, which solve_lower_in_place goes round. Otherwise Haswell's, where AVX2 and FMA are there. Does nothing when
/// the user has set OPENBLAS_CORETYPE, on other processors, or with another BLAS.
void choose_blas_kernels();

}  // namespace scabo::linalg
