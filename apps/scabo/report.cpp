// `scabo report` and the end of `scabo run --report`: a page for the browser by the Python program beside this one
// (python/scabo/report), which fills the page built from report/.
#include "report.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "commands.hpp"
#include "python_program.hpp"
#include "terminal.hpp"

namespace scabo::app {

ExitStatus report(const std::vector<std::string>& arguments) { return become(command_of(reports()), arguments); }

ReportAtEnd::ReportAtEnd() : command_(command_of(reports())) {
  const std::filesystem::path page = data_folder() / "report_template.html";
  std::error_code error;
  if (!std::filesystem::exists(page, error))
    throw std::runtime_error(
        fmt::format("the page for reports is not at {}: `make report` in the sources of Scabo builds it, then `make "
                    "install` (it needs Node.js 18 or newer and npm: apt install nodejs npm); or run without --report",
                    page.string()));
}

ExitStatus ReportAtEnd::write(const std::filesystem::path& directory, ExitStatus status, bool quiet) const {
  std::vector<std::string> arguments = {directory.string()};
  if (quiet) arguments.insert(arguments.begin(), "--quiet");
  if (run_and_wait(command_, arguments) == 0) return status;
  print_error(fmt::format("the report was not written; the results are complete, and `scabo report {}` makes it again",
                          directory.string()));
  return status == ExitStatus::solved ? ExitStatus::failure : status;
}

}  // namespace scabo::app
