// Runs command lines as a shell does.
#pragma once

#include <string>

namespace ibmfair::test {

struct ShellResult {
  int exit_code = -1;
  std::string out;  ///< the text of standard output and standard error
};

/// Runs the line with `sh -c` in the folder; the program under test can be called as `ibmfair`.
ShellResult run_shell(const std::string& line, const std::string& folder);

/// Whether there is a program of this name.
bool is_installed(const std::string& program);

/// The text in single quotes, so that a shell takes it as one word.
std::string shell_quoted(const std::string& text);

}  // namespace ibmfair::test
