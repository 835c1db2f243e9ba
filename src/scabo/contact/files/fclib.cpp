#include "scabo/contact/files/fclib.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "scabo/contact/files/hdf5_file.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::contact {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Index = Eigen::Index;
using Integers = std::vector<std::int64_t>;
constexpr std::int64_t most_rows = 100'000'000;

// ---- reading ----

/// Rows and columns of the entries of a matrix, however they are stored.
struct Entries {
  Integers row, column;
};

void expect_at_least(const Hdf5Reader& file, const std::string& path, std::size_t size, std::int64_t least,
                     const char* why) {
  if (static_cast<std::int64_t>(size) < least)
    file.fail(path, fmt::format("must hold {} values ({}), not {}", least, why, size));
}

/// Expands pointers of compressed columns (or rows) to one index for each entry.
Integers spread(const Hdf5Reader& file, const std::string& path, const Integers& p, std::size_t values) {
  Integers index;
  index.reserve(values);
  if (p.front() != 0) file.fail(path, fmt::format("must start with 0, not {}", p.front()));
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    if (p[k + 1] < p[k] || p[k + 1] > static_cast<std::int64_t>(values))
      file.fail(path, fmt::format("entry {} is {}: must be from {} (the one before) to {} (the values of x)", k + 1,
                                  p[k + 1], p[k], values));
    index.insert(index.end(), static_cast<std::size_t>(p[k + 1] - p[k]), static_cast<std::int64_t>(k));
  }
  return index;
}

Entries read_entries(const Hdf5Reader& file, const std::string& group, std::int64_t m, std::int64_t n,
                     std::size_t values) {
  const std::int64_t nz = file.integer(group + "/nz");
  if (nz < -2)
    file.fail(
        group + "/nz",
        fmt::format("must be -1 (compressed columns), -2 (compressed rows) or the number of triplets, not {}", nz));
  Integers p = file.integers(group + "/p"), i = file.integers(group + "/i");
  if (nz >= 0) {
    expect_at_least(file, group + "/p", p.size(), nz, "nz");
    expect_at_least(file, group + "/i", i.size(), nz, "nz");
    expect_at_least(file, group + "/x", values, nz, "nz");
    p.resize(static_cast<std::size_t>(nz));
    i.resize(static_cast<std::size_t>(nz));
    return {std::move(i), std::move(p)};
  }
  const std::int64_t pointers = (nz == -1 ? n : m) + 1;
  if (static_cast<std::int64_t>(p.size()) != pointers)
    file.fail(group + "/p", fmt::format("must hold {} values ({} + 1, because nz is {}), not {}", pointers,
                                        nz == -1 ? "n" : "m", nz, p.size()));
  Integers other = spread(file, group + "/p", p, values);
  expect_at_least(file, group + "/i", i.size(), static_cast<std::int64_t>(other.size()), "the last of p");
  i.resize(other.size());
  return nz == -1 ? Entries{std::move(i), std::move(other)} : Entries{std::move(other), std::move(i)};
}

Sparse read_matrix(const Hdf5Reader& file, const std::string& group) {
  const std::int64_t m = file.integer(group + "/m"), n = file.integer(group + "/n");
  for (const auto& [name, size] : {std::pair{"/m", m}, std::pair{"/n", n}})
    if (size < 0 || size > most_rows)
      file.fail(group + name, fmt::format("must be from 0 to {}, not {}", most_rows, size));
  const Vector x = file.numbers(group + "/x");
  const Entries entries = read_entries(file, group, m, n, static_cast<std::size_t>(x.size()));
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.row.size());
  for (std::size_t k = 0; k < entries.row.size(); ++k) {
    const std::int64_t row = entries.row[k], column = entries.column[k];
    if (row < 0 || row >= m || column < 0 || column >= n)
      file.fail(group, fmt::format("entry {} is in row {} and column {} (counted from 0) of a matrix of {} x {}", k,
                                   row, column, m, n));
    const double value = x[static_cast<Index>(k)];
    if (!std::isfinite(value))
      file.fail(group + "/x", fmt::format("entry {} is {}: must be a finite number", k, value));
    triplets.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  }
  Sparse A(m, n);
  A.setFromTriplets(triplets.begin(), triplets.end());  // repeated entries are added, as in CSparse
  return A;
}

