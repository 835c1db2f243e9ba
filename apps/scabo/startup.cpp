#include "startup.hpp"

#include <fcntl.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

#include "exit_status.hpp"
#include "terminal.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SCABO_ADDRESS_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define SCABO_ADDRESS_SANITIZER 1
#endif

// Memory management of OpenBLAS; weak, so that any BLAS can be linked.
extern "C" {
[[gnu::weak]] void* blas_memory_alloc(int position);
[[gnu::weak]] void blas_memory_free(void* buffer);
}

namespace scabo::app {

namespace {

constexpr std::size_t megabyte = 1 << 20;
constexpr std::size_t blas_buffer = 128 * megabyte;  // OpenBLAS 0.3 on x86-64
/// Memory of each thread: buffer of BLAS, stack, and the reserve of malloc.
constexpr std::size_t of_a_thread = blas_buffer + 8 * megabyte + 64 * megabyte;
/// Other memory of a small model: the heap, and tables that libraries create at their start.
constexpr std::size_t for_work = 32 * megabyte;

/// Whether this amount could be allocated now, under the limits of this process. Nothing remains allocated.
bool is_free(std::size_t bytes) {
  void* const probe = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (probe == MAP_FAILED) return false;
  munmap(probe, bytes);
  return true;
}

bool room_for_threads(int count) { return is_free(static_cast<std::size_t>(count) * of_a_thread + 2 * for_work); }

/// Each thread of BLAS keeps a buffer, each thread that calls BLAS needs one, and one more is in use while their number
/// changes.
int buffers_of(int threads) { return 2 * threads + 1; }

/// Number of processors that this process may use, which is the number of threads that OpenBLAS creates.
int processors() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

void keep_open(int descriptor, int mode) {
  if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  // The lowest free descriptor is this one, because all lower ones are open at this point.
  [[maybe_unused]] const int opened = open("/dev/null", mode);
}

[[noreturn]] void end_after_an_exception() {
  const char* message = "scabo: the program ended unexpectedly: this is a bug, please report it\n";
  try {
    if (const std::exception_ptr exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    message = "scabo: not enough memory: make the mesh coarser, or raise the limit (`ulimit -v`)\n";
  } catch (...) {
  }
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, std::strlen(message));
  _exit(ExitStatus::failure);
}

/// The stack can grow only while there is address space; otherwise the program would end with SIGSEGV.
[[gnu::noinline]] void take_stack() {
  std::array<volatile char, megabyte> stack;
  for (std::size_t i = 0; i < stack.size(); i += 4096) stack[i] = 0;
}

/// BLAS keeps its buffers, and needs as many as threads are in it at once. A thread that comes first when the matrices
/// have taken the memory would wait for its buffer for ever.
void take_blas_buffers(int count) {
  if (!blas_memory_alloc || !blas_memory_free) return;
  std::vector<void*> buffers;
  for (int i = 0; i < count; ++i) buffers.push_back(blas_memory_alloc(0));
  for (void* buffer : buffers) blas_memory_free(buffer);
}

/// Of the signals held before main(), see hold_termination.
bool termination_held = false;
sigset_t signals_before;

}  // namespace

int threads_that_fit(int wanted) {
  if (wanted <= 1) return wanted;
  if (!room_for_threads(buffers_of(wanted))) return 1;
  take_blas_buffers(buffers_of(wanted));
  return wanted;
}

void keep_memory() {
#if defined(__GLIBC__)
  // Hundreds of matrices are allocated and freed. Returning each to the system and having it cleared again took a third
  // of the time of a small super-element (17 ms against 12 ms at 320 degrees of freedom).
  mallopt(M_MMAP_THRESHOLD, 256 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

void ignore_broken_pipes() { std::signal(SIGPIPE, SIG_IGN); }

void prepare_process() {
  if (termination_held) sigprocmask(SIG_SETMASK, &signals_before, nullptr);
  keep_open(STDIN_FILENO, O_WRONLY);
  keep_open(STDOUT_FILENO, O_RDONLY);
  keep_open(STDERR_FILENO, O_RDONLY);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(end_after_an_exception);
  if (room_for_threads(buffers_of(std::max(4, processors())))) return;
  take_stack();
  take_blas_buffers(1);
}

}  // namespace scabo::app

#if defined(__linux__) && !defined(SCABO_ADDRESS_SANITIZER)

namespace {

using scabo::app::blas_buffer;
using scabo::app::for_work;
using scabo::app::is_free;
using scabo::app::processors;

bool is_set(char* const* environment, const char* assignment) {
  for (; *environment; ++environment)
    if (std::strcmp(*environment, assignment) == 0) return true;
  return false;
}

void refuse() {
  char message[320] = "scabo: not enough memory: at its start the program needs about 250 MB of address space";
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    // stdio cannot be used here, because libraries are not initialised.
    char digits[24];
    int count = 0;
    for (rlim_t megabytes = limit.rlim_cur / 1'000'000; count == 0 || megabytes > 0; megabytes /= 10)
      digits[count++] = static_cast<char>('0' + megabytes % 10);
    std::strcat(message, ", and the limit is ");
    std::size_t end = std::strlen(message);
    while (count > 0) message[end++] = digits[--count];
    message[end] = '\0';
    std::strcat(message, " MB: raise it, as in `ulimit -v 500000`, in kB");
  }
  std::strcat(message, "\n");
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, std::strlen(message));
  _exit(scabo::app::ExitStatus::failure);
}

/// See prepare_process. Standard streams and the environment of the C library do not exist yet.
void check_memory(int, char** arguments, char** environment) {
  constexpr const char* one_thread = "OPENBLAS_NUM_THREADS=1";
  if (scabo::app::room_for_threads(scabo::app::buffers_of(processors()))) return;
  if (!is_set(environment, one_thread)) {
    int count = 0;
    while (environment[count]) ++count;
    constexpr int most = 4000;
    char* with_one_thread[most + 2];
    int kept = 0;
    with_one_thread[kept++] = const_cast<char*>(one_thread);
    for (int i = 0; i < count && kept <= most; ++i)
      if (std::strncmp(environment[i], one_thread, std::strlen(one_thread) - 1) != 0)
        with_one_thread[kept++] = environment[i];
    with_one_thread[kept] = nullptr;
    char program[4096];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length > 0) {
      program[length] = '\0';
      execve(program, arguments, with_one_thread);
    }
  }
  if (!is_free(blas_buffer + for_work)) refuse();
}

/// Until prepare_process, so that threads which libraries start, as OpenBLAS does, never take SIGTERM: where it waits
/// for the end of METIS (linalg/held_termination), it must not find another thread. Not under mpirun, which ends lost
/// runs by SIGTERM: there a rank would no longer record that end.
void hold_termination(int, char**, char** environment) {
  for (char* const* of = environment; *of; ++of)
    for (const char* launched : {"OMPI_COMM_WORLD_SIZE=", "PMI_SIZE=", "PMIX_RANK="})
      if (std::strncmp(*of, launched, std::strlen(launched)) == 0) return;
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGTERM);
  scabo::app::termination_held = sigprocmask(SIG_BLOCK, &held, &scabo::app::signals_before) == 0;
}

}  // namespace

// Functions listed here run before the initialisers of shared libraries.
[[gnu::section(".preinit_array"), gnu::used]] static void (*const check_memory_first)(int, char**,
                                                                                      char**) = check_memory;
[[gnu::section(".preinit_array"), gnu::used]] static void (*const hold_termination_next)(int, char**,
                                                                                         char**) = hold_termination;

#endif
