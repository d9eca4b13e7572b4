#include "commands/usage/usage_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "commands/shared_options.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr int usage_version = 1;

ordered_json text_or_null(const std::string& text) {
  return text.empty() ? ordered_json() : ordered_json(text);
}

const char* file_use(Role role) {
  switch (role) {
    case Role::value:
      break;
    case Role::reads:
      return "reads";
    case Role::might_read:
      return "reads it if there is one of that name";
    case Role::writes:
      return "writes";
  }
  return "";
}

ordered_json argument_json(const OptionUsage& argument) {
  return {{"name", argument.name},
          {"type", argument.type},
          {"required", argument.required},
          {"repeatable", argument.repeatable},
          {"choices", argument.choices},
          {"offers", argument.offers},
          {"unit", text_or_null(argument.unit)},
          {"default", text_or_null(argument.default_value)},
          {"file", text_or_null(file_use(argument.role))},
          {"extensions", argument.extensions},
          {"help", argument.help}};
}

ordered_json option_json(const OptionUsage& option) {
  return {
      {"name", option.name},
      {"short_name", text_or_null(option.letter)},
      {"type", option.type},
      {"value", text_or_null(option.value)},
      {"choices", option.choices},
      {"offers", option.offers},
      {"unit", text_or_null(option.unit)},
      {"default", option.type == "flag" ? ordered_json(false) : text_or_null(option.default_value)},
      {"default_text", text_or_null(option.default_text)},
      {"group", option.group},
      {"excludes", option.excludes},
      {"needs", option.needs},
      {"file", text_or_null(file_use(option.role))},
      {"extensions", option.extensions},
      {"help", option.help}};
}

ordered_json options_json(const std::vector<OptionUsage>& options) {
  ordered_json list = ordered_json::array();
  for (const OptionUsage& option : options) {
    list.push_back(option_json(option));
  }
  return list;
}

ordered_json command_json(const CommandUsage& command) {
  ordered_json arguments = ordered_json::array(), examples = ordered_json::array();
  for (const OptionUsage& argument : command.arguments) {
    arguments.push_back(argument_json(argument));
  }
  for (const Example& example : command.examples) {
    examples.push_back({{"command", example.command}, {"meaning", example.meaning}});
  }
  return {{"name", command.name},
          {"summary", command.summary},
          {"usage", synopsis_of(command)},
          {"arguments", arguments},
          {"options", options_json(command.options)},
          {"examples", examples}};
}

/// An exit code of digits becomes a number; the code `128 + n` stays a text.
ordered_json code_json(const std::string& code) {
  const bool number =
      std::all_of(code.begin(), code.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? ordered_json(std::stoi(code)) : ordered_json(code);
}

ordered_json program_json(const ProgramUsage& program) {
  ordered_json codes = ordered_json::array(), variables = ordered_json::array();
  for (const ExitCodeUsage& row : program.exit_codes) {
    codes.push_back({{"code", code_json(row.code)}, {"meaning", row.meaning}});
  }
  for (const VariableUsage& variable : program.variables) {
    variables.push_back({{"name", variable.name}, {"meaning", variable.meaning}});
  }
  return {{"version", usage_version},
          {"program", "ibmfair " + program.version},
          {"summary", program.summary},
          {"options", options_json(program.options)},
          {"exit_codes", codes},
          {"environment", variables},
          {"commands", ordered_json::array()}};
}

}  // namespace

std::string usage_json(const ProgramUsage& program) {
  ordered_json json = program_json(program);
  for (const CommandUsage& command : program.commands) {
    json["commands"].push_back(command_json(command));
  }
  return text_of(json);
}

std::string usage_json(const ProgramUsage& program, const CommandUsage& command) {
  ordered_json json = program_json(program);
  json["commands"].push_back(command_json(command));
  return text_of(json);
}

}  // namespace ibmfair::commands