Vector read_vector(const Hdf5Reader& file, const std::string& path, Index size, const char* why) {
  Vector values = file.numbers(path);
  if (values.size() != size) file.fail(path, fmt::format("must hold {} values ({}), not {}", size, why, values.size()));
  for (Index k = 0; k < size; ++k)
    if (!std::isfinite(values[k]))
      file.fail(path, fmt::format("entry {} is {}: must be a finite number", k, values[k]));
  return values;
}

int read_dimension(const Hdf5Reader& file, const std::string& path) {
  const std::int64_t dimension = file.integer(path);
  if (dimension != 2 && dimension != 3) file.fail(path, fmt::format("must be 2 or 3, not {}", dimension));
  return static_cast<int>(dimension);
}

/// Number of pairs of `rows` rows.
Index pairs_of(const Hdf5Reader& file, const std::string& path, Index rows, int dimension) {
  if (rows % dimension != 0)
    file.fail(path, fmt::format("is {}, which is not a multiple of spacedim, {}: every pair has a normal and {}", rows,
                                dimension, dimension == 3 ? "two tangents" : "a tangent"));
  return rows / dimension;
}

Vector read_mu(const Hdf5Reader& file, const std::string& path, Index pairs) {
  Vector mu = read_vector(file, path, pairs, "one for each pair");
  for (Index k = 0; k < pairs; ++k)
    if (mu[k] < 0.0)
      file.fail(path, fmt::format("entry {} is {}: a coefficient of friction must be 0 or more", k, mu[k]));
  return mu;
}

/// `cohesion` and `tension` in files of Scabo; tension may be infinite.
Vector read_strength(const Hdf5Reader& file, const std::string& path, Index pairs) {
  if (!file.has(path)) return {};
  Vector values = file.numbers(path);
  if (values.size() != pairs)
    file.fail(path, fmt::format("must hold {} values (one for each pair), not {}", pairs, values.size()));
  for (Index k = 0; k < pairs; ++k)
    if (!(values[k] >= 0.0)) file.fail(path, fmt::format("entry {} is {}: must be 0 or more", k, values[k]));
  return values;
}

/// `mu_backward` in files of Scabo, of plane problems.
Vector read_backward(const Hdf5Reader& file, const std::string& path, Index pairs, int dimension) {
  if (!file.has(path)) return {};
  if (dimension != 2) file.fail(path, "coefficients that differ by direction are for spacedim 2");
  return read_mu(file, path, pairs);
}

/// V, R, s: rigid motions if R = 0; otherwise l = -R^-1 (V' r + s) is eliminated into W and q.
void read_constraints(const Hdf5Reader& file, Problem& problem) {
  const std::string V_path = "fclib_local/V", R_path = "fclib_local/R";
  problem.G.resize(problem.q.size(), 0);
  problem.f = Vector::Zero(0);
  if (!file.has(V_path) && !file.has(R_path)) return;
  const Sparse V = read_matrix(file, V_path), R = read_matrix(file, R_path);
  if (V.rows() != problem.q.size())
    file.fail(V_path + "/m", fmt::format("must be {}, as many as rows of W, not {}", problem.q.size(), V.rows()));
  if (R.rows() != V.cols() || R.cols() != V.cols())
    file.fail(R_path,
              fmt::format("must be {0} x {0}, as many as columns of V, not {1} x {2}", V.cols(), R.rows(), R.cols()));
  const Vector s = read_vector(file, "fclib_local/vectors/s", V.cols(), "one for each column of V");
  if (R.norm() == 0.0) {
    problem.G = RigidMap(V);
    problem.f = s;
    return;
  }
  const Eigen::FullPivLU<Matrix> lu{Matrix(R)};
  if (!lu.isInvertible())
    file.fail(R_path, "must be zero or nonsingular: constraints of both kinds in one problem are not supported");
  const Matrix X = lu.solve(Matrix(V.transpose()));
  problem.W = Delassus(Matrix(problem.W.dense() - Matrix(V * X)));
  problem.q -= V * Vector(lu.solve(s));
}

