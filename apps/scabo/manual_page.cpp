// `scabo manual`: the manual page, in the language of man(7).
#include <fmt/format.h>

#include "command_description.hpp"
#include "scabo/result/version.hpp"

namespace scabo::app {

namespace {

/// Text as it stands: a backslash and a hyphen mean something to roff, and so does a dot or a quotation mark that
/// begins a line.
std::string roff(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == '\n';
    if (begins && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\')
      result += "\\e";
    else if (text[i] == '-')
      result += "\\-";
    else
      result += text[i];
  }
  return result;
}

std::string synopsis(const CommandDescription& command) {
  std::string text = fmt::format(".SY \"scabo {}\"\n", command.name);
  for (const OptionDescription& argument : command.arguments) text += fmt::format(".I {}\n", roff(argument.value));
  if (!command.options.empty()) text += ".RI [ options ]\n";
  return text + ".YS\n";
}

std::string entry(const OptionDescription& option) {
  std::string head;
  for (const std::string& flag : option.flags)
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(flag));
  if (!option.value.empty()) {
    const bool attached = option.value.starts_with("[");
    head += fmt::format("{}\\fI{}\\fR", head.empty() || attached ? "" : " ", roff(option.value));
  }
  std::string text = option.text;
  if (option.kind == ValueKind::choice) text += fmt::format(": {}", fmt::join(option.choices, ", "));
  return fmt::format(".TP\n{}\n{}\n", head, roff(text));
}

std::string entries(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& argument : command.arguments) text += entry(argument);
  for (const OptionDescription& option : command.options) text += entry(option);
  return text;
}

/// With its line breaks.
std::string as_printed(const std::string& text) { return fmt::format(".nf\n{}\n.fi\n", roff(text)); }

}  // namespace

std::string manual_page(const std::vector<CommandDescription>& commands) {
  const CommandDescription& program = commands.front();
  std::string text = fmt::format(".\\\" Written by `scabo manual`.\n.TH SCABO 1 \"\" \"scabo {}\" \"User Commands\"\n",
                                 result::version());
  text += ".SH NAME\nscabo \\- frictional contact by the scaled boundary finite element method\n.SH SYNOPSIS\n";
  for (std::size_t i = 1; i < commands.size(); ++i) text += synopsis(commands[i]);
  text +=
      ".SH DESCRIPTION\nScabo solves plane problems of elastic bodies in frictional contact, described by a model "
      "file in YAML.\nEvery result is certified: equilibrium, penetration and Coulomb's law are checked after the "
      "solve.\n.SH OPTIONS\n";
  text += entries(program) + ".SH COMMANDS\n";
  for (std::size_t i = 1; i < commands.size(); ++i)
    text += fmt::format(".SS scabo {}\n{}.\n{}{}", commands[i].name, roff(commands[i].text), entries(commands[i]),
                        commands[i].footer.empty() ? "" : ".PP\n" + as_printed(commands[i].footer));
  text += ".SH EXIT STATUS\n" + as_printed(program.footer.substr(program.footer.find('\n') + 1));
  text +=
      ".SH ENVIRONMENT\n.TP\n.B SCABO_PYTHON\nPython interpreter for \\fBscabo plot\\fR and \\fBscabo report\\fR; "
      "default: the first of /usr/bin/python3 and python3 that has Matplotlib, or for a report NumPy\n"
      ".TP\n.B NO_COLOR\nIf set, messages have no colour\n";
  return text;
}

}  // namespace scabo::app
