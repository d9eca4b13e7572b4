// The interface of a command. A new command is one file that defines a `declare_...` function, and
// one row in table.cpp.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "commands/exit_code.h"
#include "commands/host.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// Runs a command with the arguments that were parsed before. Reports failure by throwing one of
/// the library's exceptions.
using Runner = std::function<ExitCode(Host& host)>;

struct Command {
  std::string_view name;
  std::string_view summary;  ///< one line for the list of commands

  /// Declares the command's arguments and options, and documents them with examples
  /// (commands/documentation.h); help, man pages and completions are made from this documentation.
  /// The parsed values are stored in an object that the returned runner shares. Options that every
  /// command has (--quiet, -v, --threads) are not declared here.
  Runner (*declare)(CLI::App& app);
};

/// All commands, in the order in which `ibmfair --help` lists them.
std::span<const Command> command_table();

}  // namespace ibmfair::commands
