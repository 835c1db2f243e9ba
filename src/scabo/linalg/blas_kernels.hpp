// Which of its kernels OpenBLAS uses.
#pragma once

namespace scabo::linalg {

/// Chooses OpenBLAS's kernels once, before the first large product. OpenBLAS 0.3.21 takes a processor it does not know
/// (any newer than itself) for one of 2004, and on AVX-512 ones picks kernels whose small triangular solves are slow:
/// measured on such a machine, the super-element of 320 degrees of freedom took 31 ms with its own choice (Prescott), 12
/// ms with SkylakeX or Cooperlake and 10 ms with Haswell. So Haswell's are taken wherever AVX2 and FMA are there. Does
/// nothing when the user has set OPENBLAS_CORETYPE, on other processors, or with another BLAS.
void choose_blas_kernels();

}  // namespace scabo::linalg
