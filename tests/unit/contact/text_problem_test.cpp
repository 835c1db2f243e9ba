// The text layout: read from texts as Siconos writes them, written and read with equal bits; every mistake
// has its place.
#include "scabo/contact/files/text_problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/contact/saved_problems.hpp"

namespace scabo::contact {
namespace {

/// [4 1 0 .5; 1.125 3 .25 0; 0 .25 5 1; .5 0 1 2], unsymmetric on purpose.
Matrix expected_W() {
  Matrix W(4, 4);
  W << 4, 1, 0, .5, 1.125, 3, .25, 0, 0, .25, 5, 1, .5, 0, 1, 2;
  return W;
}

const char* const vectors = "-1 0.5 1e-1 -0.3\n0.3 7e-1 \n";
const std::string dense = "2\n2\n0\n4\n4\n4\t4\n4 1.125 0 .5\n1 3 .25 0\n0 .25 5 1\n.5 0 1 2\n";
const std::string columns =
    "2\n2\n2\n4\n4\n2\nCSparse Version 3.2.0, Sept 12, 2017.  Copyright (c) Timothy A. Davis, 2006-2016\n"
    "4-by-4, nzmax: 12 nnz: 12, 1-norm: 6.25\n"
    "    col 0 : locations 0 to 2\n      0 : 4\n      1 : 1.125\n      3 : 0.5\n"
    "    col 1 : locations 3 to 5\n      0 : 1\n      1 : 3\n      2 : 0.25\n"
    "    col 2 : locations 6 to 8\n      1 : 0.25\n      2 : 5\n      3 : 1\n"
    "    col 3 : locations 9 to 11\n      0 : 0.5\n      2 : 1\n      3 : 2\n";
const std::string triplets =
    "2\n2\n2\n4\n4\n1\nCSparse Version 3.2.0\ntriplet: 4-by-4, nzmax: 12 nnz: 12\n"
    "    0 0 : 4\n    0 1 : 1\n    0 3 : 0.5\n    1 0 : 1.125\n    1 1 : 3\n    1 2 : 0.25\n"
    "    2 1 : 0.25\n    2 2 : 5\n    2 3 : 1\n    3 0 : 0.5\n    3 2 : 1\n    3 3 : 2\n";
// Four blocks of 2 x 2, compressed by rows.
const std::string blocks =
    "2\n2\n1\n4\n4\n4\n2\n2\n2\t4\t\n2\t4\t\n3\n4\n0\t2\t4\t\n0\t1\t0\t1\t\n"
    "0\n4\n1.125\n1\n3\n1\n0\n.25\n.5\n0\n2\n0\n.5\n.25\n0\n3\n5\n1\n1\n2\n";

TEST(TextProblem, ReadInEveryStorage) {
  for (const std::string& matrix : {dense, columns, triplets, blocks}) {
    const SavedProblem saved = parse_text_problem(matrix + vectors, "problem.dat");
    EXPECT_EQ(saved.problem.dimension, 2);
    EXPECT_EQ(saved.problem.pairs(), 2);
    EXPECT_EQ(saved.problem.W.is_dense(), matrix == dense);
    EXPECT_EQ(saved.problem.W.is_sparse() ? Matrix(saved.problem.W.sparse()) : saved.problem.W.dense(), expected_W())
        << matrix;
    EXPECT_EQ(saved.problem.q, Vector((Vector(4) << -1.0, 0.5, 0.1, -0.3).finished()));
    EXPECT_EQ(saved.problem.mu, Vector((Vector(2) << 0.3, 0.7).finished()));
  }
}

TEST(TextProblem, WrittenAndReadWithEqualBits) {
  for (const int dimension : {2, 3}) {
    Problem problem = random_problem(dimension, 9, 31);
    for (const bool sparse : {false, true}) {
      if (sparse) problem.W = Delassus(thinned(problem.W.dense()));
      const Problem read = parse_text_problem(text_of(problem), "problem.dat").problem;
      ASSERT_EQ(read.W.is_sparse(), sparse);
      if (sparse)
        EXPECT_EQ(Matrix(read.W.sparse()), Matrix(problem.W.sparse()));
      else
        EXPECT_EQ(read.W.dense(), problem.W.dense());
      EXPECT_EQ(read.q, problem.q);
      EXPECT_EQ(read.mu, problem.mu);
    }
  }
}

TEST(TextProblem, WhatTheLayoutCannotHoldIsRefused) {
  Problem problem = random_problem(2, 2, 1);
  problem.G = Matrix::Ones(4, 1);
  problem.f = Vector::Ones(1);
  EXPECT_THROW(text_of(problem), std::invalid_argument);
}

std::string mistake_in(const std::string& text) {
  try {
    parse_text_problem(text, "p.dat");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no mistake";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST(TextProblem, EveryMistakeHasItsPlace) {
  const auto expect = [](const std::string& text, const char* message) {
    EXPECT_THAT(mistake_in(text), testing::StartsWith(message)) << text;
  };
  expect("", "p.dat:1:1: dimension: the file ends here");
  expect("5\n", "p.dat:1:1: dimension: must be from 2 to 3, not 5");
  expect("scabo: 1\n", "p.dat:1:1: dimension: must be a whole number, not 'scabo:'");
  expect("2\n-1\n", "p.dat:2:1: number of pairs: must be from 0 to ");
  expect("2\n2\n3\n", "p.dat:3:1: storage of W (0 dense, 1 blocks, 2 sparse): must be from 0 to 2, not 3");
  expect("2\n2\n0\n4\n5\n", "p.dat:5:1: columns of W (dimension times pairs): must be 4, not 5");
  expect("2\n30000000\n0\n60000000\n60000000\n1 2",
         "p.dat:5:1: columns of W (dimension times pairs): 60000000 values must follow");
  expect(replaced(dense + vectors, "1.125", "nan"), "p.dat:7:3: W: must be a finite number, not 'nan'");
  expect(replaced(dense + vectors, "1.125", "1,125"), "p.dat:7:3: W: must be a number, not '1,125'");
  expect(replaced(dense + vectors, "1e-1", "inf"), "p.dat:11:8: q: must be a finite number, not 'inf'");
  expect(replaced(dense + vectors, "7e-1", "-7e-1"),
         "p.dat:12:5: mu: a coefficient of friction must be 0 or more, not -0.7");
  expect(dense + vectors + "1", "p.dat:13:1: end: data follow after mu");
  expect(dense + "-1 0.5", "p.dat:11:7: q: the file ends here");
  expect(replaced(columns + vectors, "col 1", "col 2"), "p.dat:13:9: column of W: must be 1, not 2");
  expect(replaced(columns + vectors, "9 to 11", "9 to 12"), "p.dat:21:28: last location: must be from 8 to 11, not 12");
  expect(replaced(columns + vectors, "9 to 11", "9 to 10"), "p.dat:23:11: W: the columns hold 11 entries, nnz is 12");
  expect(replaced(columns + vectors, "      2 : 5", "      4 : 5"), "p.dat:19:7: row: must be from 0 to 3, not 4");
  expect(replaced(columns + vectors, "4-by-4", "4 by 4"), "p.dat:8:1: sizes of W: must be like '4-by-4,'");
  expect(replaced(triplets + vectors, "nnz: 12", "nnz: 1200"), "p.dat:8:33: nnz: 1200 values must follow");
  expect(replaced(triplets + vectors, "0 3 :", "0 3"), "p.dat:11:9: W: must be ':', not '0.5'");
  expect(replaced(blocks + vectors, "2\t4\t\n2", "2\t3\t\n2"), "p.dat:9:3: ends of block rows: the last must be 4");
  expect(replaced(blocks + vectors, "0\t1\t0\t1", "0\t1\t0\t2"),
         "p.dat:14:7: block columns: must be from 0 to 1, not 2");
  expect(replaced(blocks + vectors, "0\t2\t4", "0\t3\t2"), "p.dat:13:5: row pointers: must be from 3 to 4, not 2");
}

}  // namespace
}  // namespace scabo::contact
