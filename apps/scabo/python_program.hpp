// The programs beside this one that are written in Python: pictures and reports (share/scabo/scabo_plot, scabo_report).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exit_status.hpp"

namespace scabo::app {

/// A program in Python that is installed with this one.
struct PythonProgram {
  std::string folder;                ///< in share/scabo
  std::string purpose;               ///< `pictures`, in messages
  std::vector<std::string> modules;  ///< what it needs of Python
  std::string needs;                 ///< the same for people, `NumPy and Matplotlib`
  std::string package;               ///< of Debian, which has them
};

/// Pictures by Matplotlib, and reports for a browser.
PythonProgram pictures();
PythonProgram reports();

/// `share/scabo` beside the program, in the build directory as where it is installed.
std::filesystem::path data_folder();

/// The words with which the program is started: interpreter, options, folder. The interpreter is the one named by
/// SCABO_PYTHON, otherwise the distribution's or the first on PATH that has the modules. Throws std::runtime_error if
/// there is none, or if the program is not at its place.
std::vector<std::string> command_of(const PythonProgram& program);

/// This process becomes the program, so that its output and exit status are those of the command; returns only by an
/// exception.
ExitStatus become(std::vector<std::string> command, const std::vector<std::string>& arguments);

/// Runs it and waits: its exit status, 128 and the signal if one ended it. Output and error are those of this process.
int run_and_wait(std::vector<std::string> command, const std::vector<std::string>& arguments);

}  // namespace scabo::app
