#include "command_description.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace scabo::app {

namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Of `TEXT:{stress,contact}`, the type of an option that accepts certain words only.
std::vector<std::string> choices_in(const std::string& type) {
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

ValueKind kind_of(const std::string& value) {
  if (value == "MODEL") return ValueKind::model;
  if (value == "DIR") return ValueKind::directory;
  if (value == "FILE" || value == "NEW" || value == "DECK") return ValueKind::file;
  return ValueKind::other;
}

OptionDescription describe(const CLI::Option& option) {
  OptionDescription description;
  for (const std::string& name : option.get_snames()) description.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) description.flags.push_back("--" + name);
  description.text = one_line(option.get_description());
  const bool takes_value = option.get_items_expected_max() > 0 && option.get_items_expected_min() > 0;
  if (description.flags.empty())
    description.value = option.get_name(true, false);
  else if (option.get_items_expected_max() > 0)
    description.value = option.get_option_text();
  description.choices = choices_in(option.get_type_name());
  if (!description.choices.empty())
    description.kind = ValueKind::choice;
  else if (takes_value)
    description.kind = kind_of(description.value);
  description.repeats = option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
  return description;
}

CommandDescription describe(const CLI::App& app, bool program) {
  CommandDescription command;
  command.name = program ? "" : app.get_name();
  command.text = app.get_description();
  command.footer = CLI::detail::trim_copy(app.get_footer());
  for (const CLI::Option* option : app.get_options()) {
    OptionDescription description = describe(*option);
    (description.flags.empty() ? command.arguments : command.options).push_back(std::move(description));
  }
  return command;
}

}  // namespace

std::vector<CommandDescription> describe_commands(const CLI::App& app) {
  std::vector<CommandDescription> commands = {describe(app, true)};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(describe(*command, false));
  return commands;
}

}  // namespace scabo::app
