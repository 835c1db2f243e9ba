#include "scabo/contact/files/text_problem.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace scabo::contact {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Index = Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr long most_numbers = 100'000'000;
constexpr long most_entries = std::numeric_limits<int>::max();

/// Words of a text with their positions.
class Words {
 public:
  Words(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::string_view next(const char* what) {
    skip_space();
    at_ = {line_, static_cast<int>(position_ - line_start_) + 1, what};
    const std::size_t start = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    if (start == position_) fail("the file ends here: use a complete copy, whose sizes are those of its data");
    return text_.substr(start, position_ - start);
  }

  long integer(const char* what, long least, long most) { return integer_in(next(what), least, most); }

  /// A whole number within a word such as `4-by-4,`.
  long integer_in(std::string_view word, long least, long most) const {
    long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("must be a whole number, not '{}'", shown(word)));
    if (least == most && value != least) fail(fmt::format("must be {}, not {}", least, value));
    if (value < least || value > most) fail(fmt::format("must be from {} to {}, not {}", least, most, value));
    return value;
  }

  double number(const char* what) {
    const std::string_view word = next(what);
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("must be a number, not '{}'", shown(word)));
    if (!std::isfinite(value)) fail(fmt::format("must be a finite number, not '{}'", shown(word)));
    return value;
  }

  void expect(const char* what, std::string_view word) {
    const std::string_view found = next(what);
    if (found != word) fail(fmt::format("must be '{}', not '{}'", word, shown(found)));
  }

  void skip_line() {
    while (position_ < text_.size() && text_[position_] != '\n') ++position_;
  }

  void expect_end() {
    skip_space();
    if (position_ == text_.size()) return;
    next("end");
    fail(
        "data follow after mu, where a problem of the sizes at the start ends: write one of these sizes, in local form "
        "and without rolling friction");
  }

  /// Position of the last word read.
  [[noreturn]] void fail(std::string message) const { throw InputError(file_, {{at_, std::move(message)}}); }

  /// Checks that there cannot be more values than remaining bytes, before memory is allocated for them.
  void expect_room(double values) const {
    if (values > static_cast<double>(text_.size() - position_))
      fail(fmt::format(
          "{:.0f} values must follow, but only {} bytes are left: use a complete copy, whose sizes are those "
          "of its data",
          values, text_.size() - position_));
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static std::string shown(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 40)) text += c > 0x20 && c < 0x7f ? c : '?';
    return text;
  }
  void skip_space() {
    for (; position_ < text_.size() && is_space(text_[position_]); ++position_) {
      if (text_[position_] != '\n') continue;
      ++line_;
      line_start_ = position_ + 1;
    }
  }

  std::string_view text_;
  std::string file_;
  Source at_;
  std::size_t position_ = 0, line_start_ = 0;
  int line_ = 1;
};

/// 0: all values, column by column.
Matrix read_dense(Words& words, Index size) {
  words.integer("rows of W", size, size);
  words.integer("columns of W", size, size);
  words.expect_room(static_cast<double>(size) * static_cast<double>(size));
  Matrix W(size, size);
  for (Index j = 0; j < size; ++j)
    for (Index i = 0; i < size; ++i) W(i, j) = words.number("W");
  return W;
}

/// 0, then the end of each of `count` block rows, the last of which is `size`.
std::vector<long> read_ends(Words& words, const char* what, long count, long size) {
  std::vector<long> ends{0};
  for (long k = 0; k < count; ++k) ends.push_back(words.integer(what, ends.back() + 1, size));
  if (ends.back() != size) words.fail(fmt::format("the last must be {}, the size of W, not {}", size, ends.back()));
  return ends;
}

