// `scabo completion`: scripts for shells.
#include <fmt/format.h>

#include "command_description.hpp"
#include "scabo/base/error.hpp"

namespace scabo::app {

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> flags_of(const CommandDescription& command) {
  std::vector<std::string> flags;
  for (const OptionDescription& option : command.options)
    flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  return flags;
}

std::vector<std::string> names_of(const std::vector<CommandDescription>& commands) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < commands.size(); ++i) names.push_back(commands[i].name);
  return names;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// What a shell does for each kind of value; `{}` in `choice` are the words.
struct ValueActions {
  std::string model, directory, file, choice, other;
};

std::string action_for(const OptionDescription& value, const ValueActions& actions) {
  switch (value.kind) {
    case ValueKind::model:
      return actions.model;
    case ValueKind::directory:
      return actions.directory;
    case ValueKind::file:
      return actions.file;
    case ValueKind::choice:
      return replaced(actions.choice, "{}", joined(value.choices, " "));
    case ValueKind::none:
    case ValueKind::other:
      return actions.other;
  }
  throw BrokenInvariant("a kind of value without a completion");
}

// bash

const ValueActions& in_bash() {
  static const ValueActions actions = {"_scabo_files '@(yaml|yml|json)'", "_scabo_directories", "_scabo_files '*'",
                                       "_scabo_words '{}'", ":"};
  return actions;
}

std::string bash_script(const std::vector<CommandDescription>& commands) {
  std::string text = R"(# Completion of scabo for bash, written by `scabo completion bash`.
_scabo_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_scabo_directories() { compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "$word"); }
_scabo_files() {
  local name extended
  extended=$(shopt -p extglob)
  shopt -s extglob
  compopt -o filenames
  while IFS= read -r name; do
    # shellcheck disable=SC2053  # a pattern
    if [[ -d $name || $1 == '*' || ${name##*.} == $1 ]]; then COMPREPLY+=("$name"); fi
  done < <(compgen -f -- "$word")
  eval "$extended"
}
_scabo() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command='' i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then command=${COMP_WORDS[i]}; break; fi
  done
  case $command in
)";
  for (const CommandDescription& command : commands) {
    text += fmt::format("    {})\n", command.name.empty() ? "''" : command.name);
    std::string cases;
    for (const OptionDescription& option : command.options)
      if (option.takes_value())
        cases += fmt::format("        {}) {}; return ;;\n", joined(option.flags, "|"), action_for(option, in_bash()));
    if (!cases.empty()) text += "      case $before in\n" + cases + "      esac\n";
    const std::string flags = joined(flags_of(command), " ");
    if (command.name.empty()) {
      text += fmt::format("      _scabo_words '{} {}' ;;\n", joined(names_of(commands), " "), flags);
    } else {
      text += fmt::format("      if [[ $word == -* ]]; then _scabo_words '{}'; else {}; fi ;;\n", flags,
                          command.arguments.empty() ? ":" : action_for(command.arguments.front(), in_bash()));
    }
  }
  return text + "  esac\n}\ncomplete -F _scabo scabo\n";
}

// zsh

std::string zsh_quoted(std::string text) {
  text = replaced(std::move(text), "'", "'\\''");
  for (const char* special : {"[", "]", ":"}) text = replaced(std::move(text), special, fmt::format("\\{}", special));
  return text;
}

const ValueActions& in_zsh() {
  static const ValueActions actions = {R"x(_files -g "*.(yaml|yml|json)")x", "_files -/", "_files", "({})", " "};
  return actions;
}

std::string zsh_option(const OptionDescription& option) {
  std::string spec = option.repeats            ? "'*'"
                     : option.flags.size() > 1 ? fmt::format("'({})'", joined(option.flags, " "))
                                               : "";
  spec += option.flags.size() > 1 ? fmt::format("{{{}}}", joined(option.flags, ",")) : option.flags.front();
  spec += fmt::format("'[{}]", zsh_quoted(option.text));
  if (option.takes_value()) spec += fmt::format(":{}:{}", zsh_quoted(option.value), action_for(option, in_zsh()));
  return spec + "'";
}

std::string zsh_script(const std::vector<CommandDescription>& commands) {
  std::string text = R"(#compdef scabo
# Completion of scabo for zsh, written by `scabo completion zsh`.
_scabo() {
  local state line
  local -a commands
  commands=(
)";
  for (std::size_t i = 1; i < commands.size(); ++i)
    text += fmt::format("    '{}:{}'\n", commands[i].name, zsh_quoted(commands[i].text));
  text += "  )\n  _arguments -C";
  for (const OptionDescription& option : commands.front().options) text += " \\\n    " + zsh_option(option);
  text +=
      " \\\n    '1:command:->command' '*::argument:->arguments'\n  case $state in\n"
      "    command) _describe command commands ;;\n    arguments)\n      case $line[1] in\n";
  for (std::size_t i = 1; i < commands.size(); ++i) {
    text += fmt::format("        {}) _arguments", commands[i].name);
    for (const OptionDescription& option : commands[i].options) text += " \\\n          " + zsh_option(option);
    for (const OptionDescription& argument : commands[i].arguments)
      text += fmt::format(" \\\n          '1:{}:{}'", zsh_quoted(argument.value), action_for(argument, in_zsh()));
    text += " ;;\n";
  }
  return text +
         "      esac ;;\n  esac\n}\nif [ \"$funcstack[1]\" = _scabo ]; then _scabo \"$@\"; else compdef _scabo scabo; "
         "fi\n";
}

// fish

std::string fish_quoted(std::string text) {
  return "'" + replaced(replaced(std::move(text), "\\", "\\\\"), "'", "\\'") + "'";
}

const ValueActions& in_fish() {
  static const ValueActions actions = {" -F", " -a '(__fish_complete_directories)'", " -F", " -a '{}'", ""};
  return actions;
}

std::string fish_option(const OptionDescription& option) {
  std::string text;
  for (const std::string& flag : option.flags)
    text += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
  if (option.takes_value()) text += " -x" + action_for(option, in_fish());
  return text + " -d " + fish_quoted(option.text);
}

std::string fish_script(const std::vector<CommandDescription>& commands) {
  std::string text = "# Completion of scabo for fish, written by `scabo completion fish`.\ncomplete -c scabo -f\n";
  for (const OptionDescription& option : commands.front().options)
    text += "complete -c scabo -n __fish_use_subcommand" + fish_option(option) + "\n";
  for (std::size_t i = 1; i < commands.size(); ++i) {
    const CommandDescription& command = commands[i];
    text += fmt::format("complete -c scabo -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        fish_quoted(command.text));
    const std::string here = fmt::format("complete -c scabo -n '__fish_seen_subcommand_from {}'", command.name);
    for (const OptionDescription& option : command.options) text += here + fish_option(option) + "\n";
    for (const OptionDescription& argument : command.arguments)
      if (const std::string value = action_for(argument, in_fish()); !value.empty()) text += here + value + "\n";
  }
  return text;
}

}  // namespace

std::string completion_script(const std::vector<CommandDescription>& commands, const std::string& shell) {
  if (shell == "bash") return bash_script(commands);
  if (shell == "zsh") return zsh_script(commands);
  if (shell == "fish") return fish_script(commands);
  throw BrokenInvariant("the command line accepts only the shells there are");
}

}  // namespace scabo::app