/// `guesses/1` and `solution`: r and l, if present.
void read_known(const Hdf5Reader& file, const std::string& group, const Problem& problem, Vector& r, Vector& l) {
  if (!file.has(group + "/r")) return;
  r = read_vector(file, group + "/r", problem.q.size(), "as many as q");
  l = Vector::Zero(problem.G.cols());
  if (problem.G.cols() > 0 && file.has(group + "/l"))
    l = read_vector(file, group + "/l", problem.G.cols(), "one for each column of V");
}

/// Correspondence of the pairs to contact.csv: only in files written by a run of Scabo.
void read_origin(const Hdf5Reader& file, SavedProblem& saved) {
  const Index pairs = saved.problem.pairs();
  if (file.has("scabo/force_scale")) {
    saved.force_scale = read_vector(file, "scabo/force_scale", 1, "one number")[0];
    if (saved.force_scale < 0.0)
      file.fail("scabo/force_scale", fmt::format("must be 0 or more, not {}", saved.force_scale));
  }
  if (!file.has("scabo/contact_of_pair")) return;
  for (int k = 1; file.has(fmt::format("scabo/contacts/{}", k)); ++k)
    saved.contacts.push_back(file.text(fmt::format("scabo/contacts/{}", k)));
  const auto read = [&](const std::string& path, std::int64_t least, std::int64_t most) {
    const Integers values = file.integers(path);
    if (static_cast<Index>(values.size()) != pairs)
      file.fail(path, fmt::format("must hold {} values (one for each pair), not {}", pairs, values.size()));
    std::vector<int> numbers;
    for (const std::int64_t value : values) {
      if (value < least || value > most)
        file.fail(path, fmt::format("must be from {} to {}, not {}", least, most, value));
      numbers.push_back(static_cast<int>(value));
    }
    return numbers;
  };
  saved.contact_of_pair = read("scabo/contact_of_pair", 0, static_cast<std::int64_t>(saved.contacts.size()) - 1);
  saved.number_of_pair = read("scabo/number_of_pair", 1, std::numeric_limits<int>::max());
}

SavedProblem read_local(const Hdf5Reader& file) {
  SavedProblem saved;
  saved.layout = "FCLIB, local form";
  Problem& problem = saved.problem;
  problem.dimension = read_dimension(file, "fclib_local/spacedim");
  Sparse W = read_matrix(file, "fclib_local/W");
  if (W.rows() != W.cols()) file.fail("fclib_local/W", fmt::format("must be square, not {} x {}", W.rows(), W.cols()));
  const Index pairs = pairs_of(file, "fclib_local/W/m", W.rows(), problem.dimension);
  problem.q = read_vector(file, "fclib_local/vectors/q", W.rows(), "as many as rows of W");
  problem.mu = read_mu(file, "fclib_local/vectors/mu", pairs);
  problem.mu_backward = read_backward(file, "fclib_local/vectors/mu_backward", pairs, problem.dimension);
  problem.cohesion = read_strength(file, "fclib_local/vectors/cohesion", pairs);
  problem.tension = read_strength(file, "fclib_local/vectors/tension", pairs);
  if (2 * W.nonZeros() >= W.rows() * W.cols())  // dense storage is then smaller and faster
    problem.W = Delassus(Matrix(W));
  else
    problem.W = Delassus(std::move(W));
  read_constraints(file, problem);
  read_origin(file, saved);
  return saved;
}

