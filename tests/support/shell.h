// Runs command lines as a shell does.
#pragma once

#include <string>

namespace ibmfair::test {

struct ShellResult {
  int exit_code = -1;
  std::string out;  ///< of standard output and standard error
};

/// Runs the line with `sh -c` in the folder, the program under test being found as `ibmfair`.
ShellResult run_shell(const std::string& line, const std::string& folder);

/// Whether there is a program of this name.
bool is_installed(const std::string& program);

/// The text in single quotes, as a shell takes it.
std::string shell_quoted(const std::string& text);

}  // namespace ibmfair::test
