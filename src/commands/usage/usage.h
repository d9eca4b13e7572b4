// What the program can be told, as data: one model, made of the declarations of the commands, from
// which the help and everything else that lists options are written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/argument_roles.h"
#include "commands/documentation.h"

namespace ibmfair::commands {

/// An option, or an argument that is known by its place.
struct OptionUsage {
  std::string name;                     ///< `--cutoff`; of an argument `IN`
  std::string letter;                   ///< `-q`; empty: none
  std::string value;                    ///< what stands for its value: `LENGTH`; empty: a flag
  std::string type;                     ///< flag, integer, number, length, bytes, choice, file, ...
  std::vector<std::string> choices;     ///< all the values there are; empty: not that few
  std::vector<std::string> offers;      ///< some of them
  std::string default_value;            ///< as it would be typed; empty: none
  std::string default_text;             ///< in words where there is no such value
  std::string unit;                     ///< of the value
  std::string group;                    ///< of an option
  std::string help;                     ///< without unit and default
  std::vector<std::string> excludes;    ///< options that cannot be given with it
  std::vector<std::string> needs;       ///< options that have to be given with it
  Role role = Role::value;              ///< whether it names a file, and what becomes of that
  std::vector<std::string> extensions;  ///< of such files, those to offer first
  bool required = false;
  bool repeatable = false;  ///< an argument that stands for any number
};

struct CommandUsage {
  std::string name, summary;
  std::vector<OptionUsage> arguments;
  std::vector<OptionUsage> options;  ///< group by group
  std::vector<Example> examples;
  std::vector<Section> sections;
};

struct ExitCodeUsage {
  std::string code, meaning;
};

struct VariableUsage {
  std::string name, meaning;
};

struct ProgramUsage {
  std::string version, summary;
  std::vector<OptionUsage> options;  ///< in place of a command
  std::vector<CommandUsage> commands;
  std::vector<ExitCodeUsage> exit_codes;
  std::vector<VariableUsage> variables;  ///< of the environment
};

/// Of a command that is declared as it is in the table.
CommandUsage usage_of_command(const CLI::App& command);

/// Of the program whose subcommands are all commands.
ProgramUsage usage_of_program(const CLI::App& app);

/// The names of the groups that the options belong to, in their order.
std::vector<std::string> groups_of(const std::vector<OptionUsage>& options);

/// `-q, --quiet`, `--cutoff LENGTH`, `--metric mass|identity`, `IN`.
std::string heading_of(const OptionUsage& option);

/// `ibmfair smooth IN OUT [OPTION...]`.
std::string synopsis_of(const CommandUsage& command);

/// The help, and in brackets unit, default, and what it needs and excludes.
std::string full_help_of(const OptionUsage& option, const std::vector<OptionUsage>& others);

}  // namespace ibmfair::commands
