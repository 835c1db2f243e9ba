// Exit statuses of the program.
#pragma once

namespace scabo::app {

enum ExitStatus : int {
  solved = 0,       ///< every increment is solved and certified
  wrong_input = 1,  ///< the command line, the model file or a file it names is wrong
  /// Not solved: `status` is `not_converged`, `mechanism`, `collapse` or, of a problem file, `infeasible`. Finished
  /// increments are kept.
  not_converged = 2,
  failure = 3,      ///< any other failure: a file cannot be written, memory is insufficient, or a bug
  signalled = 128,  ///< plus the number of the signal: 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP
};

}  // namespace scabo::app
