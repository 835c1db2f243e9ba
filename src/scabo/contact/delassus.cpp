#include "scabo/contact/delassus.hpp"

#include <mutex>
#include <random>

#include "scabo/base/error.hpp"
#include "scabo/contact/pair_operator.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

struct Delassus::Data {
  enum class Kind { dense, sparse, condensed, products } kind = Kind::dense;
  Eigen::Index size = 0;
  Matrix dense;
  Eigen::SparseMatrix<double> sparse;  // or B
  std::shared_ptr<const linalg::SymmetricPositiveSolver> K;
  std::shared_ptr<const PairOperator> products;
  mutable Matrix columns_of_pairs;  // condensed and products: result of diagonal_blocks
  mutable std::mutex guard;
};

/// Entries that are computed when they are first asked for.
struct Delassus::Formed {
  mutable Matrix W;
  mutable std::once_flag once;
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
  formed_ = std::make_shared<const Formed>();
}

Delassus::Delassus(std::shared_ptr<const linalg::SymmetricPositiveSolver> K, Eigen::SparseMatrix<double> B) {
  auto data = std::make_shared<Data>();
  data->kind = Data::Kind::condensed;
  data->size = B.cols();
  data->K = std::move(K);
  data->sparse = std::move(B);
  data->sparse.makeCompressed();
  data_ = std::move(data);
  formed_ = std::make_shared<const Formed>();
}

Delassus::Delassus(std::shared_ptr<const PairOperator> products) {
  auto data = std::make_shared<Data>();
  data->kind = Data::Kind::products;
  data->size = products->size();
  data->products = std::move(products);
  data_ = std::move(data);
  formed_ = std::make_shared<const Formed>();
}

Delassus Delassus::with_holder(std::shared_ptr<const PairHolder> holder) const {
  Delassus result = *this;
  result.holder_ = std::move(holder);
  return result;
}

Eigen::Index Delassus::size() const { return data_ ? data_->size : 0; }
bool Delassus::is_dense() const { return !data_ || data_->kind == Data::Kind::dense; }
bool Delassus::is_sparse() const { return data_ && data_->kind == Data::Kind::sparse; }

Matrix Delassus::times(const Matrix& p) const {
  ensure(p.rows() == size(), "the Delassus operator and the forces differ in size");
  if (!data_) return p;
  Matrix result;
  switch (data_->kind) {
    case Data::Kind::dense:
      result = data_->dense * p;
      break;
    case Data::Kind::sparse:
      return data_->sparse * p;
    case Data::Kind::condensed:
      result = data_->sparse.transpose() * data_->K->solve(data_->sparse * p);
      break;
    case Data::Kind::products:
      result.resize(p.rows(), p.cols());
      for (Eigen::Index j = 0; j < p.cols(); ++j) result.col(j) = data_->products->times(p.col(j));
      break;
  }
  if (factor_ != 1.0) result *= factor_;
  return result;
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
      break;
    case Data::Kind::sparse:
      result.noalias() = data_->sparse * p;
      return;
    case Data::Kind::condensed: {
      const Vector forces = data_->sparse * p;
      result = data_->sparse.transpose() * data_->K->solve(forces);
      break;
    }
    case Data::Kind::products:
      result = data_->products->times(p);
      break;
  }
  if (factor_ != 1.0) result *= factor_;
}

Matrix Delassus::diagonal_blocks(int d) const {
  Matrix blocks = Matrix::Zero(d, size());
  if (!data_) return blocks;
  const Eigen::Index N = size() / d;
  if (data_->kind == Data::Kind::dense) {
    for (Eigen::Index i = 0; i < N; ++i) blocks.middleCols(d * i, d) = factor_ * data_->dense.block(d * i, d * i, d, d);
    return blocks;
  }
  if (data_->kind == Data::Kind::sparse) {
    for (Eigen::Index column = 0; column < size(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(data_->sparse, column); it; ++it)
        if (it.row() / d == column / d) blocks(it.row() % d, column) += it.value();
    return blocks;
  }
  const std::scoped_lock lock(data_->guard);
  Matrix& kept = data_->columns_of_pairs;
  if (data_->kind == Data::Kind::products) {
    if (kept.size() == 0) kept = data_->products->diagonal_blocks();
    if (d == kept.rows()) return factor_ * kept;
    ensure(d == 1, "blocks of pairs have as many components as the pairs");
    for (Eigen::Index k = 0; k < size(); ++k) blocks(0, k) = factor_ * kept(k % kept.rows(), k);
    return blocks;
  }
  if (kept.rows() == d) return factor_ * kept;
  constexpr Eigen::Index most_exact = 4000;
  if (size() > most_exact) {
    Delassus alone = *this;
    alone.factor_ = 1.0;
    kept = probed_blocks(alone, d);
    return factor_ * kept;
  }
  const Eigen::Index chunk = columns_at_a_time / d * d;
  for (Eigen::Index first = 0; first < size(); first += chunk) {
    const Eigen::Index count = std::min(chunk, size() - first);
    const Eigen::SparseMatrix<double> part = data_->sparse.middleCols(first, count);
    const Matrix W = part.transpose() * data_->K->solve(Matrix(part));
    for (Eigen::Index i = 0; i < count; i += d) blocks.middleCols(first + i, d) = W.block(i, i, d, d);
  }
  kept = blocks;
  return factor_ * kept;
}

Vector Delassus::diagonal() const {
  if (is_dense()) return data_ ? Vector(factor_ * data_->dense.diagonal()) : Vector();
  if (is_sparse()) return data_->sparse.diagonal();
  return diagonal_blocks(1).transpose();
}

const Matrix& Delassus::matrix() const {
  static const Matrix none(0, 0);
  ensure(is_dense(), "this Delassus operator is not dense");
  return data_ ? data_->dense : none;
}

const Matrix& Delassus::dense() const {
  if (is_dense() && factor_ == 1.0) return matrix();
  std::call_once(formed_->once, [&] {
    if (data_->kind == Data::Kind::dense) {
      formed_->W = factor_ * data_->dense;
      return;
    }
    if (data_->kind == Data::Kind::sparse) {
      formed_->W = Matrix(data_->sparse);
      return;
    }
    Matrix W(size(), size());
    for (Eigen::Index first = 0; first < size(); first += columns_at_a_time) {
      const Eigen::Index count = std::min(columns_at_a_time, size() - first);
      Matrix unit = Matrix::Zero(size(), count);
      unit.middleRows(first, count).setIdentity();
      W.middleCols(first, count) = times(unit);
    }
    formed_->W = 0.5 * (W + W.transpose());
  });
  return formed_->W;
}

const Eigen::SparseMatrix<double>& Delassus::sparse() const {
  ensure(is_sparse(), "this Delassus operator is not sparse");
  return data_->sparse;
}

Delassus Delassus::scaled(double factor) const {
  if (!data_) return *this;
  if (data_->kind == Data::Kind::sparse) return Delassus(Eigen::SparseMatrix<double>(factor * data_->sparse));
  Delassus result = *this;
  result.factor_ *= factor;
  result.formed_ = std::make_shared<const Formed>();
  return result;
}

}  // namespace scabo::contact
