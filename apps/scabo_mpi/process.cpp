#include "process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <thread>

#include "mumps.hpp"
#include "own_fields.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/run/failures.hpp"
#include "share.hpp"

namespace scabo::mpi {

namespace {

constexpr int failure = 3;                                  // exit status
constexpr std::size_t most_at_once = std::size_t{1} << 30;  // bytes: MPI counts with int

/// What an exception of a rank was, for rank 0 to throw again.
enum class Kind : int { none, input, memory, other };

Bytes pack(const InputError& error) {
  Packer packer;
  packer.add(error.file());
  packer.add(error.diagnostics().size());
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    packer.add(diagnostic.at.line);
    packer.add(diagnostic.at.column);
    packer.add(diagnostic.at.path);
    packer.add(diagnostic.message);
  }
  return std::move(packer).take();
}

[[noreturn]] void throw_input_error(const Bytes& bytes) {
  Unpacker unpacker(bytes);
  std::string file = unpacker.get_text();
  std::vector<Diagnostic> diagnostics(unpacker.get<std::size_t>());
  for (Diagnostic& diagnostic : diagnostics) {
    diagnostic.at.line = unpacker.get<int>();
    diagnostic.at.column = unpacker.get<int>();
    diagnostic.at.path = unpacker.get_text();
    diagnostic.message = unpacker.get_text();
  }
  throw InputError(std::move(file), std::move(diagnostics));
}

std::string machine_name() {
  char name[256] = "";
  return gethostname(name, sizeof name - 1) == 0 ? name : "?";
}

}  // namespace

Process::Process(MPI_Comm comm) : comm_(comm), machine_(machine_name()) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &count_);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &on_this_machine_);
  MPI_Comm_free(&here);
}

Process::~Process() = default;

Bytes Process::broadcast(const Bytes* from_root) const {
  Bytes bytes;
  if (from_root) bytes = *from_root;
  unsigned long long size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, comm_);
  bytes.resize(size);
  for (std::size_t at = 0; at < bytes.size(); at += most_at_once)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(most_at_once, bytes.size() - at)), MPI_BYTE, 0, comm_);
  return bytes;
}

void Process::send(const Bytes& bytes, int to, int tag) const {
  const unsigned long long size = bytes.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, to, tag, comm_);
  for (std::size_t at = 0; at < bytes.size(); at += most_at_once)
    MPI_Send(bytes.data() + at, static_cast<int>(std::min(most_at_once, bytes.size() - at)), MPI_BYTE, to, tag, comm_);
}

Bytes Process::received(int from, int tag) const {
  unsigned long long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG_LONG, from, tag, comm_, MPI_STATUS_IGNORE);
  Bytes bytes(size);
  for (std::size_t at = 0; at < bytes.size(); at += most_at_once)
    MPI_Recv(bytes.data() + at, static_cast<int>(std::min(most_at_once, bytes.size() - at)), MPI_BYTE, from, tag, comm_,
             MPI_STATUS_IGNORE);
  return bytes;
}

Bytes Process::distributed(const std::function<Bytes(int)>& message) const {
  constexpr int tag = 11;
  Bytes own;
  together([&] {
    if (rank_ != 0) {
      own = received(0, tag);
      return;
    }
    for (int rank = 1; rank < count_; ++rank) send(message(rank), rank, tag);
    own = message(0);
  });
  return own;
}

std::vector<Bytes> Process::collected(const Bytes& own) const {
  constexpr int tag = 12;
  if (rank_ != 0) {
    send(own, 0, tag);
    return {};
  }
  std::vector<Bytes> all{own};
  for (int rank = 1; rank < count_; ++rank) all.push_back(received(rank, tag));
  return all;
}

std::vector<Bytes> Process::gathered(const Bytes& own) const {
  const int size = static_cast<int>(own.size());
  std::vector<int> sizes(static_cast<std::size_t>(count_)), starts{0};
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, comm_);
  for (const int s : sizes) starts.push_back(starts.back() + s);
  Bytes all(static_cast<std::size_t>(starts.back()));
  MPI_Allgatherv(own.data(), size, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE, comm_);
  std::vector<Bytes> of_rank;
  for (std::size_t r = 0; r < sizes.size(); ++r)
    of_rank.emplace_back(all.begin() + starts[r], all.begin() + starts[r + 1]);
  return of_rank;
}

