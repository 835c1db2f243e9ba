// Preparation of the process before any work: sufficient address space for BLAS, three open standard streams, and
// handling of signals that would end a run in the middle of a file.
#pragma once

namespace scabo::app {

/// To be called first in main.
///
/// - Standard input, output and error are open afterwards. Where the caller closed one, the next file that is opened
///   would get its number, and text for the screen would go into it. The replacement of a closed stream cannot be
///   written to, so that the error is noticed.
/// - SIGXFSZ is ignored: a file that reaches the limit of `ulimit -f` is then an error that names the file.
/// - std::bad_alloc that cannot be caught elsewhere ends the program with status 3 and a message.
/// - If memory is scarce, the buffer of BLAS and a part of the stack are allocated now.
///
/// The check of memory itself runs before main and before the initialisers of shared libraries: OpenBLAS allocates a
/// buffer of 128 MB for each of its threads while it is loaded, more when their number changes, and retries forever if
/// it gets none. In that case its threads are limited to one, and the program restarts itself; if memory is still
/// insufficient, it ends with status 3 and states the amount needed.
void prepare_process();

/// Memory that is freed remains with the process.
void keep_memory();

/// `wanted`, whose buffers are then allocated, or 1 if the limit on memory leaves no room for the buffers and stacks of
/// so many threads.
int threads_that_fit(int wanted);

/// The reader of standard output or error may end early (`| head`): writing then fails, but does not end this program.
/// For runs, whose results are files.
void ignore_broken_pipes();

}  // namespace scabo::app
