// Choice of the kernels that OpenBLAS uses.
#pragma once

namespace scabo::linalg {

/// Chooses the kernels of OpenBLAS once, before the first large product. OpenBLAS 0.3.21 treats a processor that it
/// does not know (any newer than itself) like one of 2004. If AVX-512 is available, the SkylakeX kernels are chosen:
/// their products are almost twice as fast as those of Haswell (measured 57 against 36 GFlop/s at n = 158, 66 against
/// 35 at 638); their triangular solve is half as fast, which CholeskyFactor avoids. Otherwise the Haswell kernels
/// are chosen if AVX2 and FMA are available. Does nothing if the user has set OPENBLAS_CORETYPE, on other processors,
/// or with another BLAS.
void choose_blas_kernels();

}  // namespace scabo::linalg