void Process::end_all(const std::string& why) const {
  // All may fail at once; the first one to report ends the others before they report.
  std::this_thread::sleep_for(std::chrono::milliseconds(std::min(300 * rank_, 3000)));
  const std::string text = fmt::format("rank {} of {} ({}): {}", rank_, count_, machine_, why);
  std::fprintf(stderr, "scabo: %s\n", text.c_str());
  if (!directory_.empty()) result::mark_failed(directory_, text);
  MPI_Abort(comm_, failure);
  std::abort();
}

bool Process::agreed(const std::function<void()>& alone) const {
  Kind kind = Kind::none;
  Bytes words;
  std::exception_ptr own;
  const auto put = [&](Kind what, const std::string& text) {
    kind = what;
    words.assign(text.begin(), text.end());
    own = std::current_exception();
  };
  try {
    alone();
  } catch (const InputError& error) {
    kind = Kind::input;
    words = pack(error);
    own = std::current_exception();
  } catch (const std::bad_alloc&) {
    put(Kind::memory, run::not_enough_memory);
  } catch (const PetscFailure& error) {
    put(error.code == PETSC_ERR_MEM ? Kind::memory : Kind::other,
        error.code == PETSC_ERR_MEM ? run::not_enough_memory : error.what());
  } catch (const std::exception& error) {
    put(Kind::other, error.what());
  }
  std::vector<int> kinds(static_cast<std::size_t>(count_));
  const int mine = static_cast<int>(kind);
  MPI_Allgather(&mine, 1, MPI_INT, kinds.data(), 1, MPI_INT, comm_);
  const auto found = std::find_if(kinds.begin(), kinds.end(), [](int k) { return k != 0; });
  if (found == kinds.end()) return true;
  const int first = static_cast<int>(found - kinds.begin());
  if (first == 0 && rank_ == 0) std::rethrow_exception(own);
  constexpr int tag = 7;
  if (first != 0 && rank_ == first) {
    Packer packer;
    packer.add(machine_);
    packer.add_list(words);
    send(std::move(packer).take(), 0, tag);
  }
  if (rank_ != 0) return false;
  const Bytes message = received(first, tag);
  Unpacker unpacker(message);
  const std::string machine = unpacker.get_text();
  words = unpacker.get_list<char>();
  if (static_cast<Kind>(*found) == Kind::input) throw_input_error(words);
  throw RankFailed(
      fmt::format("rank {} of {} ({}): {}", first, count_, machine, std::string(words.begin(), words.end())));
}

void Process::together(const std::function<void()>& work) const {
  try {
    work();
  } catch (const std::bad_alloc&) {
    end_all(run::not_enough_memory);
  } catch (const PetscFailure& error) {
    end_all(error.code == PETSC_ERR_MEM ? run::not_enough_memory : error.what());
  } catch (const std::exception& error) {
    end_all(error.what());
  }
}

Share& Process::share(int id) {
  const auto found = shares_.find(id);
  ensure(found != shares_.end(), "a rank was asked for a part that it does not have");
  return *found->second;
}

MumpsFactor& Process::factor(int id) {
  const auto found = factors_.find(id);
  ensure(found != factors_.end(), "a rank was asked for a factor that it does not have");
  return *found->second;
}

void Process::read_model(const std::string* file, const std::vector<std::string>* settings,
                         const std::filesystem::path* directory) {
  Packer packer;
  if (file) {
    packer.add(*file);
    packer.add(directory->string());
    packer.add(settings->size());
    for (const std::string& setting : *settings) packer.add(setting);
  }
  const Bytes own = std::move(packer).take();
  const Bytes bytes = broadcast(file ? &own : nullptr);
  Unpacker unpacker(bytes);
  const std::string name = unpacker.get_text();
  directory_ = unpacker.get_text();
  std::vector<std::string> values(unpacker.get<std::size_t>());
  for (std::string& value : values) value = unpacker.get_text();
  agreed([&] {
    if (rank_ != 0) model_ = std::make_unique<model::Model>(input::read_model(name, input::parse_settings(values)));
  });
}

}  // namespace scabo::mpi
