// Motions without deformation that supports and springs leave to a body.
#pragma once

#include <vector>

#include "scabo/system/body_system.hpp"

namespace scabo::system {

/// Basis of the null space of A (rows x columns), its columns orthonormal.
Matrix null_space(const Matrix& A);

/// Of the motions `free`, 3 x m, with orthonormal columns: those that change no spring's length, 3 x k, k <= m.
Matrix at_rest(const Matrix& free, const std::vector<HeldDirection>& springs, const Vec2& reference, double lever);

}  // namespace scabo::system
