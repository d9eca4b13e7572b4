// The command line: a parser for the commands of the table.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

/// Arguments that do not match the declaration of a command. The message should be followed by a
/// hint to the help.
class Misuse : public BadOption {
 public:
  using BadOption::BadOption;
};

class CommandLine {
 public:
  /// A parser for all commands. The options of a command are declared only when the command is
  /// named or asked about.
  CommandLine();

  /// Declares only the command with this name. If there is no such command, throws BadOption with a
  /// suggestion.
  explicit CommandLine(std::string_view command);

  /// Declares only this command, which must outlive the CommandLine.
  explicit CommandLine(const Command& command);

  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Parses the program's arguments, of which the first is the command's name; may be called once.
  /// If an option such as --help or --version asks for a text, returns the text to print. Throws
  /// Misuse, and BadOption for unacceptable values.
  std::optional<std::string> parse(std::vector<std::string> words);

  /// The command that the arguments named. Before parsing there must be only one command.
  CLI::App& command();

  /// A sentence that names the help command to type, for messages about misuse.
  std::string help_hint() const;

  /// If the arguments named no command: examples of the most common commands; else empty.
  std::string first_commands() const;

  /// Runs the command with the parsed arguments.
  ExitCode run(Host& host);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ibmfair::commands
