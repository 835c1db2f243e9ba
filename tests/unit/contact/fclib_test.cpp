// FCLIB's layout: what is written is read with equal bits; files by others are the business of
// tests/regression/contact_cli_test.py, broken ones of tests/input/bad_problems_test.py.
#include "scabo/contact/files/fclib.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <limits>

#include "support/decompositions.hpp"
#include "unit/contact/saved_problems.hpp"

namespace scabo::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

SavedProblem written_and_read(const SavedProblem& saved) {
  const Scratch scratch;
  const std::string file = scratch.file("problem.hdf5");
  write_fclib(file, saved);
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
  return read_problem_file(file);
}

TEST(Fclib, WrittenAndReadWithEqualBits) {
  for (const int dimension : {2, 3}) {
    SavedProblem saved;
    saved.problem = random_problem(dimension, 5, 7);
    saved.title = "Five pairs";
    saved.description = "häßlich, \"quoted\"";
    const SavedProblem read = written_and_read(saved);
    EXPECT_EQ(read.problem.dimension, dimension);
    ASSERT_TRUE(read.problem.W.is_dense());
    EXPECT_EQ(read.problem.W.dense(), saved.problem.W.dense());
    EXPECT_EQ(read.problem.q, saved.problem.q);
    EXPECT_EQ(read.problem.mu, saved.problem.mu);
    EXPECT_EQ(read.problem.G.cols(), 0);
    EXPECT_EQ(read.problem.cohesion.size(), 0);
    EXPECT_EQ(read.problem.tension.size(), 0);
    EXPECT_EQ(read.start.p.size(), 0);
    EXPECT_EQ(read.r.size(), 0);
    EXPECT_EQ(read.title, saved.title);
    EXPECT_EQ(read.description, saved.description);
    EXPECT_EQ(read.layout, "FCLIB, local form");
  }
}

TEST(Fclib, SparseStaysSparse) {
  SavedProblem saved;
  saved.problem = random_problem(3, 20, 11);
  saved.problem.W = Delassus(thinned(saved.problem.W.dense()));
  const SavedProblem read = written_and_read(saved);
  ASSERT_TRUE(read.problem.W.is_sparse());
  EXPECT_EQ(read.problem.W.sparse().nonZeros(), saved.problem.W.sparse().nonZeros());
  EXPECT_EQ(Matrix(read.problem.W.sparse()), Matrix(saved.problem.W.sparse()));
}

TEST(Fclib, RigidMotionsLawsHistoryAndSolution) {
  SavedProblem saved;
  saved.problem = random_problem(2, 4, 3);
  saved.problem.G = random_vector(24, 5).reshaped(8, 3);
  saved.problem.f = random_vector(3, 6);
  saved.problem.cohesion = random_vector(4, 8).cwiseAbs();
  saved.problem.tension = Vector::Zero(4);
  saved.problem.tension << 0.0, infinity, 3.5, 1e-300;
  saved.start = {random_vector(8, 9), random_vector(3, 10)};
  saved.r = random_vector(8, 12);
  saved.a = random_vector(3, 13);
  saved.force_scale = 12345.678;
  saved.contacts = {"joint", "base"};
  saved.contact_of_pair = {0, 0, 1, 1};
  saved.number_of_pair = {1, 3, 2, 4};
  const SavedProblem read = written_and_read(saved);
  EXPECT_EQ(read.problem.G.dense(), saved.problem.G.dense());
  EXPECT_EQ(read.problem.f, saved.problem.f);
  EXPECT_EQ(read.problem.cohesion, saved.problem.cohesion);
  EXPECT_EQ(read.problem.tension, saved.problem.tension);
  EXPECT_EQ(read.start.p, saved.start.p);
  EXPECT_EQ(read.start.a, saved.start.a);
  EXPECT_EQ(read.r, saved.r);
  EXPECT_EQ(read.a, saved.a);
  EXPECT_EQ(read.force_scale, saved.force_scale);
  EXPECT_EQ(read.contacts, saved.contacts);
  EXPECT_EQ(read.contact_of_pair, saved.contact_of_pair);
  EXPECT_EQ(read.number_of_pair, saved.number_of_pair);
}