/// 1: dense blocks in compressed rows.
Sparse read_blocks(Words& words, Index size) {
  const long blocks = words.integer("number of blocks", 0, most_entries);
  Sparse W(size, size);
  if (blocks == 0) return W;
  const long rows = words.integer("block rows", 1, size), columns = words.integer("block columns", 1, size);
  const std::vector<long> row_end = read_ends(words, "ends of block rows", rows, size);
  const std::vector<long> column_end = read_ends(words, "ends of block columns", columns, size);
  const long pointers = words.integer("number of row pointers", 1, rows + 1);
  words.integer("number of blocks, again", blocks, blocks);
  std::vector<long> first, column;
  for (long k = 0; k < pointers; ++k) first.push_back(words.integer("row pointers", k == 0 ? 0 : first.back(), blocks));
  if (first.front() != 0 || first.back() != blocks)
    words.fail(fmt::format("row pointers must go from 0 to {}", blocks));
  for (long k = 0; k < blocks; ++k) column.push_back(words.integer("block columns", 0, columns - 1));
  Triplets entries;
  for (std::size_t row = 0; row + 1 < first.size(); ++row)
    for (long block = first[row]; block < first[row + 1]; ++block) {
      const auto at = static_cast<std::size_t>(column[static_cast<std::size_t>(block)]);
      words.integer("number of a block", block, block);
      for (long j = column_end[at]; j < column_end[at + 1]; ++j)
        for (long i = row_end[row]; i < row_end[row + 1]; ++i)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(j), words.number("W"));
    }
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

/// From `sizes`, `4-by-4,`, through `nzmax: 12 nnz: 12,`: the number of entries.
long read_sparse_sizes(Words& words, std::string_view sizes, Index size) {
  if (sizes.ends_with(',')) sizes.remove_suffix(1);
  const std::size_t by = sizes.find("-by-");
  if (by == std::string_view::npos) words.fail("must be like '4-by-4,'");
  words.integer_in(sizes.substr(0, by), size, size);
  words.integer_in(sizes.substr(by + 4), size, size);
  words.expect("sizes of W", "nzmax:");
  words.integer("nzmax", 0, most_entries);
  words.expect("sizes of W", "nnz:");
  std::string_view entries = words.next("nnz");
  if (entries.ends_with(',')) entries.remove_suffix(1);
  const long count = words.integer_in(entries, 0, most_entries);
  words.expect_room(static_cast<double>(count));
  return count;
}

Triplets read_triplets(Words& words, Index size) {
  words.expect("sizes of W", "triplet:");
  const long count = read_sparse_sizes(words, words.next("sizes of W"), size);
  Triplets entries;
  for (long k = 0; k < count; ++k) {
    const long i = words.integer("row", 0, size - 1), j = words.integer("column", 0, size - 1);
    words.expect("W", ":");
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), words.number("W"));
  }
  return entries;
}

Triplets read_columns(Words& words, Index size) {
  const long count = read_sparse_sizes(words, words.next("sizes of W"), size);
  words.skip_line();  // its norm
  Triplets entries;
  long done = 0;
  for (long j = 0; j < size; ++j) {
    words.expect("column of W", "col");
    words.integer("column of W", j, j);
    words.expect("column of W", ":");
    words.expect("column of W", "locations");
    words.integer("first location", done, done);
    words.expect("column of W", "to");
    const long last = words.integer("last location", done - 1, count - 1);
    for (; done <= last; ++done) {
      const long i = words.integer("row", 0, size - 1);
      words.expect("W", ":");
      entries.emplace_back(static_cast<int>(i), static_cast<int>(j), words.number("W"));
    }
  }
  if (done != count) words.fail(fmt::format("the columns hold {} entries, nnz is {}", done, count));
  return entries;
}

