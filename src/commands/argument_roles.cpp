#include "commands/argument_roles.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace ibmfair::commands {

namespace {

CLI::Option* first_argument(CLI::App& command, Role role) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_positional() && role_of(*option) == role) {
      return option;
    }
  }
  return nullptr;
}

}  // namespace

Role role_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string argument = option.get_positional() ? option.get_single_name() : "";
  if (type == file_to_write || argument == "OUT") {
    return Role::writes;
  }
  if (type == file_to_read || argument == "IN") {
    return Role::reads;
  }
  return type == name_or_file_to_read ? Role::might_read : Role::value;
}

std::string key_of(const CLI::Option& option) {
  if (!option.get_positional()) {
    return option.get_lnames().front();
  }
  const std::string& name = option.get_single_name();
  if (name == "IN") {
    return "input";
  }
  if (name == "OUT") {
    return "output";
  }
  return CLI::detail::to_lower(name);
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

bool has_optional_value(const CLI::Option& option) {
  return is_flag(option) && !option.get_type_name().empty();
}

std::vector<std::string> given_values(const CLI::Option& option) {
  const bool alone = is_flag(option) && (!has_optional_value(option) || option.count() == 0 ||
                                         option.results().back() == flag_alone);
  if (alone) {
    return {};
  }
  return is_flag(option) ? std::vector{option.results().back()} : option.results();
}

bool is_given(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

CLI::Option* input_argument(CLI::App& command) {
  return first_argument(command, Role::reads);
}

CLI::Option* output_argument(CLI::App& command) {
  return first_argument(command, Role::writes);
}

const CLI::Option* find_argument(const CLI::App& command, std::string_view key, bool positional) {
  const auto options = command.get_options([&](const CLI::Option* option) {
    return option->get_configurable() && option->get_positional() == positional &&
           key_of(*option) == key;
  });
  return options.empty() ? nullptr : options.front();
}

}  // namespace ibmfair::commands
