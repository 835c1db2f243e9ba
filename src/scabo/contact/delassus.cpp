#include "scabo/contact/delassus.hpp"

#include <mutex>
#include <random>

#include "scabo/base/error.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

struct Delassus::Data {
  enum class Kind { dense, sparse, condensed } kind = Kind::dense;
  Eigen::Index size = 0;
  Eigen::SparseMatrix<double> sparse;  // or B
  std::shared_ptr<const linalg::SymmetricPositiveSolver> K;
  double factor = 1.0;  // of B' K^-1 B
  mutable Matrix dense;
  mutable std::once_flag formed;
  mutable Matrix columns_of_pairs;  // condensed: result of diagonal_blocks
  mutable std::mutex guard;
};

namespace {

constexpr Eigen::Index columns_at_a_time = 64;  // dense right-hand sides: bounded memory

/// Diagonal blocks from products with a few vectors (Bekas, Kokiopoulou, Saad, Appl. Numer. Math. 57 (2007) 1214): each
/// vector has random signs on every 64th pair, so that contributions of distant pairs average out.
Matrix probed_blocks(const Delassus& W, int d) {
  constexpr Eigen::Index colours = 64;
  const Eigen::Index N = W.size() / d;
  Matrix blocks(d, W.size());
  std::minstd_rand random(1);
  Vector sign(N);
  for (double& s : sign) s = (random() >> 8) % 2 == 0 ? 1.0 : -1.0;
  for (Eigen::Index colour = 0; colour < colours; ++colour) {
    Matrix probes = Matrix::Zero(W.size(), d);
    for (Eigen::Index i = colour; i < N; i += colours)
      for (int k = 0; k < d; ++k) probes(d * i + k, k) = sign[i];
    const Matrix images = W.times(probes);
    for (Eigen::Index i = colour; i < N; i += colours)
      blocks.middleCols(d * i, d) = sign[i] * images.middleRows(d * i, d);
  }
  return blocks;
}

}  // namespace

Delassus::Delassus(Matrix dense) {
  ensure(dense.rows() == dense.cols(), "a Delassus operator is square");
  auto data = std::make_shared<Data>();
  data->size = dense.rows();
  data->dense = std::move(dense);
  data_ = std::move(data);
}

Delassus::Delassus(Eigen::SparseMatrix<double> sparse) {
  ensure(sparse.rows() == sparse.cols(), "a Delassus operator is square");
  auto data = std::make_shared<Data>();
  data->kind = Data::Kind::sparse;
  data->size = sparse.rows();
  data->sparse = std::move(sparse);
  data->sparse.makeCompressed();
  data_ = std::move(data);
}

Delassus::Delassus(std::shared_ptr<const linalg::SymmetricPositiveSolver> K, Eigen::SparseMatrix<double> B) {
  auto data = std::make_shared<Data>();
  data->kind = Data::Kind::condensed;
  data->size = B.cols();
  data->K = std::move(K);
  data->sparse = std::move(B);
  data->sparse.makeCompressed();
  data_ = std::move(data);
}

Eigen::Index Delassus::size() const { return data_ ? data_->size : 0; }
bool Delassus::is_dense() const { return !data_ || data_->kind == Data::Kind::dense; }
bool Delassus::is_sparse() const { return data_ && data_->kind == Data::Kind::sparse; }

Matrix Delassus::times(const Matrix& p) const {
  ensure(p.rows() == size(), "the Delassus operator and the forces differ in size");
  if (!data_) return p;
  switch (data_->kind) {
    case Data::Kind::dense:
      return data_->dense * p;
    case Data::Kind::sparse:
      return data_->sparse * p;
    case Data::Kind::condensed:
      break;
  }
  return data_->factor * (data_->sparse.transpose() * data_->K->solve(data_->sparse * p));
}

Vector Delassus::times(const Vector& p) const {
  Vector result;
  apply(p, result);
  return result;
}