/// 2: as CSparse prints it.
Sparse read_sparse(Words& words, Index size) {
  const long kind = words.integer("kind of sparse W (1 triplets, 2 compressed columns)", 1, 2);
  words.next("version of CSparse");
  words.skip_line();
  const Triplets entries = kind == 1 ? read_triplets(words, size) : read_columns(words, size);
  Sparse W(size, size);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

using Text = std::back_insert_iterator<fmt::memory_buffer>;

void write_dense(Text to, const Matrix& W) {
  fmt::format_to(to, "{}\t{}\n", W.rows(), W.cols());
  for (Index j = 0; j < W.cols(); ++j) {
    for (Index i = 0; i < W.rows(); ++i) fmt::format_to(to, "{:.17g} ", W(i, j));
    fmt::format_to(to, "\n");
  }
}

void write_sparse(Text to, Sparse W) {
  W.makeCompressed();
  double norm = 0.0;  // the largest sum of a column
  for (Index j = 0; j < W.cols(); ++j) {
    double sum = 0.0;
    for (Sparse::InnerIterator at(W, j); at; ++at) sum += std::abs(at.value());
    norm = std::max(norm, sum);
  }
  fmt::format_to(to, "2\nCSparse Version 3.2.0\n{0}-by-{0}, nzmax: {1} nnz: {1}, 1-norm: {2:g}\n", W.cols(),
                 W.nonZeros(), norm);
  for (Index j = 0; j < W.cols(); ++j) {
    fmt::format_to(to, "    col {} : locations {} to {}\n", j, W.outerIndexPtr()[j], W.outerIndexPtr()[j + 1] - 1);
    for (Sparse::InnerIterator at(W, j); at; ++at) fmt::format_to(to, "      {} : {:.17g}\n", at.row(), at.value());
  }
}

void write_vector(Text to, const Vector& values) {
  for (const double value : values) fmt::format_to(to, "{:.17g} ", value);
  fmt::format_to(to, "\n");
}

}  // namespace

SavedProblem parse_text_problem(std::string_view text, const std::string& file) {
  Words words(text, file);
  SavedProblem saved;
  saved.layout = "Siconos text";
  Problem& problem = saved.problem;
  problem.dimension = static_cast<int>(words.integer("dimension", 2, 3));
  const long pairs = words.integer("number of pairs", 0, most_numbers / 3);
  const Index size = problem.dimension * pairs;
  const long storage = words.integer("storage of W (0 dense, 1 blocks, 2 sparse)", 0, 2);
  words.integer("rows of W (dimension times pairs)", size, size);
  words.integer("columns of W (dimension times pairs)", size, size);
  words.expect_room(static_cast<double>(size));  // q alone
  if (storage == 0) problem.W = Delassus(read_dense(words, size));
  if (storage == 1) problem.W = Delassus(read_blocks(words, size));
  if (storage == 2) problem.W = Delassus(read_sparse(words, size));
  problem.q.resize(size);
  problem.mu.resize(pairs);
  for (double& value : problem.q) value = words.number("q");
  for (double& value : problem.mu) {
    value = words.number("mu");
    if (value < 0.0) words.fail(fmt::format("a coefficient of friction must be 0 or more, not {}", value));
  }
  words.expect_end();
  problem.G.resize(size, 0);
  problem.f = Vector::Zero(0);
  return saved;
}

SavedProblem read_text_problem(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file, {{{}, std::string("cannot be read: ") + std::strerror(errno)}});
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_text_problem(text, file);
}

std::string text_of(const Problem& problem) {
  if (problem.G.cols() > 0 || problem.cohesion.size() > 0 || problem.tension.size() > 0 ||
      problem.mu_backward.size() > 0)
    throw std::invalid_argument(
        "the text layout cannot store rigid motions, cohesion, tension and coefficients that differ by direction: "
        "write "
        "the problem as HDF5");
  fmt::memory_buffer text;
  const auto to = std::back_inserter(text);
  const Index size = problem.q.size();
  const bool sparse = problem.W.is_sparse();
  fmt::format_to(to, "{}\n{}\n{}\n{}\n{}\n", problem.dimension, problem.pairs(), sparse ? 2 : 0, size, size);
  if (sparse)
    write_sparse(to, problem.W.sparse());
  else
    write_dense(to, problem.W.dense());
  write_vector(to, problem.q);
  write_vector(to, problem.mu);
  return fmt::to_string(text);
}

}  // namespace scabo::contact
