// The exit codes of the program, and the only place where exceptions are mapped to exit codes.
#pragma once

#include <span>
#include <string_view>

#include "commands/console.h"

namespace ibmfair::commands {

enum class ExitCode {
  done = 0,
  not_reached = 1,  ///< ran, but did not achieve the requested result
  usage = 2,        ///< an option or argument that cannot be used
  bad_file = 3,     ///< an input that cannot be read or is malformed
  bad_mesh = 4,     ///< geometry that cannot be processed
  out_of_memory = 5,
  cannot_write = 6,
  internal_error = 70,  ///< a bug in the program
  interrupted = 130
};

/// A row of the help about exit codes; the codes of signals share one row.
struct ExitCodeMeaning {
  std::string_view code;
  std::string_view meaning;
};

std::span<const ExitCodeMeaning> exit_code_meanings();

/// The exit code of the exception being handled. Must be called in a catch block. Allocates no
/// memory.
ExitCode exit_code_of_current_exception();

/// Prints the message of the exception being handled, and returns its exit code. Must be called in
/// a catch block. Allocates no memory.
ExitCode print_current_exception(const Console& console);

}  // namespace ibmfair::commands
