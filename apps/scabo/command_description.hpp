// The command line as data: what its parser accepts, for completion in shells and for the manual page. Everything is
// read from the parser itself, so that neither can say anything else.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace scabo::app {

enum class ValueKind { none, model, directory, file, choice, other };

struct OptionDescription {
  std::vector<std::string> flags;    ///< `-o`, `--output`; empty for an argument without a flag
  std::string value;                 ///< what help calls it, `DIR`; empty for a flag without a value
  ValueKind kind = ValueKind::none;  ///< what completes it
  std::vector<std::string> choices;  ///< of ValueKind::choice
  std::string text;                  ///< one sentence, without line breaks
  bool repeats = false;              ///< may be given more than once

  bool takes_value() const { return kind != ValueKind::none; }
};

struct CommandDescription {
  std::string name;  ///< empty for the program itself
  std::string text;
  std::vector<OptionDescription> options, arguments;
  std::string footer;  ///< example and remarks, with line breaks
};

/// The program first, then its commands in the order of help.
std::vector<CommandDescription> describe_commands(const CLI::App& app);

/// A script for bash, zsh or fish.
std::string completion_script(const std::vector<CommandDescription>& commands, const std::string& shell);

/// The manual page scabo(1), for man.
std::string manual_page(const std::vector<CommandDescription>& commands);

}  // namespace scabo::app
