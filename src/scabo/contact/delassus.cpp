#include "scabo/contact/delassus.hpp"

#include <cmath>
#include <mutex>
#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

struct Delassus::Data {
  enum class Kind { dense, sparse, products } kind = Kind::dense;
  Eigen::Index size = 0;
  Matrix dense;
  Eigen::SparseMatrix<double> sparse;
  std::shared_ptr<const PairOperator> products;
  Matrix diagonal_blocks;  // of products
};

/// Entries that are computed when they are first asked for, and the bodies.
struct Delassus::Formed {
  std::optional<Eigen::SparseMatrix<double>> bodies = {};
  mutable Matrix W;
  mutable std::once_flag once;
};

namespace {

constexpr Eigen::Index columns_at_a_time = 64;  // dense right-hand sides: bounded memory

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

Delassus::Delassus(std::shared_ptr<const PairOperator> products) {
  auto data = std::make_shared<Data>();
  data->kind = Data::Kind::products;
  data->size = products->size();
  data->diagonal_blocks = products->diagonal_blocks();
  data->products = std::move(products);
  data_ = std::move(data);
  formed_ = std::make_shared<const Formed>();
}

Delassus Delassus::with_holder(std::shared_ptr<const PairHolder> holder) const {
  Delassus result = *this;
  result.holder_ = std::move(holder);
  return result;
}

Delassus Delassus::with_bodies(Eigen::SparseMatrix<double> Y) const {
  Delassus result = *this;
  auto formed = std::make_shared<Formed>();
  formed->bodies = std::move(Y);
  result.formed_ = std::move(formed);
  return result;
}

const Eigen::SparseMatrix<double>* Delassus::bodies() const {
  return formed_ && formed_->bodies ? &*formed_->bodies : nullptr;
}

Eigen::Index Delassus::size() const { return data_ ? data_->size : 0; }
bool Delassus::is_dense() const { return !data_ || data_->kind == Data::Kind::dense; }
bool Delassus::is_sparse() const { return data_ && data_->kind == Data::Kind::sparse; }

Matrix Delassus::times(const Matrix& p) const {
  ensure(p.rows() == size(), "the Delassus operator and the forces differ in size");
  if (is_sparse()) return data_->sparse * p;
  if (data_ && is_dense()) return factor_ * (data_->dense * p);
  Matrix result(p.rows(), p.cols());
  for (Eigen::Index j = 0; j < p.cols(); ++j) result.col(j) = times(Vector(p.col(j)));
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
      if (const Eigen::SparseMatrix<double>* const Y = bodies())
        result.noalias() = Y->transpose() * Vector(*Y * p);
      else
        result.noalias() = data_->sparse * p;
      return;
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
  const Matrix& kept = data_->diagonal_blocks;
  if (d == kept.rows()) return factor_ * kept;
  ensure(d == 1, "blocks of pairs have as many components as the pairs");
  for (Eigen::Index k = 0; k < size(); ++k) blocks(0, k) = factor_ * kept(k % kept.rows(), k);
  return blocks;
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
  Delassus result = *this;
  if (is_sparse()) {
    result = Delassus(Eigen::SparseMatrix<double>(factor * data_->sparse));
  } else {
    result.factor_ *= factor;
    result.formed_ = std::make_shared<const Formed>();
  }
  return bodies() ? result.with_bodies(std::sqrt(factor) * *bodies()) : result;
}

}  // namespace scabo::contact