SavedProblem read_global(const Hdf5Reader& file) {
  SavedProblem saved;
  saved.layout = "FCLIB, global form";
  GlobalProblem global;
  global.dimension = read_dimension(file, "fclib_global/spacedim");
  global.M = read_matrix(file, "fclib_global/M");
  const Index n = global.M.rows();
  if (global.M.cols() != n) file.fail("fclib_global/M", fmt::format("must be square, not {} x {}", n, global.M.cols()));
  global.H = read_matrix(file, "fclib_global/H");
  if (global.H.rows() != n)
    file.fail("fclib_global/H/m", fmt::format("must be {}, as many as rows of M, not {}", n, global.H.rows()));
  const Index pairs = pairs_of(file, "fclib_global/H/n", global.H.cols(), global.dimension);
  global.f = read_vector(file, "fclib_global/vectors/f", n, "as many as rows of M");
  global.w = read_vector(file, "fclib_global/vectors/w", global.H.cols(), "as many as columns of H");
  global.mu = read_mu(file, "fclib_global/vectors/mu", pairs);
  global.G = Sparse(n, 0);
  global.b = Vector::Zero(0);
  if (file.has("fclib_global/G")) {
    global.G = read_matrix(file, "fclib_global/G");
    if (global.G.rows() != n)
      file.fail("fclib_global/G/m", fmt::format("must be {}, as many as rows of M, not {}", n, global.G.rows()));
    global.b = read_vector(file, "fclib_global/vectors/b", global.G.cols(), "as many as columns of G");
  }
  try {
    saved.reduction = std::make_shared<const GlobalReduction>(std::move(global));
    saved.problem = saved.reduction->problem();
  } catch (const SingularProblem& error) {
    file.fail("fclib_global/M", std::string(error.what()) + ": the motion without contact is not determined");
  }
  return saved;
}

// ---- writing ----

void write_matrix(Hdf5Writer& file, const std::string& group, Sparse A) {
  A.makeCompressed();
  const auto entries = static_cast<std::size_t>(A.nonZeros());
  file.integer(group + "/m", static_cast<int>(A.rows()));
  file.integer(group + "/n", static_cast<int>(A.cols()));
  file.integer(group + "/nz", -1);
  file.integer(group + "/nzmax", static_cast<int>(entries));
  file.integers(group + "/p", std::vector<int>(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1));
  file.integers(group + "/i", std::vector<int>(A.innerIndexPtr(), A.innerIndexPtr() + entries));
  file.numbers(group + "/x", A.valuePtr(), entries);
}

/// Every entry of a dense matrix, including zeros, so that it is read back as dense.
Sparse all_entries(const Matrix& A) {
  if (A.size() > std::numeric_limits<int>::max())
    throw std::runtime_error(
        fmt::format("a matrix of {} x {} has more entries than FCLIB's layout can store", A.rows(), A.cols()));
  Sparse S(A.rows(), A.cols());
  S.reserve(Eigen::VectorXi::Constant(A.cols(), static_cast<int>(A.rows())));
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i < A.rows(); ++i) S.insert(i, j) = A(i, j);
  return S;
}

void write_forces(Hdf5Writer& file, const std::string& group, const Problem& problem, const Vector& r,
                  const Vector& l) {
  Vector u = problem.W.times(r) + problem.q;
  if (l.size() > 0) u += problem.G * l;
  file.numbers(group + "/r", r);
  file.numbers(group + "/u", u);
  if (l.size() > 0) file.numbers(group + "/l", l);
}

void write_info(Hdf5Writer& file, const std::string& form, const std::string& title, const std::string& description) {
  file.text(form + "/info/title", title);
  file.text(form + "/info/description", description);
  file.text(form + "/info/math_info", "");
}

}  // namespace