void Delassus::apply(const Eigen::Ref<const Vector>& p, Vector& result) const {
  ensure(p.size() == size(), "the Delassus operator and the forces differ in size");
  result.resize(p.size());
  if (!data_) return;
  switch (data_->kind) {
    case Data::Kind::dense:
      result.noalias() = data_->dense * p;
      return;
    case Data::Kind::sparse:
      result.noalias() = data_->sparse * p;
      return;
    case Data::Kind::condensed:
      break;
  }
  const Vector forces = data_->sparse * p;
  result = data_->factor * (data_->sparse.transpose() * data_->K->solve(forces));
}

Matrix Delassus::diagonal_blocks(int d) const {
  Matrix blocks = Matrix::Zero(d, size());
  if (!data_) return blocks;
  const Eigen::Index N = size() / d;
  if (data_->kind == Data::Kind::dense) {
    for (Eigen::Index i = 0; i < N; ++i) blocks.middleCols(d * i, d) = data_->dense.block(d * i, d * i, d, d);
    return blocks;
  }
  if (data_->kind == Data::Kind::sparse) {
    for (Eigen::Index column = 0; column < size(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(data_->sparse, column); it; ++it)
        if (it.row() / d == column / d) blocks(it.row() % d, column) += it.value();
    return blocks;
  }
  const std::scoped_lock lock(data_->guard);
  if (data_->columns_of_pairs.rows() == d) return data_->columns_of_pairs;
  constexpr Eigen::Index most_exact = 4000;
  if (size() > most_exact) {
    data_->columns_of_pairs = blocks = probed_blocks(*this, d);
    return blocks;
  }
  const Eigen::Index chunk = columns_at_a_time / d * d;
  for (Eigen::Index first = 0; first < size(); first += chunk) {
    const Eigen::Index count = std::min(chunk, size() - first);
    const Eigen::SparseMatrix<double> part = data_->sparse.middleCols(first, count);
    const Matrix W = data_->factor * (part.transpose() * data_->K->solve(Matrix(part)));
    for (Eigen::Index i = 0; i < count; i += d) blocks.middleCols(first + i, d) = W.block(i, i, d, d);
  }
  data_->columns_of_pairs = blocks;
  return blocks;
}

Vector Delassus::diagonal() const {
  if (is_dense()) return data_ ? Vector(data_->dense.diagonal()) : Vector();
  if (is_sparse()) return data_->sparse.diagonal();
  return diagonal_blocks(1).transpose();
}

const Matrix& Delassus::dense() const {
  static const Matrix none(0, 0);
  if (!data_) return none;
  if (data_->kind == Data::Kind::dense) return data_->dense;
  std::call_once(data_->formed, [&] {
    if (data_->kind == Data::Kind::sparse) {
      data_->dense = Matrix(data_->sparse);
      return;
    }
    Matrix W(size(), size());
    for (Eigen::Index first = 0; first < size(); first += columns_at_a_time) {
      const Eigen::Index count = std::min(columns_at_a_time, size() - first);
      const Matrix part = data_->sparse.middleCols(first, count);
      W.middleCols(first, count) = data_->factor * (data_->sparse.transpose() * data_->K->solve(part));
    }
    data_->dense = 0.5 * (W + W.transpose());
  });
  return data_->dense;
}

const Eigen::SparseMatrix<double>& Delassus::sparse() const {
  ensure(is_sparse(), "this Delassus operator is not sparse");
  return data_->sparse;
}

Delassus Delassus::scaled(double factor) const {
  if (!data_) return *this;
  switch (data_->kind) {
    case Data::Kind::dense:
      return Delassus(Matrix(factor * data_->dense));
    case Data::Kind::sparse:
      return Delassus(Eigen::SparseMatrix<double>(factor * data_->sparse));
    case Data::Kind::condensed:
      break;
  }
  auto data = std::make_shared<Data>();
  data->kind = data_->kind;
  data->size = data_->size;
  data->sparse = data_->sparse;
  data->K = data_->K;
  data->factor = factor * data_->factor;
  Delassus result;
  result.data_ = std::move(data);
  return result;
}

}  // namespace scabo::contact
