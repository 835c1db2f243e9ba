// PETSc's objects as C++ objects, and its errors as exceptions.
#pragma once

#include <petscmat.h>
#include <petscvec.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace scabo::mpi {

/// A function of PETSc failed on this rank; others may be waiting for it.
struct PetscFailure : std::runtime_error {
  PetscFailure(int number, const std::string& what) : std::runtime_error(what), code(number) {}
  int code;
};

/// Throws PetscFailure with PETSc's own message (remembered by the error handler of main.cpp).
void check(PetscErrorCode code);
void remember_errors();

template <typename Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { reset(); }
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  operator Object() const { return object_; }
  Object* out() {  ///< to be created
    reset();
    return &object_;
  }
  Object* at() { return &object_; }
  void reset() {
    if (object_ != nullptr) static_cast<void>(destroy(&object_));
    object_ = nullptr;
  }

 private:
  Object object_ = nullptr;
};

using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedIS = Owned<IS, ISDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;
using OwnedMapping = Owned<ISLocalToGlobalMapping, ISLocalToGlobalMappingDestroy>;
using OwnedPartitioning = Owned<MatPartitioning, MatPartitioningDestroy>;

}  // namespace scabo::mpi
