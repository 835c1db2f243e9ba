// Problems to write and read back.
#pragma once

#include <unistd.h>

#include <Eigen/SparseCore>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "scabo/contact/files/saved_problem.hpp"

namespace scabo::contact {

/// A directory for one test, gone after it.
class Scratch {
 public:
  Scratch() {
    const std::string name = (std::filesystem::temp_directory_path() / "scabo_problems_XXXXXX").string();
    std::string made = name;
    if (!::mkdtemp(made.data())) throw std::runtime_error("no temporary directory");
    path_ = made;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Numbers whose every bit is used, of both signs and many sizes.
inline Vector random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> digits(-1.0, 1.0), exponent(-300.0, 300.0);
  Vector values(size);
  for (double& value : values) value = std::ldexp(digits(random), static_cast<int>(exponent(random)));
  return values;
}

inline Problem random_problem(int dimension, Eigen::Index pairs, unsigned seed) {
  const Eigen::Index size = dimension * pairs;
  Problem problem;
  problem.dimension = dimension;
  problem.W = Matrix(random_vector(size * size, seed).reshaped(size, size));  // unsymmetric: kept as it is
  problem.q = random_vector(size, seed + 1);
  problem.mu = random_vector(pairs, seed + 2).cwiseAbs();
  problem.G = Matrix::Zero(size, 0);
  problem.f = Vector::Zero(0);
  return problem;
}

/// Every third entry.
inline Eigen::SparseMatrix<double> thinned(const Matrix& A) {
  Eigen::SparseMatrix<double> S(A.rows(), A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      if ((i + j) % 3 == 0) S.insert(i, j) = A(i, j);
  S.makeCompressed();
  return S;
}

}  // namespace scabo::contact
