// The state of the process before any work: enough address space for BLAS, three open standard streams, and signals
// that would end a run in the middle of a file.
#pragma once

namespace scabo::app {

/// To be called first in main.
///
/// - Standard input, output and error are open afterwards. Where the caller closed one, the next file that is opened
///   would get its number, and text for the screen would go into it. What stands in for a closed stream refuses to be
///   written, so that the error is seen.
/// - SIGXFSZ is ignored: a file that reaches the limit of `ulimit -f` is then an error with a name.
/// - std::bad_alloc where no exception may pass ends the program with status 3 and a sentence.
/// - Where memory is scarce, the buffer of BLAS and a part of the stack are taken now.
///
/// The check of memory itself runs before main, and before the initialisers of shared libraries: OpenBLAS maps a buffer
/// of 128 MB for each of its threads while it is loaded and more when they change, and tries again for ever where it gets none. Then its
/// threads are limited to one, for which the program starts itself again; where that does not fit either, it ends
/// with status 3 and says what is needed.
void prepare_process();

/// `wanted`, whose buffers are taken then, or 1 where the limit on memory leaves no room for the buffers and stacks of so
/// many threads.
int threads_that_fit(int wanted);

/// Text on standard output or error may be read by a program that ends early (`| head`): writing then fails, and
/// does not end this program. For runs, whose results are files.
void ignore_broken_pipes();

constexpr const char* not_enough_memory =
    "not enough memory for this model or problem: make its mesh coarser (`scabo check` prints the sizes), or raise the "
    "limit (`ulimit -v`)";

}  // namespace scabo::app
