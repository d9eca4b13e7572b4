// The usage of the program as data. This model is made from the declarations of the commands; the
// help and all other texts that list options are written from it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/argument_roles.h"
#include "commands/documentation.h"

namespace ibmfair::commands {

/// An option or a positional argument.
struct OptionUsage {
  std::string name;                     ///< `--cutoff`; for an argument `IN`
  std::string letter;                   ///< `-q`; empty: none
  std::string value;                    ///< placeholder of the value: `LENGTH`; empty: a flag
  std::string optional_value;           ///< placeholder of a flag's value that may be left out
  std::string type;                     ///< flag, integer, number, length, bytes, choice, file, ...
  std::vector<std::string> choices;     ///< all possible values; empty: not a choice
  std::vector<std::string> offers;      ///< some possible values
  std::string default_value;            ///< as typed on the command line; empty: none
  std::string default_text;             ///< in words, if there is no default value
  std::string unit;                     ///< of the value
  std::string group;                    ///< group of an option
  std::string help;                     ///< without unit and default
  std::vector<std::string> excludes;    ///< options that must not be given with this option
  std::vector<std::string> needs;       ///< options that must be given with this option
  Role role = Role::value;              ///< whether the value is a file to read or to write
  std::vector<std::string> extensions;  ///< extensions of the files to offer first
  bool required = false;
  bool repeatable = false;  ///< an argument that takes any number of values
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
  std::vector<OptionUsage> options;  ///< options that can be given instead of a command
  std::vector<CommandUsage> commands;
  std::vector<ExitCodeUsage> exit_codes;
  std::vector<VariableUsage> variables;  ///< environment variables
};

/// The usage of a command that was declared by its row of the command table.
CommandUsage usage_of_command(const CLI::App& command);

/// The usage of the program; the subcommands of `app` must be all its commands.
ProgramUsage usage_of_program(const CLI::App& app);

/// The names of the groups of the options, in the order of the options.
std::vector<std::string> groups_of(const std::vector<OptionUsage>& options);

/// The heading of an option or argument: `-q, --quiet`, `--cutoff LENGTH`,
/// `--metric mass|identity`, `IN`.
std::string heading_of(const OptionUsage& option);

/// The synopsis of a command: `ibmfair smooth IN OUT [OPTION...]`.
std::string synopsis_of(const CommandUsage& command);

/// The help of an option, followed by its unit, default, needed and excluded options in brackets. A
/// needed option of the same group is left out if it is among `others`.
std::string full_help_of(const OptionUsage& option, const std::vector<OptionUsage>& others);

}  // namespace ibmfair::commands
