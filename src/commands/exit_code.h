// What the program tells its caller, and the one place where failures are mapped to it.
#pragma once

#include <span>
#include <string_view>

#include "commands/console.h"

namespace ibmfair::commands {

enum class ExitCode {
  done = 0,
  not_reached = 1,  ///< ran, but did not reach what was asked
  usage = 2,        ///< an option or argument that cannot be used
  bad_file = 3,     ///< an input that cannot be read or is malformed
  bad_mesh = 4,     ///< geometry that cannot be processed
  out_of_memory = 5,
  cannot_write = 6,
  internal_error = 70,  ///< a mistake in the program itself
  interrupted = 130
};

/// What the help says of a code; the codes of signals share a row.
struct ExitCodeMeaning {
  std::string_view code;
  std::string_view meaning;
};

std::span<const ExitCodeMeaning> exit_code_meanings();

/// The code of the exception being handled; call it in a catch block only. It needs no memory.
ExitCode exit_code_of_current_exception();

/// Says what the exception being handled is about, and returns its exit code; call it in a catch
/// block only. It needs no memory.
ExitCode tell_of_current_exception(const Console& console);

}  // namespace ibmfair::commands
