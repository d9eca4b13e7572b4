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
      {"optional_value", text_or_null(option.optional_value)},
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

/// The list of json_of(row) for all rows.
template <class Row, class JsonOf>
ordered_json list_of(const std::vector<Row>& rows, const JsonOf& json_of) {
  ordered_json list = ordered_json::array();
  for (const Row& row : rows) {
    list.push_back(json_of(row));
  }
  return list;
}

ordered_json example_json(const Example& example) {
  return {{"command", example.command}, {"meaning", example.meaning}};
}

ordered_json command_json(const CommandUsage& command) {
  return {{"name", command.name},
          {"summary", command.summary},
          {"usage", synopsis_of(command)},
          {"arguments", list_of(command.arguments, argument_json)},
          {"options", list_of(command.options, option_json)},
          {"examples", list_of(command.examples, example_json)}};
}

/// An exit code of digits becomes a number; the code `128 + n` stays a text.
ordered_json code_json(const std::string& code) {
  const bool number =
      std::all_of(code.begin(), code.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? ordered_json(std::stoi(code)) : ordered_json(code);
}

ordered_json exit_code_json(const ExitCodeUsage& row) {
  return {{"code", code_json(row.code)}, {"meaning", row.meaning}};
}

ordered_json variable_json(const VariableUsage& variable) {
  return {{"name", variable.name}, {"meaning", variable.meaning}};
}

ordered_json program_json(const ProgramUsage& program, const std::vector<CommandUsage>& commands) {
  return {{"version", usage_version},
          {"program", "ibmfair " + program.version},
          {"summary", program.summary},
          {"options", list_of(program.options, option_json)},
          {"exit_codes", list_of(program.exit_codes, exit_code_json)},
          {"environment", list_of(program.variables, variable_json)},
          {"commands", list_of(commands, command_json)}};
}

}  // namespace

std::string usage_json(const ProgramUsage& program) {
  return text_of(program_json(program, program.commands));
}

std::string usage_json(const ProgramUsage& program, const CommandUsage& command) {
  return text_of(program_json(program, {command}));
}

}  // namespace ibmfair::commands