SavedProblem read_fclib(const std::string& name) {
  const Hdf5Reader file(name);
  const bool local = file.has("fclib_local");
  if (!local && !file.has("fclib_global")) {
    std::string there;
    for (const std::string& group : file.names("/")) there += (there.empty() ? "" : ", ") + group.substr(0, 60);
    throw InputError(
        name,
        {{{},
          fmt::format(
              "has neither fclib_local nor fclib_global, so that it is not a problem in FCLIB's layout (available: {})",
              there.empty() ? "nothing" : there.substr(0, 300))}});
  }
  SavedProblem saved = local ? read_local(file) : read_global(file);
  const std::string form = local ? "fclib_local" : "fclib_global";
  saved.title = file.text(form + "/info/title");
  saved.description = file.text(form + "/info/description");
  read_known(file, "guesses/1", saved.problem, saved.start.p, saved.start.a);
  read_known(file, "solution", saved.problem, saved.r, saved.a);
  return saved;
}

void write_fclib(const std::string& name, const SavedProblem& saved) {
  const Problem& problem = saved.problem;
  Hdf5Writer file(name);
  file.integer("fclib_local/spacedim", problem.dimension);
  write_matrix(file, "fclib_local/W", problem.W.is_sparse() ? problem.W.sparse() : all_entries(problem.W.dense()));
  file.numbers("fclib_local/vectors/q", problem.q);
  file.numbers("fclib_local/vectors/mu", problem.mu);
  if (problem.mu_backward.size() > 0) file.numbers("fclib_local/vectors/mu_backward", problem.mu_backward);
  if (problem.cohesion.size() > 0) file.numbers("fclib_local/vectors/cohesion", problem.cohesion);
  if (problem.tension.size() > 0) file.numbers("fclib_local/vectors/tension", problem.tension);
  if (problem.G.cols() > 0) {
    write_matrix(file, "fclib_local/V", problem.G.sparse());
    write_matrix(file, "fclib_local/R", Sparse(problem.G.cols(), problem.G.cols()));
    file.numbers("fclib_local/vectors/s", problem.f);
  }
  write_info(file, "fclib_local", saved.title, saved.description);
  if (saved.start.p.size() > 0) {
    file.integer("guesses/number_of_guesses", 1);
    write_forces(file, "guesses/1", problem, saved.start.p, saved.start.a);
  }
  if (saved.r.size() > 0) write_forces(file, "solution", problem, saved.r, saved.a);
  file.numbers("scabo/force_scale", &saved.force_scale, 1);
  if (!saved.contact_of_pair.empty()) {
    for (std::size_t k = 0; k < saved.contacts.size(); ++k)
      file.text(fmt::format("scabo/contacts/{}", k + 1), saved.contacts[k]);
    file.integers("scabo/contact_of_pair", saved.contact_of_pair);
    file.integers("scabo/number_of_pair", saved.number_of_pair);
  }
  file.finish();
}

void write_fclib(const std::string& name, const GlobalProblem& global, const std::string& title, const Vector& r) {
  Hdf5Writer file(name);
  file.integer("fclib_global/spacedim", global.dimension);
  write_matrix(file, "fclib_global/M", global.M);
  write_matrix(file, "fclib_global/H", global.H);
  file.numbers("fclib_global/vectors/f", global.f);
  file.numbers("fclib_global/vectors/w", global.w);
  file.numbers("fclib_global/vectors/mu", global.mu);
  if (global.G.cols() > 0) {
    write_matrix(file, "fclib_global/G", global.G);
    file.numbers("fclib_global/vectors/b", global.b);
  }
  write_info(file, "fclib_global", title, "");
  if (r.size() > 0) {
    const Vector motion = GlobalReduction(global).motion(r);
    const Vector v = motion.head(global.M.rows()), l = motion.tail(global.G.cols());
    file.numbers("solution/v", v);
    file.numbers("solution/u", global.H.transpose() * v + global.w);
    file.numbers("solution/r", r);
    if (l.size() > 0) file.numbers("solution/l", l);
  }
  file.finish();
}

}  // namespace scabo::contact