TEST(Fclib, TheSameProblemTheSameBytes) {
  const Scratch scratch;
  SavedProblem saved;
  saved.problem = random_problem(3, 3, 21);
  const auto bytes = [&](const char* name) {
    write_fclib(scratch.file(name), saved);
    std::ifstream stream(scratch.file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(bytes("a.hdf5"), bytes("b.hdf5"));
}

// HDF5 itself crashed at the end of a process that had met a full disk, and did not say why a file was not written.
TEST(Fclib, AFullDiskIsNamedAndTheNextFileIsWritten) {
  SavedProblem saved;
  saved.problem = random_problem(2, 40, 7);
  const Scratch scratch;
  const std::string file = scratch.file("problem.hdf5");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write_fclib(file, saved);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(message, "cannot write " + file + ": File too large");
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
  EXPECT_FALSE(std::filesystem::exists(file));
  write_fclib(file, saved);
  EXPECT_EQ(read_problem_file(file).problem.W.dense(), saved.problem.W.dense());
}

TEST(Fclib, WhatCannotBeWrittenIsSaid) {
  SavedProblem saved;
  saved.problem = random_problem(2, 1, 1);
  EXPECT_THAT(
      [&] { write_fclib("/no/such/directory/p.hdf5", saved); },
      testing::ThrowsMessage<std::runtime_error>(testing::StartsWith("cannot write /no/such/directory/p.hdf5: ")));
}

// The chain v1 - v2 on springs, pressed at v1: M v = f + H r, u = H' v + w.
GlobalProblem two_springs() {
  GlobalProblem global;
  global.dimension = 2;
  Matrix M(4, 4), H(4, 2);
  M << 3, 0, -1, 0, 0, 3, 0, -1, -1, 0, 2, 0.5, 0, -1, 0.25, 2;  // slightly unsymmetric
  H << 1, 0, 0, 1, 0, 0, 0, 0;
  global.M = M.sparseView();
  global.H = H.sparseView();
  global.G = Eigen::SparseMatrix<double>(4, 0);
  global.f = Vector::LinSpaced(4, -2.0, 1.0);
  global.w = Vector::LinSpaced(2, 0.1, 0.2);
  global.b = Vector::Zero(0);
  global.mu = Vector::Constant(1, 0.3);
  return global;
}

TEST(GlobalForm, ReducesToThePairs) {
  const GlobalProblem global = two_springs();
  const GlobalReduction reduction(global);
  const Problem problem = reduction.problem();
  const Matrix M = Matrix(global.M), H = Matrix(global.H), inverse = test::inverse(M);
  EXPECT_LT((problem.W.dense() - H.transpose() * inverse * H).norm(), 1e-14);
  EXPECT_LT((problem.q - global.w - H.transpose() * inverse * global.f).norm(), 1e-14);
  const Vector r = Vector::LinSpaced(2, 1.0, 0.25), v = reduction.motion(r);
  EXPECT_LT((M * v - global.f - H * r).norm(), 1e-14);
  EXPECT_LT((H.transpose() * v + global.w - problem.W.times(r) - problem.q).norm(), 1e-14);
}

TEST(GlobalForm, BilateralConstraintsHold) {
  GlobalProblem global = two_springs();
  Matrix G(4, 1);
  G << 0, 1, 0, -2;
  global.G = G.sparseView();
  global.b = Vector::Constant(1, 0.7);
  const GlobalReduction reduction(global);
  const Problem problem = reduction.problem();
  const Vector r = Vector::LinSpaced(2, 1.0, 0.25), motion = reduction.motion(r), v = motion.head(4),
               l = motion.tail(1);
  EXPECT_LT((Matrix(global.M) * v - global.f - global.H * r - G * l).norm(), 1e-14);
  EXPECT_NEAR((G.transpose() * v)[0] + 0.7, 0.0, 1e-14);
  EXPECT_LT((global.H.transpose() * v + global.w - problem.W.times(r) - problem.q).norm(), 1e-14);
}

TEST(GlobalForm, WrittenAndRead) {
  const Scratch scratch;
  const std::string file = scratch.file("global.hdf5");
  const GlobalProblem global = two_springs();
  const Vector r = Vector::LinSpaced(2, 1.0, 0.25);
  write_fclib(file, global, "Two springs", r);
  const SavedProblem read = read_problem_file(file);
  EXPECT_EQ(read.layout, "FCLIB, global form");
  EXPECT_EQ(read.title, "Two springs");
  EXPECT_EQ(read.r, r);
  ASSERT_TRUE(read.reduction);
  EXPECT_EQ(Matrix(read.reduction->global().M), Matrix(global.M));
  EXPECT_EQ(read.problem.q, GlobalReduction(global).problem().q);
}

TEST(GlobalForm, SingularIsSaid) {
  GlobalProblem global = two_springs();
  global.M = Eigen::SparseMatrix<double>(4, 4);
  EXPECT_THROW(GlobalReduction{global}, SingularProblem);
}

}  // namespace
}  // namespace scabo::contact
