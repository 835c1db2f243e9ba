#include "scabo/contact/rigid_map.hpp"

#include <mutex>

namespace scabo::contact {

struct RigidMap::Data {
  explicit Data(Sparse of) : sparse(std::move(of)) { sparse.makeCompressed(); }
  Sparse sparse;
  mutable Matrix dense;
  mutable std::once_flag formed;
};

const RigidMap::Sparse& RigidMap::sparse() const { return data_->sparse; }
RigidMap::RigidMap(Sparse sparse) : data_(std::make_shared<const Data>(std::move(sparse))) {}
RigidMap::RigidMap(const Matrix& dense) : RigidMap(Sparse(dense.sparseView(1.0, 0.0))) {}

RigidMap::RigidMap() {
  static const auto none = std::make_shared<const Data>(Sparse(0, 0));
  data_ = none;
}

void RigidMap::resize(Eigen::Index rows, Eigen::Index cols) { *this = RigidMap(Sparse(rows, cols)); }

const Matrix& RigidMap::dense() const {
  std::call_once(data_->formed, [&] { data_->dense = Matrix(data_->sparse); });
  return data_->dense;
}

}  // namespace scabo::contact
