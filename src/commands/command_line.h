// The command line: the table of commands, declared and ready to parse.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

/// Arguments that do not fit any command's declaration; the help tells more.
class Misuse : public BadOption {
 public:
  using BadOption::BadOption;
};

class CommandLine {
 public:
  /// Of every command, each declared when it is named or asked about. With `many_files`, those that
  /// map one mesh to one mesh take any number of them and --out-dir (commands/many_files.h).
  explicit CommandLine(bool many_files = false);

  /// Declares the command of this name alone. Throws BadOption with a suggestion where there is
  /// none.
  explicit CommandLine(std::string_view command);

  /// Declares this command alone, which has to outlive the line.
  explicit CommandLine(const Command& command);

  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Parses the program's arguments, once: the command's name first. Returns the text to print
  /// where --help or --version ask for one. Throws Misuse and, for values, BadOption.
  std::optional<std::string> parse(std::vector<std::string> words);

  /// The command that the arguments named; before parsing, the only one there is.
  CLI::App& command();

  /// Where the help is that would have told what to write.
  std::string help_hint() const;

  /// After a Misuse without a command: the commands that most people need; else empty.
  std::string first_commands() const;

  /// Does what the parsed arguments ask for.
  ExitCode run(Console& console);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ibmfair::commands
