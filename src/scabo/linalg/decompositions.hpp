// Eigen's decompositions of dense matrices, compiled once, in decompositions.cpp, and not in every source that uses
// one.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "scabo/base/types.hpp"

#define SCABO_DECOMPOSITIONS(declared)                                               \
  declared template class Eigen::PartialPivLU<scabo::Matrix>;                        \
  declared template class Eigen::LLT<scabo::Matrix>;                                 \
  declared template Eigen::LLT<scabo::Matrix>& Eigen::LLT<scabo::Matrix>::compute(   \
      const Eigen::EigenBase<scabo::Matrix>&);                                       \
  declared template class Eigen::LDLT<scabo::Matrix>;                                \
  declared template Eigen::LDLT<scabo::Matrix>& Eigen::LDLT<scabo::Matrix>::compute( \
      const Eigen::EigenBase<scabo::Matrix>&);                                       \
  declared template class Eigen::HouseholderQR<scabo::Matrix>;                       \
  declared template class Eigen::ColPivHouseholderQR<scabo::Matrix>;                 \
  declared template class Eigen::CompleteOrthogonalDecomposition<scabo::Matrix>;     \
  declared template class Eigen::JacobiSVD<scabo::Matrix>;                           \
  declared template class Eigen::SelfAdjointEigenSolver<scabo::Matrix>;              \
  declared template Eigen::SelfAdjointEigenSolver<scabo::Matrix>&                    \
  Eigen::SelfAdjointEigenSolver<scabo::Matrix>::compute(const Eigen::EigenBase<scabo::Matrix>&, int)

SCABO_DECOMPOSITIONS(extern);
