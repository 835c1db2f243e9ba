// What the shell learns from a run.
#pragma once

namespace scabo::app {

enum ExitStatus : int {
  solved = 0,       ///< every increment solved and certified
  wrong_input = 1,  ///< the command line, the model file or a file it names is wrong
  not_converged =
      2,        ///< an increment did not converge, or is a mechanism (`status` tells which); those before it are kept
  failure = 3,  ///< anything else: a file cannot be written, memory runs out, a bug
  signalled = 128,  ///< plus the signal's number: 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP
};

}  // namespace scabo::app
