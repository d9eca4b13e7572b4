#include "commands/usage/usage.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/exit_code.h"
#include "ibmfair/base/instruction_set.h"
#include "ibmfair/base/version.h"

namespace ibmfair::commands {

namespace {

/// The shared groups, which are listed after a command's own groups.
constexpr std::array last_groups{groups::energy_and_flow,  groups::solver_and_memory,
                                 groups::input_and_output, groups::reports_and_pictures,
                                 groups::many_files,       groups::every_command};

/// The choices in the parser's type name of an option, which is as `TEXT:{mass,identity}`.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{');
  if (open == std::string::npos || type.back() != '}') {
    return {};
  }
  return CLI::detail::split(type.substr(open + 1, type.size() - open - 2), ',');
}

std::string type_of(const OptionUsage& option) {
  static const std::map<std::string, std::string> types{
      {"", "flag"},         {"N", "integer"},
      {"NUMBER", "number"}, {"BYTES", "bytes"},
      {"LENGTH", "length"}, {"DIR", "directory"},
      {"FILE", "file"},     {"NAME|FILE", "name or file"}};
  if (!option.choices.empty()) {
    return "choice";
  }
  if (option.role == Role::reads || option.role == Role::writes) {
    return "file";
  }
  const auto known = types.find(option.value);
  return known == types.end() ? "text" : known->second;
}

/// The placeholder of the value in the help.
std::string value_of(const CLI::Option& option, const OptionUsage& usage) {
  if (is_flag(option)) {
    return "";
  }
  if (!usage.choices.empty()) {
    return fmt::format("{}", fmt::join(usage.choices, "|"));
  }
  const std::string type = option.get_type_name();
  return type == file_to_write ? file_to_read : type;
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* option : options) {
    names.push_back(option->get_name());
  }
  std::sort(names.begin(), names.end());  // because the set is ordered by addresses
  return names;
}

OptionUsage usage_of_option(const CLI::Option& option, const OptionNote& note) {
  OptionUsage usage;
  usage.name = option.get_positional() ? option.get_single_name() : option.get_name();
  usage.letter = option.get_snames().empty() ? "" : "-" + option.get_snames().front();
  usage.choices = choices_in(option.get_type_name());
  usage.role = role_of(option);
  usage.value = value_of(option, usage);
  usage.optional_value = has_optional_value(option) ? option.get_type_name() : "";
  usage.type = type_of(usage);
  usage.offers = note.offers;
  usage.default_text = note.default_text;
  usage.default_value = note.default_text.empty() ? option.get_default_str() : "";
  usage.unit = note.unit;
  usage.group = option.get_group();
  usage.help = option.get_description();
  usage.excludes = names_of(option.get_excludes());
  usage.needs = names_of(option.get_needs());
  usage.extensions = note.extensions;
  usage.required = option.get_required();
  usage.repeatable = option.get_positional() && option.get_items_expected_max() > 1;
  return usage;
}

void sort_by_group(std::vector<OptionUsage>& options) {
  std::map<std::string, std::size_t> rank;
  for (const OptionUsage& option : options) {
    rank.try_emplace(option.group, rank.size());
  }
  for (std::size_t i = 0; i < last_groups.size(); ++i) {
    rank[last_groups[i]] = options.size() + i;
  }
  std::stable_sort(options.begin(), options.end(), [&](const OptionUsage& a, const OptionUsage& b) {
    return rank[a.group] < rank[b.group];
  });
}

/// Adds the arguments and options of `app` itself, without hidden options.
void add_options(const CLI::App& app, const std::map<std::string, OptionNote>& notes,
                 std::vector<OptionUsage>& arguments, std::vector<OptionUsage>& options) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) {
      continue;
    }
    const auto note = notes.find(option->get_name(true, true));
    (option->get_positional() ? arguments : options)
        .push_back(usage_of_option(*option, note == notes.end() ? OptionNote{} : note->second));
  }
  sort_by_group(options);
}

std::vector<VariableUsage> variables() {
  return {
      {"COLUMNS", "the width of the help, in place of the terminal's (80 to 110)"},
      {"NO_COLOR", "where set, nothing is coloured and no line is redrawn with escape codes"},
      {"CLICOLOR_FORCE", "where set and not 0, messages are coloured even if not on a terminal"},
      {"TERM", "`dumb`: no colours, no progress"},
      {kernels_variable,
       "`baseline`: do without the processor's AVX2, to see whether results depend on it"},
      {"SOURCE_DATE_EPOCH", "the date of the man page, in seconds since 1970"}};
}

}  // namespace

CommandUsage usage_of_command(const CLI::App& command) {
  const Documentation& documentation = documentation_of(command);
  CommandUsage usage;
  usage.name = command.get_name();
  usage.summary = command.get_description();
  add_options(command, documentation.notes, usage.arguments, usage.options);
  usage.examples = documentation.examples;
  usage.sections = documentation.sections;
  return usage;
}

ProgramUsage usage_of_program(const CLI::App& app) {
  ProgramUsage usage;
  usage.version = version();
  usage.summary = app.get_description();
  std::vector<OptionUsage> none;
  add_options(app, {}, none, usage.options);
  for (const CLI::App* command : app.get_subcommands({})) {
    usage.commands.push_back(usage_of_command(*command));
  }
  for (const ExitCodeMeaning& row : exit_code_meanings()) {
    usage.exit_codes.push_back({std::string(row.code), std::string(row.meaning)});
  }
  usage.variables = variables();
  return usage;
}

std::vector<std::string> groups_of(const std::vector<OptionUsage>& options) {
  std::vector<std::string> names;
  for (const OptionUsage& option : options) {
    if (names.empty() || names.back() != option.group) {
      names.push_back(option.group);
    }
  }
  return names;
}

std::string heading_of(const OptionUsage& option) {
  std::string text = option.letter.empty() ? option.name : option.letter + ", " + option.name;
  if (!option.value.empty() && option.name.starts_with('-')) {
    text += " " + option.value;
  }
  if (!option.optional_value.empty()) {
    text += fmt::format(" [{}]", option.optional_value);
  }
  return text;
}

std::string synopsis_of(const CommandUsage& command) {
  std::string text = "ibmfair " + command.name;
  for (const OptionUsage& argument : command.arguments) {
    const std::string word = argument.name + (argument.repeatable ? "..." : "");
    text += argument.required ? fmt::format(" {}", word) : fmt::format(" [{}]", word);
  }
  return text + " [OPTION...]";
}

std::string full_help_of(const OptionUsage& option, const std::vector<OptionUsage>& others) {
  std::vector<std::string> remarks;
  if (!option.unit.empty()) {
    remarks.push_back("unit: " + option.unit);
  }
  if (const std::string& given = option.default_text + option.default_value; !given.empty()) {
    remarks.push_back("default: " + given);
  }
  for (const std::string& needed : option.needs) {
    // A needed option of the same group is explained nearby, so it is not mentioned.
    if (std::none_of(others.begin(), others.end(), [&](const OptionUsage& other) {
          return other.name == needed && other.group == option.group;
        })) {
      remarks.push_back("needs " + needed);
    }
  }
  if (!option.excludes.empty()) {
    remarks.push_back(fmt::format("not with {}", fmt::join(option.excludes, ", ")));
  }
  return remarks.empty() ? option.help
                         : fmt::format("{} [{}]", option.help, fmt::join(remarks, "; "));
}

}  // namespace ibmfair::commands
